// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/walk_map.h"

#include <cmath>
#include <numbers>

#include "core/number_text.h"
#include "core/portable_math.h"
#include "core/units.h"
#include "project/survey/clicked_places.h"

namespace standpoint {

namespace {

constexpr double kEvery_m = 0.3, kHalf_m = 40, kReach_m = 15;
constexpr int kAround = 72;
constexpr double kElevations_deg[] = {-65, -50, -38, -28, -20, -12, -4, 4, 10, 20, 32, 45, 58, 70};
constexpr double kLevel = 0.7;  // of a normal's upward part: floors and ceilings, with stairs and slopes

bool isPaused(const WalkState& walk, double after_s) {
  for (const auto& [from, to] : walk.pauses)
    if (after_s > from && (after_s < to || from == to)) return true;
  return false;
}

}  // namespace

void WalkMap::begin(std::shared_ptr<const RayScene> scene, const Georeference& georeference, double height_m) {
  scene_ = std::move(scene);
  shift_m_ = georeference.shift_m;
  height_m_ = height_m;
  map_ = {};
  looked_m_ = -1;
}

bool WalkMap::look(double x_m, double y_m) {
  if (map_.cells.empty()) {
    const auto floor =
        waypointsOf({exactText(x_m) + "," + exactText(y_m)}, *scene_, {.shift_m = shift_m_}, height_m_, "walk");
    if (!floor) return false;
    eye_m_ = floor->front().floor_m.z() + height_m_;
    map_.x_m = x_m - kHalf_m, map_.y_m = y_m - kHalf_m;
    map_.columns = map_.rows = static_cast<int>(2 * kHalf_m / map_.cell_m);
    map_.cells.assign(static_cast<std::size_t>(map_.columns) * map_.rows, 0);
  }
  Eigen::Vector3d eye(x_m - shift_m_.x(), y_m - shift_m_.y(), eye_m_);
  if (const auto below = scene_->intersect(eye, -Eigen::Vector3d::UnitZ(), 2 * height_m_))
    eye.z() = eye_m_ = below->position.z() + height_m_;
  for (const double elevation_deg : kElevations_deg)
    for (int k = 0; k < kAround; ++k) {
      double up = 0, along = 1, s = 0, c = 1;
      portable::sinCos(elevation_deg * kRadPerDeg, up, along);
      portable::sinCos(2 * std::numbers::pi * k / kAround, s, c);
      const auto hit = scene_->intersect(eye, {along * c, along * s, up}, kReach_m);
      if (!hit) continue;
      const int column = static_cast<int>(std::floor((hit->position.x() + shift_m_.x() - map_.x_m) / map_.cell_m));
      const int row = static_cast<int>(std::floor((hit->position.y() + shift_m_.y() - map_.y_m) / map_.cell_m));
      if (column < 0 || row < 0 || column >= map_.columns || row >= map_.rows) continue;
      const double rise = hit->position.z() - (eye_m_ - height_m_);
      const std::uint8_t what = hit->normal.z() > kLevel    ? (rise < 0.3 ? SeenMap::kFloor : 0)
                                : hit->normal.z() < -kLevel ? SeenMap::kCeiling
                                                            : SeenMap::kWall;
      map_.cells[static_cast<std::size_t>(row) * map_.columns + column] |= what;
    }
  return true;
}

std::string WalkMap::between(const std::array<double, 2>& from, const std::array<double, 2>& to) const {
  if (!scene_ || map_.cells.empty()) return {};
  Eigen::Vector3d at(from[0] - shift_m_.x(), from[1] - shift_m_.y(), eye_m_);
  const Eigen::Vector3d end(to[0] - shift_m_.x(), to[1] - shift_m_.y(), eye_m_);
  constexpr double kPast_m = 1e-3;
  for (double left = (end - at).norm(); left > kPast_m; left = (end - at).norm()) {
    const Eigen::Vector3d ahead = (end - at) / left;
    const auto hit = scene_->intersect(at, ahead, left);
    if (!hit) return {};
    const auto& product = scene_->environment().products[hit->product];
    if (product.ifc_class != "IfcDoor") return product.name.empty() ? product.ifc_class : product.name;
    at = hit->position + kPast_m * ahead;
  }
  return {};
}

std::shared_ptr<const SeenMap> WalkMap::grow(const WalkState& walk) {
  if (!scene_ || !walk.recording || !walk.at) return nullptr;
  if (walk.way.size() <= 1 && looked_m_ > 0) map_ = {}, looked_m_ = -1;  // another walk began
  WalkedWay way = walk.way;
  way.push_back({walk.at->front(), walk.at->back(), walk.recorded_s});
  bool grown = false;
  double before_m = 0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const double length = std::hypot(way[i][0] - way[i - 1][0], way[i][1] - way[i - 1][1]);
    while (true) {
      const double next = looked_m_ < 0 ? 0 : looked_m_ + kEvery_m;
      if (next > before_m + length) break;
      const double part = length > 0 ? (next - before_m) / length : 0;
      looked_m_ = next;
      if (isPaused(walk, way[i - 1][2] + part * (way[i][2] - way[i - 1][2]))) continue;
      grown = look(way[i - 1][0] + part * (way[i][0] - way[i - 1][0]),
                   way[i - 1][1] + part * (way[i][1] - way[i - 1][1])) ||
              grown;
    }
    before_m += length;
  }
  return grown ? std::make_shared<const SeenMap>(map_) : nullptr;
}

}  // namespace standpoint
