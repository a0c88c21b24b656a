// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "core/html_text.h"

namespace standpoint {

// Pieces of the pictures of a set and of its scores: SVG, the same bytes on every machine.

inline constexpr const char* kSvgInk = "#333333";

// 1, 2 or 5 times a power of ten, of which four or more fit.
inline double scaleBar(double width_m) {
  double bar = 1e-3;
  for (const double factor : {1.0, 2.0, 5.0})
    for (double power = 1e-3; power < 1e6; power *= 10)
      if (factor * power <= width_m / 4) bar = std::max(bar, factor * power);
  return bar;
}

inline std::string textAt(double x, double y, double size, const char* anchor, const std::string& text,
                          const char* colour = kSvgInk) {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" font-family=\"sans-serif\" font-size=\"{:.0f}\" text-anchor=\"{}\" "
      "fill=\"{}\">{}</text>\n",
      x, y, size, anchor, colour, htmlText(text));
}

// With its length to the right of it.
inline std::string scaleBarAt(double x, double y, double bar_m, double units_per_m) {
  return fmt::format("<path stroke=\"{}\" stroke-width=\"2\" d=\"M{:.1f} {:.1f}h{:.1f}\"/>\n", kSvgInk, x, y,
                     bar_m * units_per_m) +
         textAt(x + bar_m * units_per_m + 6, y + 4, 11, "start", fmt::format("{:g} m", bar_m));
}

}  // namespace standpoint
