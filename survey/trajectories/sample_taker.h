// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "survey/trajectories/trajectory_file.h"

namespace standpoint {

struct TimedPose {
  double time_s = 0;
  Pose pose;
};

// A pose in one frame as in the other.
Pose localPose(const TrajectoryFrame& frame, const Pose& of_file);
Pose filePose(const TrajectoryFrame& frame, const Pose& local);

// Collects the samples of a trajectory and refuses what is none.
class SampleTaker {
 public:
  SampleTaker(std::string file, std::string format, const TrajectoryFrame& frame);
  // `place`: "walk.tum line 7". The pose is in the file's frame; its quaternion may be of a length that rounding gives
  // it.
  Result<void> take(const TimedPose& sample, const std::string& place);
  // The breaks, and whether there is anything at all.
  Result<ReadTrajectory> finish();
  Report& report() { return read_.report; }

 private:
  std::string file_;
  TrajectoryFrame frame_;
  ReadTrajectory read_;
};

// How a text has its samples: so many numbers in a line.
struct TextTrack {
  std::string format;                // id
  std::string name;                  // "TUM"
  std::vector<std::size_t> columns;  // that a line may have
  std::function<Result<TimedPose>(const std::vector<double>& numbers, std::string_view line)> sample;
  std::function<Result<void>(std::string_view line)> comment = {};  // of lines that begin with #
  bool names_first = false;                                         // the first line without # has the columns' names
};
Result<ReadTrajectory> readTextTrack(const std::filesystem::path& file, const TextTrack& track,
                                     const TrajectoryFrame& frame, Progress& progress);

// A text of one line for each sample, poses in the file's frame.
Result<void> writeTextTrack(const std::filesystem::path& file, std::string head, const Trajectory& samples,
                            const TrajectoryFrame& frame,
                            const std::function<void(std::string& text, const TimedPose& sample)>& line);
// Numbers as texts that read back the same, between `separator`; no line's end.
void appendNumbers(std::string& text, std::initializer_list<double> numbers, char separator);

}  // namespace standpoint
