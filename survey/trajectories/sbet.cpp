// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/motion/rotation_vector.h"
#include "core/part_file.h"
#include "core/units.h"
#include "pointclouds/files/file_access.h"
#include "pointclouds/files/raw_bytes.h"
#include "survey/geodesy.h"
#include "survey/trajectories/formats.h"
#include "survey/trajectories/sample_taker.h"

// Smoothed best estimate of trajectory (Applanix), as PDAL reads it (PDAL@ccf0ab7, SbetCommon.hpp): records of 17
// doubles. Angles are those of a body with x ahead, y right, z down against north, east, down: heading clockwise, then
// pitch with the nose up, then roll with the right side down. True heading is the platform's less the wander angle, as
// PDAL's filters.georeference has it.
namespace standpoint::trajectories {

namespace {

constexpr std::size_t kNumbers = 17, kRecord = kNumbers * sizeof(double), kChunk = 4096;
constexpr double kWeek_s = 604800;
using Record = std::array<double, kNumbers>;
struct Field {
  enum : std::size_t {
    time,
    latitude,
    longitude,
    altitude,
    velocity,  // north, east, down
    roll = 7,
    pitch,
    heading,
    wander,
    acceleration,
    rate = 14,
  };
};

Result<MapProjection> projectionOf(const TrajectoryFrame& frame, const std::string& file) {
  if (frame.crs.empty())
    return failure(ErrorKind::usage,
                   "SBET has geographic coordinates; give the model a projected CRS and an origin first (georeference)",
                   file);
  return MapProjection::of(frame.crs);
}

Result<TimedPose> poseOf(const Record& record, const MapProjection& projection) {
  if (!(std::abs(record[Field::latitude]) <= std::numbers::pi / 2) ||
      !(std::abs(record[Field::longitude]) <= 2 * std::numbers::pi))
    return failure(ErrorKind::unusable, "latitude and longitude are not in radians; is the file another format?");
  const MapProjection::Geographic at{record[Field::latitude], record[Field::longitude]};
  TRY_ASSIGN(const Eigen::Vector2d map, projection.map(at));
  TRY_ASSIGN(const double north, projection.northDirection_rad(at));
  return TimedPose{record[Field::time],
                   {rotationOf({record[Field::roll], -record[Field::pitch],
                                north - (record[Field::heading] - record[Field::wander])}),
                    {map.x(), map.y(), record[Field::altitude]}}};
}

}  // namespace

Result<ReadTrajectory> readSbet(const std::filesystem::path& file, const TrajectoryFrame& frame, Progress& progress) {
  TRY_ASSIGN(const auto input, InputFile::open(file));
  const std::string name = input.name();
  TRY_ASSIGN(const auto projection, projectionOf(frame, name));
  if (input.size() % kRecord != 0)
    return failure(ErrorKind::unusable,
                   fmt::format("the file ends after {} of {} bytes of a record; copy it again, or it is not SBET",
                               input.size() % kRecord, kRecord),
                   fmt::format("{} record {}", name, input.size() / kRecord + 1));
  SampleTaker taker(name, "sbet", frame);
  std::vector<std::uint8_t> bytes(kChunk * kRecord);
  double weeks_s = 0, before = -1;
  for (std::uint64_t at = 0; at < input.size(); at += bytes.size()) {
    TRY_ASSIGN(const auto got, input.read(at, bytes));
    for (std::size_t k = 0; k + kRecord <= got; k += kRecord) {
      const std::string place = fmt::format("{} record {}", name, (at + k) / kRecord + 1);
      auto record = load<Record>(bytes.data() + k);
      if (record[Field::time] < before - 0.99 * kWeek_s) {
        weeks_s += kWeek_s;
        taker.report().note(place, "the GPS week ends here; its seconds go on");
      }
      before = record[Field::time];
      record[Field::time] += weeks_s;
      const auto sample = poseOf(record, projection);
      if (!sample) return failure(sample.error().kind, sample.error().message, place);
      TRY(taker.take(*sample, place));
    }
    progress.advance(static_cast<double>(at) / static_cast<double>(input.size()));
    TRY(progress.check());
  }
  return taker.finish();
}

Result<Report> writeSbet(const std::filesystem::path& file, const Trajectory& samples, const TrajectoryFrame& frame) {
  TRY_ASSIGN(const auto projection, projectionOf(frame, file.filename().string()));
  TRY_ASSIGN(const auto spline, PoseSpline::through(samples));
  TRY_ASSIGN(auto part, PartFile::create(file));
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < samples.pose.size(); ++i) {
    const Pose pose = filePose(frame, samples.pose[i]);
    TRY_ASSIGN(const auto at, projection.geographic(pose.translation.head<2>()));
    TRY_ASSIGN(const double north, projection.northDirection_rad(at));
    const EulerAngles angles = eulerAngles(unitRotation(pose.rotation));
    const Velocity v = velocity(spline, samples.time_s[i]);
    const Eigen::Vector3d on_map = frame.file_from_local.rotation * (frame.scale * v.linear_mps);
    const double sine = std::sin(north), cosine = std::cos(north);
    const Eigen::Vector3d rate_of_body = samples.pose[i].rotation.conjugate() * v.angular_radps;
    Record record{};
    record[Field::time] = samples.time_s[i];
    record[Field::latitude] = at.latitude_rad;
    record[Field::longitude] = at.longitude_rad;
    record[Field::altitude] = pose.translation.z();
    record[Field::velocity] = on_map.x() * cosine + on_map.y() * sine;
    record[Field::velocity + 1] = on_map.x() * sine - on_map.y() * cosine;
    record[Field::velocity + 2] = -on_map.z();
    record[Field::roll] = angles.roll_rad;
    record[Field::pitch] = -angles.pitch_rad;
    record[Field::heading] = std::remainder(north - angles.yaw_rad, 2 * std::numbers::pi);
    record[Field::rate] = rate_of_body.x();
    record[Field::rate + 1] = -rate_of_body.y();
    record[Field::rate + 2] = -rate_of_body.z();
    for (const double number : record) append(bytes, number);
    if (bytes.size() < kChunk * kRecord) continue;
    TRY(part.append(bytes));
    bytes.clear();
  }
  TRY(part.append(bytes));
  TRY(part.commit());
  Report report;
  report.warn(file.filename().string(), "accelerations are written as 0");
  return report;
}

}  // namespace standpoint::trajectories
