// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/visible_colour.h"

#include <cmath>

namespace standpoint {

Colour visibleColour(const PhysicalMaterial& material) {
  if (!material.transmittance.empty()) return {0.62F, 0.79F, 0.88F, 1};  // a pane has next to no diffuse colour
  const double red = atWavelength(material.reflectance, 660), green = atWavelength(material.reflectance, 532);
  const double blue = green - 0.8 * std::fabs(red - green);  // bricks and leaves are poor in blue, greys are not
  const auto shown = [](double reflectance) {
    return static_cast<float>(std::pow(std::fmax(0.01, std::fmin(reflectance, 1.0)), 1 / 2.2));
  };
  return {shown(red), shown(green), shown(blue), 1};
}

}  // namespace standpoint
