// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/trajectories/formats.h"
#include "survey/trajectories/sample_taker.h"

// As the TUM RGB-D benchmark has it, and as evo reads it (MichaelGrupp/evo, file_interface.py).
namespace standpoint::trajectories {

Result<ReadTrajectory> readTum(const std::filesystem::path& file, const TrajectoryFrame& frame, Progress& progress) {
  TextTrack track{"tum", "TUM", {8}, {}};
  track.sample = [](const std::vector<double>& n, std::string_view) -> Result<TimedPose> {
    return TimedPose{n[0], {{n[7], n[4], n[5], n[6]}, {n[1], n[2], n[3]}}};
  };
  return readTextTrack(file, track, frame, progress);
}

Result<Report> writeTum(const std::filesystem::path& file, const Trajectory& samples, const TrajectoryFrame& frame) {
  TRY(writeTextTrack(file, "# timestamp tx ty tz qx qy qz qw\n", samples, frame,
                     [](std::string& text, const TimedPose& s) {
                       const auto& [q, p] = s.pose;
                       appendNumbers(text, {s.time_s, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()}, ' ');
                     }));
  return Report{};
}

}  // namespace standpoint::trajectories
