// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "importers/ifc/model/style.h"
#include "importers/ifc/shapes/curve.h"
#include "importers/ifc/shapes/faceted.h"
#include "importers/ifc/shapes/solid.h"

namespace standpoint::ifc {
namespace {

// Indices count from 1, and an IFC4 face set may send them through PnIndex first.
class Indices {
 public:
  Indices(const Value& pn_index, std::size_t count) : count_(count) {
    for (const Value v : pn_index) through_.push_back(v.integer());
  }
  // The list's points, or nothing when one of them does not exist.
  bool read(const Value& list, std::vector<std::uint32_t>& out) const {
    out.clear();
    for (const Value v : list) {
      auto i = v.integer();
      if (!through_.empty())
        i = i >= 1 && i <= static_cast<std::int64_t>(through_.size()) ? through_[static_cast<std::size_t>(i - 1)] : 0;
      if (i < 1 || i > static_cast<std::int64_t>(count_)) return false;
      if (out.empty() || out.back() != i - 1) out.push_back(static_cast<std::uint32_t>(i - 1));
    }
    while (out.size() > 1 && out.front() == out.back()) out.pop_back();
    return true;
  }

 private:
  std::vector<std::int64_t> through_;
  std::size_t count_;
};

Result<geometry::PolyMesh> finished(const Entity& entity, geometry::PolyMesh mesh, std::size_t bad, Scope& scope) {
  if (bad > 0) scope.report.lose(entity.place(), std::to_string(bad) + " faces refer to points outside the list");
  if (mesh.faces.empty()) return fail(entity, "the face set has no valid face");
  orient(mesh, entity[entity.is("IFCPOLYGONALFACESET") ? 1 : 2].symbol() == "T", scope);
  return mesh;
}

}  // namespace

// In the first release of IFC4 a triangulated face set had NormalIndex in its place: a list for each triangle.
Value pnIndex(const Entity& face_set) {
  const Value last = face_set[face_set.is("IFCPOLYGONALFACESET") ? 3 : 4];
  const auto first = last.begin();
  return first != last.end() && (*first).isList() ? Value() : last;
}

Result<geometry::PolyMesh> triangulatedFaceSet(const Entity& entity, Scope& scope) {
  geometry::PolyMesh mesh;
  mesh.points = pointList(entity.ref(0), scope);
  if (!scope.spend(mesh.points.size())) return fail(entity, "too many points");
  const Indices indices(pnIndex(entity), mesh.points.size());
  const FaceColours colours(entity, scope.model);
  std::size_t bad = 0, number = 0;
  const Value rows = entity[3];
  for (const Value row : rows) {
    geometry::Face face;
    face.tag = colours.tag(number++);
    if (!indices.read(row, face.outer))
      ++bad;
    else if (face.outer.size() == 3)
      mesh.faces.push_back(std::move(face));
  }
  return finished(entity, std::move(mesh), bad, scope);
}

Result<geometry::PolyMesh> polygonalFaceSet(const Entity& entity, Scope& scope) {
  geometry::PolyMesh mesh;
  mesh.points = pointList(entity.ref(0), scope);
  if (!scope.spend(mesh.points.size())) return fail(entity, "too many points");
  const Indices indices(pnIndex(entity), mesh.points.size());
  const FaceColours colours(entity, scope.model);
  std::size_t bad = 0, number = 0;
  const Value faces = entity[2];
  for (const Value v : faces) {
    geometry::Face face;
    face.tag = colours.tag(number++);
    const Entity polygon = entity.follow(v);
    if (!polygon || !indices.read(polygon[0], face.outer)) {
      ++bad;
      continue;
    }
    if (polygon.is("IFCINDEXEDPOLYGONALFACEWITHVOIDS")) {
      const Value inner = polygon[1];
      for (const Value loop : inner) {
        std::vector<std::uint32_t> hole;
        if (indices.read(loop, hole) && hole.size() >= 3) face.holes.push_back(std::move(hole));
      }
    }
    if (face.outer.size() >= 3) mesh.faces.push_back(std::move(face));
  }
  return finished(entity, std::move(mesh), bad, scope);
}

}  // namespace standpoint::ifc
