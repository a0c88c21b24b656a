// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include "scanners/engine/embree_scene.h"
#include "scanners/math/target_clones.h"

namespace standpoint {

namespace {

// A mesh that stands in one place, or is smaller than the record of an instance, is put into the scene itself: that
// spares each ray the change of frame.
constexpr std::size_t kSmallMesh = 64;
// Of the bounds of triangles, as a share of the scene's size: several times the rounding of Embree's boxes and frames.
constexpr double kSwell = 2e-6;

bool onProgress(void* progress, double fraction) {
  auto& handle = *static_cast<Progress*>(progress);
  handle.advance(fraction);
  return !handle.cancelled();
}

Result<void> checkDevice(RTCDevice device) {
  const RTCError code = rtcGetDeviceError(device);
  if (code == RTC_ERROR_NONE) return {};
  if (code == RTC_ERROR_CANCELLED) return failure(ErrorKind::cancelled, "cancelled");
  if (code == RTC_ERROR_OUT_OF_MEMORY)
    return failure(ErrorKind::unusable, "the environment does not fit into memory", "ray scene");
  return failure(ErrorKind::internal, "Embree error " + std::to_string(code) + " while building", "ray scene");
}

}  // namespace

EmbreeScene::~EmbreeScene() {
  for (RTCScene scene : mesh_scenes_)
    if (scene != nullptr) rtcReleaseScene(scene);
  for (const RestingBody& body : bodies_)
    if (body.scene != nullptr) rtcReleaseScene(body.scene);
  if (scene_ != nullptr) rtcReleaseScene(scene_);
  if (device_ != nullptr) rtcReleaseDevice(device_);
}

Result<void> EmbreeScene::commit(std::shared_ptr<const Environment> environment,
                                 const std::vector<RoundInstance>& balls, const std::string& embree_settings,
                                 const std::vector<MovingBody>& bodies, Progress& progress) {
  environment_ = std::move(environment);
  if (auto wrong = validate(*environment_); !wrong.empty()) return failure(ErrorKind::unusable, wrong, "environment");
  device_ = rtcNewDevice(embree_settings.c_str());
  if (device_ == nullptr) return failure(ErrorKind::internal, "Embree has no device on this machine", "ray scene");
  scene_ = rtcNewScene(device_);
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  mesh_scenes_.assign(environment_->meshes.size(), nullptr);

  listPlacements(bodies);
  std::vector<std::uint32_t> uses(environment_->meshes.size(), 0);
  for (std::size_t k = 0; k < still_count_; ++k) ++uses[placed(k).mesh];
  size_m_ = size();
  for (const std::uint32_t i : placements_) placed_at_.push_back(environment_->instances[i].world_from_mesh);
  tbb::parallel_invoke([&] { buildTree(uses, balls, progress); }, [&] { findEdges(progress); });
  buildBodies(bodies);
  if (auto go_on = progress.check(); !go_on) return go_on;
  return checkDevice(device_);
}

void EmbreeScene::listPlacements(const std::vector<MovingBody>& bodies) {
  std::vector<std::uint32_t> body_of(environment_->instances.size(), kNoBody);
  for (std::uint32_t b = 0; b < bodies.size(); ++b)
    for (const std::uint32_t instance : bodies[b].instances) body_of[instance] = b;
  for (const bool moving : {false, true}) {
    for (std::uint32_t i = 0; i < environment_->instances.size(); ++i) {
      const Instance& instance = environment_->instances[i];
      if ((body_of[i] != kNoBody) != moving || !environment_->products[instance.product].inScene() ||
          environment_->meshes[instance.mesh]->triangles.empty())
        continue;
      placements_.push_back(i);
      if (moving) body_of_.push_back(body_of[i]);
    }
    if (!moving) still_count_ = placements_.size();
  }
}

void EmbreeScene::buildBodies(const std::vector<MovingBody>& bodies) {
  tbb::task_arena one_thread(1);  // as for what stands
  one_thread.execute([&] {
    for (const MovingBody& body : bodies) {
      RestingBody& resting = bodies_.emplace_back();
      resting.scene = rtcNewScene(device_);
      resting.local_from_rest = body.local_from_rest;
      resting.from_s = body.from_s, resting.to_s = body.to_s;
      rtcSetSceneFlags(resting.scene, RTC_SCENE_FLAG_ROBUST);
    }
    for (std::size_t k = still_count_; k < placements_.size(); ++k) {
      RestingBody& resting = bodies_[body_of_[k - still_count_]];
      attachPlaced(static_cast<std::uint32_t>(k), resting.scene);
      for (const auto& p : environment_->meshes[placed(k).mesh]->positions)
        resting.box.extend(placed(k).world_from_mesh * p.cast<double>());
    }
    for (const RestingBody& resting : bodies_) rtcCommitScene(resting.scene);
  });
  // What stands at rest inside of nothing is no body to meet.
  for (RestingBody& resting : bodies_)
    if (resting.box.isEmpty()) resting.to_s = -std::numeric_limits<double>::infinity();
}

void EmbreeScene::buildTree(const std::vector<std::uint32_t>& uses, const std::vector<RoundInstance>& balls,
                            Progress& progress) {
  // One thread builds: with more, the order of triangles in a leaf, and so which of two coincident faces is met, would
  // depend on timing. A million triangles take about half a second.
  tbb::task_arena one_thread(1);
  one_thread.execute([&] {
    for (std::uint32_t k = 0; k < still_count_ && !progress.cancelled(); ++k) {
      const auto mesh = environment_->instances[placements_[k]].mesh;
      const auto ball = std::find_if(balls.begin(), balls.end(),
                                     [&](const RoundInstance& b) { return b.instance == placements_[k]; });
      if (ball != balls.end())
        attachBall(k, ball->radius_m);
      else if (uses[mesh] == 1 || environment_->meshes[mesh]->triangles.size() <= kSmallMesh)
        attachPlaced(k, scene_);
      else
        attachInstanced(k);
    }
    rtcSetSceneProgressMonitorFunction(scene_, onProgress, &progress);
    rtcCommitScene(scene_);
    rtcSetSceneProgressMonitorFunction(scene_, nullptr, nullptr);
  });
}

void EmbreeScene::findEdges(Progress& progress) {
  std::vector<std::uint8_t> used(environment_->meshes.size(), 0);
  for (const std::uint32_t i : placements_) used[environment_->instances[i].mesh] = 1;
  edges_.resize(used.size());
  tbb::parallel_for(std::size_t{0}, used.size(), [&](std::size_t mesh) {
    if (used[mesh] != 0 && !progress.cancelled()) edges_[mesh] = outlineEdges(*environment_->meshes[mesh]);
  });
}

double EmbreeScene::size() const {
  std::vector<double> radius_m(environment_->meshes.size(), -1);
  double size_m = 0;
  for (const std::uint32_t i : placements_) {
    const Instance& instance = environment_->instances[i];
    double& radius = radius_m[instance.mesh];
    if (radius < 0)
      for (const auto& p : environment_->meshes[instance.mesh]->positions)
        radius = std::max(radius, static_cast<double>(p.norm()));
    size_m = std::max(
        size_m, instance.world_from_mesh.translation().norm() + instance.world_from_mesh.linear().norm() * radius);
  }
  return size_m;
}

void EmbreeScene::attachPlaced(std::uint32_t placement, RTCScene scene) {
  const Instance& instance = environment_->instances[placements_[placement]];
  RayFaces& faces = faces_.emplace_back(*environment_->meshes[instance.mesh], instance.world_from_mesh);
  faces.swell = kSwell * size_m_;
  RTCGeometry geometry = newFaces(device_, faces);
  rtcAttachGeometryByID(scene, geometry, placement);
  rtcReleaseGeometry(geometry);
}

void EmbreeScene::attachBall(std::uint32_t placement, double radius_m) {
  const Instance& instance = environment_->instances[placements_[placement]];
  const auto& ball = balls_[placement] = {instance.world_from_mesh.translation(), radius_m};
  RTCGeometry geometry = ballGeometry(device_, ball);
  rtcAttachGeometryByID(scene_, geometry, placement);
  rtcReleaseGeometry(geometry);
}

RTCScene EmbreeScene::meshScene(std::uint32_t mesh) {
  if (mesh_scenes_[mesh] != nullptr) return mesh_scenes_[mesh];
  RayFaces& faces = faces_.emplace_back(*environment_->meshes[mesh], Eigen::Affine3d::Identity());
  faces.world_from_mesh = placed_at_.data();
  for (const std::uint32_t i : placements_)
    if (const Instance& instance = environment_->instances[i]; instance.mesh == mesh)
      faces.swell = std::max(faces.swell, kSwell * size_m_ * instance.world_from_mesh.linear().inverse().norm());
  RTCScene scene = rtcNewScene(device_);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = newFaces(device_, faces);
  rtcAttachGeometryByID(scene, geometry, 0);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  return mesh_scenes_[mesh] = scene;
}

void EmbreeScene::attachInstanced(std::uint32_t placement) {
  const Instance& instance = environment_->instances[placements_[placement]];
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, meshScene(instance.mesh));
  const Eigen::Matrix<float, 3, 4> transform = instance.world_from_mesh.matrix().topRows<3>().cast<float>();
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform.data());
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene_, geometry, placement);
  rtcReleaseGeometry(geometry);
}

