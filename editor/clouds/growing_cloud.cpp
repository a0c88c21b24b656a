// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clouds/growing_cloud.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace standpoint {

namespace {

constexpr double kWhole_rad = 2 * std::numbers::pi;
constexpr int kForeseenAtOnce = 4;  // parts in one picture: some milliseconds

// By the model alone: no noise, and lighter where the beam meets a surface straight.
std::shared_ptr<const Cloud> foreseenPart(const RayScene& scene, const StandingInstrument& stands,
                                          const SweepShape& shape, std::size_t part) {
  constexpr int kColumns = 20, kRows = 80;
  constexpr double kSeen_m = 100, kOutside_m = 0.2;
  Cloud cloud;
  cloud.header.origin_m = stands.centre_m;
  for (int column = 0; column < kColumns; ++column)
    for (int row = 0; row < kRows; ++row) {
      const double azimuth = shape.from_rad + (static_cast<double>(part) + (column + 0.5) / kColumns) * kWhole_rad /
                                                  static_cast<double>(GrowingCloud::kParts);
      const double elevation = shape.low_rad + (shape.high_rad - shape.low_rad) * (row + 0.5) / kRows;
      const Eigen::Vector3d way =
          stands.rotation * Eigen::Vector3d(std::cos(azimuth) * std::cos(elevation),
                                            -std::sin(azimuth) * std::cos(elevation), std::sin(elevation));
      const Eigen::Vector3d from = stands.centre_m + kOutside_m * way;
      const auto hit = scene.intersect(from, way, kSeen_m);
      if (!hit) continue;
      const Eigen::Vector3f place = ((hit->range_m + kOutside_m) * way).cast<float>();
      CloudPoint point;
      point.position_m = {place.x(), place.y(), place.z()};
      cloud.points.push_back(point);
      const auto grey = static_cast<std::uint8_t>(60 + 170 * std::abs(hit->normal.dot(way)));
      cloud.colours.push_back({grey, grey, grey, 255});
    }
  return std::make_shared<const Cloud>(std::move(cloud));
}

}  // namespace

Result<void> GrowingCloud::begin(const ScanHeader& header) {
  const std::lock_guard lock(mutex_);
  ScanHeader where = header;
  if (stands_.body != nullptr)
    where.file_from_scanner = {stands_.rotation, stands_.centre_m + maker_.header().origin_m};
  maker_.begin(where);
  columns_ = std::max(1U, header.columns);
  step_ = std::max<std::uint64_t>(1, columns_ * header.rows / kMostPoints);
  seen_ = 0;
  points_.assign(kParts, {});
  parts_.assign(kParts, nullptr);
  whole_ = false;
  colouring_.reset();
  return {};
}

Result<void> GrowingCloud::write(const PointBlock& block) {
  const std::lock_guard lock(mutex_);
  if (block.size() == 0) return {};
  for (std::uint64_t i = (step_ - seen_ % step_) % step_; i < block.size(); i += step_) {
    double azimuth = std::fmod(std::atan2(-block.y_m[i], block.x_m[i]) - shape_.from_rad, kWhole_rad);
    if (azimuth < 0) azimuth += kWhole_rad;
    const auto part = static_cast<std::size_t>(azimuth / kWhole_rad * kParts);
    points_[std::min(part, kParts - 1)].push_back(maker_.make(block, i));
  }
  seen_ += block.size();
  // Blocks come in the order of columns. A pulse's noise may carry it over to the next part: that one is still open.
  const double done = static_cast<double>(block.column.back() + 1) / static_cast<double>(columns_);
  const double measured = shape_.turn_rad * shape_.fans / kWhole_rad;
  for (std::size_t part = 0; part < kParts; ++part)
    if (!parts_[part] && (done >= 1 || done * measured * kParts >= static_cast<double>(part + 2))) finish(part);
  whole_ = done >= 1;
  return {};
}

void GrowingCloud::finish(std::size_t part) {
  Cloud cloud;
  cloud.header = maker_.header();
  cloud.shift_m = cloud.header.origin_m;
  cloud.points = std::move(points_[part]);
  points_[part].clear();
  if (!colouring_ && !cloud.points.empty()) colouring_ = colouringOf(cloud.points, cloud.header.channels);
  for (const auto& p : cloud.points) cloud.colours.push_back(colourOf(p, p.position_m[2], *colouring_));
  parts_[part] = std::make_shared<const Cloud>(std::move(cloud));
}

double GrowingCloud::endOf(std::size_t part) const {
  // Just before its end, which may be where the next turn begins.
  return shareAt(shape_, shape_.from_rad + (static_cast<double>(part) + 0.999) * kWhole_rad / kParts);
}

void GrowingCloud::foresee(std::shared_ptr<const RayScene> scene, const StandingInstrument& stands) {
  const std::lock_guard lock(mutex_);
  scene_ = std::move(scene);
  stands_ = stands;
}

std::vector<ShownUnderlay> GrowingCloud::shown(std::optional<double> share) {
  const std::lock_guard lock(mutex_);
  passed_ = std::max(passed_, share.value_or(0));
  const bool all_of_it = whole_ && !share;
  int foreseen_now = 0;
  std::vector<ShownUnderlay> all;
  for (std::size_t part = 0; part < kParts; ++part) {
    if (!all_of_it && passed_ < 1 && endOf(part) > passed_) continue;
    auto cloud = parts_[part];
    const bool measured = (static_cast<double>(part) + 0.5) * kWhole_rad / kParts < shape_.turn_rad * shape_.fans;
    if (!cloud && scene_ && measured && !foreseen_[part] && foreseen_now++ < kForeseenAtOnce)
      foreseen_[part] = foreseenPart(*scene_, stands_, shape_, part);
    if (!cloud) cloud = foreseen_[part];
    if (!cloud || cloud->points.empty()) continue;
    ShownUnderlay shown{cloud, Eigen::Matrix4d::Identity()};
    shown.local_from_cloud.topRightCorner<3, 1>() = cloud->pointsOrigin_m();
    all.push_back(std::move(shown));
  }
  return all;
}

}  // namespace standpoint
