// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>

struct ImFont;

namespace standpoint {

struct Fonts {
  ImFont* text = nullptr;
  ImFont* bold = nullptr;
  ImFont* small = nullptr;
  ImFont* mono = nullptr;
  ImFont* huge = nullptr;            // icons of empty panels
  std::array<ImFont*, 6> letters{};  // of the text's family, from small to large: a device's letters are made of them
  std::string problem;               // which packages are missing; "" when none is
};

// How large everything is drawn, and in which letters.
struct Style {
  Fonts fonts;
  float scale = 1;  // pixels per point
  float px(float points) const { return points * scale; }
};

}  // namespace standpoint
