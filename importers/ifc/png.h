// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace standpoint::ifc {

// A PNG (ISO/IEC 15948) of 8-bit grey, grey with alpha, RGB or RGBA points (1 to 4 components), rows from the top.
// `pixels` has width × height × components bytes.
std::vector<std::byte> pngFromPixels(const std::vector<std::byte>& pixels, std::uint32_t width, std::uint32_t height, int components);

}  // namespace standpoint::ifc
