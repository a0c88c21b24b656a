// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/surface/vertex_deviation.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <map>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "optimizer/surface/placed_surfaces.h"

namespace standpoint {

namespace {

using Eigen::Affine3d;

constexpr double kSamePlace = 1e-9;  // of transforms relative to each other, m and 1

using Range = std::pair<std::size_t, std::size_t>;  // of instances

Range instancesOf(const Environment& environment, std::uint32_t product) {
  const auto less = [](const Instance& instance, std::uint32_t p) { return instance.product < p; };
  const auto begin = environment.instances.begin();
  const auto first = std::lower_bound(begin, environment.instances.end(), product, less);
  const auto last = std::lower_bound(first, environment.instances.end(), product + 1, less);
  return {static_cast<std::size_t>(first - begin), static_cast<std::size_t>(last - begin)};
}

// What must be equal for two instances to have the same deviation: the meshes, and how they stand to each other.
struct Situation {
  std::vector<const Mesh*> meshes;  // its own, then those of its product in the other environment
  std::vector<Affine3d> places;     // of the others, seen from it; then its own linear part, as lengths are the world's
  std::size_t instance = 0;
};

Situation situationOf(const Environment& from, std::size_t i, const Environment& to, Range range) {
  const Instance& own = from.instances[i];
  Situation result{{from.meshes[own.mesh].get()}, {}, i};
  const Affine3d own_from_world = own.world_from_mesh.inverse();
  for (auto k = range.first; k < range.second; ++k) {
    const Instance& other = to.instances[k];
    result.meshes.push_back(to.meshes[other.mesh].get());
    result.places.push_back(own.world_from_mesh.matrix() == other.world_from_mesh.matrix()
                                ? Affine3d::Identity()
                                : own_from_world * other.world_from_mesh);
  }
  Affine3d lengths = Affine3d::Identity();
  lengths.linear() = own.world_from_mesh.linear().transpose() * own.world_from_mesh.linear();
  result.places.push_back(lengths);
  return result;
}

bool alike(const Situation& a, const Situation& b) {
  for (std::size_t i = 0; i < a.places.size(); ++i)
    if (!((a.places[i].matrix() - b.places[i].matrix()).cwiseAbs().maxCoeff() <= kSamePlace)) return false;
  return true;
}

// For each instance the first one that has the same deviation. One whose product is gone from `to` stands for itself.
std::vector<std::size_t> representatives(const Environment& from, const Environment& to) {
  std::vector<std::size_t> result(from.instances.size());
  std::map<std::vector<std::uint32_t>, std::vector<Situation>>
      known;  // by mesh indices: pointers would order by chance
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = i;
    const Range range = instancesOf(to, from.instances[i].product);
    if (range.first == range.second) continue;
    auto now = situationOf(from, i, to, range);
    std::vector<std::uint32_t> key{from.instances[i].mesh};
    for (auto k = range.first; k < range.second; ++k) key.push_back(to.instances[k].mesh);
    auto& same_meshes = known[key];
    const auto found =
        std::find_if(same_meshes.begin(), same_meshes.end(), [&](const Situation& s) { return alike(s, now); });
    if (found != same_meshes.end())
      result[i] = found->instance;
    else
      same_meshes.push_back(std::move(now));
  }
  return result;
}

std::vector<float> areas(const Mesh& mesh, const Affine3d& world_from_mesh) {
  std::vector<double> sums(mesh.positions.size(), 0);
  const auto edge = [&](std::uint32_t a, std::uint32_t b) {
    return Eigen::Vector3d(world_from_mesh.linear() *
                           (mesh.positions[b].cast<double>() - mesh.positions[a].cast<double>()));
  };
  for (const auto& t : mesh.triangles) {
    const double fraction = edge(t[0], t[1]).cross(edge(t[0], t[2])).norm() / 6;
    for (const auto v : t) sums[v] += fraction;
  }
  return {sums.begin(), sums.end()};
}

bool standsUnchanged(const Environment& from, std::size_t i, const Environment& to, Range range) {
  const Instance& own = from.instances[i];
  for (auto k = range.first; k < range.second; ++k)
    if (to.meshes[to.instances[k].mesh] == from.meshes[own.mesh] &&
        to.instances[k].world_from_mesh.matrix() == own.world_from_mesh.matrix())
      return true;
  return false;
}

}  // namespace

Result<std::vector<std::shared_ptr<const InstanceDeviation>>> vertexDeviation(const Environment& from,
                                                                              const Environment& to,
                                                                              Progress& progress) {
  const PlacedSurfaces surfaces(to);
  const auto representative = representatives(from, to);
  std::vector<std::shared_ptr<InstanceDeviation>> own(from.instances.size());
  double all = 1;
  for (std::size_t i = 0; i < own.size(); ++i)
    if (representative[i] == i) all += static_cast<double>(from.meshes[from.instances[i].mesh]->positions.size());
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t{0}, own.size(), [&](std::size_t i) {  // each into its own slot
    if (representative[i] != i || progress.cancelled()) return;
    const Instance& instance = from.instances[i];
    const Mesh& mesh = *from.meshes[instance.mesh];
    auto result = std::make_shared<InstanceDeviation>();
    result->area_m2 = areas(mesh, instance.world_from_mesh);
    result->distance_m.assign(mesh.positions.size(), 0);
    const Range range = instancesOf(to, instance.product);
    if (!standsUnchanged(from, i, to, range))
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.positions.size(), 1024), [&](const auto& vertices) {
        if (progress.cancelled()) return;
        for (std::size_t v = vertices.begin(); v < vertices.end(); ++v) {
          const Eigen::Vector3d p = instance.world_from_mesh * mesh.positions[v].cast<double>();
          const double squared = range.first < range.second ? surfaces.squaredDistance(p, range.first, range.second)
                                                            : surfaces.squaredDistance(p);
          result->distance_m[v] = static_cast<float>(std::sqrt(squared));
        }
      });
    own[i] = std::move(result);
    progress.advance(static_cast<double>(done += mesh.positions.size()) / all);
  });
  TRY(progress.check());
  std::vector<std::shared_ptr<const InstanceDeviation>> result(own.size());
  for (std::size_t i = 0; i < own.size(); ++i) result[i] = own[representative[i]];
  return result;
}

}  // namespace standpoint
