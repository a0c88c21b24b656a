// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/view_state.h"

#include <cmath>

#include "core/random.h"
#include "core/visible_colour.h"

namespace standpoint {

namespace {

float channel(double hue, double lightness, double chroma, double offset) {
  const double k = std::fmod(offset + hue * 12, 12.0);
  return static_cast<float>(lightness - chroma * std::fmax(-1.0, std::fmin(std::fmin(k - 3, 9 - k), 1.0)));
}

}  // namespace

Colour materialColour(const PhysicalMaterial* material) {
  if (material == nullptr) return {0.93F, 0.26F, 0.60F, 1};   // nothing else in the picture is pink
  const Colour own = visibleColour(*material);
  if (!material->transmittance.empty()) return own;
  // Hues leave out the pink of "unassigned".
  const double hue = static_cast<double>(stableHash(material->id.c_str()) % 1009) / 1009 * 0.82;
  const auto mixed = [](float shown, float tint) { return 0.88F * shown + 0.12F * tint; };
  return {mixed(own.r, channel(hue, 0.5, 0.3, 0)), mixed(own.g, channel(hue, 0.5, 0.3, 8)), mixed(own.b, channel(hue, 0.5, 0.3, 4)), 1};
}

}  // namespace standpoint