namespace {

std::uint64_t facetNumber(std::uint32_t instance_id, std::uint32_t geometry_id, std::uint32_t primitive_id) {
  if (geometry_id == RTC_INVALID_GEOMETRY_ID) return kNoFacet;
  const std::uint64_t placement = instance_id == RTC_INVALID_GEOMETRY_ID ? geometry_id : instance_id;
  return placement << 32U | primitive_id;
}

// Embree takes what is nearly 0 for a small positive number, whatever its sign, and sixteen rays of unlike signs miss
// boxes then (3.13, geometries of the user's own). It is off by less than the bounds are swollen by.
float clearDirection(float part) { return std::abs(part) < 1e-9F ? 0.0F : part; }

void clearDirections(const float* from, float* to) {
  for (int k = 0; k < 3 * kPacket; ++k) to[k] = clearDirection(from[k]);
}

void tracePacket(RTCScene scene, const RayPacket& rays, std::uint32_t lanes, RTCRayHit16& query) {
  alignas(64) int valid[kPacket];
  for (unsigned k = 0; k < kPacket; ++k) valid[k] = (lanes >> k & 1U) != 0 ? -1 : 0;
  MeetingQuery meeting(RayQuery::Rays::coherent);
  meeting.set(rays.origin_x, rays.direction_x, kPacket, kPacket, rays.one_origin, rays.seen);
  EmbreeScene::setRays(query, rays);
  meeting.query.trace(valid, scene, query);
}

// Lanes that are not among those have the ray of the first one.
STANDPOINT_CLONES void roundAll(const double* from, const std::uint64_t* in, int first, float* to) {
  const double other = from[first];
  for (int k = 0; k < kPacket; ++k) to[k] = static_cast<float>(in[k] != 0 ? from[k] : other);
}

}  // namespace

