// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/environment.h"
#include "materials/pattern.h"

namespace standpoint {

// `material:GLOB` means single surfaces of a product: those whose name fits or, where a surface has no name, those of
// products one of whose materials fits.
class SurfaceSelector {
 public:
  // Nothing for the other kinds of selectors.
  static std::optional<SurfaceSelector> parse(const Environment& environment, std::string_view selector);
  bool fits(const Environment& environment, std::uint32_t product, std::uint32_t surface) const;

 private:
  explicit SurfaceSelector(std::string_view globs) : pattern_(globs) {}

  Pattern pattern_;
  std::vector<bool> by_surface_, by_product_;
};

}  // namespace standpoint
