// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "emulated-ui/device/orders.h"

namespace standpoint {

// Places of a scan's picture: "u,v", shares of its width and height from its upper left corner, less than 1.

struct PicturePlace {
  double u = 0.5, v = 0.5;
};
std::optional<PicturePlace> placeIn(const std::string& text);
std::size_t cellAt(const ScanPreview& picture, const PicturePlace& place);
// What was measured there, in the scanner's frame; nothing where no point came back.
std::optional<Eigen::Vector3d> spotIn(const ScanPreview& picture, const std::string& place);

}  // namespace standpoint
