// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <fmt/format.h>

#include "core/part_file.h"
#include "pointclouds/files/line_reader.h"
#include "pointclouds/files/number_text.h"
#include "survey/trajectories/formats.h"
#include "survey/trajectories/sample_taker.h"

// As the KITTI odometry benchmark has its poses: the first three rows of a matrix, camera axes (x right, y down, z
// ahead) in the frame of the first camera. Its times are in a file of their own.
namespace standpoint::trajectories {

namespace {

namespace fs = std::filesystem;

// Of the camera's axes as ours: ahead is x, left is -x of it, up is -y.
const Eigen::Quaterniond kOursFromCamera(0.5, -0.5, 0.5, -0.5);

fs::path ownTimes(const fs::path& file) { return file.parent_path() / (file.stem().string() + "_times.txt"); }

Result<std::vector<double>> readTimes(const fs::path& poses) {
  std::error_code code;
  fs::path file = ownTimes(poses);
  if (!fs::exists(file, code)) file = poses.parent_path() / "times.txt";
  if (!fs::exists(file, code))
    return failure(ErrorKind::unusable,
                   fmt::format("KITTI poses have no times; put these beside the file as times.txt or {}, a line a pose",
                               ownTimes(poses).filename().string()),
                   poses.filename().string());
  TRY_ASSIGN(auto input, InputFile::open(file));
  LineReader lines(std::move(input));
  std::vector<double> times;
  for (;;) {
    TRY_ASSIGN(const auto line, lines.next());
    if (!line) return times;
    if (trimmed(*line).empty()) continue;
    const auto time = numberFrom<double>(*line);
    if (!time) return failure(ErrorKind::unusable, "a time is a number of seconds", lines.place());
    times.push_back(*time);
  }
}

}  // namespace

Result<ReadTrajectory> readKitti(const fs::path& file, const TrajectoryFrame& frame, Progress& progress) {
  TRY_ASSIGN(const auto times, readTimes(file));
  TextTrack track{"kitti", "KITTI", {12}, {}};
  std::size_t next = 0;
  track.sample = [&](const std::vector<double>& n, std::string_view) -> Result<TimedPose> {
    if (next == times.size())
      return failure(ErrorKind::unusable, fmt::format("there are {} times for more poses than that", times.size()));
    Eigen::Matrix3d rotation;
    rotation << n[0], n[1], n[2], n[4], n[5], n[6], n[8], n[9], n[10];
    if (!((rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).norm() < 1e-3) || rotation.determinant() < 0)
      return failure(ErrorKind::unusable, "the first three columns of the matrix are no rotation");
    const Eigen::Quaterniond camera(rotation);
    return TimedPose{times[next++],
                     {(kOursFromCamera * camera * kOursFromCamera.conjugate()).normalized(),
                      kOursFromCamera * Eigen::Vector3d(n[3], n[7], n[11])}};
  };
  TRY_ASSIGN(auto read, readTextTrack(file, track, frame, progress));
  if (next < times.size())
    read.report.lose(file.filename().string(), fmt::format("{} times are without a pose", times.size() - next));
  return read;
}

Result<Report> writeKitti(const fs::path& file, const Trajectory& samples, const TrajectoryFrame& frame) {
  std::string times;
  TRY(writeTextTrack(file, "", samples, frame, [&](std::string& text, const TimedPose& s) {
    const Eigen::Matrix3d r =
        (kOursFromCamera.conjugate() * s.pose.rotation * kOursFromCamera).normalized().toRotationMatrix();
    const Eigen::Vector3d p = kOursFromCamera.conjugate() * s.pose.translation;
    appendNumbers(
        text, {r(0, 0), r(0, 1), r(0, 2), p.x(), r(1, 0), r(1, 1), r(1, 2), p.y(), r(2, 0), r(2, 1), r(2, 2), p.z()},
        ' ');
    appendNumber(times, s.time_s);
    times += '\n';
  }));
  TRY(writeWholeText(ownTimes(file), times));
  return Report{};
}

}  // namespace standpoint::trajectories
