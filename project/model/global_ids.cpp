// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/model/global_ids.h"

#include <string_view>
#include <unordered_map>

#include <fmt/format.h>

namespace standpoint {

void warnOfSharedGlobalIds(const Environment& environment, std::size_t first, Report& report) {
  std::unordered_map<std::string_view, std::size_t> owner;  // for look-up only
  for (std::size_t i = 0; i < environment.products.size(); ++i) {
    const Product& product = environment.products[i];
    if (product.global_id.empty()) continue;
    const auto [it, is_new] = owner.emplace(product.global_id, i);
    if (is_new || i < first || (first > 0 && it->second >= first)) continue;
    const Product& other = environment.products[it->second];
    report.warn(product.id,
                fmt::format("{} '{}' has the GlobalId {} of {} '{}' ({}): materials, treatments and updates that go by "
                            "it cannot tell them apart",
                            product.ifc_class, product.name, product.global_id, other.ifc_class, other.name, other.id));
  }
}

}  // namespace standpoint
