// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which product of a changed model is which of the old one, and what has changed.

#include <cstdint>
#include <vector>

#include "core/environment.h"

namespace standpoint {

constexpr std::int32_t kNoProduct = -1;

struct ProductMatch {
  std::vector<std::int32_t> new_of_old;  // index into the new products; kNoProduct: gone
  std::vector<std::int32_t> old_of_new;
};
// By GlobalId; products without one by class and name where both models have that name once, else by id and name.
ProductMatch matchProducts(const Environment& before, const Environment& after);

struct ProductChange {
  bool geometry = false;           // a surface moved by more than 0.1 mm in bounds, centre or extent of its area
  bool material = false;           // materials, layers, or the name, colour or picture of its surfaces
  bool properties = false;         // name, type, place, groups, or a property
  std::vector<std::string> which;  // properties: "Pset_WallCommon.FireRating", "name"
  bool any() const { return geometry || material || properties; }
};
// Per old product; nothing is said of those that are gone. Both environments are in the same local frame.
std::vector<ProductChange> productChanges(const Environment& before, const Environment& after,
                                          const ProductMatch& match);

}  // namespace standpoint
