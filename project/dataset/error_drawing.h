// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/environment.h"
#include "pointclouds/scores/error_places.h"
#include "pointclouds/scores/error_view.h"

namespace standpoint {

// Pieces of the pages that show where in a cloud something is wrong: SVG with the views as images in it.

// Okabe and Ito's colours, which people with any colour vision tell apart, without the yellow, which paper hides.
inline constexpr std::array<Rgb, 7> kInks = {
    {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {86, 180, 233}, {230, 159, 0}, {0, 0, 0}}};
inline constexpr Rgb kInkOfRight = {190, 190, 190};

std::string smallText(const std::string& text);
std::string legendOf(const std::vector<std::pair<Rgb, std::string>>& entries);

// Three views of a box in kInks, of pixels that its points fill, at most `most` a side.
std::vector<ErrorView> viewsOf(const Bounds& box, std::uint64_t points, double most);
// Where points are, without the few that lie far off, and some space around them.
Bounds boxAround(const PointSpread& spread);
Bounds cubeAround(const Eigen::Vector3d& middle, double edge_m);
inline bool isIn(const Bounds& box, const Eigen::Vector3d& at) {
  return (at.array() >= box.min.array()).all() && (at.array() <= box.max.array()).all();
}

// A mark of a place that is shown closer.
struct PlaceMark {
  std::string text;
  Eigen::Vector3d at_m = Eigen::Vector3d::Zero();
};
// One below the other, as large as the page, with coordinates along their edges and a scale bar.
std::string largeViews(const std::vector<ErrorView>& views, const std::vector<PlaceMark>& marks);

// A box that is looked at closer.
struct CloseUp {
  Bounds box;
  std::vector<ErrorView> views;
  std::uint64_t shown = 0;  // points of what it is of

  CloseUp(const Bounds& cube, std::uint64_t points) : box(cube), views(viewsOf(cube, points, 240)) {}
  bool has(const Eigen::Vector3d& at) const { return isIn(box, at); }
  // Where `ink` is nothing, the point is right.
  void add(const Eigen::Vector3d& at, std::optional<std::size_t> ink);
  std::string svg() const;
};

}  // namespace standpoint
