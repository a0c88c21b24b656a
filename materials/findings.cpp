// SPDX-License-Identifier: GPL-3.0-or-later
#include "materials/findings.h"

#include <algorithm>
#include <cstdio>

namespace standpoint {

namespace {

std::string metres(double area_m2) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f m²", area_m2);
  return text;
}

std::string called(const Product& product) {
  return (product.ifc_class.empty() ? "object" : product.ifc_class) + " '" + product.name + "'";
}

}  // namespace

// Called by rising product.
void FindingCollector::add(Cause cause, std::uint32_t product, double area_m2) {
  auto [place, is_new] = extents_.try_emplace(std::move(cause), Extent{product, product, 1, area_m2});
  if (is_new) return;
  auto& extent = place->second;
  extent.products += extent.last != product;
  extent.last = product;
  extent.area_m2 += area_m2;
}

std::vector<MaterialFinding> FindingCollector::findings(const Environment& environment) const {
  std::vector<std::pair<const Cause*, const Extent*>> order;
  for (const auto& [cause, extent] : extents_) order.emplace_back(&cause, &extent);
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    return std::pair(!a.first->warning, -a.second->area_m2) < std::pair(!b.first->warning, -b.second->area_m2);
  });
  std::vector<MaterialFinding> result;
  for (const auto& [cause, extent] : order) {
    const auto& product = environment.products[extent->first];
    const auto more = extent->products > 1 ? " and " + std::to_string(extent->products - 1) + " more" : std::string();
    result.push_back({cause->warning ? "warning" : "note", product.id,
                      cause->what + ' ' + called(product) + more + cause->then + " (" + metres(extent->area_m2) + ")"});
  }
  return result;
}

}  // namespace standpoint
