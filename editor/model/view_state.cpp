// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/view_state.h"

#include <algorithm>
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
  if (material == nullptr) return {0.93F, 0.26F, 0.60F, 1};  // nothing else in the picture is pink
  const Colour own = visibleColour(*material);
  if (!material->transmittance.empty()) return own;
  // Hues leave out the pink of "unassigned".
  const double hue = static_cast<double>(stableHash(material->id.c_str()) % 1009) / 1009 * 0.82;
  const auto mixed = [](float shown, float tint) { return 0.88F * shown + 0.12F * tint; };
  return {mixed(own.r, channel(hue, 0.5, 0.3, 0)), mixed(own.g, channel(hue, 0.5, 0.3, 8)),
          mixed(own.b, channel(hue, 0.5, 0.3, 4)), 1};
}

Colour confidenceColour(double confidence) {
  if (confidence < 0) return materialColour(nullptr);
  // Stops at 0, kWeakConfidence and 1.
  if (confidence < kWeakConfidence) return {0.84F, static_cast<float>(0.33 + 0.4 * confidence), 0.25F, 1};
  const auto fraction = static_cast<float>(std::min(1.0, (confidence - kWeakConfidence) / (1 - kWeakConfidence)));
  return {std::lerp(0.90F, 0.42F, fraction), std::lerp(0.72F, 0.70F, fraction), std::lerp(0.30F, 0.46F, fraction), 1};
}

}  // namespace standpoint
