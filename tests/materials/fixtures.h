// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "materials/materials.h"

namespace standpoint {

inline std::filesystem::path sharedFolder() {
  const char* given = std::getenv("STANDPOINT_SHARED");
  return given ? std::filesystem::path(given) : std::filesystem::path(SOURCE_DIR "/../shared");
}

template <class T>
T orThrow(Result<T> result) {
  if (!result) ADD_FAILURE() << result.error().source << ": " << result.error().message;
  return std::move(result).value();
}

inline const std::vector<PhysicalMaterial>& shippedLibrary() {
  static const auto library = orThrow(readMaterialLibrary(SOURCE_DIR "/materials/library"));
  return library;
}

inline const RuleSet& shippedRules() {
  static const auto rules = orThrow(readAssignmentRules(SOURCE_DIR "/materials/rules/default.json", shippedLibrary()));
  return rules;
}

inline const PhysicalMaterial* findMaterial(const std::string& id) {
  for (const auto& material : shippedLibrary())
    if (material.id == id) return &material;
  return nullptr;
}

// Squares of side 1 in the plane z = 0, one for each surface, in the surfaces' order.
inline std::shared_ptr<const Mesh> unitSquares(std::vector<std::uint32_t> surfaces) {
  auto mesh = std::make_shared<Mesh>();
  for (const auto surface : surfaces) {
    const auto first = static_cast<std::uint32_t>(mesh->positions.size());
    for (const auto& [x, y] : {std::pair{0.F, 0.F}, {1.F, 0.F}, {1.F, 1.F}, {0.F, 1.F}})
      mesh->positions.emplace_back(x, y, 0.F);
    mesh->triangles.push_back({first, first + 1, first + 2});
    mesh->triangles.push_back({first, first + 2, first + 3});
    mesh->surface_of_triangle.insert(mesh->surface_of_triangle.end(), 2, surface);
  }
  sortBySurface(*mesh);
  return mesh;
}

// Builds an environment piece by piece; each product gets the mesh of one instance.
struct Builder {
  Environment environment;

  std::uint32_t surface(const std::string& name, Colour colour = {}) {
    environment.surfaces.push_back({name, colour, {}, {}, {}});
    return static_cast<std::uint32_t>(environment.surfaces.size() - 1);
  }
  Product& product(const std::string& ifc_class, const std::string& name, std::vector<std::uint32_t> surfaces,
                   const Eigen::Affine3d& world_from_mesh = Eigen::Affine3d::Identity()) {
    const auto index = static_cast<std::uint32_t>(environment.products.size());
    environment.products.emplace_back();
    auto& product = environment.products.back();
    product.id = std::to_string(100 + index).insert(0, 1, '#');
    product.ifc_class = ifc_class;
    product.name = name;
    environment.meshes.push_back(unitSquares(std::move(surfaces)));
    environment.instances.push_back(
        {static_cast<std::uint32_t>(environment.meshes.size() - 1), index, world_from_mesh});
    return product;
  }
  MaterialResult assign(std::vector<AssignmentRule> rules, const std::vector<MaterialOverride>& overrides = {}) const {
    return assignBy(RuleSet(std::move(rules)), overrides);
  }
  MaterialResult assign() const { return assignBy(shippedRules()); }
  MaterialResult assignBy(const RuleSet& rules, const std::vector<MaterialOverride>& overrides = {},
                          const AssignOptions& options = {}) const {
    Progress progress;
    EXPECT_EQ(validate(environment), "");
    return assignMaterials(environment, shippedLibrary(), rules, overrides, options, progress).value();
  }
};

inline std::string materialId(const MaterialResult& result, std::uint32_t product, std::uint32_t surface) {
  const auto index = materialOf(result.assignment, product, surface);
  return index < 0 ? "" : result.assignment.materials[static_cast<std::size_t>(index)].id;
}

}  // namespace standpoint
