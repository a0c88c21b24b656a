// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/environment.h"

namespace standpoint {

using Rgb = std::array<std::uint8_t, 3>;

// A parallel view of points along an axis: a plan (x to the right, y up), or what one sees from the south (x, z) or
// from the east (y, z).
enum class ViewFrom { above, south, east };
std::array<int, 2> axesOf(ViewFrom from);  // to the right and up: 0 is x

// Points of a box as a picture of at most kMostPixels a side: those that are right in grey, over them those that are
// wrong in the colours of `inks`. Holds counts, not points.
class ErrorView {
 public:
  static constexpr int kMostPixels = 1024;
  // The box has an extent along both axes of the view, and pixels of `pixel_m` or, where they would be too many, larger
  // ones.
  ErrorView(ViewFrom from, const Bounds& box, double pixel_m, std::vector<Rgb> inks);

  void addRight(const Eigen::Vector3d& at);  // what lies outside of the box is left out
  void addWrong(const Eigen::Vector3d& at, std::size_t ink);

  int width() const { return width_; }  // pixels
  int height() const { return height_; }
  double pixel_m() const { return pixel_m_; }
  const Bounds& box() const { return box_; }
  ViewFrom from() const { return from_; }
  // Rows from the top, three bytes a pixel: white without points, grey with right ones alone, else the ink that most of
  // the wrong ones have, the stronger the more of the points are wrong.
  std::vector<std::uint8_t> pixels() const;

 private:
  void count(const Eigen::Vector3d& at, std::size_t what);

  ViewFrom from_;
  Bounds box_;
  double pixel_m_;
  std::vector<Rgb> inks_;
  int width_ = 0, height_ = 0;
  std::vector<std::uint32_t> counts_;  // of each pixel: right ones, then those of each ink
};

}  // namespace standpoint
