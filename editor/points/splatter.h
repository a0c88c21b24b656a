// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace standpoint {

// Points as they are drawn, in columns: the processor takes eight at once. Not in any order of place, so that the first
// n of them are an even part.
struct PackedPoints {
  std::vector<float> x_m, y_m, z_m;    // from their own origin
  std::vector<std::uint32_t> colours;  // red in the lowest byte, then green, blue, alpha
  std::size_t size() const { return x_m.size(); }
  std::size_t bytes() const { return size() * 16; }
};

// Some of them in a picture.
struct PointRun {
  const PackedPoints* points = nullptr;
  std::size_t first = 0, count = 0;
  Eigen::Matrix4d clip_from_points = Eigen::Matrix4d::Identity();  // as OpenGL has it: seen within ±w
  int size_px = 1;                                                 // of the square that each point covers
  std::vector<Eigen::Vector4d> kept_sides;                         // in the points' frame: n·p + d >= 0 is drawn
};

// Rows from the bottom, as OpenGL has them.
struct PointPicture {
  int width = 0, height = 0;
  std::vector<std::uint32_t> colours;  // as in PackedPoints; 0: no point
  std::vector<float> depths;           // of the window: 0 near, 1 far, and where there is no point
};

// Draws points by the processor: software OpenGL needs ten times as long, because it handles each as a vertex. The
// nearest point of a pixel stays; of those equally near the one with the smaller number as its colour. So a picture
// depends neither on threads nor on the order of what is drawn, and can be drawn in parts.
class Splatter {
 public:
  void begin(int width, int height);  // nothing is drawn yet
  void draw(std::span<const PointRun> runs);
  const PointPicture& picture();  // of what has been drawn since begin()

 private:
  int width_ = 0, height_ = 0;
  bool changed_ = true;
  std::vector<std::vector<std::uint64_t>> nearest_;  // a picture for each thread: depth, colour
  PointPicture picture_;
};

// How the depths of a picture are distances.
struct DepthRange {
  double near_m = 0.1, far_m = 1000;
  bool parallel = false;
};
// Eye-dome lighting: what lies behind its neighbours in the picture gets darker, so that edges and form are seen
// without any normals.
void shadeByDepth(PointPicture& picture, const DepthRange& range);

}  // namespace standpoint
