// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/shapes/convex_cut.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "importers/geometry/boolean_ways.h"
#include "importers/ifc/shapes/flaps.h"
#include "importers/ifc/shapes/seams.h"

namespace standpoint::ifc {
namespace {

constexpr double kFlat_m = 1e-6;          // as the kernel's clip: points this near to a plane are on it
constexpr std::size_t kMostPlanes = 256;  // of a tool; rounder ones are left to the kernel

struct CutPlane {
  Eigen::Vector3d normal;
  double offset;
  double above(const Eigen::Vector3d& p) const { return normal.dot(p) - offset; }
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

// The planes that bound a convex solid, each once; nothing when it is not convex.
std::optional<std::vector<CutPlane>> planesOfConvex(geometry::PolyMesh tool) {
  if (geometry::volume(tool) < 0)
    for (auto& face : tool.faces) std::reverse(face.outer.begin(), face.outer.end());
  std::vector<CutPlane> planes;
  for (const auto& face : tool.faces) {
    const auto plane = planeOf(tool, face);
    if (!plane) continue;
    for (const auto& other : tool.faces)
      for (const std::uint32_t i : other.outer)
        if (plane->above(tool.points[i]) > 10 * kFlat_m) return {};
    const bool known = std::any_of(planes.begin(), planes.end(), [&](const CutPlane& p) {
      return p.normal.dot(plane->normal) > 1 - 1e-10 && std::abs(p.offset - plane->offset) < 10 * kFlat_m;
    });
    if (!known) planes.push_back(*plane);
    if (planes.size() > kMostPlanes) return {};
  }
  return planes.size() >= 4 ? std::optional(planes) : std::nullopt;
}

// What of one face is outside of the tool, piece by piece. A single face is an open surface, which clip leaves open.
Result<void> appendOutside(geometry::PolyMesh& kept, const geometry::PolyMesh& host, const geometry::Face& face,
                           const std::vector<CutPlane>& planes) {
  geometry::PolyMesh rest;
  geometry::Face own;
  own.tag = face.tag;
  const auto copy = [&](const std::vector<std::uint32_t>& from, std::vector<std::uint32_t>& to) {
    for (const std::uint32_t i : from)
      to.push_back(static_cast<std::uint32_t>(rest.points.size())), rest.points.push_back(host.points[i]);
  };
  copy(face.outer, own.outer);
  for (const auto& hole : face.holes) copy(hole, own.holes.emplace_back());
  rest.faces.push_back(std::move(own));
  for (const CutPlane& plane : planes) {
    TRY_ASSIGN(const auto outside, geometry::clip(rest, -plane.normal, -plane.offset));
    TRY_ASSIGN(auto inside, geometry::clip(rest, plane.normal, plane.offset));
    geometry::append(kept, outside);
    rest = std::move(inside);
    if (rest.faces.empty()) break;
  }
  return {};
}

bool crossesBelow(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p) {
  return (a.y() > p.y()) != (b.y() > p.y()) && p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x();
}

// By the number of crossings, seen along the strongest axis of the normal.
bool holds(const geometry::PolyMesh& mesh, const geometry::Face& face, const CutPlane& plane,
           const Eigen::Vector3d& point) {
  int axis = 0;
  plane.normal.cwiseAbs().maxCoeff(&axis);
  const auto flat = [axis](const Eigen::Vector3d& p) { return Eigen::Vector2d(p[(axis + 1) % 3], p[(axis + 2) % 3]); };
  bool in = false;
  const auto count = [&](const std::vector<std::uint32_t>& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i)
      if (crossesBelow(flat(mesh.points[loop[i]]), flat(mesh.points[loop[(i + 1) % loop.size()]]), flat(point)))
        in = !in;
  };
  count(face.outer);
  for (const auto& hole : face.holes) count(hole);
  return in;
}

// Whether a face of the part that goes away is a piece of the host's own surface, flush with the tool's.
bool isOfHost(const geometry::PolyMesh& core, const geometry::Face& face, const geometry::PolyMesh& host,
              const CutPlane& plane) {
  std::vector<Triangle> triangles;
  if (!geometry::triangulate(core.points, face, triangles) || triangles.empty()) return true;
  const Triangle& t = triangles[0];
  const Eigen::Vector3d inner = (core.points[t[0]] + core.points[t[1]] + core.points[t[2]]) / 3;
  return std::any_of(host.faces.begin(), host.faces.end(), [&](const geometry::Face& f) {
    for (const std::uint32_t i : f.outer)
      if (std::abs(plane.above(host.points[i])) > 2 * kFlat_m) return false;
    const auto own = planeOf(host, f);
    return own && own->normal.dot(plane.normal) > 0 && holds(host, f, plane, inner);
  });
}

const CutPlane* planeUnder(const geometry::PolyMesh& core, const geometry::Face& face,
                           const std::vector<CutPlane>& planes) {
  const auto own = planeOf(core, face);
  for (const CutPlane& plane : planes) {
    const bool on = std::all_of(face.outer.begin(), face.outer.end(),
                                [&](std::uint32_t i) { return std::abs(plane.above(core.points[i])) <= 2 * kFlat_m; });
    if (on && own && own->normal.dot(plane.normal) > 0.9) return &plane;
  }
  return nullptr;
}

// The host's faces outside of the tool, and the reveals: where the tool's planes bound what goes away.
Result<geometry::PolyMesh> subtractConvex(geometry::PolyMesh host, const std::vector<CutPlane>& planes) {
  for (const CutPlane& plane : planes) snapToPlane(host, plane.normal, plane.offset);
  geometry::PolyMesh core = host;
  for (const CutPlane& plane : planes) {
    auto next = geometry::clip(core, plane.normal, plane.offset);
    if (!next) return next;
    core = std::move(*next);
    if (core.faces.empty()) return host;  // they only touch
  }
  geometry::PolyMesh kept;
  for (const auto& face : host.faces) TRY(appendOutside(kept, host, face, planes));
  geometry::PolyMesh reveals;
  reveals.points = core.points;
  for (geometry::Face face : core.faces) {
    const CutPlane* plane = planeUnder(core, face, planes);
    if (!plane || isOfHost(core, face, host, *plane)) continue;
    std::reverse(face.outer.begin(), face.outer.end());
    for (auto& hole : face.holes) std::reverse(hole.begin(), hole.end());
    reveals.faces.push_back(std::move(face));
  }
  geometry::append(kept, reveals);
  mendSeams(kept);
  const double before = geometry::volume(host), expected = before - geometry::volume(core);
  if (std::abs(geometry::volume(kept) - expected) > 1e-6 + 1e-4 * std::abs(before))
    return failure(ErrorKind::unusable, "by planes: volume check failed");
  return kept;
}

bool allFit(const geometry::PolyMesh& host, std::span<const geometry::PolyMesh> tools) {
  const auto common = geometry::commonDirection(host, tools);
  return common && std::all_of(common->fits.begin(), common->fits.end(), [](bool fits) { return fits; });
}

// A body that was closed and is not any more has lost a face.
bool tore(const geometry::PolyMesh& before, const geometry::PolyMesh& after) {
  return !after.faces.empty() && geometry::isClosed(before) && !geometry::isClosed(after);
}

Result<geometry::PolyMesh> byPlanes(const geometry::PolyMesh& host, const geometry::PolyMesh& tool) {
  const auto planes = planesOfConvex(tool);
  if (!planes) return failure(ErrorKind::unusable, "by planes: the tool is not convex");
  return subtractConvex(host, *planes);
}

// Does what it can the simple ways; the tools that are left are put into `general`.
geometry::PolyMesh subtractSimple(const geometry::PolyMesh& host, std::span<const geometry::PolyMesh> tools,
                                  std::vector<geometry::PolyMesh>& general) {
  if (allFit(host, tools))
    if (auto flat = geometry::subtract(host, tools); flat && !tore(host, *flat)) return std::move(*flat);
  geometry::PolyMesh left = host;
  for (const auto& tool : tools) {
    auto cut = byPlanes(left, tool);
    if (cut && !tore(left, *cut))
      left = std::move(*cut);
    else
      general.push_back(tool);
  }
  return left;
}

bool holdAll(std::span<const geometry::PolyMesh> tools, const geometry::PolyMesh& host) {
  Eigen::AlignedBox3d box, tool_box;
  for (const auto& p : host.points) box.extend(p);
  for (const auto& tool : tools)
    for (const auto& p : tool.points) tool_box.extend(p);
  tool_box.extend(Eigen::Vector3d(tool_box.min().array() - 1e-5));
  tool_box.extend(Eigen::Vector3d(tool_box.max().array() + 1e-5));
  return tool_box.contains(box);
}

}  // namespace

Result<geometry::PolyMesh> subtractSimpleTools(const geometry::PolyMesh& host,
                                               std::span<const geometry::PolyMesh> tools) {
  std::vector<geometry::PolyMesh> general;
  geometry::PolyMesh left = subtractSimple(host, tools, general);
  if (!general.empty()) return failure(ErrorKind::unusable, "a tool is not simple");
  return left;
}

namespace {

// The kernel's volume check leaves room for a lost face where the tools are large: these look closer.
Result<geometry::PolyMesh> byKernel(const geometry::PolyMesh& host, std::span<const geometry::PolyMesh> tools) {
  auto cut = geometry::subtract(host, tools);
  if (!cut) return cut;
  mendSeams(*cut);
  if (tore(host, *cut)) return failure(ErrorKind::unusable, "the Boolean operation left the body open");
  if (cut->faces.empty() && !holdAll(tools, host))
    return failure(ErrorKind::unusable, "the Boolean operation removed a body that extends beyond its tools");
  return cut;
}

// A tool that will not go as it is, or leaves flaps, goes a little larger: faces and edges that only just touched, on
// which every kernel stumbles, part. If even that fails what there was stands, with flaps, or torn but of the right
// volume.
Result<geometry::PolyMesh> subtractStubborn(const geometry::PolyMesh& host, const geometry::PolyMesh& tool) {
  auto first = byKernel(host, std::span(&tool, 1));
  if (first && !hasFlaps(*first)) return first;
  for (const double by_m : {2e-5, 1e-4}) {
    const geometry::PolyMesh larger = grown(tool, by_m);
    if (auto cut = byPlanes(host, larger); cut && !tore(host, *cut) && !hasFlaps(*cut)) return cut;
    if (auto cut = byKernel(host, std::span(&larger, 1)); cut && (!first || !hasFlaps(*cut))) return cut;
  }
  if (first) return first;
  if (auto torn = byPlanes(host, tool)) return torn;
  return first;
}

// All at once, else each half on its own: of many tools only the few that do not go as they are cost a call each.
Result<geometry::PolyMesh> subtractGeneral(const geometry::PolyMesh& host, std::span<const geometry::PolyMesh> tools) {
  if (tools.size() == 1) return subtractStubborn(host, tools[0]);
  if (auto cut = byKernel(host, tools); cut && (!hasFlaps(*cut) || hasFlaps(host))) return cut;
  auto first = subtractGeneral(host, tools.first(tools.size() / 2));
  return first ? subtractGeneral(*first, tools.subspan(tools.size() / 2)) : first;
}

}  // namespace

Result<geometry::PolyMesh> subtractTools(const geometry::PolyMesh& host, std::span<const geometry::PolyMesh> tools) {
  std::vector<geometry::PolyMesh> general;
  geometry::PolyMesh left = subtractSimple(host, tools, general);
  if (hasFlaps(left) && !hasFlaps(host)) {  // a side that rounding put a hair inside of the host's
    std::vector<geometry::PolyMesh> larger, general_of_larger;
    for (const auto& tool : tools) larger.push_back(grown(tool, 2e-5));
    geometry::PolyMesh without = subtractSimple(host, larger, general_of_larger);
    if (!tore(host, without) && !hasFlaps(without)) left = std::move(without), general = std::move(general_of_larger);
  }
  return general.empty() ? left : subtractGeneral(left, general);
}

}  // namespace standpoint::ifc