void EmbreeScene::setRays(RTCRayHit16& query, const RayPacket& rays) {
  std::copy_n(rays.origin_x, 3 * kPacket, query.ray.org_x);  // x, y, z lie side by side in both
  clearDirections(rays.direction_x, query.ray.dir_x);
  for (unsigned k = 0; k < kPacket; ++k) {
    query.ray.mask[k] = ~0U, query.ray.id[k] = k;
    query.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
  }
}

void EmbreeScene::intersect(const RayPacket& rays, int count, float max_range_m, std::uint64_t* facets,
                            float* ranges_m) const {
  static thread_local RTCRayHit16 query{};
  std::fill_n(query.ray.tfar, kPacket, max_range_m);
  tracePacket(scene_, rays, (1U << static_cast<unsigned>(count)) - 1, query);
  for (int k = 0; k < count; ++k)
    facets[k] = facetNumber(query.hit.instID[0][k], query.hit.geomID[k], query.hit.primID[k]);
  std::copy_n(query.ray.tfar, count, ranges_m);
}

void EmbreeScene::intersectBody(std::uint32_t body, const RayLanes& rays, std::uint32_t lanes, float min_range_m,
                                std::uint64_t* facets, float* ranges_m) const {
  static thread_local RTCRayHit16 query{};
  std::uint64_t in[kPacket] = {};
  forLanes(lanes, [&](std::uint32_t k) { in[k] = 1; });
  RayPacket packet;
  const int first = std::countr_zero(lanes);
  roundAll(rays.origin.x, in, first, packet.origin_x), roundAll(rays.origin.y, in, first, packet.origin_y);
  roundAll(rays.origin.z, in, first, packet.origin_z), roundAll(rays.direction.x, in, first, packet.direction_x);
  roundAll(rays.direction.y, in, first, packet.direction_y), roundAll(rays.direction.z, in, first, packet.direction_z);
  std::fill_n(query.ray.tnear, kPacket, min_range_m);
  std::copy_n(ranges_m, kPacket, query.ray.tfar);
  tracePacket(bodies_[body].scene, packet, lanes, query);
  forLanes(lanes, [&](std::uint32_t k) {
    const std::uint64_t facet = facetNumber(query.hit.instID[0][k], query.hit.geomID[k], query.hit.primID[k]);
    const float range_m = query.ray.tfar[k];
    if (facet != kNoFacet && (range_m < ranges_m[k] || (range_m == ranges_m[k] && facet < facets[k])))
      facets[k] = facet, ranges_m[k] = range_m;
  });
}

