// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/timed_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace standpoint {

namespace {

// From where a ray enters the box to where it leaves it, in multiples of its direction; empty where it misses it.
bool crosses(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
             double farthest) {
  double from = 0, to = farthest;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.min()[axis] - origin[axis], high = box.max()[axis] - origin[axis];
    if (direction[axis] == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    const double a = low / direction[axis], b = high / direction[axis];
    from = std::max(from, std::min(a, b)), to = std::min(to, std::max(a, b));
  }
  return from <= to;
}

}  // namespace

struct TimedScene::Asked {
  RayQuery query{RayQuery::Rays::coherent};  // first: Embree hands a pointer to its context on
  TimedScene& of;
  Eigen::Vector3d origin[kPacket], direction[kPacket];
  double time_s[kPacket] = {};
  float nearest_m = 0;
  std::uint64_t* facets = nullptr;
  float* ranges_m = nullptr;
  std::vector<NearBody>* near = nullptr;

  void comesNear(std::uint32_t body, unsigned lane) const {
    if (near == nullptr) return;
    const auto known = std::find_if(near->begin(), near->end(), [&](const NearBody& n) { return n.body == body; });
    (known != near->end() ? *known : near->emplace_back(NearBody{body})).lanes |= 1U << lane;
  }
};

std::shared_ptr<SweptBodies> TimedScene::swept(const EmbreeScene& scene, const BeamWidth& beam) {
  return std::make_shared<SweptBodies>(scene, beam, meet);
}

TimedScene::TimedScene(std::shared_ptr<SweptBodies> bodies)
    : swept_(std::move(bodies)),
      scene_(swept_->scene()),
      beam_m_(swept_->beam().aside_m(swept_->beam().farthest_m)),
      known_(scene_.bodies().size()) {}

void TimedScene::meet(const RTCIntersectFunctionNArguments* arguments) {
  const auto& window = *static_cast<const SweptWindow*>(arguments->geometryUserPtr);
  auto& asked = *reinterpret_cast<Asked*>(arguments->context);
  RTCRayN* rays = RTCRayHitN_RayN(arguments->rayhit, arguments->N);
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (arguments->valid[i] == 0) continue;
    const unsigned lane = RTCRayN_id(rays, arguments->N, i);
    if (!window.reaches(arguments->primID, asked.time_s[lane], asked.origin[lane], asked.direction[lane],
                        static_cast<double>(asked.ranges_m[lane])))
      continue;
    asked.of.meetBody(window.body(arguments->primID), asked, lane);
    // Boxes beyond what is met may still hold something in its cell of ranges, or be near a wide beam.
    RTCRayN_tfar(rays, arguments->N, i) = asked.ranges_m[lane] + static_cast<float>(asked.of.beam_m_) + 0.01F;
  }
}

void TimedScene::meetBody(std::uint32_t body, Asked& asked, unsigned lane) {
  const RestingBody& resting = scene_.bodies()[body];
  const double time_s = asked.time_s[lane];
  if (time_s < resting.from_s || time_s > resting.to_s) return;
  const Pose& at = pose(body, time_s);
  const Eigen::Quaterniond back = at.rotation.conjugate();
  const Eigen::Vector3d origin = back * (asked.origin[lane] - at.translation), direction = back * asked.direction[lane];
  const auto farthest = static_cast<double>(asked.ranges_m[lane]);
  const double reach = (resting.box.center() - origin).norm() + resting.box.diagonal().norm() / 2;
  const Eigen::Vector3d aside = Eigen::Vector3d::Constant(swept_->beam().aside_m(reach) + 1e-4);
  const Eigen::AlignedBox3d box(resting.box.min() - aside, resting.box.max() + aside);
  if (!crosses(box, origin, direction, farthest + beam_m_)) return;
  asked.comesNear(body, lane);
  const NearestHit hit = scene_.nearestOf(body, origin, direction, static_cast<double>(asked.nearest_m), farthest);
  if (hit.facet == kNoFacet) return;
  const bool first =
      hit.range_m < asked.ranges_m[lane] || (hit.range_m == asked.ranges_m[lane] && hit.facet < asked.facets[lane]);
  if (first) asked.facets[lane] = hit.facet, asked.ranges_m[lane] = hit.range_m;
}

