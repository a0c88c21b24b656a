// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/motion/rotation_vector.h"
#include "core/units.h"
#include "survey/trajectories/formats.h"
#include "survey/trajectories/sample_taker.h"

// As HELIOS++ reads and writes trajectories (3dgeo-heidelberg/helios@fd94d1ff, InterpolatedMovingPlatform.cpp,
// DirectTrajectoryWriteStrategy.h): degrees; its body has x right, y ahead, z up. "Canonical" is Rx(roll) Ry(pitch)
// Rz(yaw); "ARINC 705" turns by yaw clockwise, then by roll about y, then by pitch about x. What HELIOS++ reads has a
// line #HEADER with the columns' names, what it writes has x y z t roll pitch yaw.
namespace standpoint::trajectories {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr std::array<const char*, 7> kNames = {"x", "y", "z", "t", "roll", "pitch", "yaw"};

const Quaterniond kTheirsFromOurs(std::sqrt(0.5), 0, 0, std::sqrt(0.5));  // ahead is their y

Quaterniond about(const Vector3d& axis, double degrees) { return rotationBy(axis * (degrees * kRadPerDeg)); }
double degrees(double y, double x) { return 360 * portable::turnOf(y, x); }
// The same angle at most half a turn from the one before: HELIOS++ interpolates each angle by itself, so a heading that
// came back at 180° would whirl its platform round.
double onwards(double angle, double& before) {
  before = angle + 360 * std::round((before - angle) / 360);
  return before;
}

Quaterniond canonical(double roll, double pitch, double yaw) {
  return about(Vector3d::UnitX(), roll) * about(Vector3d::UnitY(), pitch) * about(Vector3d::UnitZ(), yaw);
}
Quaterniond arinc(double roll, double pitch, double yaw) {
  return about(-Vector3d::UnitZ(), yaw) * about(Vector3d::UnitY(), roll) * about(Vector3d::UnitX(), pitch);
}

// The columns in the order of kNames, from "#HEADER: "t", "roll", …".
Result<std::array<std::size_t, 7>> columnsOf(std::string_view header) {
  std::array<std::size_t, 7> columns{};
  columns.fill(kNames.size());
  std::size_t column = 0;
  for (std::size_t from = header.find(':'); from != std::string_view::npos && from + 1 < header.size(); ++column) {
    const std::size_t end = std::min(header.find(',', from + 1), header.size());
    std::string name;
    for (const char c : header.substr(from + 1, end - from - 1))
      if (std::isalpha(static_cast<unsigned char>(c)) != 0) name += c;
    for (std::size_t k = 0; k < kNames.size(); ++k)
      if (name == kNames[k]) columns[k] = column;
    from = end;
  }
  for (std::size_t k = 0; k < kNames.size(); ++k)
    if (column != kNames.size() || columns[k] == kNames.size())
      return failure(ErrorKind::unusable,
                     fmt::format("the header has no column '{}', or columns that are not known", kNames[k]));
  return columns;
}

using RotationOf = Quaterniond (*)(double roll, double pitch, double yaw);

Result<ReadTrajectory> readOf(const char* id, RotationOf rotation, const std::filesystem::path& file,
                              const TrajectoryFrame& frame, Progress& progress) {
  TextTrack track{id, "HELIOS++", {7}, {}};
  std::array<std::size_t, 7> column = {0, 1, 2, 3, 4, 5, 6};
  track.comment = [&](std::string_view line) -> Result<void> {
    if (!line.starts_with("#HEADER")) return {};
    TRY_ASSIGN(column, columnsOf(line));
    return {};
  };
  track.sample = [&](const std::vector<double>& n, std::string_view) -> Result<TimedPose> {
    const auto at = [&](std::size_t k) { return n[column[k]]; };
    return TimedPose{at(3), {rotation(at(4), at(5), at(6)) * kTheirsFromOurs, {at(0), at(1), at(2)}}};
  };
  return readTextTrack(file, track, frame, progress);
}

Result<Report> writeOf(RotationOf rotation, const std::filesystem::path& file, const Trajectory& samples,
                       const TrajectoryFrame& frame) {
  constexpr const char* kHead = "#TIME_COLUMN: 0\n#HEADER: \"t\", \"roll\", \"pitch\", \"yaw\", \"x\", \"y\", \"z\"\n";
  double last_roll = 0, last_pitch = 0, last_yaw = 0;
  TRY(writeTextTrack(file, kHead, samples, frame, [&](std::string& text, const TimedPose& s) {
    const Eigen::Matrix3d r = (s.pose.rotation * kTheirsFromOurs.conjugate()).normalized().toRotationMatrix();
    const Vector3d& p = s.pose.translation;
    const auto sine = [](double x) { return degrees(x, std::sqrt(std::max(0.0, 1 - x * x))); };
    const bool is_canonical = rotation == canonical;
    const double roll = is_canonical ? degrees(-r(1, 2), r(2, 2)) : sine(-r(2, 0));
    const double pitch = is_canonical ? sine(r(0, 2)) : degrees(r(2, 1), r(2, 2));
    const double yaw = is_canonical ? degrees(-r(0, 1), r(0, 0)) : degrees(-r(1, 0), r(0, 0));
    appendNumbers(
        text,
        {s.time_s, onwards(roll, last_roll), onwards(pitch, last_pitch), onwards(yaw, last_yaw), p.x(), p.y(), p.z()},
        ',');
  }));
  return Report{};
}

}  // namespace

Result<ReadTrajectory> readHelios(const std::filesystem::path& file, const TrajectoryFrame& frame, Progress& progress) {
  return readOf("helios", canonical, file, frame, progress);
}
Result<Report> writeHelios(const std::filesystem::path& file, const Trajectory& samples, const TrajectoryFrame& frame) {
  return writeOf(canonical, file, samples, frame);
}
Result<ReadTrajectory> readHeliosArinc(const std::filesystem::path& file, const TrajectoryFrame& frame,
                                       Progress& progress) {
  return readOf("helios-arinc", arinc, file, frame, progress);
}
Result<Report> writeHeliosArinc(const std::filesystem::path& file, const Trajectory& samples,
                                const TrajectoryFrame& frame) {
  return writeOf(arinc, file, samples, frame);
}

}  // namespace standpoint::trajectories
