// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "core/environment.h"
#include "materials/pattern.h"

namespace standpoint {

// A selector held against one environment. `material:GLOB` and `colour:` mean single surfaces of a product: of
// `material:` those whose name fits or, where a surface has no name, those of products one of whose materials fits.
class Selector {
 public:
  Selector(const Environment& environment, std::string_view text);

  bool fits(std::uint32_t product) const { return of_product_[product]; }  // some surface of it, or all
  bool fits(std::uint32_t product, std::uint32_t surface) const;
  bool asksSurface() const { return !materials_.empty() || !colours_.empty(); }
  const std::optional<Eigen::Vector3d>& direction() const { return direction_; }  // unit
  const std::optional<Eigen::Vector3d>& point() const { return point_; }          // file frame; only with a direction

 private:
  struct Named {
    std::vector<bool> of_surface, of_product;
  };
  void add(std::string_view condition);

  const Environment& environment_;
  std::vector<bool> of_product_;
  std::vector<Named> materials_;
  std::vector<std::vector<bool>> colours_;  // by surface
  std::optional<Eigen::Vector3d> direction_, point_;
};

}  // namespace standpoint
