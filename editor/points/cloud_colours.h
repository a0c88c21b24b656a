// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "pointclouds/octree/cloud_point.h"

namespace standpoint {

using PointColour = std::array<std::uint8_t, 4>;  // red, green, blue, alpha

// What the colours of a cloud's points are made of, besides each point itself: the scan's own colour, shaded by its
// intensity from what nearly all points have at least to what nearly all have at most, because formats state the
// sensor's possible range, of which a scan fills a corner. Without any intensity height stands for it.
struct CloudColouring {
  bool by_height = false;
  float low = 0, high = 65535;  // of CloudPoint::intensity, or of the height above the cloud's origin in metres
  bool operator==(const CloudColouring&) const = default;
};
// `points`: all, or an even part of them.
CloudColouring colouringOf(std::span<const CloudPoint> points, std::uint32_t channels);

// Colours of points relative to the cloud's origin, one for each; from any thread.
using PaintOfPoints = std::function<std::vector<PointColour>(std::span<const CloudPoint> points)>;

// Other colours for a cloud than its own: of the points that are in memory, and how the others are painted.
struct CloudPaint {
  std::vector<PointColour> colours;
  PaintOfPoints others;
};

// `height_m`: above the cloud's origin. It is not the record's own where that is relative to a node.
PointColour colourOf(const CloudPoint& point, float height_m, const CloudColouring& colouring);

}  // namespace standpoint
