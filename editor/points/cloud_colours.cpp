// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/points/cloud_colours.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace standpoint {

namespace {

// A colour alone shows no form: part of the intensity is mixed in.
std::uint8_t greyed(std::uint8_t colour, std::uint8_t grey) {
  return static_cast<std::uint8_t>(colour * (96 + grey * 159 / 255) / 255);
}

}  // namespace

CloudColouring colouringOf(std::span<const CloudPoint> points, std::uint32_t channels) {
  CloudColouring colouring{.by_height = (channels & cloud_channel::kIntensity) == 0};
  std::vector<float> values;
  values.reserve(points.size());
  for (const auto& p : points)
    values.push_back(colouring.by_height ? p.position_m[2] : static_cast<float>(p.intensity));
  if (values.empty()) return colouring;
  const auto at = [&](double fraction) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
  colouring.low = at(0.02);
  colouring.high = at(0.98);
  return colouring;
}

PointColour colourOf(const CloudPoint& point, float height_m, const CloudColouring& colouring) {
  const float value = colouring.by_height ? height_m : static_cast<float>(point.intensity);
  const float span = std::max(colouring.high - colouring.low, 1e-6F);
  const float fraction = std::clamp((value - colouring.low) / span, 0.0F, 1.0F);
  const auto grey = static_cast<std::uint8_t>(40.5F + 215 * fraction);
  return {greyed(point.colour[0], grey), greyed(point.colour[1], grey), greyed(point.colour[2], grey), 255};
}

}  // namespace standpoint
