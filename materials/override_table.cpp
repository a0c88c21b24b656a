// SPDX-License-Identifier: GPL-3.0-or-later
#include "materials/override_table.h"

#include <algorithm>

namespace standpoint {

OverrideTable::OverrideTable(const Environment& environment, const std::vector<MaterialOverride>& overrides)
    : of_product_(environment.products.size(), -1), selects_(overrides.size(), false) {
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
    if (!selector.fits(pair.product, pair.surface)) continue;
    selects_[static_cast<std::size_t>(index)] = true;
    if (selector.direction()) said.faces.push_back(index);
    else said.whole = std::max(said.whole, index);
  }
  std::erase_if(said.faces, [&](int index) { return index < said.whole; });
  return said;
}

}  // namespace standpoint
