// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/json_file.h"
#include "survey/trajectories/formats.h"
#include "survey/trajectories/sample_taker.h"

// Our own: a line of JSON behind #, the names of the columns, and a line a sample with as many digits as a double
// needs.
namespace standpoint::trajectories {

namespace {

constexpr const char* kFormat = "standpoint-trajectory";
constexpr int kVersion = 1;
constexpr const char* kBody = "x forward, y left, z up";

// The file's frame, where the head says what it is.
Result<std::optional<Pose>> poseOfHead(std::string_view line) {
  TRY_ASSIGN(const auto head, parseJson(std::string(line.substr(1)), "head"));
  const auto format = head.find("format"), version = head.find("version");
  if (!head.is_object() || format == head.end() || *format != kFormat)
    return failure(ErrorKind::unusable, fmt::format("the head's format is not {}", kFormat));
  if (version == head.end() || *version != kVersion)
    return failure(ErrorKind::unusable,
                   "the head's version is not known; a newer version of this program wrote the file");
  const auto frame = head.find("map_from_local");
  if (frame == head.end()) return std::nullopt;
  try {
    const auto p = frame->at("translation_m").get<std::array<double, 3>>();
    const auto q = frame->at("rotation_xyzw").get<std::array<double, 4>>();
    return Pose{{q[3], q[0], q[1], q[2]}, {p[0], p[1], p[2]}};
  } catch (const nlohmann::json::exception&) {
    return failure(ErrorKind::unusable, "the head's map_from_local is no frame");
  }
}

}  // namespace

Result<ReadTrajectory> readOwn(const std::filesystem::path& file, const TrajectoryFrame&, Progress& progress) {
  TextTrack track{"csv", "this format", {8}, {}};
  bool headed = false;
  std::optional<Pose> file_from_local;
  track.names_first = true;
  track.comment = [&](std::string_view line) -> Result<void> {
    if (std::exchange(headed, true)) return {};
    TRY_ASSIGN(file_from_local, poseOfHead(line));
    return {};
  };
  track.sample = [&](const std::vector<double>& n, std::string_view) -> Result<TimedPose> {
    if (!headed) return failure(ErrorKind::unusable, "the head is missing: a line with # and JSON");
    return TimedPose{n[0], {{n[7], n[4], n[5], n[6]}, {n[1], n[2], n[3]}}};
  };
  TRY_ASSIGN(auto read, readTextTrack(file, track, {}, progress));
  read.file_from_local = file_from_local;
  return read;
}

Result<Report> writeOwn(const std::filesystem::path& file, const Trajectory& samples, const TrajectoryFrame& frame) {
  const auto& [q, p] = frame.file_from_local;
  nlohmann::ordered_json head;
  head["format"] = kFormat;
  head["version"] = kVersion;
  head["crs"] = frame.crs;
  head["map_from_local"] = {{"scale", frame.scale},
                            {"translation_m", {p.x(), p.y(), p.z()}},
                            {"rotation_xyzw", {q.x(), q.y(), q.z(), q.w()}}};
  head["body"] = kBody;
  head["spline"] = "cubic through position and quaternion";
  const std::string text = "# " + head.dump() + "\ntime_s,x_m,y_m,z_m,qx,qy,qz,qw\n";
  TRY(writeTextTrack(file, text, samples, {}, [](std::string& line, const TimedPose& s) {
    const auto& [rotation, place] = s.pose;
    appendNumbers(
        line, {s.time_s, place.x(), place.y(), place.z(), rotation.x(), rotation.y(), rotation.z(), rotation.w()}, ',');
  }));
  return Report{};
}

}  // namespace standpoint::trajectories
