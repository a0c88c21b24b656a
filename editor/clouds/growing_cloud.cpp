// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clouds/growing_cloud.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace standpoint {

namespace {

constexpr double kWhole_rad = 2 * std::numbers::pi;

}  // namespace

Result<void> GrowingCloud::begin(const ScanHeader& header) {
  const std::lock_guard lock(mutex_);
  maker_.begin(header);
  columns_ = std::max(1U, header.columns);
  step_ = std::max<std::uint64_t>(1, columns_ * header.rows / kMostPoints);
  seen_ = 0;
  points_.assign(kParts, {});
  parts_.assign(kParts, nullptr);
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

std::vector<ShownUnderlay> GrowingCloud::shown(double share) const {
  const std::lock_guard lock(mutex_);
  std::vector<ShownUnderlay> all;
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    if (!parts_[part] || parts_[part]->points.empty() || (share < 1 && endOf(part) > share)) continue;
    ShownUnderlay shown{parts_[part], Eigen::Matrix4d::Identity()};
    shown.local_from_cloud.topRightCorner<3, 1>() = parts_[part]->pointsOrigin_m();
    all.push_back(std::move(shown));
  }
  return all;
}

}  // namespace standpoint
