// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/timed_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/task_arena.h>

#include "scanners/engine/footprint.h"

namespace standpoint {

namespace {

constexpr int kPosesPerWindow = 8;
constexpr double kPerWindow = 4;  // 1 / kWindow_s

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

// What the bodies sweep in a quarter of a second, as a geometry of Embree with a box each.
struct TimedScene::Window {
  // Where the middle of a body is about, from one pose of the window to the next, and how far off at most.
  struct Path {
    Eigen::Vector3d centre[kPosesPerWindow + 1];
    double reach_m = 0;  // from there: of the body, too
  };
  TimedScene& owner;
  std::int64_t number;
  std::vector<std::uint32_t> bodies;  // those that are there
  std::vector<Path> paths;
  std::vector<Eigen::AlignedBox3d> swept;
  RTCScene scene = nullptr;

  Window(TimedScene& of, std::int64_t index) : owner(of), number(index) {
    const double from_s = static_cast<double>(number) * kWindow_s, step_s = kWindow_s / kPosesPerWindow;
    for (std::uint32_t b = 0; b < owner.scene_.bodies().size(); ++b) {
      const RestingBody& body = owner.scene_.bodies()[b];
      if (from_s + kWindow_s < body.from_s || from_s > body.to_s) continue;
      Eigen::AlignedBox3d box;
      Eigen::Vector3d before = Eigen::Vector3d::Zero();
      double step_m = 0;
      Path& path = paths.emplace_back();
      for (int i = -1; i <= kPosesPerWindow + 1; ++i) {
        const Eigen::Vector3d centre = body.local_from_rest->pose(from_s + i * step_s) * body.box.center();
        if (i >= 0) step_m = std::max(step_m, (centre - before).norm());
        box.extend(centre), before = centre;
        if (i >= 0 && i <= kPosesPerWindow) path.centre[i] = centre;
      }
      path.reach_m = body.box.diagonal().norm() / 2 + step_m / 2 + 1e-3;
      const double aside = body.box.diagonal().norm() / 2 + step_m + owner.beam_m_;
      bodies.push_back(b);
      swept.emplace_back(box.min().array() - aside, box.max().array() + aside);
    }
    if (bodies.empty()) return;
    // Whoever waits for others meanwhile might take up another column on this thread.
    tbb::this_task_arena::isolate([this] { build(); });
  }
  // May the ray come near the body before it ends?
  bool reaches(std::size_t k, double time_s, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
               double farthest_m) const {
    const double steps = (time_s * kPerWindow - static_cast<double>(number)) * kPosesPerWindow;
    const int i = std::clamp(static_cast<int>(steps), 0, kPosesPerWindow - 1);
    const Path& path = paths[k];
    const Eigen::Vector3d to = path.centre[i] + (steps - i) * (path.centre[i + 1] - path.centre[i]) - origin;
    const double along = std::max(0.0, to.dot(direction));
    if (along - path.reach_m > farthest_m + owner.beam_m_) return false;
    const double radius = path.reach_m + owner.aside_m(along + path.reach_m);
    return to.squaredNorm() - along * along <= radius * radius + 1e-9 * to.squaredNorm();
  }
  void build() {
    RTCDevice device = owner.scene_.device();
    scene = rtcNewScene(device);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(bodies.size()));
    rtcSetGeometryUserData(geometry, this);
    rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, meet);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, 0);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
  }
  ~Window() {
    if (scene != nullptr) rtcReleaseScene(scene);
  }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;
};

struct TimedScene::Asked {
  RayQuery query{RayQuery::Rays::coherent};  // first: Embree hands a pointer to its context on
  Eigen::Vector3d origin[kPacket], direction[kPacket];
  double time_s[kPacket] = {};
  float nearest_m = 0;
  std::uint64_t* facets = nullptr;
  float* ranges_m = nullptr;
  std::uint32_t near = 0;  // lanes
};

TimedScene::TimedScene(const EmbreeScene& scene, const BeamWidth& beam)
    : scene_(scene), width_(beam), beam_m_(aside_m(beam.farthest_m)), known_(scene.bodies().size()) {}

// As far out as rays of a beam go (footprint.h), which is w(R) ≤ (D0 + γR) / 2.
double TimedScene::aside_m(double range_m) const {
  return kBeamEdge * (width_.exit_m + width_.divergence_rad * std::min(range_m, width_.farthest_m)) / 2;
}

TimedScene::~TimedScene() = default;

