// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/result.h"

namespace standpoint {

// An icon as strokes on a square of 24 by 24, drawn for this project: emulated-ui/icons/icons.json says what each
// means. A drawing is a text of steps: "M x y" begins a line there, "L x y …" goes on, "Z" closes it; "O x y r" is a
// circle, "A x y r from to" an arc in degrees clockwise from three o'clock. "F" before any of them fills it.
struct IconStroke {
  std::vector<std::array<float, 2>> points;
  bool closed = false, filled = false;
};
struct Icon {
  std::string id, means;
  std::vector<IconStroke> strokes;
};

// Null where there is none of this name.
const Icon* findIcon(const std::string& id);
// All of them; an error names file and place.
const Result<std::vector<Icon>>& deviceIcons();

}  // namespace standpoint
