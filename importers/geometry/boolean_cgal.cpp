// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <exception>
#include <optional>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>

#include "importers/geometry/boolean_ways.h"
#include "importers/geometry/polygon.h"

namespace standpoint::geometry {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

constexpr std::size_t kMaxTriangles = 50000;  // exact numbers: beyond this, minutes

std::optional<Surface> toSurface(const PolyMesh& mesh) {
  const TriangulatedMesh triangles = triangulate(mesh);
  if (triangles.failed_faces > 0 || triangles.triangles.size() > kMaxTriangles) return std::nullopt;
  const std::vector<std::uint32_t> map = weldMap(triangles.points, kSnap_m);
  std::vector<Kernel::Point_3> points;
  std::vector<std::size_t> to(map.size());
  for (std::size_t i = 0; i < map.size(); ++i) {
    to[i] = map[i] == i ? points.size() : to[map[i]];
    const Eigen::Vector3d& p = triangles.points[i];
    if (map[i] == i) points.emplace_back(p.x(), p.y(), p.z());
  }
  std::vector<std::vector<std::size_t>> polygons;
  for (const Triangle& t : triangles.triangles) {
    const std::size_t a = to[t[0]], b = to[t[1]], c = to[t[2]];
    if (a != b && b != c && c != a) polygons.push_back({a, b, c});
  }
  if (!pmp::is_polygon_soup_a_polygon_mesh(polygons) && !pmp::orient_polygon_soup(points, polygons))
    return std::nullopt;
  Surface surface;
  pmp::polygon_soup_to_polygon_mesh(points, polygons, surface);
  if (!CGAL::is_closed(surface) || !pmp::does_bound_a_volume(surface)) return std::nullopt;
  return surface;
}

PolyMesh fromSurface(const Surface& surface, std::uint32_t tag) {
  PolyMesh mesh;
  std::vector<std::uint32_t> to(surface.number_of_vertices() + surface.number_of_removed_vertices());
  for (const auto v : surface.vertices()) {
    to[v] = static_cast<std::uint32_t>(mesh.points.size());
    const auto& p = surface.point(v);
    mesh.points.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
  }
  for (const auto f : surface.faces()) {
    Face face{{}, {}, tag};
    for (const auto v : surface.vertices_around_face(surface.halfedge(f))) face.outer.push_back(to[v]);
    mesh.faces.push_back(std::move(face));
  }
  return mesh;
}

#if CGAL_VERSION_NR >= 1060000000
using Output = std::optional<Surface*>;
#else
using Output = boost::optional<Surface*>;
#endif

// One call for all operations: CGAL's three functions would be compiled for types of their own, a minute more.
bool combine(Surface& a, Surface& b, Operation operation, Surface& out) {
  const auto index = [&]() -> std::size_t {
    switch (operation) {
      case Operation::difference: return pmp::Corefinement::TM1_MINUS_TM2;
      case Operation::intersection: return pmp::Corefinement::INTERSECTION;
      case Operation::unite: break;
    }
    return pmp::Corefinement::UNION;
  }();
  std::array<Output, 4> outputs;
  outputs[index] = &out;
  return pmp::corefine_and_compute_boolean_operations(a, b, outputs,
                                                      CGAL::parameters::throw_on_self_intersection(true))[index];
}

}  // namespace

Result<PolyMesh> combineWithCgal(const PolyMesh& a, std::span<const PolyMesh> b, Operation operation) {
  try {
    std::optional<Surface> first = toSurface(a);
    if (!first) return failure(ErrorKind::unusable, "CGAL: a body does not bound a volume");
    std::optional<Surface> tools;
    for (const PolyMesh& tool : b) {  // all tools in one: subtracting one by one multiplies triangles
      std::optional<Surface> next = toSurface(tool);
      if (!next) return failure(ErrorKind::unusable, "CGAL: a tool does not bound a volume");
      if (!tools) {
        tools = std::move(next);
        continue;
      }
      Surface joined;
      if (!combine(*tools, *next, Operation::unite, joined))
        return failure(ErrorKind::unusable, "CGAL: cannot unite the tools");
      tools = std::move(joined);
    }
    if (!tools) return a;
    Surface result;
    if (!combine(*first, *tools, operation, result))
      return failure(ErrorKind::unusable, "CGAL: the result is not manifold");
    return fromSurface(result, a.faces.empty() ? 0 : a.faces[0].tag);
  } catch (const std::exception& e) {
    return failure(ErrorKind::unusable, std::string("CGAL: ") + e.what());
  }
}

}  // namespace standpoint::geometry
