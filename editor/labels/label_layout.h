// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace standpoint {

// What labels name; who comes first has the right of way.
enum class LabelKind {
  measuring,
  measurement,
  worst_place,
  station,
  target,
  obstacle,
  waypoint,
  trajectory,
  hole,
  stair,
  room
};

struct LabelOf {
  LabelKind kind = LabelKind::room;
  std::size_t index = 0;  // of that kind: the same one in each frame
  auto operator<=>(const LabelOf&) const = default;
};

// What shall be written into the picture: as much of it as there is room for.
struct WantedLabel {
  struct Text {
    std::string words;
    Eigen::Vector2d size_px;  // with its margin
  };
  LabelOf of;
  Eigen::Vector2d at_px;    // what is named
  std::vector<Text> texts;  // the first one that fits is taken
  bool centred = false;     // around at_px rather than beside it
  bool chosen = false;      // before all that are not
  double gap_px = 0;        // between what is named and a label beside it
  double mark_px = 0;       // around at_px, what no label may cover
};

// Where it stands by what it names.
enum class LabelSide { above, below, right, left };

struct PlacedLabel {
  Eigen::Vector2d corner_px;  // at the top left
  std::size_t text = 0;       // of WantedLabel::texts
  LabelSide side = LabelSide::above;
};

// Lays out the labels of one view, frame by frame. A label goes to another side, and comes back into the picture, only
// where there is more room for it than it takes to stay: a picture that moves does not make it flicker.
class LabelLayout {
 public:
  // For each label its place, or none where every text of it would cover another or what is `kept_free`, or leave the
  // picture.
  std::vector<std::optional<PlacedLabel>> layOut(const std::vector<WantedLabel>& labels, const Eigen::Vector2d& size_px,
                                                 double slack_px = 0,
                                                 const std::vector<Eigen::AlignedBox2d>& kept_free = {});

 private:
  std::map<LabelOf, PlacedLabel> before_;
};

}  // namespace standpoint
