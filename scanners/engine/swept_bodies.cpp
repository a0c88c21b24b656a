// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/swept_bodies.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/task_arena.h>

#include "scanners/engine/footprint.h"

namespace standpoint {

double BeamWidth::aside_m(double range_m) const {
  return kBeamEdge * (exit_m + divergence_rad * std::min(range_m, farthest_m)) / 2;
}

SweptWindow::SweptWindow(const EmbreeScene& scene, const BeamWidth& beam, std::int64_t number,
                         RTCIntersectFunctionN meet)
    : of_(scene), beam_(beam), beam_m_(beam.aside_m(beam.farthest_m)), number_(number) {
  const double from_s = static_cast<double>(number) * kLength_s;
  for (std::uint32_t b = 0; b < scene.bodies().size(); ++b)
    if (from_s + kLength_s >= scene.bodies()[b].from_s && from_s <= scene.bodies()[b].to_s) addPath(b);
  if (bodies_.empty()) return;
  // Whoever waits for others meanwhile might take up another column on this thread.
  tbb::this_task_arena::isolate([&] { build(meet); });
}

SweptWindow::~SweptWindow() {
  if (scene_ != nullptr) rtcReleaseScene(scene_);
}

void SweptWindow::addPath(std::uint32_t number) {
  const RestingBody& body = of_.bodies()[number];
  const double from_s = static_cast<double>(number_) * kLength_s, step_s = kLength_s / kPoses;
  Eigen::AlignedBox3d box;
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  double step_m = 0;
  Path& path = paths_.emplace_back();
  for (int i = -1; i <= kPoses + 1; ++i) {
    const Eigen::Vector3d centre = body.local_from_rest->pose(from_s + i * step_s) * body.box.center();
    if (i >= 0) step_m = std::max(step_m, (centre - before).norm());
    box.extend(centre), before = centre;
    if (i >= 0 && i <= kPoses) path.centre[i] = centre;
  }
  path.reach_m = body.box.diagonal().norm() / 2 + step_m / 2 + 1e-3;
  const double aside = body.box.diagonal().norm() / 2 + step_m + beam_m_;
  bodies_.push_back(number);
  boxes_.emplace_back(box.min().array() - aside, box.max().array() + aside);
}

bool SweptWindow::reaches(std::size_t box, double time_s, const Eigen::Vector3d& origin,
                          const Eigen::Vector3d& direction, double farthest_m) const {
  const double steps = (time_s / kLength_s - static_cast<double>(number_)) * kPoses;
  const int i = std::clamp(static_cast<int>(steps), 0, kPoses - 1);
  const Path& path = paths_[box];
  const Eigen::Vector3d to = path.centre[i] + (steps - i) * (path.centre[i + 1] - path.centre[i]) - origin;
  const double along = std::max(0.0, to.dot(direction));
  if (along - path.reach_m > farthest_m + beam_m_) return false;
  const double radius = path.reach_m + beam_.aside_m(along + path.reach_m);
  return to.squaredNorm() - along * along <= radius * radius + 1e-9 * to.squaredNorm();
}

void SweptWindow::bounds(const RTCBoundsFunctionArguments* arguments) {
  const auto& window = *static_cast<const SweptWindow*>(arguments->geometryUserPtr);
  const Eigen::AlignedBox3d& box = window.boxes_[arguments->primID];
  const auto low = [](double v) { return std::nextafter(static_cast<float>(v), -std::numeric_limits<float>::max()); };
  const auto high = [](double v) { return std::nextafter(static_cast<float>(v), std::numeric_limits<float>::max()); };
  RTCBounds& to = *arguments->bounds_o;
  to.lower_x = low(box.min().x()), to.lower_y = low(box.min().y()), to.lower_z = low(box.min().z());
  to.upper_x = high(box.max().x()), to.upper_y = high(box.max().y()), to.upper_z = high(box.max().z());
}

void SweptWindow::build(RTCIntersectFunctionN meet) {
  RTCDevice device = of_.device();
  scene_ = rtcNewScene(device);
  rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(bodies_.size()));
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, meet);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene_, geometry, 0);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_);
}

std::shared_ptr<const SweptWindow> SweptBodies::window(std::int64_t number) {
  std::shared_ptr<Kept> kept;
  {
    const std::lock_guard lock(mutex_);
    auto& found = kept_[number];
    if (!found) found = std::make_shared<Kept>();
    found->asked = ++asked_;
    kept = found;
    if (kept_.size() > kMostKept)
      kept_.erase(std::min_element(kept_.begin(), kept_.end(),
                                   [](const auto& a, const auto& b) { return a.second->asked < b.second->asked; }));
  }
  std::call_once(kept->made, [&] { kept->window = std::make_shared<SweptWindow>(scene_, beam_, number, meet_); });
  return kept->window;
}

}  // namespace standpoint
