// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

namespace standpoint {

// What a part of a body is made of; each instrument says what colour its shells have.
enum class BodyPaint : std::uint8_t { shell, trim, dark, glass, metal, accent, legs, rubber, clothes };
using BodyColour = std::array<std::uint8_t, 3>;

// Triangles of closed solids, seen anticlockwise from outside; metres.
struct BodyMesh {
  std::vector<Eigen::Vector3f> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<BodyPaint> paints;  // one per triangle
};

// A cross-section of a solid around its axis: a rectangle whose corners are cut, at a height along the axis.
struct Section {
  double along_m = 0;
  double wide_m = 0, deep_m = 0;  // half of it, along the first and the second axis
  double cut_m = 0;               // of each corner
};

// Solids that bodies are made of. A frame's Z is the axis along which a solid goes up; its X is what is wide.
struct SolidMaker {
  BodyMesh& mesh;

  // Through sections that rise along Z: eight corners each, four where nothing is cut from any.
  void loft(BodyPaint paint, const Eigen::Isometry3d& frame, const std::vector<Section>& sections);
  // A block with its lower face in the middle of the frame, its vertical edges and its rims cut by `cut_m`; at the top
  // as wide and deep as `narrowed` says.
  void block(BodyPaint paint, const Eigen::Vector3d& foot_m, const Eigen::Vector3d& size_m, double cut_m,
             const Eigen::Vector2d& narrowed = {1, 1});
  // A round solid between two places.
  void rod(BodyPaint paint, const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m, double from_radius_m,
           double to_radius_m, int sides);
  // A bow of a square bar: an arch over the line between two places, `rise_m` high.
  void bow(BodyPaint paint, const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m, double rise_m, double bar_m);

 private:
  void rings(BodyPaint paint, const std::vector<std::vector<Eigen::Vector3d>>& rings);
};

}  // namespace standpoint