const Pose& TimedScene::pose(std::uint32_t body, double time_s) {
  Known& known = known_[body];
  if (known.slot != kNoSlot && known.time_s == time_s) return known.local_from_rest;
  const double slots = std::floor(time_s * kSlots_per_s);
  if (const auto slot = static_cast<std::int64_t>(slots); known.slot != slot) {
    known.slot = slot;
    known.poses.sample(*scene_.bodies()[body].local_from_rest, Pose{}, slots / kSlots_per_s,
                       (slots + 1) / kSlots_per_s);
  }
  known.time_s = time_s;
  return known.local_from_rest = known.poses.at(time_s);
}

const SweptWindow& TimedScene::windowOf(std::int64_t number) {
  for (const Held& held : windows_)
    if (held.window && held.number == number) return *held.window;
  Held& held = windows_[oldest_];
  oldest_ = 1 - oldest_;
  held = {number, swept_->window(number)};
  return *held.window;
}

void TimedScene::ask(Asked& asked, int count) {
  for (std::uint32_t left = (1U << static_cast<unsigned>(count)) - 1; left != 0;) {
    RTCRayHit16 rays{};
    alignas(64) int valid[kPacket] = {};
    std::int64_t number = 0;
    bool any = false;
    for (int k = 0; k < count; ++k) {
      if ((left >> static_cast<unsigned>(k) & 1U) == 0) continue;
      const auto own = static_cast<std::int64_t>(std::floor(asked.time_s[k] / SweptWindow::kLength_s));
      if (any && own != number) continue;
      any = true, number = own;
      left &= ~(1U << static_cast<unsigned>(k));
      valid[k] = -1;
      scene_.setRay(rays, k, asked.origin[k], asked.direction[k], asked.nearest_m,
                    asked.ranges_m[k] + static_cast<float>(beam_m_) + 0.01F);
    }
    const SweptWindow& window = windowOf(number);
    if (window.scene() != nullptr) asked.query.trace(valid, window.scene(), rays);
  }
}

void TimedScene::intersect(const RayPacket& rays, int count, float max_range_m, std::uint64_t* facets, float* ranges_m,
                           std::vector<NearBody>* near) {
  scene_.intersect(rays, count, max_range_m, facets, ranges_m);
  if (!moves()) return;
  Asked asked{.of = *this};
  asked.near = near;
  asked.facets = facets, asked.ranges_m = ranges_m;
  for (int k = 0; k < count; ++k) {
    asked.origin[k] = Eigen::Vector3f(rays.origin_x[k], rays.origin_y[k], rays.origin_z[k]).cast<double>();
    asked.direction[k] = Eigen::Vector3f(rays.direction_x[k], rays.direction_y[k], rays.direction_z[k]).cast<double>();
    asked.time_s[k] = rays.time_s[k];
  }
  ask(asked, count);
}

void TimedScene::intersect(const RayPacket& rays, int count, float max_range_m, NearestHit* hits) {
  std::uint64_t facets[kPacket];
  float ranges_m[kPacket];
  intersect(rays, count, max_range_m, facets, ranges_m, nullptr);
  for (int k = 0; k < count; ++k) hits[k] = {facets[k], ranges_m[k]};
}

NearestHit TimedScene::nearest(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction_unit, double min_range_m,
                               double max_range_m, double time_s) {
  NearestHit hit = scene_.nearest(origin, direction_unit, min_range_m, max_range_m);
  if (!moves()) return hit;
  Asked asked{.of = *this};
  asked.origin[0] = origin, asked.direction[0] = direction_unit, asked.time_s[0] = time_s;
  asked.nearest_m = static_cast<float>(min_range_m);
  asked.facets = &hit.facet, asked.ranges_m = &hit.range_m;
  ask(asked, 1);
  return hit;
}

NearestHit TimedScene::nearestBody(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction_unit,
                                   double max_range_m, double time_s) {
  NearestHit hit{kNoFacet, static_cast<float>(max_range_m)};
  if (!moves()) return hit;
  Asked asked{.of = *this};
  asked.origin[0] = origin, asked.direction[0] = direction_unit, asked.time_s[0] = time_s;
  asked.facets = &hit.facet, asked.ranges_m = &hit.range_m;
  ask(asked, 1);
  return hit;
}

Facet TimedScene::at(const Facet& facet, double time_s) {
  if (facet.body == kNoBody) return facet;
  const Pose& at = pose(facet.body, time_s);
  Facet placed = facet;
  placed.normal = at.rotation * facet.normal;
  placed.offset = facet.offset + placed.normal.dot(at.translation);
  return placed;
}

}  // namespace standpoint
