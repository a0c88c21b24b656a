// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/simplify/engines/held_shape.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kLineWeight = 0.3;  // of an upright plane, times the squared length of its edge

void addPlane(const ManifoldShape& manifold, std::uint32_t corner, std::vector<Quadric>& planes) {
  const auto& t = manifold.triangles[corner / 3];
  const auto a = t[corner % 3], b = t[nextCorner(corner) % 3], c = t[nextCorner(nextCorner(corner)) % 3];
  const Vector3d edge = manifold.positions[b] - manifold.positions[a];
  const Vector3d upright = edge.cross(edge.cross(manifold.positions[c] - manifold.positions[a]));
  const double length = upright.norm();
  if (!(length > 0)) return;
  for (const auto v : {a, b})
    planes[v].addPlane(upright / length, manifold.positions[a], kLineWeight * edge.squaredNorm());
}

}  // namespace

HeldShape heldShapeOf(const Shape& shape, const std::vector<bool>* stays) {
  HeldShape held{manifoldOf(shape, stays), {}, {}};
  held.lines.resize(held.names.size());
  held.borders.resize(held.names.size());
  for (const auto& [one, other] : held.line_edges) {
    addPlane(held, one, held.lines);
    addPlane(held, other, held.lines);
  }
  for (const auto corner : held.border_edges) addPlane(held, corner, held.borders);
  return held;
}

Result<void> checkReachable(const ManifoldShape& manifold, std::size_t triangles) {
  const auto fixed = static_cast<std::size_t>(
      std::count_if(manifold.triangles.begin(), manifold.triangles.end(), [&](const Triangle& t) {
        return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return manifold.holds[v] == Hold::fixed; });
      }));
  if (fixed > triangles)
    return failure(ErrorKind::unusable,
                   fmt::format("{} triangles are at edges of three or more, {} are requested", fixed, triangles));
  return {};
}

void CollapseRecorder::record(std::uint32_t kept, std::uint32_t removed, std::uint32_t triangles,
                              const Eigen::Vector3d& position) {
  auto& names = held_->names;
  auto& holds = held_->holds;
  Collapse step;
  step.kept = names[kept];
  step.removed = names[removed];
  if (holds[removed] > holds[kept]) std::swap(step.kept, step.removed);
  step.triangles = triangles;
  step.position = position;
  log_.push_back(step);
  triangles_ -= triangles;
  names[kept] = step.kept;
  holds[kept] = std::max(holds[kept], holds[removed]);
  held_->lines[kept] += held_->lines[removed];
  held_->borders[kept] += held_->borders[removed];
  held_->positions[kept] = position;
}

}  // namespace standpoint
