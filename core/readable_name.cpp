// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/readable_name.h"

#include <algorithm>

namespace standpoint {

std::string longNameOf(const Product& product) {
  const auto property = std::find_if(product.properties.begin(), product.properties.end(),
                                     [](const Property& p) { return p.set == "Attributes" && p.name == "LongName"; });
  return property == product.properties.end() ? "" : property->value;
}

std::string readableName(const Product& product) {
  const std::string longer = longNameOf(product);
  if (longer.empty() || longer == product.name) return product.name.empty() ? product.id : product.name;
  return product.name.empty() ? longer : product.name + " " + longer;
}

}  // namespace standpoint
