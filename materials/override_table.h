// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/environment.h"
#include "materials/areas.h"
#include "materials/materials.h"
#include "materials/select.h"

namespace standpoint {

// What the user said of each surface: the last override that means all of it, and those after it that mean single
// faces.
class OverrideTable {
 public:
  OverrideTable(const Environment& environment, const std::vector<MaterialOverride>& overrides,
                const Eigen::Vector3d& shift_m);

  struct Said {
    int whole = -1;
    std::vector<int> faces;  // rising: the later wins
  };
  Said of(const SurfaceOfProduct& pair);
  bool selects(std::size_t index) const { return selects_[index]; }
  const Eigen::Vector3d& direction(int index) const { return *selectors_[static_cast<std::size_t>(index)].direction(); }
  std::optional<Eigen::Vector3d> point(int index) const;  // local frame

 private:
  bool isAt(int index, const SurfaceOfProduct& pair) const;

  const Environment& environment_;
  Eigen::Vector3d shift_m_;
  std::vector<Selector> selectors_;
  std::vector<int> of_product_;  // of those that mean whole products
  std::vector<int> narrower_;    // those that mean surfaces or faces
  std::vector<bool> selects_;
};

}  // namespace standpoint
