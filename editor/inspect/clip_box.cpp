// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/inspect/clip_box.h"

#include <algorithm>
#include <cmath>

namespace standpoint {

using Eigen::Vector3d;

Vector3d ClipBox::axis(int i) const {
  if (i == 0) return {std::cos(yaw_rad), std::sin(yaw_rad), 0};
  if (i == 1) return {-std::sin(yaw_rad), std::cos(yaw_rad), 0};
  return Vector3d::UnitZ();
}

bool ClipBox::contains(const Vector3d& p) const {
  for (int i = 0; i < 3; ++i)
    if (std::abs(axis(i).dot(p - centre)) > half[i]) return false;
  return true;
}

std::array<Vector3d, 8> ClipBox::corners() const {
  std::array<Vector3d, 8> all;
  for (int c = 0; c < 8; ++c) {
    Vector3d p = centre;
    for (int i = 0; i < 3; ++i) p += axis(i) * ((c >> i & 1) != 0 ? half[i] : -half[i]);
    all[static_cast<std::size_t>(c)] = p;
  }
  return all;
}

ClipPlane planeOf(const ClipBox& box, int face) {
  const Vector3d outward = box.axis(face / 2) * (face % 2 == 1 ? 1 : -1);
  return {box.centre + outward * box.half[face / 2], -outward};
}

ClipBox withFaceMoved(const ClipBox& box, int face, double by_m) {
  ClipBox moved = box;
  const int i = face / 2;
  const double sense = face % 2 == 1 ? 1 : -1;
  const double by = sense * std::max(sense * by_m, kThinnestClip_m - 2 * box.half[i]);
  moved.half[i] += sense * by / 2;
  moved.centre += box.axis(i) * (by / 2);
  return moved;
}

ClipBox clipAround(const Bounds& bounds, double margin_m) {
  const Vector3d half = (bounds.max - bounds.min) / 2 + Vector3d::Constant(margin_m);
  return {(bounds.min + bounds.max) / 2, half.cwiseMax(kThinnestClip_m / 2), 0};
}

ClipBox slabThrough(const Vector3d& place, const Vector3d& normal, double thickness_m, const Bounds& bounds) {
  const double thin = std::max(thickness_m, kThinnestClip_m) / 2;
  ClipBox slab = clipAround(bounds, 0.5);
  if (std::abs(normal.z()) > std::sqrt(0.5)) {
    slab.centre.z() = place.z();
    slab.half.z() = thin;
    return slab;
  }
  slab.yaw_rad = std::atan2(normal.y(), normal.x());
  const double reach = std::hypot(slab.half.x(), slab.half.y());
  // Beside the place as far as the bounds are, whichever way it is turned.
  const Vector3d along = slab.axis(1);
  const Vector3d beside = place + along * along.dot(slab.centre - place);
  slab.half.x() = thin;
  slab.half.y() = reach;
  slab.centre = {beside.x(), beside.y(), slab.centre.z()};
  return slab;
}

int thinAxis(const ClipBox& box) {
  int axis = 0;
  box.half.minCoeff(&axis);
  return axis;
}

Bounds boundsOf(const ClipBox& box) {
  Bounds bounds;
  for (const auto& corner : box.corners()) bounds.extend(corner);
  return bounds;
}

std::optional<ClipBox> combined(const std::optional<ClipBox>& box, const std::optional<double>& cut_height_m) {
  if (!box || !cut_height_m) return box;
  const double top = box->centre.z() + box->half.z();
  return *cut_height_m >= top ? box : withFaceMoved(*box, 5, *cut_height_m - top);
}

std::vector<ClipPlane> keptSides(const std::optional<ClipBox>& box, const std::optional<double>& cut_height_m) {
  std::vector<ClipPlane> kept;
  if (const auto both = combined(box, cut_height_m))
    for (int face = 0; face < kClipFaces; ++face) kept.push_back(planeOf(*both, face));
  else if (cut_height_m)
    kept.push_back({{0, 0, *cut_height_m}, -Vector3d::UnitZ()});
  return kept;
}

}  // namespace standpoint
