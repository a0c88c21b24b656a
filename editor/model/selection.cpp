// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/selection.h"

#include <algorithm>

namespace standpoint {

bool Selection::contains(std::uint32_t product) const {
  return std::binary_search(products_->begin(), products_->end(), product);
}

void Selection::clear() {
  if (!empty()) set(std::vector<std::uint32_t>{});
}

void Selection::set(std::uint32_t product) { set(std::vector<std::uint32_t>{product}); }

void Selection::set(std::vector<std::uint32_t> products) {
  primary_ = products.empty() ? 0 : products.back();
  std::sort(products.begin(), products.end());
  products.erase(std::unique(products.begin(), products.end()), products.end());
  if (products != *products_) products_ = std::make_shared<const std::vector<std::uint32_t>>(std::move(products));
}

void Selection::toggle(std::uint32_t product) {
  auto changed = *products_;
  const auto place = std::lower_bound(changed.begin(), changed.end(), product);
  if (place != changed.end() && *place == product) {
    changed.erase(place);
    if (primary_ == product && !changed.empty()) primary_ = changed.back();
  } else {
    changed.insert(place, product);
    primary_ = product;
  }
  products_ = std::make_shared<const std::vector<std::uint32_t>>(std::move(changed));
}

}  // namespace standpoint
