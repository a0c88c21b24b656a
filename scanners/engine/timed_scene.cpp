// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/timed_scene.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "scanners/math/target_clones.h"

namespace standpoint {

namespace {

std::int64_t slotOf(double time_s, double slots_per_s) {
  return static_cast<std::int64_t>(std::floor(time_s * slots_per_s));
}

STANDPOINT_CLONES void widen(const RayPacket& from, TimedRays& to) {
  for (int k = 0; k < kPacket; ++k) {
    to.rays.origin.x[k] = static_cast<double>(from.origin_x[k]);
    to.rays.origin.y[k] = static_cast<double>(from.origin_y[k]);
    to.rays.origin.z[k] = static_cast<double>(from.origin_z[k]);
    to.rays.direction.x[k] = static_cast<double>(from.direction_x[k]);
    to.rays.direction.y[k] = static_cast<double>(from.direction_y[k]);
    to.rays.direction.z[k] = static_cast<double>(from.direction_z[k]);
    to.time_s[k] = from.time_s[k];
  }
}

// A box and how far rays go beyond what they meet, in the frame of rays.
struct WideBox {
  double low[3], high[3], centre[3], radius, beyond_m;
  WideBox(const Eigen::AlignedBox3d& box, double beyond) : radius(box.diagonal().norm() / 2), beyond_m(beyond) {
    for (int axis = 0; axis < 3; ++axis)
      low[axis] = box.min()[axis], high[axis] = box.max()[axis], centre[axis] = box.center()[axis];
  }
};

// Narrows the way of a ray to where it is between two planes; in multiples of its direction. One along them is between
// them everywhere or nowhere.
STANDPOINT_INLINE void narrow(double low, double high, double origin, double direction, double& from, double& to) {
  constexpr double kAlong = 1e-300;
  const double across = direction != 0 ? direction : kAlong;
  const double a = (low - origin) / across, b = (high - origin) / across;
  const double first = a < b ? a : b, last = a < b ? b : a;
  from = from < first ? first : from;
  to = last < to ? last : to;
}

// Which rays enter the box, wider by the beam about them.
STANDPOINT_CLONES void enter(const WideBox& box, const BeamWidth& beam, const RayLanes& rays, const float* farthest_m,
                             std::uint64_t* enters) {
  for (int k = 0; k < kPacket; ++k) {
    const double x = rays.origin.x[k], y = rays.origin.y[k], z = rays.origin.z[k];
    const double dx = box.centre[0] - x, dy = box.centre[1] - y, dz = box.centre[2] - z;
    const double aside = beam.aside_m(std::sqrt(dotOf(dx, dy, dz, dx, dy, dz)) + box.radius) + 1e-4;
    double from = 0, to = static_cast<double>(farthest_m[k]) + box.beyond_m;
    narrow(box.low[0] - aside, box.high[0] + aside, x, rays.direction.x[k], from, to);
    narrow(box.low[1] - aside, box.high[1] + aside, y, rays.direction.y[k], from, to);
    narrow(box.low[2] - aside, box.high[2] + aside, z, rays.direction.z[k], from, to);
    enters[k] = from <= to ? 1U : 0;
  }
}

}  // namespace

struct TimedScene::Asked {
  RayQuery query{RayQuery::Rays::coherent};  // first: Embree hands a pointer to its context on
  TimedScene& of;
  const RayPacket& packet;
  TimedRays rays;  // those of the packet, if not more exactly
  float nearest_m = 0;
  std::uint64_t* facets = nullptr;
  float* ranges_m = nullptr;  // of all sixteen
  // That are asked about, as bits: where Embree (3.13) takes the sixteen in eights, it calls back for others, too.
  std::uint32_t in_question = 0;
  std::vector<NearBody>* near = nullptr;

