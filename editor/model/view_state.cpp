// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/view_state.h"

#include <cmath>

#include "core/random.h"

namespace standpoint {

namespace {

float channel(double hue, double lightness, double chroma, double offset) {
  const double k = std::fmod(offset + hue * 12, 12.0);
  return static_cast<float>(lightness - chroma * std::fmax(-1.0, std::fmin(std::fmin(k - 3, 9 - k), 1.0)));
}

}  // namespace

Colour materialColour(const char* material_id) {
  if (material_id == nullptr) return {0.93F, 0.26F, 0.60F, 1};   // nothing else in the picture is pink
  const auto hash = stableHash(material_id);
  // Hues leave out the pink of "unassigned".
  const double hue = static_cast<double>(hash % 1009) / 1009 * 0.82;
  const double lightness = 0.48 + static_cast<double>(hash / 1009 % 97) / 97 * 0.22;
  const double chroma = 0.10 + static_cast<double>(hash / 97873 % 89) / 89 * 0.14;
  return {channel(hue, lightness, chroma, 0), channel(hue, lightness, chroma, 8), channel(hue, lightness, chroma, 4), 1};
}

}  // namespace standpoint
