// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/forecast/surface_samples.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "core/random.h"
#include "scanners/engine/embree_scene.h"

namespace standpoint {

namespace {

constexpr double kOffSurface_m = 1e-3;
// Steps that fill a square evenly: 1/p and 1/p² of the plastic number p, the root of p³ = p + 1.
constexpr double kEvenly[2] = {0.7548776662466927, 0.5698402909980532};

struct TriangleInPlace {
  Eigen::Vector3d a, ab, ac;
  double area() const { return ab.cross(ac).norm() / 2; }
};

TriangleInPlace placed(const Environment& environment, const Instance& instance, std::uint32_t triangle) {
  const auto& mesh = *environment.meshes[instance.mesh];
  const auto& t = mesh.triangles[triangle];
  const auto corner = [&](int k) -> Eigen::Vector3d {
    return instance.world_from_mesh * mesh.positions[t[k]].cast<double>();
  };
  const Eigen::Vector3d a = corner(0);
  return {a, corner(1) - a, corner(2) - a};
}

// Calls `visit(instance, triangle, placed)` for all that is in the scene, in order.
template <class Visit>
void eachTriangle(const Environment& environment, const Visit& visit) {
  for (std::uint32_t i = 0; i < environment.instances.size(); ++i) {
    const auto& instance = environment.instances[i];
    if (!environment.products[instance.product].inScene()) continue;
    const auto count = static_cast<std::uint32_t>(environment.meshes[instance.mesh]->triangles.size());
    for (std::uint32_t t = 0; t < count; ++t) visit(i, t, placed(environment, instance, t));
  }
}

SurfaceSample sampleOf(const Environment& environment, std::uint32_t instance, std::uint32_t triangle,
                       const TriangleInPlace& t, double u, double v) {
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  SurfaceSample sample;
  sample.place.position = t.a + u * t.ab + v * t.ac;
  sample.place.normal = t.ab.cross(t.ac).normalized();
  if (environment.instances[instance].world_from_mesh.linear().determinant() < 0) sample.place.normal *= -1;
  sample.place.instance = instance;
  sample.place.triangle = triangle;
  sample.product = environment.instances[instance].product;
  return sample;
}

// Does this ray leave the scene, or meet a surface from the side that it faces?
bool reachesLight(const EmbreeScene& scene, const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
  const NearestHit hit = scene.nearest(from, direction, 0, 1e4);
  if (hit.facet == kNoFacet) return true;
  const Facet facet = scene.facet(hit.facet).metBy(from, direction);
  const bool mirrored = scene.environment().instances[facet.instance].world_from_mesh.linear().determinant() < 0;
  return (facet.normal.dot(direction) < 0) != mirrored;
}

// Bodies that share a face would count it twice: it belongs to the first of them. Which of two faces in one place a ray
// meets is a matter of rounding, so several look.
bool belongsToEarlier(const EmbreeScene& scene, const SurfaceSample& sample, const Eigen::Vector3d& normal) {
  constexpr double kAbove_m = 5e-3;
  constexpr int kRays = 8;
  const Eigen::Vector3d across = normal.unitOrthogonal();
  const Eigen::Vector3d along = normal.cross(across);
  for (int k = 0; k < kRays; ++k) {
    const double azimuth = 2.4 * k;
    const Eigen::Vector3d aside = 0.5 * kAbove_m * (std::cos(azimuth) * across + std::sin(azimuth) * along);
    const Eigen::Vector3d way = aside - kAbove_m * normal;
    const double range = way.norm();
    const NearestHit hit = scene.nearest(sample.place.position - way, way / range, 0, 1.2 * range);
    if (hit.facet == kNoFacet) continue;
    const Facet facet = scene.facet(hit.facet).metBy(sample.place.position - way, way / range);
    const double off = std::abs(facet.normal.dot(sample.place.position) - facet.offset);
    if (facet.product < sample.product && off < kOffSurface_m && std::abs(facet.normal.dot(normal)) > 0.999)
      return true;
  }
  return false;
}

bool sideIsOpen(const EmbreeScene& scene, const Eigen::Vector3d& place, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d across = normal.unitOrthogonal();
  const Eigen::Vector3d along = normal.cross(across);
  const Eigen::Vector3d from = place + kOffSurface_m * normal;
  int open = 0;
  constexpr int kRays = 7;
  for (int k = 0; k < kRays; ++k) {
    const double azimuth = 2.4 * k;  // the golden angle, about
    open += static_cast<int>(reachesLight(
        scene, from, (normal + 0.7 * (std::cos(azimuth) * across + std::sin(azimuth) * along)).normalized()));
  }
  return 2 * open > kRays;
}

}  // namespace

Result<SurfaceSamples> sampleSurfaces(const RayScene& scene, std::size_t count, std::uint64_t seed,
                                      Progress& progress) {
  const auto& environment = scene.environment();
  SurfaceSamples result;
  eachTriangle(environment,
               [&](std::uint32_t, std::uint32_t, const TriangleInPlace& t) { result.area_m2 += t.area(); });
  TRY(progress.check());
  if (!(result.area_m2 > 0) || !std::isfinite(result.area_m2)) return SurfaceSamples{};
  const RandomKey key{seed, static_cast<std::uint32_t>(stableHash("surface samples"))};
  const double stratum = result.area_m2 / static_cast<double>(count);
  const auto drawn = [&](std::size_t k) { return philox(key, static_cast<std::uint32_t>(k), 0, 0); };
  result.samples.reserve(count);
  double passed = 0;
  auto next = drawn(0);
  eachTriangle(environment, [&](std::uint32_t instance, std::uint32_t triangle, const TriangleInPlace& t) {
    passed += t.area();
    double u = uniform(next[1]), v = uniform(next[2]);  // where the triangle's own sequence begins
    while (result.samples.size() < count &&
           (static_cast<double>(result.samples.size()) + uniform(next[0])) * stratum < passed) {
      result.samples.push_back(sampleOf(environment, instance, triangle, t, u, v));
      next = drawn(result.samples.size());
      u = std::fmod(u + kEvenly[0], 1);
      v = std::fmod(v + kEvenly[1], 1);
    }
  });
  const auto& rays = static_cast<const EmbreeScene&>(scene);
  tbb::parallel_for(std::size_t{0}, result.samples.size(), [&](std::size_t k) {  // each into its own slot
    auto& s = result.samples[k];
    for (const Eigen::Vector3d& side : {s.place.normal, Eigen::Vector3d(-s.place.normal)})
      s.exposed |= sideIsOpen(rays, s.place.position, side) && !belongsToEarlier(rays, s, side);
  });
  return result;
}

bool inSight(const RayScene& scene, const Eigen::Vector3d& eye, const SurfacePlace& place, const SightLimits& limits) {
  const Eigen::Vector3d way = place.position - eye;
  const double range = way.norm();
  if (range < 1e-6 || range > limits.max_range_m) return false;
  const Eigen::Vector3d direction = way / range;
  if (std::abs(direction.dot(place.normal)) < limits.min_cosine) return false;
  const double elevation = std::asin(std::clamp(direction.z(), -1.0, 1.0));
  if (elevation < limits.min_elevation_rad || elevation > limits.max_elevation_rad) return false;
  const double before = 1e-3 + 1e-4 * range;  // float trees put a surface a little off
  return !scene.intersect(eye, direction, range - before);
}

}  // namespace standpoint
