// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/inspect/solved_poses.h"

#include <algorithm>

#include "editor/inspect/point_colour.h"

namespace standpoint {

namespace {

const Station* stationOf(const Job& job, const std::string& scan, const std::filesystem::path& file) {
  const auto named =
      std::find_if(job.stations.begin(), job.stations.end(), [&](const Station& s) { return s.name == scan; });
  if (named != job.stations.end()) return &*named;
  const Station* only = nullptr;
  for (const auto& station : job.stations) {
    const bool has = std::any_of(station.scans.begin(), station.scans.end(),
                                 [&](const Scan& s) { return std::filesystem::path(s.file) == file; });
    if (has && only != nullptr) return nullptr;
    if (has) only = &station;
  }
  return only;
}

}  // namespace

std::vector<Pose> solvedMoves(const Job& job, const CloudHeader& header, const Eigen::Vector3d& shift_m,
                              std::span<const std::filesystem::path> files) {
  std::vector<Pose> moves;
  for (std::size_t i = 0; i < header.stations.size(); ++i) {
    const auto& scan = header.stations[i];
    const auto& file = files[std::min(i, files.size() - 1)];
    const Station* station = standsSomewhere(scan) ? stationOf(job, scan.name, file) : nullptr;
    Pose made = scan.file_from_scanner;
    made.translation -= shift_m;
    moves.push_back(station != nullptr && station->solved_pose ? *station->solved_pose * inverse(made) : Pose());
  }
  return moves;
}

std::vector<PoseOffset> poseOffsets(const Job& job) {
  std::vector<PoseOffset> offsets;
  for (const auto& station : job.stations) {
    if (station.scans.empty()) continue;
    PoseOffset offset{.station = station.name, .registered = station.solved_pose.has_value()};
    if (offset.registered) {
      offset.moved_m = (station.solved_pose->translation - station.true_pose.translation).norm();
      offset.turned_rad = station.solved_pose->rotation.angularDistance(station.true_pose.rotation);
    }
    offsets.push_back(offset);
  }
  return offsets;
}

bool hasSolvedPose(const Job& job) {
  return std::any_of(job.stations.begin(), job.stations.end(),
                     [](const Station& s) { return !s.scans.empty() && s.solved_pose; });
}

}  // namespace standpoint
