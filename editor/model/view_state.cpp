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

Result<PixelPicture> SceneView::pixels(const ViewState&, int, int) {
  return failure(ErrorKind::unusable, "nothing draws pictures here: OpenGL is missing");
}

bool keeps(const ViewState& state, const Eigen::Vector3d& place, double above_floor_m) {
  return (!state.cut_height_m || place.z() - above_floor_m < *state.cut_height_m) &&
         (!state.clip || state.clip->contains(place));
}

bool isDrawnApart(const ViewState& state, std::uint32_t product) {
  return state.doors && product < state.doors->products.size() && state.doors->products[product].inScene();
}

bool isTerrain(const Product& product) {
  return product.ifc_class == "IfcSite" || product.ifc_class == "IfcGeographicElement";
}

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
  const bool weak = confidence < kWeakConfidence;
  const auto fraction = static_cast<float>(
      weak ? confidence / kWeakConfidence : std::min(1.0, (confidence - kWeakConfidence) / (1 - kWeakConfidence)));
  if (weak)
    return {std::lerp(0.38F, 0.69F, fraction), std::lerp(0.16F, 0.33F, fraction), std::lerp(0.09F, 0.12F, fraction), 1};
  return {std::lerp(0.88F, 0.84F, fraction), std::lerp(0.59F, 0.92F, fraction), std::lerp(0.24F, 0.89F, fraction), 1};
}

}  // namespace standpoint
