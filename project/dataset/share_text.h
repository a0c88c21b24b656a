// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include <fmt/format.h>

namespace standpoint {

// A share from 0 to 1 as a number of percent; a dash where it is one of nothing.
inline std::string percentOf(const std::optional<double>& share) {
  return share ? fmt::format("{:.2f}", 100 * *share) : "–";
}
inline std::string shareText(const std::optional<double>& share) { return percentOf(share) + (share ? " %" : ""); }
// In a page's table whose heading has the unit.
inline std::string shareCell(const std::optional<double>& share) { return "<td class=\"n\">" + percentOf(share); }

}  // namespace standpoint
