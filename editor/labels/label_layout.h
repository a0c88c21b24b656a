// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace standpoint {

// What shall be written into the picture: as much of it as there is room for.
struct WantedLabel {
  struct Text {
    std::string words;
    Eigen::Vector2d size_px;  // with its margin
  };
  Eigen::Vector2d at_px;    // the middle of the lower edge, or of the whole
  bool centred = false;     // at_px is the middle of the whole
  std::vector<Text> texts;  // the first one that fits is taken
};

struct PlacedLabel {
  Eigen::Vector2d corner_px;  // at the top left
  std::size_t text = 0;       // of WantedLabel::texts
};

// For each label its place, or none where every text of it would cover one before it or leave the picture: who comes
// first has the right of way.
std::vector<std::optional<PlacedLabel>> layOut(const std::vector<WantedLabel>& labels, const Eigen::Vector2d& size_px);

}  // namespace standpoint
