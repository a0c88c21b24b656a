// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/material_scope.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/face_normal.h"
#include "core/face_patches.h"
#include "core/presentation_layers.h"
#include "editor/model/outliner_rows.h"
#include "editor/words/words.h"
#include "materials/materials.h"
#include "materials/pattern.h"

namespace standpoint {

std::string selectorOf(const Product& product) {
  return product.id.rfind('#', 0) == 0 || product.global_id.empty() ? product.id : product.global_id;
}

std::vector<MaterialScope> materialScopes(const Environment& environment, const RayHit& hit,
                                          const Eigen::Vector3d& shift_m) {
  const auto& product = environment.products[hit.product];
  const auto& surface = environment.surfaces[hit.surface];
  const auto own = selectorOf(product);
  const auto label = product.name.empty() ? product.id : product.name;
  const auto& instance = environment.instances[hit.instance];
  const Mesh& mesh = *environment.meshes[instance.mesh];
  const Eigen::Vector3d outwards = placedNormal(mesh, mesh.triangles[hit.triangle],
                                                instance.world_from_mesh);  // hit.normal is of the side that is seen
  const Eigen::Vector3d point = hit.position + shift_m;
  const auto looking = fmt::format("{}@{:.3f},{:.3f},{:.3f}", own, outwards.x(), outwards.y(), outwards.z());
  std::vector<MaterialScope> scopes = {
      {trf("This face of '{}'", label),
       fmt::format("{}@{:.4f},{:.4f},{:.4f}", looking, point.x(), point.y(), point.z()), 1},
      {trf("Faces of '{}' with this orientation", label), looking, 1},
      {trf("All of '{}'", label), own, 1}};
  const auto add = [&](std::string title, std::string selector) {
    const auto products = select(environment, selector).size();
    if (products > scopes.back().products) scopes.push_back({std::move(title), std::move(selector), products});
  };
  const auto in_class = "class:" + product.ifc_class;
  if (!product.type_name.empty())
    add(trf("All of type '{}'", product.type_name), "type:" + literalPattern(product.type_name));
  if (!product.ifc_class.empty() && !product.storey.empty())
    add(trf("All of class {} on storey '{}'", tr(readableClass(product.ifc_class)), product.storey),
        in_class + "&storey:" + literalPattern(product.storey));
  if (!product.ifc_class.empty()) add(trf("All of class {}", tr(readableClass(product.ifc_class))), in_class);
  // a layer may hold fewer products than a class, and others
  anyPresentationLayer(product, [&](const std::string& layer) {
    const auto selector = "layer:" + literalPattern(layer);
    if (const auto products = select(environment, selector).size(); products > 1)
      scopes.push_back({trf("All on layer '{}'", layer), selector, products});
    return false;
  });
  if (!surface.name.empty()) {  // single surfaces of many products: never the same as whole products
    const auto selector = "material:" + literalPattern(surface.name);
    scopes.push_back({trf("Every surface of '{}'", surface.name), selector, select(environment, selector).size()});
  }
  return scopes;
}

const PhysicalMaterial* materialAt(const Environment& environment, const MaterialAssignment& assignment,
                                   const RayHit& hit) {
  const auto material = AssignedTriangles(environment, assignment).materialOf(hit.instance, hit.triangle);
  return material < 0 ? nullptr : &assignment.materials[static_cast<std::size_t>(material)];
}

}  // namespace standpoint
