// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/opening.h"

#include "core/environment.h"
#include "importers/ifc/shapes/convex_cut.h"

namespace standpoint::ifc {
namespace {

Bounds boundsOf(const geometry::PolyMesh& mesh) {
  Bounds b;
  for (const auto& p : mesh.points) b.extend(p);
  return b;
}

bool overlap(const Bounds& a, const Bounds& b) {
  constexpr double kTouch_m = 1e-6;  // what only touches takes nothing away
  return ((a.min.array() + kTouch_m) < b.max.array()).all() && ((b.min.array() + kTouch_m) < a.max.array()).all();
}

void move(geometry::PolyMesh& mesh, const Eigen::Vector3d& by) {
  for (auto& p : mesh.points) p += by;
}

}  // namespace

void cutAway(geometry::PolyMesh& body, const std::vector<geometry::PolyMesh>& tools, const Entity& element,
             Report& report) {
  const Bounds host = boundsOf(body);
  std::vector<geometry::PolyMesh> touching;
  for (const auto& tool : tools)
    if (overlap(host, boundsOf(tool))) touching.push_back(tool);
  if (touching.empty()) return;
  // Files with map coordinates in their points: near the origin the kernel's snapping keeps its meaning.
  const Eigen::Vector3d far = (host.min + host.max) / 2;
  const Eigen::Vector3d shift = far.cwiseAbs().maxCoeff() > 1000 ? Eigen::Vector3d(far.array().round())
                                                                 : Eigen::Vector3d(Eigen::Vector3d::Zero());
  move(body, -shift);
  const std::uint32_t tag = body.faces.empty() ? 0 : body.faces.front().tag;
  for (auto& tool : touching) {
    move(tool, -shift);
    geometry::setTag(tool, tag);  // reveals look like the body
  }
  auto cut = subtractTools(body, touching);
  if (cut)
    body = std::move(*cut);
  else
    report.lose(element.place(), std::to_string(touching.size()) +
                                     " openings were not cut; the body is unchanged: " + describe(cut.error()));
  move(body, shift);
}

}  // namespace standpoint::ifc
