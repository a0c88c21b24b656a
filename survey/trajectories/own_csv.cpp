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

Result<void> checkHead(std::string_view line) {
  TRY_ASSIGN(const auto head, parseJson(std::string(line.substr(1)), "head"));
  const auto format = head.find("format"), version = head.find("version");
  if (!head.is_object() || format == head.end() || *format != kFormat)
    return failure(ErrorKind::unusable, fmt::format("the head's format is not {}", kFormat));
  if (version == head.end() || *version != kVersion)
    return failure(ErrorKind::unusable,
                   "the head's version is not known; a newer version of this program wrote the file");
  return {};
}

}  // namespace

Result<ReadTrajectory> readOwn(const std::filesystem::path& file, const TrajectoryFrame&, Progress& progress) {
  TextTrack track{"csv", "this format", {8}, {}};
  bool headed = false;
  track.names_first = true;
  track.comment = [&](std::string_view line) -> Result<void> {
    if (std::exchange(headed, true)) return {};
    return checkHead(line);
  };
  track.sample = [&](const std::vector<double>& n, std::string_view) -> Result<TimedPose> {
    if (!headed) return failure(ErrorKind::unusable, "the head is missing: a line with # and JSON");
    return TimedPose{n[0], {{n[7], n[4], n[5], n[6]}, {n[1], n[2], n[3]}}};
  };
  return readTextTrack(file, track, {}, progress);
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
