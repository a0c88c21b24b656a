// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/trajectories/sample_taker.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/motion/rotation_vector.h"
#include "core/part_file.h"
#include "pointclouds/files/line_reader.h"
#include "pointclouds/files/number_line.h"

namespace standpoint {

namespace {

constexpr std::size_t kMostSamples = 10'000'000;
constexpr std::size_t kMostNumbers = 32;
constexpr double kGap = 10, kClose = 0.01;  // of usual steps
constexpr std::size_t kMostNamed = 20;      // breaks
constexpr std::size_t kPiece = 1 << 20;

double usualStep(const std::vector<double>& times) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

}  // namespace

Pose localPose(const TrajectoryFrame& frame, const Pose& of_file) {
  const Pose local = inverse(frame.file_from_local) * Pose{unitRotation(of_file.rotation), of_file.translation};
  return {unitRotation(local.rotation), local.translation / frame.scale};
}

Pose filePose(const TrajectoryFrame& frame, const Pose& local) {
  const Pose of_file = frame.file_from_local * Pose{local.rotation, frame.scale * local.translation};
  return {unitRotation(of_file.rotation), of_file.translation};
}

SampleTaker::SampleTaker(std::string file, std::string format, const TrajectoryFrame& frame)
    : file_(std::move(file)), frame_(frame) {
  read_.format = std::move(format);
}

Result<void> SampleTaker::take(const TimedPose& sample, const std::string& place) {
  const auto wrong = [&](std::string what) { return failure(ErrorKind::unusable, std::move(what), place); };
  const double length = sample.pose.rotation.norm();
  if (!std::isfinite(sample.time_s) || !sample.pose.translation.allFinite() || !std::isfinite(length))
    return wrong("holds a value that is not a number; delete this sample");
  if (std::abs(length - 1) > 1e-3)
    return wrong(fmt::format("the quaternion has length {:.4g} instead of 1; check the order of the columns", length));
  auto& times = read_.samples.time_s;
  if (!times.empty() && sample.time_s <= times.back())
    return wrong(
        fmt::format("the time {} s is not after {} s, that of the sample before; sort the samples by time and "
                    "delete those of equal time",
                    sample.time_s, times.back()));
  if (times.size() == kMostSamples)
    return wrong(fmt::format("there are more than {} samples; keep every tenth, or split the file", kMostSamples));
  times.push_back(sample.time_s);
  read_.samples.pose.push_back(localPose(frame_, sample.pose));
  return {};
}

Result<ReadTrajectory> SampleTaker::finish() {
  const auto& times = read_.samples.time_s;
  if (times.size() < 2) return failure(ErrorKind::unusable, "a trajectory needs at least two samples", file_);
  const double usual_s = usualStep(times);
  read_.gap_s = kGap * usual_s;
  for (std::size_t i = 1; i < times.size(); ++i)
    if (times[i] - times[i - 1] > read_.gap_s) read_.breaks.push_back({times[i - 1], times[i]});
  for (std::size_t i = 0; i < std::min(read_.breaks.size(), kMostNamed); ++i)
    read_.report.warn(file_, fmt::format("no samples from {} s to {} s: the trajectory has a break there",
                                         read_.breaks[i].from_s, read_.breaks[i].to_s));
  if (read_.breaks.size() > kMostNamed)
    read_.report.warn(file_, fmt::format("{} more breaks", read_.breaks.size() - kMostNamed));
  std::size_t close = 0;
  for (std::size_t i = 1; i < times.size(); ++i) close += times[i] - times[i - 1] < kClose * usual_s ? 1 : 0;
  if (close > 0)
    read_.report.warn(file_, fmt::format("samples less than a hundredth of the usual time after the one before: {}; "
                                         "the curve may swing out between such",
                                         close));
  return std::move(read_);
}

Result<ReadTrajectory> readTextTrack(const std::filesystem::path& file, const TextTrack& track,
                                     const TrajectoryFrame& frame, Progress& progress) {
  TRY_ASSIGN(auto input, InputFile::open(file));
  LineReader lines(std::move(input));
  SampleTaker taker(lines.name(), track.format, frame);
  std::vector<double> numbers;
  bool names_to_come = track.names_first;
  for (;;) {
    TRY_ASSIGN(const auto line, lines.next());
    if (!line) break;
    const auto text = trimmed(*line);
    const auto wrong = [&](std::string what) { return failure(ErrorKind::unusable, std::move(what), lines.place()); };
    if (text.empty()) continue;
    if (text.front() == '#') {
      const auto taken = track.comment ? track.comment(text) : Result<void>{};
      if (!taken) return wrong(taken.error().message);
      continue;
    }
    if (std::exchange(names_to_come, false)) continue;
    if (!numbersOf(text, kMostNumbers, numbers))
      return wrong(fmt::format("a line of {} holds numbers alone", track.name));
    if (std::find(track.columns.begin(), track.columns.end(), numbers.size()) == track.columns.end())
      return wrong(fmt::format("the line has {} numbers where one of {} has {}; is the file of another format?",
                               numbers.size(), track.name, track.columns.front()));
    const auto sample = track.sample(numbers, text);
    if (!sample) return wrong(sample.error().message);
    TRY(taker.take(*sample, lines.place()));
    if (lines.line() % 65536 != 0) continue;
    progress.advance(lines.fraction());
    TRY(progress.check());
  }
  return taker.finish();
}

Result<void> writeTextTrack(const std::filesystem::path& file, std::string head, const Trajectory& samples,
                            const TrajectoryFrame& frame,
                            const std::function<void(std::string& text, const TimedPose& sample)>& line) {
  TRY_ASSIGN(auto part, PartFile::create(file));
  std::string text = std::move(head);
  for (std::size_t i = 0; i < samples.pose.size(); ++i) {
    line(text, {samples.time_s[i], filePose(frame, samples.pose[i])});
    text += '\n';
    if (text.size() < kPiece) continue;
    TRY(part.append(text));
    text.clear();
  }
  TRY(part.append(text));
  return part.commit();
}

void appendNumbers(std::string& text, std::initializer_list<double> numbers, char separator) {
  bool first = true;
  for (const double number : numbers) {
    if (!first) text += separator;
    first = false;
    appendNumber(text, number);
  }
}

}  // namespace standpoint
