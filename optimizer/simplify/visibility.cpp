// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/simplify/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include <tbb/parallel_for.h>

#include "core/random.h"
#include "optimizer/surface/deviation.h"
#include "optimizer/surface/placed_surfaces.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr std::uint32_t kSkyPoints = 128, kSkyRays = 8;  // of a product; from each point
constexpr double kSkyLow = 0.1;                          // lowest sine of the elevation: the horizon is no sky
constexpr double kEyeHeight = 1.6;                       // m
constexpr std::uint32_t kWalkers = 2000, kWalkersRays = 500;
constexpr double kLeastWeight = 0.1, kMostWeight = 10;
constexpr std::uint32_t kHiddenRays = 48;   // from each side
constexpr double kFree = 0.6, kOff = 1e-3;  // m; a ray that runs so far is free; where it begins off the surface
constexpr double kFar = 1e6;                // m

// Uniform on the sphere.
Vector3d direction(const std::array<std::uint32_t, 4>& block, double lowest_sine = -1) {
  const double z = lowest_sine + (1 - lowest_sine) * uniform(block[0]), turn = 2 * std::numbers::pi * uniform(block[1]),
               r = std::sqrt(std::max(0.0, 1 - z * z));
  return {r * std::cos(turn), r * std::sin(turn), z};
}

}  // namespace

std::vector<double> skyFractions(const Environment& environment, const Progress& progress) {
  const Environment tangible = sceneOf(environment);
  std::vector<double> fractions(environment.products.size(), 1);
  if (tangible.instances.empty()) return fractions;
  const PlacedSurfaces surfaces(tangible);
  std::vector<double> areas(fractions.size(), 0);
  for (std::size_t i = 0; i < tangible.instances.size(); ++i) areas[tangible.instances[i].product] += surfaces.area(i);
  std::vector<std::array<std::uint32_t, 2>> counts(tangible.instances.size());  // rays, and those that reach the sky
  tbb::parallel_for(std::size_t{0}, counts.size(), [&](std::size_t i) {
    const double all = areas[tangible.instances[i].product];
    if (!(all > 0) || progress.cancelled()) return;
    const auto points = surfaces.points(i, 1 + static_cast<std::uint32_t>(kSkyPoints * surfaces.area(i) / all));
    for (std::uint32_t k = 0; k < points.size(); ++k)
      for (std::uint32_t r = 0; r < kSkyRays; ++r) {
        const Vector3d d = direction(philox({i, 5}, k, r, 0), kSkyLow);
        ++counts[i][0];
        counts[i][1] += surfaces.firstHit(points[k] + kOff * d, d, kFar).distance < kFar ? 0 : 1;
      }
  });
  std::vector<std::array<std::uint64_t, 2>> sums(fractions.size());
  for (std::size_t i = 0; i < counts.size(); ++i)
    for (int k = 0; k < 2; ++k) sums[tangible.instances[i].product][k] += counts[i][k];
  for (std::size_t p = 0; p < fractions.size(); ++p)
    if (sums[p][0] > 0) fractions[p] = static_cast<double>(sums[p][1]) / static_cast<double>(sums[p][0]);
  return fractions;
}

std::vector<double> walkersView(const Environment& environment, const Mesh& walkable, const Progress& progress) {
  const Environment tangible = sceneOf(environment);
  std::vector<double> view(environment.products.size(), 1);
  std::vector<Vector3d> floor;
  for (const auto& p : walkable.positions) floor.push_back(p.cast<double>());
  const auto places = pointsByArea(floor, walkable.triangles, kWalkers, {0, 6});
  if (tangible.instances.empty() || places.empty()) return view;
  const PlacedSurfaces surfaces(tangible);
  std::vector<std::vector<std::uint32_t>> seen(places.size());  // products, once for each ray
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t i) {
    if (progress.cancelled()) return;
    const Vector3d eye = places[i].position + Vector3d(0, 0, kEyeHeight);
    for (std::uint32_t r = 0; r < kWalkersRays; ++r) {
      const auto hit = surfaces.firstHit(eye, direction(philox({i, 7}, r, 0, 0)), kFar);
      if (hit.distance < kFar) seen[i].push_back(tangible.instances[hit.instance].product);
    }
  });
  std::vector<double> hits(view.size(), 0), areas(view.size(), 0);
  for (const auto& list : seen)
    for (const auto product : list) ++hits[product];
  for (std::size_t i = 0; i < tangible.instances.size(); ++i) areas[tangible.instances[i].product] += surfaces.area(i);
  const double all_hits = std::accumulate(hits.begin(), hits.end(), 0.0),
               all_area = std::accumulate(areas.begin(), areas.end(), 0.0);
  if (!(all_hits > 0) || !(all_area > 0)) return view;
  for (std::size_t p = 0; p < view.size(); ++p)
    if (areas[p] > 0) view[p] = hits[p] / areas[p] / (all_hits / all_area);
  return view;
}

void weighByView(OptimizeOptions& options, const Environment& environment, const Mesh& walkable,
                 const Progress& progress) {
  if (options.products.empty()) {
    ProductAllowance same;
    same.max_deviation_m = options.max_deviation_m;
    options.products.assign(environment.products.size(), same);
  }
  const auto view = walkersView(environment, walkable, progress);
  for (std::size_t p = 0; p < view.size() && p < options.products.size(); ++p)
    options.products[p].weight *= std::clamp(std::sqrt(view[p]), kLeastWeight, kMostWeight);
}

std::vector<std::vector<bool>> hiddenTriangles(const Environment& environment, const Progress& progress) {
  const Environment tangible = sceneOf(environment);
  const PlacedSurfaces surfaces(tangible);
  const auto isHidden = [&](const Instance& instance, const Triangle& t, std::uint32_t index) {
    const Mesh& mesh = *environment.meshes[instance.mesh];
    std::array<Vector3d, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = instance.world_from_mesh * mesh.positions[t[k]].cast<double>();
    const Vector3d middle = (corners[0] + corners[1] + corners[2]) / 3;
    const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    for (std::uint32_t r = 0; r < kHiddenRays; ++r) {
      const auto block = philox({instance.mesh, 8}, index, r, 0);
      const double u = std::sqrt(uniform(block[2])), v = uniform(block[3]);
      const Vector3d random_place = (1 - u) * corners[0] + u * (1 - v) * corners[1] + u * v * corners[2],
                     place = r % 2 == 0 ? middle : random_place;
      Vector3d d = direction(block);
      if (d.dot(normal) < 0) d = -d;
      for (const double side : {1.0, -1.0})
        if (!(surfaces.firstHit(place + side * kOff * normal, side * d, kFree).distance < kFree)) return false;
    }
    return true;
  };
  std::vector<std::vector<const Instance*>> copies(environment.meshes.size());
  for (const auto& instance : tangible.instances) copies[instance.mesh].push_back(&instance);
  std::vector<std::vector<bool>> hidden(environment.meshes.size());
  tbb::parallel_for(std::size_t{0}, hidden.size(), [&](std::size_t m) {  // each its own mesh
    const Mesh& mesh = *environment.meshes[m];
    if (copies[m].empty() || progress.cancelled()) return;
    std::vector<bool> result(mesh.triangles.size(), false);
    bool any = false;
    for (std::uint32_t i = 0; i < result.size() && !progress.cancelled(); ++i) {
      result[i] = std::all_of(copies[m].begin(), copies[m].end(),
                              [&](const Instance* instance) { return isHidden(*instance, mesh.triangles[i], i); });
      any = any || result[i];
    }
    if (any) hidden[m] = std::move(result);
  });
  return hidden;
}

}  // namespace standpoint
