// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/registration/registered_clouds.h"

#include <cstdio>

#include <fmt/format.h>

#include "core/output_place.h"
#include "core/random.h"
#include "pointclouds/formats.h"
#include "survey/scanning/scan_identity.h"
#include "survey/targets/target_measuring.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

// Another pose makes another scan.
std::string guidAt(const ScanHeader& header, const Pose& pose) {
  const auto text =
      fmt::format("{} {} {}", header.guid, fmt::join(pose.translation, " "), fmt::join(pose.rotation.coeffs(), " "));
  const std::uint64_t a = stableHash(text.c_str()), b = stableHash(text.c_str(), a);
  return guidText(a, b);
}

class PosedSink final : public PointSink {
 public:
  PosedSink(PointSink& to, const PoseOf& pose_of, const std::string& by) : to_(to), pose_of_(pose_of), by_(by) {}

  Result<void> begin(const ScanHeader& header) override {
    ScanHeader posed = header;
    TRY_ASSIGN(posed.file_from_scanner, pose_of_(header));
    moved_ = posed.file_from_scanner * inverse(header.file_from_scanner);
    if (header.has_truth) posed.true_file_from_scanner = truePose(header);
    posed.guid = guidAt(header, posed.file_from_scanner);
    posed.description += (header.description.empty() ? "pose by " : "; pose by ") + by_;
    return to_.begin(posed);
  }
  Result<void> write(const PointBlock& block) override { return to_.write(block); }
  Result<void> picture(const StationPicture& picture) override {
    StationPicture posed = picture;
    posed.file_from_camera = moved_ * picture.file_from_camera;
    return to_.picture(posed);
  }
  Result<void> end() override { return to_.end(); }
  Result<void> close() override { return to_.close(); }

 private:
  PointSink& to_;
  const PoseOf& pose_of_;
  const std::string& by_;
  Pose moved_;  // from where the file had it to where it is now
};

}  // namespace

Result<void> copyPosed(const fs::path& from, const fs::path& to, const PoseOf& pose_of, const std::string& by,
                       Report& report, Progress& progress) {
  const auto posed = [&](PointSink& writer) { return std::make_unique<PosedSink>(writer, pose_of, by); };
  TRY(convertCloud({from}, to, "", report, progress, posed));
  return {};
}

Result<std::vector<fs::path>> registeredFiles(const std::vector<fs::path>& files, const fs::path& output) {
  std::vector<fs::path> to;
  std::error_code code;
  const bool is_file = output.has_extension() && !fs::is_directory(output, code);
  if (is_file && files.size() > 1)
    return failure(ErrorKind::usage, fmt::format("cannot write {} scans to one file: specify a folder", files.size()),
                   "--output");
  if (is_file) {
    const auto* format = cloudFormatFor(output);
    if (format == nullptr || format->writer == nullptr)
      return failure(ErrorKind::usage, fmt::format("unsupported format '{}'", output.extension().string()), "--output");
    TRY(checkFolderOf(output, "--output"));
    to.push_back(output);
  } else {
    for (const auto& file : files) to.push_back(output / file.filename());
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (fs::equivalent(files[i], to[i], code))
      return failure(ErrorKind::usage, "output would overwrite the input: specify another folder", files[i].string());
    for (std::size_t k = 0; k < i; ++k)
      if (to[k] == to[i])
        return failure(ErrorKind::usage,
                       fmt::format("{} has the same file name: register one folder at a time", files[k].string()),
                       files[i].string());
  }
  return to;
}

Result<void> writeRegistered(const Job& job, const Eigen::Vector3d& shift_m, const std::vector<fs::path>& files,
                             const std::vector<fs::path>& to, Report& report, Progress& progress) {
  std::error_code code;
  const fs::path folder = to.front().parent_path();
  if (!folder.empty()) fs::create_directories(folder, code);
  if (code) return failure(ErrorKind::file_system, "cannot create the folder: " + code.message(), folder.string());
  for (std::size_t i = 0; i < files.size(); ++i) {
    progress.stage("Writing " + to[i].filename().string(),
                   0.95 + 0.05 * static_cast<double>(i) / static_cast<double>(files.size()),
                   0.95 + 0.05 * static_cast<double>(i + 1) / static_cast<double>(files.size()));
    StationsOfFile stations(job, files[i]);
    const auto solved = [&](const ScanHeader& header) -> Result<Pose> {
      TRY_ASSIGN(const auto index, stations.next(header));
      const Station& station = job.stations[index];
      if (!station.solved_pose) return failure(ErrorKind::internal, "this station was not registered", station.name);
      return Pose{station.solved_pose->rotation, station.solved_pose->translation + shift_m};
    };
    TRY(copyPosed(files[i], to[i], solved, "registration", report, progress));
  }
  return {};
}

}  // namespace standpoint
