// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/material_scope.h"

#include <algorithm>

#include <fmt/format.h>

#include "materials/materials.h"
#include "materials/pattern.h"

namespace standpoint {

std::string selectorOf(const Product& product) { return product.id.rfind('#', 0) == 0 || product.global_id.empty() ? product.id : product.global_id; }

std::vector<MaterialScope> materialScopes(const Environment& environment, const RayHit& hit) {
  const auto& product = environment.products[hit.product];
  const auto& surface = environment.surfaces[hit.surface];
  const auto own = selectorOf(product);
  const auto label = product.name.empty() ? product.id : product.name;
  std::vector<MaterialScope> scopes = {{fmt::format("The faces of '{}' that look this way", label),
                                        fmt::format("{}@{:.3f},{:.3f},{:.3f}", own, hit.normal.x(), hit.normal.y(), hit.normal.z()), 1},
                                       {fmt::format("All of '{}'", label), own, 1}};
  const auto add = [&](std::string title, std::string selector) {
    const auto products = select(environment, selector).size();
    if (products > scopes.back().products) scopes.push_back({std::move(title), std::move(selector), products});
  };
  const auto in_class = "class:" + product.ifc_class;
  if (!product.type_name.empty()) add(fmt::format("All of type '{}'", product.type_name), "type:" + literalPattern(product.type_name));
  if (!product.ifc_class.empty() && !product.storey.empty())
    add(fmt::format("All {} of storey '{}'", product.ifc_class, product.storey), in_class + "&storey:" + literalPattern(product.storey));
  if (!product.ifc_class.empty()) add(fmt::format("All {}", product.ifc_class), in_class);
  if (!surface.name.empty()) {   // single surfaces of many products: never the same as whole products
    const auto selector = "material:" + literalPattern(surface.name);
    scopes.push_back({fmt::format("Every surface of '{}'", surface.name), selector, select(environment, selector).size()});
  }
  return scopes;
}

}  // namespace standpoint
