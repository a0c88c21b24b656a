// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <fmt/format.h>

#include "pointclouds/files/number_text.h"
#include "survey/trajectories/formats.h"
#include "survey/trajectories/sample_taker.h"

// As the EuRoC data sets have their ground truth, and as evo reads it. Nanoseconds since 1970 have more digits than a
// double; in seconds they keep 0.24 µs.
namespace standpoint::trajectories {

Result<ReadTrajectory> readEuroc(const std::filesystem::path& file, const TrajectoryFrame& frame, Progress& progress) {
  TextTrack track{"euroc", "EuRoC", {17, 8}, {}};
  track.sample = [](const std::vector<double>& n, std::string_view line) -> Result<TimedPose> {
    const auto nanoseconds = numberFrom<std::int64_t>(line.substr(0, line.find_first_of(", \t;")));
    if (!nanoseconds) return failure(ErrorKind::unusable, "the time is not a whole number of nanoseconds");
    return TimedPose{
        static_cast<double>(*nanoseconds / 1'000'000'000) + static_cast<double>(*nanoseconds % 1'000'000'000) / 1e9,
        {{n[4], n[5], n[6], n[7]}, {n[1], n[2], n[3]}}};
  };
  return readTextTrack(file, track, frame, progress);
}

Result<Report> writeEuroc(const std::filesystem::path& file, const Trajectory& samples, const TrajectoryFrame& frame) {
  for (std::size_t i = 0; i < samples.time_s.size(); ++i)
    if (!(std::abs(samples.time_s[i]) < 9e9) ||
        (i > 0 && std::llround(samples.time_s[i] * 1e9) <= std::llround(samples.time_s[i - 1] * 1e9)))
      return failure(ErrorKind::unusable, "two samples are less than a nanosecond apart; EuRoC cannot hold them",
                     fmt::format("sample {}", i));
  constexpr const char* kHead =
      "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z []\n";
  TRY(writeTextTrack(file, kHead, samples, frame, [](std::string& text, const TimedPose& s) {
    const auto& [q, p] = s.pose;
    const double whole = std::floor(s.time_s);
    text += std::to_string(static_cast<std::int64_t>(whole) * 1'000'000'000 + std::llround((s.time_s - whole) * 1e9));
    text += ',';
    appendNumbers(text, {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()}, ',');
  }));
  return Report{};
}

}  // namespace standpoint::trajectories
