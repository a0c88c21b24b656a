// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/environment.h"

namespace standpoint {

// The drawing layers of CAD that a product's shape lies on are properties of this set, one for each layer.
constexpr const char* kPresentationLayer = "Presentation layer";

// True when `fits` holds for the name of one of them.
template <class Fits>
bool anyPresentationLayer(const Product& product, const Fits& fits) {
  for (const Property& property : product.properties)
    if (property.set == kPresentationLayer && fits(property.value)) return true;
  return false;
}

}  // namespace standpoint
