// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/model/entities.h"

#include <algorithm>
#include <cctype>
#include <iterator>

namespace standpoint::ifc {
namespace {

constexpr EntityName kEntities[] = {
#include "importers/ifc/model/entity_table.inc"
};

int compareUpper(std::string_view name, std::string_view upper) {
  for (std::size_t i = 0; i < std::min(name.size(), upper.size()); ++i) {
    const int a = std::toupper(static_cast<unsigned char>(name[i])), b = static_cast<unsigned char>(upper[i]);
    if (a != b) return a - b;
  }
  return static_cast<int>(name.size()) - static_cast<int>(upper.size());
}

}  // namespace

const EntityName* entityName(std::string_view upper) {
  const auto it = std::lower_bound(std::begin(kEntities), std::end(kEntities), upper,
                                   [](const EntityName& e, std::string_view n) { return compareUpper(e.name, n) < 0; });
  return it != std::end(kEntities) && compareUpper(it->name, upper) == 0 ? it : nullptr;
}

std::string schemaSpelling(std::string_view upper) {
  if (const EntityName* known = entityName(upper)) return known->name;
  std::string name(upper);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (!name.empty()) name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  if (name.starts_with("Ifc") && name.size() > 3)
    name[3] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[3])));
  return name;
}

}  // namespace standpoint::ifc
