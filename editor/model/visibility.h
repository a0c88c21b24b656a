// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/environment.h"

namespace standpoint {

using HiddenProducts = std::vector<std::uint8_t>;  // one per product; 1 = hidden

// What of the model is shown. It is a way of looking, not a change of the document: nothing here is undone or saved.
class Visibility {
 public:
  // Everything is shown again.
  void reset(std::size_t products);
  bool hidden(std::uint32_t product) const { return product < hidden_->size() && (*hidden_)[product] != 0; }
  bool anyHidden() const { return hidden_count_ > 0; }
  std::size_t hiddenCount() const { return hidden_count_; }
  const std::shared_ptr<const HiddenProducts>& shared() const { return hidden_; }

  void show(std::span<const std::uint32_t> products, bool shown);
  void isolate(std::span<const std::uint32_t> products);
  bool alone() const { return alone_; }  // some were isolated: clouds under the model would stand in the way
  void showAll() { reset(hidden_->size()); }

  // What lies above is cut away, local frame.
  std::optional<double> cut_height_m;
  // Cuts so that something is seen, which nobody has asked for; then the cut of before comes back, unless another has
  // been chosen since.
  void cutForSight(std::optional<double> height_m);
  void endCutForSight();

 private:
  struct CutForSight {
    std::optional<double> made_m, before_m;
  };
  void replace(HiddenProducts hidden);
  std::shared_ptr<const HiddenProducts> hidden_ = std::make_shared<const HiddenProducts>();
  std::size_t hidden_count_ = 0;
  bool alone_ = false;
  std::optional<CutForSight> for_sight_;
};

// A storey is looked into from here above its floor: above tables and sills, below lintels.
constexpr double kCutAboveFloor_m = 1.2;

struct StoreyLevel {
  std::int32_t node = -1;  // index into Environment::spatial
  double elevation_m = 0;  // local frame
};
// Lowest first. Elevations are taken from the geometry that stands on the storey when the file's own do not fit it
// (many exporters write 0 for all of them).
std::vector<StoreyLevel> storeyLevels(const Environment& environment, double shift_up_m);

}  // namespace standpoint
