// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace standpoint {

// 0x00RRGGBB of an AutoCAD colour index, 1 to 255.
std::uint32_t rgbOfColourIndex(int index);

}  // namespace standpoint
