// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

struct ImFont;

namespace standpoint {

struct Fonts {
  ImFont* text = nullptr;
  ImFont* bold = nullptr;
  ImFont* small = nullptr;
  ImFont* mono = nullptr;
  ImFont* huge = nullptr;  // icons of empty panels
  std::string problem;     // which packages are missing; "" when none is
};

// How large everything is drawn, and in which letters.
struct Style {
  Fonts fonts;
  float scale = 1;  // pixels per point
  float px(float points) const { return points * scale; }
};

}  // namespace standpoint
