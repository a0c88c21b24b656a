// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/environment.h"

namespace standpoint {

// What lies outside is cut away, of the model and of points alike. Local frame, metres; upright, turned about the
// vertical.
struct ClipBox {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), half = Eigen::Vector3d::Ones();  // half: of its sides, > 0
  double yaw_rad = 0;
  bool operator==(const ClipBox&) const = default;

  Eigen::Vector3d axis(int i) const;  // unit, 0..2
  bool contains(const Eigen::Vector3d& p) const;
  std::array<Eigen::Vector3d, 8> corners() const;  // bit i of the index: at the far end of axis i
};

// A face: axis * 2, and 1 more for the far one.
constexpr int kClipFaces = 6;
constexpr double kThinnestClip_m = 0.005;
struct ClipPlane {
  Eigen::Vector3d point, inward;  // inward: unit, towards what is kept
  bool operator==(const ClipPlane&) const = default;
};
ClipPlane planeOf(const ClipBox& box, int face);
// The face moved along its axis by `by_m`; the opposite one stays.
ClipBox withFaceMoved(const ClipBox& box, int face, double by_m);

ClipBox clipAround(const Bounds& bounds, double margin_m);
// A slab through a place whose thin side lies along `normal`: an upright one where that is nearer to level than to
// plumb, else a level one. It reaches over all of `bounds`.
ClipBox slabThrough(const Eigen::Vector3d& place, const Eigen::Vector3d& normal, double thickness_m,
                    const Bounds& bounds);
// Of a box, the axis of its shortest side: what a section is looked along.
int thinAxis(const ClipBox& box);
Bounds boundsOf(const ClipBox& box);

// The box with what a cut at a height takes away besides.
std::optional<ClipBox> combined(const std::optional<ClipBox>& box, const std::optional<double>& cut_height_m);
// What both keep: at most six sides, for which OpenGL has planes.
std::vector<ClipPlane> keptSides(const std::optional<ClipBox>& box, const std::optional<double>& cut_height_m);

}  // namespace standpoint
