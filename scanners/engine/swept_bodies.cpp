// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/swept_bodies.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <tbb/task_arena.h>

#include "scanners/math/target_clones.h"

namespace standpoint {

namespace {

// Which rays that are sent while the body is on one piece of its path come near it; `number`: of the window.
STANDPOINT_CLONES void reach(const SweptWindow::Path& path, int piece, double number, const BeamWidth& beam,
                             double beam_m, const TimedRays& timed, const float* farthest_m, std::uint64_t* reaches) {
  const auto& [origin, direction] = timed.rays;
  const double from[3] = {path.centre[0][piece], path.centre[1][piece], path.centre[2][piece]};
  const double step[3] = {path.centre[0][piece + 1] - from[0], path.centre[1][piece + 1] - from[1],
                          path.centre[2][piece + 1] - from[2]};
  for (int k = 0; k < kPacket; ++k) {
    const double after = (timed.time_s[k] / SweptWindow::kLength_s - number) * SweptWindow::kPoses - piece;
    const double x = from[0] + after * step[0] - origin.x[k], y = from[1] + after * step[1] - origin.y[k];
    const double z = from[2] + after * step[2] - origin.z[k];
    const double ahead = dotOf(x, y, z, direction.x[k], direction.y[k], direction.z[k]);
    const double along = ahead > 0 ? ahead : 0, square = dotOf(x, y, z, x, y, z);
    const double radius = path.reach_m + beam.aside_m(along + path.reach_m);
    const double beyond = along - path.reach_m - (static_cast<double>(farthest_m[k]) + beam_m);
    const double off = square - along * along - (radius * radius + 1e-9 * square);
    reaches[k] = (beyond > off ? beyond : off) <= 0 ? 1U : 0;
  }
}

}  // namespace

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
    for (int axis = 0; i >= 0 && i <= kPoses && axis < 3; ++axis) path.centre[axis][i] = centre[axis];
  }
  path.reach_m = body.box.diagonal().norm() / 2 + step_m / 2 + 1e-3;
  const double aside = body.box.diagonal().norm() / 2 + step_m + beam_m_;
  bodies_.push_back(number);
  boxes_.emplace_back(box.min().array() - aside, box.max().array() + aside);
}

void SweptWindow::setPieces(TimedRays& rays) const {
  const auto number = static_cast<double>(number_);
  for (int k = 0; k < kPacket; ++k)
    rays.piece[k] = std::clamp(static_cast<int>((rays.time_s[k] / kLength_s - number) * kPoses), 0, kPoses - 1);
}

std::uint32_t SweptWindow::reaching(std::size_t box, const TimedRays& rays, std::uint32_t lanes,
                                    const float* farthest_m) const {
  const auto number = static_cast<double>(number_);
  std::uint32_t found = 0;
  while (lanes != 0) {
    const int of_first = rays.piece[std::countr_zero(lanes)];
    std::uint32_t meanwhile = 0;
    for (std::uint32_t k = 0; k < kPacket; ++k) meanwhile |= rays.piece[k] == of_first ? lanes & 1U << k : 0;
    std::uint64_t reaches[kPacket];
    reach(paths_[box], of_first, number, beam_, beam_m_, rays, farthest_m, reaches);
    found |= meanwhile & bitsOf(reaches);
    lanes &= ~meanwhile;
  }
  return found;
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
