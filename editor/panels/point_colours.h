// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "editor/inspect/point_colour.h"

namespace standpoint {

struct Model;

// What the points that are shown have their colours from, as it is called.
std::string pointColourName(const Model& model);
// "" or why they cannot be coloured so.
std::string whyNoPointColour(const Model& model, ColourBy colour);
// The entries of an open list; the one that has just been chosen.
std::optional<ColourBy> choosePointColour(const Model& model);

}  // namespace standpoint