void EmbreeScene::intersect(const RayPacket& rays, int count, float max_range_m, NearestHit* hits) const {
  std::uint64_t facets[kPacket];
  float ranges_m[kPacket];
  intersect(rays, count, max_range_m, facets, ranges_m);
  for (int k = 0; k < count; ++k) hits[k] = {facets[k], ranges_m[k]};
}

NearestHit EmbreeScene::nearest(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction_unit,
                                double min_range_m, double max_range_m) const {
  RTCRayHit query{};
  query.ray.org_x = static_cast<float>(origin.x());
  query.ray.org_y = static_cast<float>(origin.y());
  query.ray.org_z = static_cast<float>(origin.z());
  const float direction[3] = {static_cast<float>(direction_unit.x()), static_cast<float>(direction_unit.y()),
                              static_cast<float>(direction_unit.z())};
  query.ray.dir_x = clearDirection(direction[0]);
  query.ray.dir_y = clearDirection(direction[1]);
  query.ray.dir_z = clearDirection(direction[2]);
  query.ray.tnear = static_cast<float>(min_range_m);
  query.ray.tfar = static_cast<float>(max_range_m);
  query.ray.mask = ~0U;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  MeetingQuery meeting(RayQuery::Rays::single);
  const float start[3] = {query.ray.org_x, query.ray.org_y, query.ray.org_z};
  meeting.set(start, direction, 1, 1, true, nullptr);
  meeting.query.trace(scene_, query);
  return {facetNumber(query.hit.instID[0], query.hit.geomID, query.hit.primID), query.ray.tfar};
}

Facet EmbreeScene::facet(std::uint64_t number) const {
  Facet facet;
  facet.instance = placements_[number >> 32U];
  facet.triangle = static_cast<std::uint32_t>(number);
  const Instance& instance = environment_->instances[facet.instance];
  const Mesh& mesh = *environment_->meshes[instance.mesh];
  facet.product = instance.product;
  facet.body = bodyOf(static_cast<std::uint32_t>(number >> 32U));
  facet.surface = mesh.surface_of_triangle[facet.triangle];
  if (const auto ball = balls_.find(static_cast<std::uint32_t>(number >> 32U)); ball != balls_.end()) {
    facet.normal = Eigen::Vector3d::Zero();
    facet.offset = static_cast<double>(number >> 32U);  // tells it from other balls
    facet.ball = &ball->second;
    return facet;
  }
  const Triangle& triangle = mesh.triangles[facet.triangle];
  const auto corner = [&](int k) -> Eigen::Vector3d {
    return instance.world_from_mesh * mesh.positions[triangle[k]].cast<double>();
  };
  const Eigen::Vector3d a = corner(0);
  const Eigen::Vector3d normal = (corner(1) - a).cross(corner(2) - a);
  const double length = normal.norm();
  facet.normal = length > 0 ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::Zero();
  facet.offset = facet.normal.dot(a);
  return facet;
}

std::array<Eigen::Vector3d, 2> EmbreeScene::edgeEnds(std::uint64_t edge) const {
  const Instance& instance = placed(edge >> 32U);
  const MeshEdge& ends = edges_[instance.mesh][static_cast<std::uint32_t>(edge)];
  const auto& positions = environment_->meshes[instance.mesh]->positions;
  return {instance.world_from_mesh * positions[ends.from].cast<double>(),
          instance.world_from_mesh * positions[ends.to].cast<double>()};
}

std::optional<RayHit> EmbreeScene::intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction_unit,
                                             double max_range_m) const {
  const NearestHit hit = nearest(origin, direction_unit, 0, max_range_m);
  if (hit.facet == kNoFacet) return std::nullopt;
  const Facet met = facet(hit.facet).metBy(origin, direction_unit);
  RayHit result;
  result.range_m = rangeOnPlane(met, origin, direction_unit, hit.range_m);
  result.position = origin + result.range_m * direction_unit;
  result.normal = met.normal.dot(direction_unit) > 0 ? Eigen::Vector3d(-met.normal) : met.normal;
  result.product = met.product;
  result.surface = met.surface;
  result.instance = met.instance;
  result.triangle = met.triangle;
  return result;
}

Result<std::shared_ptr<const RayScene>> RayScene::build(std::shared_ptr<const Environment> environment,
                                                        Progress& progress, const std::vector<RoundInstance>& balls,
                                                        const std::string& embree_settings,
                                                        const std::vector<MovingBody>& bodies) {
  if (!environment) return failure(ErrorKind::internal, "there is no environment", "ray scene");
  auto scene = std::make_shared<EmbreeScene>();
  TRY(scene->commit(std::move(environment), balls, embree_settings, bodies, progress));
  return scene;
}

}  // namespace standpoint
