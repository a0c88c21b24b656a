// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/shapes/faceted.h"

#include <algorithm>

#include "importers/ifc/shapes/curve.h"
#include "importers/ifc/shapes/placement.h"
#include "importers/ifc/shapes/solid.h"

namespace standpoint::ifc {
namespace {

// Shells share their points by entity: one lookup instead of a search by coordinates.
class PointPool {
 public:
  PointPool(geometry::PolyMesh& mesh, Scope& scope) : mesh_(mesh), scope_(scope) {}
  std::uint32_t index(const Entity& point) {
    const auto [it, is_new] = index_of_.try_emplace(point.id(), static_cast<std::uint32_t>(mesh_.points.size()));
    if (is_new) mesh_.points.push_back(cartesianPoint(point, scope_));
    return it->second;
  }
  std::uint32_t add(const Eigen::Vector3d& p) {
    mesh_.points.push_back(p);
    return static_cast<std::uint32_t>(mesh_.points.size() - 1);
  }

 private:
  geometry::PolyMesh& mesh_;
  Scope& scope_;
  std::unordered_map<Id, std::uint32_t> index_of_;  // for look-up only
};

void dropRepeated(std::vector<std::uint32_t>& loop) {
  loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
  while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
}

Result<std::vector<std::uint32_t>> boundLoop(const Entity& bound, PointPool& pool, Scope& scope) {
  const Entity loop = bound.ref(0);
  std::vector<std::uint32_t> indices;
  if (loop.is("IFCPOLYLOOP")) {
    const Value points = loop[0];
    for (const Value v : points)
      if (const Entity p = loop.follow(v))
        indices.push_back(pool.index(p));
      else
        scope.misread(loop, "refers to " + notInFile(v));
  } else {
    TRY_ASSIGN(const auto points, loopPoints(loop, scope));
    for (const auto& p : points) indices.push_back(pool.add(p));
  }
  dropRepeated(indices);
  if (bound[1].symbol() == "F") std::reverse(indices.begin(), indices.end());
  if (!scope.spend(indices.size() + 1)) return fail(bound, "too many points");
  return indices;
}

double loopArea(const geometry::PolyMesh& mesh, const std::vector<std::uint32_t>& loop) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    sum += (mesh.points[loop[i]] - mesh.points[loop[0]]).cross(mesh.points[loop[i + 1]] - mesh.points[loop[0]]);
  return sum.norm() / 2;
}

Result<void> appendFace(geometry::PolyMesh& mesh, const Entity& face, PointPool& pool, Scope& scope) {
  std::vector<std::vector<std::uint32_t>> loops;
  std::size_t outer = 0;
  bool named = false;
  for (const Entity& bound : face.refs(0)) {
    TRY_ASSIGN(auto loop, boundLoop(bound, pool, scope));
    if (loop.size() < 3) continue;
    if (bound.is("IFCFACEOUTERBOUND") && !named) outer = loops.size(), named = true;
    loops.push_back(std::move(loop));
  }
  if (loops.empty()) return {};  // a face without area is no loss
  if (!named)
    for (std::size_t i = 1; i < loops.size(); ++i)
      if (loopArea(mesh, loops[i]) > loopArea(mesh, loops[outer])) outer = i;
  std::swap(loops[0], loops[outer]);
  geometry::Face f;
  f.tag = scope.model.style_of_item[scope.model.file.indexOf(face)];  // a face may be styled by itself
  f.outer = std::move(loops[0]);
  f.holes.assign(std::make_move_iterator(loops.begin() + 1), std::make_move_iterator(loops.end()));
  if (face.is("IFCADVANCEDFACE") || face.is("IFCFACESURFACE"))
    if (face[2].symbol() == "F") {
      std::reverse(f.outer.begin(), f.outer.end());
      for (auto& hole : f.holes) std::reverse(hole.begin(), hole.end());
    }
  mesh.faces.push_back(std::move(f));
  return {};
}

bool isCurved(const Entity& face) {
  if (!face.is("IFCADVANCEDFACE") && !face.is("IFCFACESURFACE")) return false;
  Entity surface_entity = face.ref(1);
  // A trimmed or bounded surface is as curved as its basis; the face has bounds of its own.
  for (int depth = 0; depth < 4 && (surface_entity.is("IFCRECTANGULARTRIMMEDSURFACE") ||
                                    surface_entity.typeName().starts_with("IFCCURVEBOUNDED"));
       ++depth)
    surface_entity = surface_entity.ref(0);
  return surface_entity && !surface_entity.is("IFCPLANE");
}

// Of faces over the same points in the same direction one is enough. Gives how many went.
std::size_t dropRepeatedFaces(geometry::PolyMesh& mesh) {
  std::vector<std::pair<std::vector<std::uint32_t>, std::size_t>> known;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    if (!mesh.faces[i].holes.empty()) continue;
    known.emplace_back(mesh.faces[i].outer, i);
    auto& loop = known.back().first;
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  }
  std::sort(known.begin(), known.end());
  std::vector<char> gone(mesh.faces.size(), 0);
  for (std::size_t i = 1; i < known.size(); ++i)
    if (known[i].first == known[i - 1].first) gone[known[i].second] = 1;
  std::size_t i = 0;
  return std::erase_if(mesh.faces, [&](const geometry::Face&) { return gone[i++] != 0; });
}

