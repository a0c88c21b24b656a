// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "emulated-ui/layout/layout.h"

namespace standpoint {

// A rectangle in points or pixels, whichever its maker had.
struct Box {
  float x = 0, y = 0, width = 0, height = 0;

  float right() const { return x + width; }
  float bottom() const { return y + height; }
};
bool overlap(const Box& a, const Box& b);  // they share more than an edge

struct PlacedRegion {
  const Region* region;
  Box box;
  int depth = 0;  // how many others it lies on
};

// What is on the screen just now: a part of rows and columns of which nothing is there leaves its room to those beside
// it. Of tabs, the part that is chosen: by its region's place in the file.
struct PlacingState {
  std::function<bool(const std::string& widget)> there;
  std::function<int(const Region& tabs)> tab;
  float strip = 0;  // height of the titles of tabs
};

// Where the leaves of the tree stand in `whole`, in reading order. Tabs stand before the part that they show, and their
// box is that of their titles; rows and columns that lie on a picture stand before their parts, as their ground.
std::vector<PlacedRegion> placeRegions(const Region& root, const Box& whole, const PlacingState& state);

// What lies on its parent at `anchor`, "bottom right" for one, with these shares of its size.
Box anchored(const Box& whole, const Region& part);

}  // namespace standpoint
