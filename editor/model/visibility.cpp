// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/visibility.h"

#include <algorithm>
#include <set>

namespace standpoint {

void Visibility::replace(HiddenProducts hidden) {
  hidden_count_ = static_cast<std::size_t>(std::count(hidden.begin(), hidden.end(), 1));
  hidden_ = std::make_shared<const HiddenProducts>(std::move(hidden));
}

void Visibility::reset(std::size_t products) {
  replace(HiddenProducts(products, 0));
  alone_ = false;
}

void Visibility::show(std::span<const std::uint32_t> products, bool shown) {
  HiddenProducts changed = *hidden_;
  for (const auto p : products)
    if (p < changed.size()) changed[p] = shown ? 0 : 1;
  if (changed != *hidden_) replace(std::move(changed));
}

void Visibility::isolate(std::span<const std::uint32_t> products) {
  HiddenProducts changed(hidden_->size(), 1);
  for (const auto p : products)
    if (p < changed.size()) changed[p] = 0;
  replace(std::move(changed));
  alone_ = true;
}

void Visibility::cutForSight(std::optional<double> height_m) {
  const bool goes_on = for_sight_ && for_sight_->made_m == cut_height_m;
  for_sight_ = {height_m, goes_on ? for_sight_->before_m : cut_height_m};
  cut_height_m = height_m;
}

void Visibility::endCutForSight() {
  if (for_sight_ && for_sight_->made_m == cut_height_m) cut_height_m = for_sight_->before_m;
  for_sight_.reset();
}

std::vector<StoreyLevel> storeyLevels(const Environment& environment, double shift_up_m) {
  std::vector<StoreyLevel> levels;
  std::set<double> distinct;
  for (std::size_t i = 0; i < environment.spatial.size(); ++i) {
    const auto& node = environment.spatial[i];
    if (node.ifc_class != "IfcBuildingStorey") continue;
    levels.push_back({static_cast<std::int32_t>(i), node.elevation_m - shift_up_m});
    distinct.insert(node.elevation_m);
  }
  if (levels.size() > 1 && distinct.size() == 1) {
    const auto all = productBounds(environment);
    for (auto& level : levels) {
      Bounds of_storey;
      for (std::size_t p = 0; p < all.size(); ++p)
        if (environment.products[p].container == level.node && !all[p].empty()) of_storey.extend(all[p]);
      if (!of_storey.empty()) level.elevation_m = of_storey.min.z();
    }
  }
  std::stable_sort(levels.begin(), levels.end(),
                   [](const StoreyLevel& a, const StoreyLevel& b) { return a.elevation_m < b.elevation_m; });
  return levels;
}

}  // namespace standpoint
