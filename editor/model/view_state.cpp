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

Colour materialColour(const PhysicalMaterial* material) {
  if (material == nullptr) return {0.93F, 0.26F, 0.60F, 1};   // nothing else in the picture is pink
  if (!material->transmittance.empty()) return {0.62F, 0.79F, 0.88F, 1};   // a pane has next to no diffuse colour
  const double red = atWavelength(material->reflectance, 660), green = atWavelength(material->reflectance, 532);
  const double blue = green - 0.8 * (red - green);   // the libraries begin in the green
  const auto shown = [](double reflectance) { return std::pow(std::fmax(0.01, std::fmin(reflectance, 1.0)), 1 / 2.2); };
  // Hues leave out the pink of "unassigned".
  const double hue = static_cast<double>(stableHash(material->id.c_str()) % 1009) / 1009 * 0.82;
  const auto mixed = [](double own, float tint) { return static_cast<float>(0.88 * own + 0.12 * tint); };
  return {mixed(shown(red), channel(hue, 0.5, 0.3, 0)), mixed(shown(green), channel(hue, 0.5, 0.3, 8)),
          mixed(shown(blue), channel(hue, 0.5, 0.3, 4)), 1};
}

}  // namespace standpoint
