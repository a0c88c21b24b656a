// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "project/document.h"

namespace standpoint {

// A house of two storeys made of boxes, 10 m by 8 m, with windows, a door, properties, layers and one station: small,
// but with one of everything that the panels show. Ids are "#100" and up; the file's frame is shifted by (500000,
// 5800000, 50).
Document demoHouse();

constexpr std::uint32_t kDemoProducts = 27;

// The first of that name; ~0U: none.
std::uint32_t productNamed(const Environment& environment, const std::string& name);

}  // namespace standpoint
