// SPDX-License-Identifier: GPL-3.0-or-later
#include "materials/select.h"

#include <algorithm>
#include <string_view>

#include "materials/materials.h"
#include "materials/pattern.h"

namespace standpoint {

namespace {

struct Selector {
  std::string_view kind;  // "class", …; empty: an id or a GlobalId
  std::string_view value;
};

Selector parsed(std::string_view selector) {
  for (const std::string_view kind : {"class", "name", "storey", "material"})
    if (selector.size() > kind.size() && selector.starts_with(kind) && selector[kind.size()] == ':')
      return {kind, selector.substr(kind.size() + 1)};
  return {{}, selector};
}

bool fits(const Selector& selector, const Pattern& pattern, const Product& product) {
  if (selector.kind == "class") return fitClass(pattern, product.ifc_class) >= 0;
  if (selector.kind == "name") return pattern.fit(folded(product.name)) >= 0;
  if (selector.kind == "storey") return pattern.fit(folded(product.storey)) >= 0;
  return !selector.value.empty() && (product.id == selector.value || product.global_id == selector.value);
}

}  // namespace

std::optional<SurfaceSelector> SurfaceSelector::parse(const Environment& environment, std::string_view selector) {
  const auto [kind, value] = parsed(selector);
  if (kind != "material") return std::nullopt;
  SurfaceSelector result(value);
  for (const auto& surface : environment.surfaces)
    result.by_surface_.push_back(!surface.name.empty() && result.pattern_.fit(folded(surface.name)) >= 0);
  for (const auto& product : environment.products)
    result.by_product_.push_back(
        std::any_of(product.materials.begin(), product.materials.end(),
                    [&](const std::string& name) { return result.pattern_.fit(folded(name)) >= 0; }));
  return result;
}

bool SurfaceSelector::fits(const Environment& environment, std::uint32_t product, std::uint32_t surface) const {
  return environment.surfaces[surface].name.empty() ? by_product_[product] : by_surface_[surface];
}

std::vector<std::uint32_t> select(const Environment& environment, const std::string& selector) {
  std::vector<std::uint32_t> products;
  if (const auto surfaces = SurfaceSelector::parse(environment, selector)) {
    for (const auto& instance : environment.instances) {
      const auto& used = environment.meshes[instance.mesh]->surface_of_triangle;
      for (auto s = used.begin(); s != used.end(); s = std::upper_bound(s, used.end(), *s))
        if (surfaces->fits(environment, instance.product, *s)) products.push_back(instance.product);
    }
    std::sort(products.begin(), products.end());
    products.erase(std::unique(products.begin(), products.end()), products.end());
    return products;
  }
  const auto what = parsed(selector);
  const Pattern pattern(what.kind.empty() ? std::string_view() : what.value);
  for (std::uint32_t i = 0; i < environment.products.size(); ++i)
    if (fits(what, pattern, environment.products[i])) products.push_back(i);
  return products;
}

}  // namespace standpoint