void TimedScene::bounds(const RTCBoundsFunctionArguments* arguments) {
  const auto& window = *static_cast<const Window*>(arguments->geometryUserPtr);
  const Eigen::AlignedBox3d& box = window.swept[arguments->primID];
  const auto low = [](double v) { return std::nextafter(static_cast<float>(v), -std::numeric_limits<float>::max()); };
  const auto high = [](double v) { return std::nextafter(static_cast<float>(v), std::numeric_limits<float>::max()); };
  RTCBounds& to = *arguments->bounds_o;
  to.lower_x = low(box.min().x()), to.lower_y = low(box.min().y()), to.lower_z = low(box.min().z());
  to.upper_x = high(box.max().x()), to.upper_y = high(box.max().y()), to.upper_z = high(box.max().z());
}

void TimedScene::meet(const RTCIntersectFunctionNArguments* arguments) {
  const auto& window = *static_cast<const Window*>(arguments->geometryUserPtr);
  auto& asked = *reinterpret_cast<Asked*>(arguments->context);
  RTCRayN* rays = RTCRayHitN_RayN(arguments->rayhit, arguments->N);
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (arguments->valid[i] == 0) continue;
    const unsigned lane = RTCRayN_id(rays, arguments->N, i);
    if (!window.reaches(arguments->primID, asked.time_s[lane], asked.origin[lane], asked.direction[lane],
                        static_cast<double>(asked.ranges_m[lane])))
      continue;
    window.owner.meetBody(window.bodies[arguments->primID], asked, lane);
    // Boxes beyond what is met may still hold something in its cell of ranges, or be near a wide beam.
    RTCRayN_tfar(rays, arguments->N, i) = asked.ranges_m[lane] + static_cast<float>(window.owner.beam_m_) + 0.01F;
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
  const Eigen::Vector3d aside = Eigen::Vector3d::Constant(aside_m(reach) + 1e-4);
  const Eigen::AlignedBox3d box(resting.box.min() - aside, resting.box.max() + aside);
  if (!crosses(box, origin, direction, farthest + beam_m_)) return;
  asked.near |= 1U << lane;
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

TimedScene::Window& TimedScene::windowOf(std::int64_t number) {
  for (const auto& window : windows_)
    if (window && window->number == number) return *window;
  auto& window = windows_[oldest_];
  oldest_ = 1 - oldest_;
  window = std::make_unique<Window>(*this, number);
  return *window;
}

void TimedScene::ask(Asked& asked, int count) {
  for (std::uint32_t left = (1U << static_cast<unsigned>(count)) - 1; left != 0;) {
    RTCRayHit16 rays{};
    alignas(64) int valid[kPacket] = {};
    std::int64_t number = 0;
    bool any = false;
    for (int k = 0; k < count; ++k) {
      if ((left >> static_cast<unsigned>(k) & 1U) == 0) continue;
      const auto own = static_cast<std::int64_t>(std::floor(asked.time_s[k] / kWindow_s));
      if (any && own != number) continue;
      any = true, number = own;
      left &= ~(1U << static_cast<unsigned>(k));
      valid[k] = -1;
      scene_.setRay(rays, k, asked.origin[k], asked.direction[k], asked.nearest_m,
                    asked.ranges_m[k] + static_cast<float>(beam_m_) + 0.01F);
    }
    const Window& window = windowOf(number);
    if (window.scene != nullptr) asked.query.trace(valid, window.scene, rays);
  }
}

std::uint32_t TimedScene::intersect(const RayPacket& rays, int count, float max_range_m, std::uint64_t* facets,
                                    float* ranges_m) {
  scene_.intersect(rays, count, max_range_m, facets, ranges_m);
  if (!moves()) return 0;
  Asked asked;
  asked.facets = facets, asked.ranges_m = ranges_m;
  for (int k = 0; k < count; ++k) {
    asked.origin[k] = Eigen::Vector3f(rays.origin_x[k], rays.origin_y[k], rays.origin_z[k]).cast<double>();
    asked.direction[k] = Eigen::Vector3f(rays.direction_x[k], rays.direction_y[k], rays.direction_z[k]).cast<double>();
    asked.time_s[k] = rays.time_s[k];
  }
  ask(asked, count);
  return asked.near;
}

void TimedScene::intersect(const RayPacket& rays, int count, float max_range_m, NearestHit* hits) {
  std::uint64_t facets[kPacket];
  float ranges_m[kPacket];
  intersect(rays, count, max_range_m, facets, ranges_m);
  for (int k = 0; k < count; ++k) hits[k] = {facets[k], ranges_m[k]};
}

NearestHit TimedScene::nearest(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction_unit, double min_range_m,
                               double max_range_m, double time_s) {
  NearestHit hit = scene_.nearest(origin, direction_unit, min_range_m, max_range_m);
  if (!moves()) return hit;
  Asked asked;
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
  Asked asked;
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
