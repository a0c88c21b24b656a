// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/split_by_material.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "core/face_patches.h"

namespace standpoint {

namespace {

class Splitter {
 public:
  Splitter(const MaterialAssignment& assignment, LooksOfSplit looks) : assignment_(assignment), looks_(looks) {}

  void split(Environment& environment) {
    std::map<std::pair<std::uint32_t, std::vector<std::uint32_t>>, std::uint32_t> mesh_of;
    std::vector<std::shared_ptr<const Mesh>> meshes;
    const AssignedTriangles triangles(environment, assignment_);
    for (auto& instance : environment.instances) {
      const auto& mesh = environment.meshes[instance.mesh];
      if (hasFaces(instance.product)) {
        auto own = byFace(environment, instance, triangles);
        instance.mesh = static_cast<std::uint32_t>(meshes.size());
        meshes.push_back(std::move(own));
        continue;
      }
      const auto& used = usedSurfaces(mesh);
      std::vector<std::uint32_t> become;
      for (const auto surface : used)
        become.push_back(surfaceFor(environment, surface, materialOf(assignment_, instance.product, surface)));
      const auto [found, fresh] =
          mesh_of.try_emplace({instance.mesh, become}, static_cast<std::uint32_t>(meshes.size()));
      if (fresh) meshes.push_back(repainted(*mesh, used, become));
      instance.mesh = found->second;
    }
    environment.meshes = std::move(meshes);
  }

  std::vector<Surface> surfaces;
  std::vector<std::int32_t> material_of;

 private:
  const std::vector<std::uint32_t>& usedSurfaces(const std::shared_ptr<const Mesh>& mesh) {
    const auto [found, fresh] = used_.try_emplace(mesh);
    if (fresh) {
      auto& used = found->second = mesh->surface_of_triangle;
      std::sort(used.begin(), used.end());
      used.erase(std::unique(used.begin(), used.end()), used.end());
    }
    return found->second;
  }

  bool hasFaces(std::uint32_t product) const {
    const auto& faces = assignment_.faces;
    const auto found = std::lower_bound(faces.begin(), faces.end(), product,
                                        [](const AssignedFaces& f, std::uint32_t p) { return f.product < p; });
    return found != faces.end() && found->product == product;
  }

  std::shared_ptr<const Mesh> byFace(const Environment& environment, const Instance& instance,
                                     const AssignedTriangles& triangles) {
    auto copy = std::make_shared<Mesh>(*environment.meshes[instance.mesh]);
    const auto index = static_cast<std::uint32_t>(&instance - environment.instances.data());
    for (std::uint32_t i = 0; i < copy->triangles.size(); ++i) {
      auto& surface = copy->surface_of_triangle[i];
      surface = surfaceFor(environment, surface, triangles.materialOf(index, i));
    }
    sortTriangles(*copy);
    return copy;
  }

  std::uint32_t surfaceFor(const Environment& environment, std::uint32_t surface, std::int32_t material) {
    const bool by_look = looks_ == LooksOfSplit::kept || material < 0;
    const auto [found, fresh] =
        index_.try_emplace({by_look ? surface : 0, material}, static_cast<std::uint32_t>(surfaces.size()));
    if (fresh) {
      surfaces.push_back(by_look ? environment.surfaces[surface] : Surface());
      material_of.push_back(material);
    }
    return found->second;
  }

  static std::shared_ptr<const Mesh> repainted(const Mesh& mesh, const std::vector<std::uint32_t>& used,
                                               const std::vector<std::uint32_t>& become) {
    auto copy = std::make_shared<Mesh>(mesh);
    for (auto& surface : copy->surface_of_triangle)
      surface = become[static_cast<std::size_t>(std::lower_bound(used.begin(), used.end(), surface) - used.begin())];
    sortTriangles(*copy);
    return copy;
  }

  // By surface, as validate() demands.
  static void sortTriangles(Mesh& mesh) {
    if (std::is_sorted(mesh.surface_of_triangle.begin(), mesh.surface_of_triangle.end())) return;
    std::vector<std::uint32_t> order(mesh.triangles.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto before = mesh;
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return before.surface_of_triangle[a] < before.surface_of_triangle[b];
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
      mesh.triangles[i] = before.triangles[order[i]];
      mesh.surface_of_triangle[i] = before.surface_of_triangle[order[i]];
    }
  }

  const MaterialAssignment& assignment_;
  LooksOfSplit looks_;
  std::map<std::pair<std::uint32_t, std::int32_t>, std::uint32_t> index_;   // (look, material) → surface
  std::map<std::shared_ptr<const Mesh>, std::vector<std::uint32_t>> used_;  // holds them, so that no address comes back
};

}  // namespace

std::vector<std::int32_t> splitByMaterial(std::span<Environment* const> environments,
                                          const MaterialAssignment& assignment, LooksOfSplit looks) {
  Splitter splitter(assignment, looks);
  for (auto* environment : environments) splitter.split(*environment);
  for (auto* environment : environments) environment->surfaces = splitter.surfaces;
  return std::move(splitter.material_of);
}

}  // namespace standpoint
