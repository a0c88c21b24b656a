// SPDX-License-Identifier: GPL-3.0-or-later
#include "materials/override_table.h"

#include <algorithm>

#include "core/face_patches.h"

namespace standpoint {

OverrideTable::OverrideTable(const Environment& environment, const std::vector<MaterialOverride>& overrides,
                             const Eigen::Vector3d& shift_m)
    : environment_(environment),
      shift_m_(shift_m),
      of_product_(environment.products.size(), -1),
      selects_(overrides.size(), false) {
  selectors_.reserve(overrides.size());
  for (std::size_t i = 0; i < overrides.size(); ++i) {
    const auto& selector = selectors_.emplace_back(environment, overrides[i].selector);
    if (selector.asksSurface() || selector.direction()) {
      narrower_.push_back(static_cast<int>(i));
      continue;
    }
    for (std::uint32_t product = 0; product < of_product_.size(); ++product) {
      if (!selector.fits(product)) continue;
      of_product_[product] = static_cast<int>(i);
      selects_[i] = true;
    }
  }
}

OverrideTable::Said OverrideTable::of(const SurfaceOfProduct& pair) {
  Said said{of_product_[pair.product], {}};
  for (const int index : narrower_) {
    const auto& selector = selectors_[static_cast<std::size_t>(index)];
    if (!selector.fits(pair.product, pair.surface) || (selector.point() && !isAt(index, pair))) continue;
    selects_[static_cast<std::size_t>(index)] = true;
    if (selector.direction())
      said.faces.push_back(index);
    else
      said.whole = std::max(said.whole, index);
  }
  std::erase_if(said.faces, [&](int index) { return index < said.whole; });
  return said;
}

std::optional<Eigen::Vector3d> OverrideTable::point(int index) const {
  const auto& point = selectors_[static_cast<std::size_t>(index)].point();
  return point ? std::optional<Eigen::Vector3d>(*point - shift_m_) : std::nullopt;
}

// Of all faces of the product the one at the point: beside it, that of another surface is not meant.
bool OverrideTable::isAt(int index, const SurfaceOfProduct& pair) const {
  const auto found = nearestFace(environment_, pair.product, std::nullopt, direction(index), *point(index));
  return found &&
         environment_.meshes[environment_.instances[found->instance].mesh]->surface_of_triangle[found->triangle] ==
             pair.surface;
}

}  // namespace standpoint