  void comeNear(std::uint32_t body, std::uint32_t lanes) const {
    if (near == nullptr || lanes == 0) return;
    const auto known = std::find_if(near->begin(), near->end(), [&](const NearBody& n) { return n.body == body; });
    (known != near->end() ? *known : near->emplace_back(NearBody{body})).lanes |= lanes;
  }
};

std::shared_ptr<SweptBodies> TimedScene::swept(const EmbreeScene& scene, const BeamWidth& beam) {
  return std::make_shared<SweptBodies>(scene, beam, meet);
}

TimedScene::TimedScene(std::shared_ptr<SweptBodies> bodies)
    : swept_(std::move(bodies)),
      scene_(swept_->scene()),
      beam_m_(swept_->beam().aside_m(swept_->beam().farthest_m)),
      slots_(scene_.bodies().size()) {}

void TimedScene::meet(const RTCIntersectFunctionNArguments* arguments) {
  const auto& window = *static_cast<const SweptWindow*>(arguments->geometryUserPtr);
  auto& asked = *reinterpret_cast<Asked*>(arguments->context);
  RTCRayN* rays = RTCRayHitN_RayN(arguments->rayhit, arguments->N);
  std::uint32_t asking = 0;
  for (unsigned i = 0; i < arguments->N; ++i)
    if (arguments->valid[i] != 0) asking |= 1U << RTCRayN_id(rays, arguments->N, i);
  asking = window.reaching(arguments->primID, asked.rays, asking & asked.in_question, asked.ranges_m);
  if (asking == 0) return;
  asked.of.meetBody(window.body(arguments->primID), asked, asking);
  // Boxes beyond what is met may still hold something in its cell of ranges, or be near a wide beam.
  for (unsigned i = 0; i < arguments->N; ++i)
    if (const unsigned lane = RTCRayN_id(rays, arguments->N, i); arguments->valid[i] != 0 && (asking >> lane & 1U) != 0)
      RTCRayN_tfar(rays, arguments->N, i) = asked.ranges_m[lane] + static_cast<float>(asked.of.beam_m_) + 0.01F;
}

void TimedScene::meetBody(std::uint32_t body, Asked& asked, std::uint32_t lanes) {
  const RestingBody& resting = scene_.bodies()[body];
  forLanes(lanes, [&](std::uint32_t k) {
    if (asked.rays.time_s[k] < resting.from_s || asked.rays.time_s[k] > resting.to_s) lanes &= ~(1U << k);
  });
  if (lanes == 0) return;
  PoseLanes where;
  poses(body, asked.rays.time_s, lanes, where);
  RayLanes rest;
  placesAtRest(where, asked.rays.rays.origin, rest.origin);
  directionsAtRest(where, asked.rays.rays.direction, rest.direction);
  std::uint64_t enters[kPacket];
  enter({resting.box, beam_m_}, swept_->beam(), rest, asked.ranges_m, enters);
  lanes &= bitsOf(enters);
  asked.comeNear(body, lanes);
  if (lanes != 0) scene_.intersectBody(body, rest, lanes, asked.nearest_m, asked.facets, asked.ranges_m);
}

const PoseWindow& TimedScene::during(std::uint32_t body, std::int64_t number) {
  Slot& slot = slots_[body][static_cast<std::size_t>(number & 1)];
  if (slot.number != number) {
    slot.number = number;
    const auto from = static_cast<double>(number);
    slot.poses.sample(*scene_.bodies()[body].local_from_rest, Pose{}, from / kSlots_per_s, (from + 1) / kSlots_per_s);
  }
  return slot.poses;
}

Pose TimedScene::pose(std::uint32_t body, double time_s) {
  return during(body, slotOf(time_s, kSlots_per_s)).at(time_s);
}

void TimedScene::poses(std::uint32_t body, const double* times_s, std::uint32_t lanes, PoseLanes& local_from_rest) {
  while (lanes != 0) {
    const std::int64_t slot = slotOf(times_s[std::countr_zero(lanes)], kSlots_per_s);
    std::uint32_t meanwhile = 0;
    forLanes(lanes, [&](std::uint32_t k) {
      if (slotOf(times_s[k], kSlots_per_s) == slot) meanwhile |= 1U << k;
    });
    during(body, slot).at(times_s, meanwhile, local_from_rest);
    lanes &= ~meanwhile;
  }
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
  static thread_local RTCRayHit16 query{};
  for (std::uint32_t left = (1U << static_cast<unsigned>(count)) - 1; left != 0;) {
    alignas(64) int valid[kPacket] = {};
    const std::uint32_t before = left;
    const std::int64_t number = slotOf(asked.rays.time_s[std::countr_zero(left)], 1 / SweptWindow::kLength_s);
    forLanes(left, [&](std::uint32_t k) {
      if (slotOf(asked.rays.time_s[k], 1 / SweptWindow::kLength_s) == number) valid[k] = -1, left &= ~(1U << k);
    });
    asked.in_question = before & ~left;
    const SweptWindow& window = windowOf(number);
    if (window.scene() == nullptr) continue;
    window.setPieces(asked.rays);
    EmbreeScene::setRays(query, asked.packet);
    for (int k = 0; k < kPacket; ++k)
      query.ray.tnear[k] = asked.nearest_m, query.ray.tfar[k] = asked.ranges_m[k] + static_cast<float>(beam_m_) + 0.01F;
    asked.query.trace(valid, window.scene(), query);
  }
}

void TimedScene::intersect(const RayPacket& rays, int count, float max_range_m, std::uint64_t* facets, float* ranges_m,
                           std::vector<NearBody>* near) {
  scene_.intersect(rays, count, max_range_m, facets, ranges_m);
  if (!moves()) return;
  Asked asked{.of = *this, .packet = rays};
  asked.near = near;
  asked.facets = facets, asked.ranges_m = ranges_m;
  widen(rays, asked.rays);
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
  const NearestHit still = scene_.nearest(origin, direction_unit, min_range_m, max_range_m);
  return moves() ? nearer(still, origin, direction_unit, min_range_m, time_s) : still;
}

NearestHit TimedScene::nearestBody(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction_unit,
                                   double max_range_m, double time_s) {
  const NearestHit nothing{kNoFacet, static_cast<float>(max_range_m)};
  return moves() ? nearer(nothing, origin, direction_unit, 0, time_s) : nothing;
}

NearestHit TimedScene::nearer(const NearestHit& than, const Eigen::Vector3d& origin,
                              const Eigen::Vector3d& direction_unit, double min_range_m, double time_s) {
  RayPacket packet{};
  packet.set(0, origin, direction_unit);
  std::uint64_t facets[kPacket] = {than.facet};
  float ranges_m[kPacket] = {than.range_m};
  Asked asked{.of = *this, .packet = packet};
  asked.rays.rays.origin.set(0, origin), asked.rays.rays.direction.set(0, direction_unit);
  asked.rays.time_s[0] = time_s;
  asked.nearest_m = static_cast<float>(min_range_m);
  asked.facets = facets, asked.ranges_m = ranges_m;
  ask(asked, 1);
  return {facets[0], ranges_m[0]};
}

Facet TimedScene::at(const Facet& facet, double time_s) {
  if (facet.body == kNoBody) return facet;
  const Pose at = pose(facet.body, time_s);
  Facet placed = facet;
  placed.normal = at.rotation * facet.normal;
  placed.offset = facet.offset + placed.normal.dot(at.translation);
  return placed;
}

}  // namespace standpoint
