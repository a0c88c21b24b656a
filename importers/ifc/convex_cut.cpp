// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/convex_cut.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace standpoint::ifc {
namespace {

struct CutPlane {
  Eigen::Vector3d normal;
  double offset;
};

// Newell's normal, which takes a slightly bent polygon as it comes.
std::optional<CutPlane> planeOf(const geometry::PolyMesh& mesh, const geometry::Face& face) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(), centre = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < face.outer.size(); ++i) {
    const Eigen::Vector3d &a = mesh.points[face.outer[i]], &b = mesh.points[face.outer[(i + 1) % face.outer.size()]];
    normal += (a - mesh.points[face.outer[0]]).cross(b - mesh.points[face.outer[0]]);
    centre += a;
  }
  if (normal.norm() < 1e-12) return {};
  normal.normalize();
  return CutPlane{normal, normal.dot(centre) / static_cast<double>(face.outer.size())};
}

constexpr std::size_t kMostPlanes = 64;   // of a tool: more parts than that help nobody

// The planes that bound a convex solid, each once; nothing when it is not convex.
std::optional<std::vector<CutPlane>> planesOfConvex(const geometry::PolyMesh& tool) {
  constexpr double kFlat_m = 1e-5;
  std::vector<CutPlane> planes;
  for (const auto& face : tool.faces) {
    const auto plane = planeOf(tool, face);
    if (!plane) continue;
    for (const auto& other : tool.faces)
      for (const std::uint32_t i : other.outer)
        if (plane->normal.dot(tool.points[i]) > plane->offset + kFlat_m) return {};
    const bool known = std::any_of(planes.begin(), planes.end(), [&](const CutPlane& p) { return p.normal.dot(plane->normal) > 1 - 1e-10 && std::abs(p.offset - plane->offset) < kFlat_m; });
    if (!known) planes.push_back(*plane);
    if (planes.size() > kMostPlanes) return {};
  }
  return planes.size() >= 4 ? std::optional(planes) : std::nullopt;
}

Result<geometry::PolyMesh> cutInParts(const geometry::PolyMesh& host, const std::vector<CutPlane>& planes) {
  geometry::PolyMesh kept, rest = host;
  for (const CutPlane& plane : planes) {
    const auto outside = geometry::clip(rest, -plane.normal, -plane.offset);
    auto inside = geometry::clip(rest, plane.normal, plane.offset);
    if (!outside) return outside;
    if (!inside) return inside;
    geometry::append(kept, *outside);
    rest = std::move(*inside);
    if (rest.faces.empty()) break;
  }
  if (rest.faces.empty()) return host;   // nothing of the host is inside: better left whole
  return kept;
}

}  // namespace

Result<geometry::PolyMesh> subtractOrCut(const geometry::PolyMesh& host, std::span<const geometry::PolyMesh> tools, const Entity& place, Report& report) {
  auto at_once = geometry::subtract(host, tools);
  if (at_once) return at_once;
  std::vector<std::vector<CutPlane>> planes;
  for (const auto& tool : tools) {
    auto of_tool = planesOfConvex(tool);
    if (!of_tool) return at_once;
    planes.push_back(std::move(*of_tool));
  }
  geometry::PolyMesh left = host;
  for (const auto& of_tool : planes) {
    auto next = cutInParts(left, of_tool);
    if (!next) return at_once;
    left = std::move(*next);
  }
  report.warn(place.place(), "was cut in parts, whose touching faces stay inside the body: " + describe(at_once.error()));
  return left;
}

}  // namespace standpoint::ifc