std::size_t branchingEdges(const geometry::PolyMesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  const auto walk = [&](const std::vector<std::uint32_t>& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) edges.push_back(std::minmax(loop[i], loop[(i + 1) % loop.size()]));
  };
  for (const auto& face : mesh.faces) {
    walk(face.outer);
    for (const auto& hole : face.holes) walk(hole);
  }
  std::sort(edges.begin(), edges.end());
  std::size_t found = 0;
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    while (end < edges.size() && edges[end] == edges[i]) ++end;
    found += end - i > 2 ? 1 : 0;
  }
  return found;
}

void flip(geometry::PolyMesh& mesh) {
  for (auto& face : mesh.faces) {
    std::reverse(face.outer.begin(), face.outer.end());
    for (auto& hole : face.holes) std::reverse(hole.begin(), hole.end());
  }
}

}  // namespace

void orient(geometry::PolyMesh& shell, bool should_be_closed, Scope& scope) {
  Repairs& repairs = scope.repairs;
  repairs.duplicate += dropRepeatedFaces(shell);
  const bool was_closed = geometry::isClosed(shell);
  const bool inverted = was_closed && geometry::volume(shell) < 0;
  repairs.inverted += inverted ? 1 : 0;
  geometry::PolyMesh oriented = shell;
  geometry::orientOutward(oriented);
  const std::size_t dropped = shell.faces.size() - oriented.faces.size();
  const bool is_closed = dropped == 0 && was_closed ? true : geometry::isClosed(oriented);
  if (dropped > 0 && was_closed && !is_closed) {
    if (inverted) flip(shell);
    return;
  }
  repairs.degenerate += dropped;
  repairs.disagreeing += !was_closed && is_closed ? 1 : 0;
  repairs.open += should_be_closed && !is_closed ? 1 : 0;
  if (!is_closed) repairs.branching += branchingEdges(oriented);
  shell = std::move(oriented);
}

Result<void> appendShell(geometry::PolyMesh& mesh, const Entity& shell, Scope& scope) {
  if (!shell) return failure(ErrorKind::unusable, "a shell is missing", shell.place());
  PointPool pool(mesh, scope);
  std::size_t failed = 0;
  std::string why;
  const Value faces = shell[0];
  for (const Value v : faces) {
    const Entity face = shell.follow(v);
    if (!face) continue;
    const auto done = isCurved(face) ? appendCurvedFace(mesh, face, scope) : appendFace(mesh, face, pool, scope);
    if (!done && failed++ == 0) why = describe(done.error());
  }
  if (failed > 0) scope.report.lose(shell.place(), std::to_string(failed) + " faces were skipped; the first: " + why);
  return {};
}

Result<geometry::PolyMesh> facetedBrep(const Entity& entity, Scope& scope) {
  geometry::PolyMesh mesh;
  TRY(appendShell(mesh, entity.ref(0), scope));
  orient(mesh, true, scope);
  if (entity.typeName().ends_with("WITHVOIDS"))
    for (const Entity& shell : entity.refs(1)) {
      geometry::PolyMesh cavity;
      TRY(appendShell(cavity, shell, scope));
      orient(cavity, true, scope);
      flip(cavity);
      geometry::append(mesh, cavity);
    }
  if (mesh.faces.empty()) return fail(entity, "the shell has no valid face");
  return mesh;
}

Result<geometry::PolyMesh> surfaceModel(const Entity& entity, Scope& scope) {
  geometry::PolyMesh mesh;
  for (const Entity& shell : entity.refs(0)) {
    geometry::PolyMesh part;
    TRY(appendShell(part, shell, scope));
    orient(part, shell.is("IFCCLOSEDSHELL"), scope);
    geometry::append(mesh, part);
  }
  if (mesh.faces.empty()) return fail(entity, "the surface model has no valid face");
  return mesh;
}

Result<geometry::PolyMesh> faceItem(const Entity& entity, Scope& scope) {
  geometry::PolyMesh mesh;
  PointPool pool(mesh, scope);
  TRY(isCurved(entity) ? appendCurvedFace(mesh, entity, scope) : appendFace(mesh, entity, pool, scope));
  if (mesh.faces.empty()) return fail(entity, "the face has no area");
  return mesh;
}

Result<geometry::PolyMesh> faceSetItem(const Entity& entity, Scope& scope) {
  geometry::PolyMesh mesh;
  TRY(appendShell(mesh, entity, scope));
  orient(mesh, entity.is("IFCCLOSEDSHELL"), scope);
  if (mesh.faces.empty()) return fail(entity, "the shell has no valid face");
  return mesh;
}

}  // namespace standpoint::ifc
