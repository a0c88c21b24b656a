// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>

namespace standpoint::las {

// The standard's classification (LAS 1.4 R15, table 17) of a product's class; docs/reference/formats/las.md has the
// table.
std::uint8_t classOf(std::string_view ifc_class);
inline constexpr std::uint8_t kLowNoise = 7;  // of a point without a surface

}  // namespace standpoint::las
