// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <span>

#include "importers/ifc/shapes/convex_cut.h"
#include "importers/ifc/shapes/curve.h"
#include "importers/ifc/shapes/placement.h"
#include "importers/ifc/shapes/seams.h"
#include "importers/ifc/shapes/solid.h"

namespace standpoint::ifc {
namespace {

// Material where n·p <= offset.
struct HalfSpace {
  Eigen::Vector3d normal;
  double offset;
};

bool isHalfSpace(const Entity& e) {
  return e.is("IFCHALFSPACESOLID") || e.is("IFCBOXEDHALFSPACE") || e.is("IFCPOLYGONALBOUNDEDHALFSPACE");
}

Result<HalfSpace> halfSpace(const Entity& entity, Scope& scope) {
  const Entity plane = entity.ref(0);
  if (!plane.is("IFCPLANE"))
    return fail(entity,
                "a half-space with a non-planar surface (" + std::string(plane.typeName()) + ") is not supported");
  const Eigen::Isometry3d f = axisPlacement(plane.ref(0), scope);
  const double side = entity[1].symbol() == "F" ? -1 : 1;
  const Eigen::Vector3d n = f.linear().col(2) * side;
  return HalfSpace{n, n.dot(f.translation())};
}

struct PlanBox {  // the host in the frame of a bounded half-space
  Eigen::AlignedBox2d plan;
  double low = 1e300, high = -1e300;
};

PlanBox planBox(const geometry::PolyMesh& host, const Eigen::Isometry3d& to_position) {
  PlanBox box;
  for (const auto& p : host.points) {
    const Eigen::Vector3d q = to_position * p;
    box.plan.extend(Eigen::Vector2d(q.head<2>()));
    box.low = std::min(box.low, q.z());
    box.high = std::max(box.high, q.z());
  }
  return box;
}

constexpr double kMargin_m = 0.1;  // so that no side of a tool that we made up lies on a face of the host

geometry::Region2 around(const Eigen::AlignedBox2d& box) {
  const Eigen::Vector2d lo = box.min().array() - kMargin_m, hi = box.max().array() + kMargin_m;
  return {{lo, {hi.x(), lo.y()}, hi, {lo.x(), hi.y()}}, {}};
}

Result<geometry::Region2> boundary(const Entity& entity, Scope& scope) {
  TRY_ASSIGN(const auto path, curve(entity.ref(3), scope));
  geometry::Region2 region{loop2(path), {}};
  geometry::normalise(region);
  if (region.outer.size() < 3) return fail(entity, "the boundary of the half-space encloses no area");
  return region;
}

enum class Reach { nothing, part, all };

// How much of the host's surroundings the boundary covers. Only asked, never used as the tool: the intersection moves
// corners by less than a micrometre, and tools that shared an edge would leave a fin between them.
Reach reachOf(const geometry::Region2& region, const PlanBox& box) {
  const geometry::Region2 surroundings = around(box.plan);
  const auto common = geometry::intersection(std::span(&region, 1), std::span(&surroundings, 1));
  if (!common) return Reach::part;
  double area = 0;
  for (const auto& r : *common) area += geometry::area(r);
  if (area <= 1e-12) return Reach::nothing;
  return area >= geometry::area(surroundings) * (1 - 1e-9) ? Reach::all : Reach::part;
}

Result<geometry::PolyMesh> prismTool(const geometry::Region2& region, const Eigen::Isometry3d& position,
                                     const PlanBox& box, const HalfSpace& half) {
  geometry::PolyMesh prism = geometry::extrude(region, Eigen::Vector3d::UnitZ(), box.high - box.low + 2 * kMargin_m);
  geometry::transform(prism, Eigen::Affine3d(position * Eigen::Translation3d(0, 0, box.low - kMargin_m)));
  return geometry::clip(prism, half.normal, half.offset);
}

// The triangles of a region: convex parts of it.
Regions trianglesOf(const geometry::Region2& region) {
  geometry::PolyMesh flat;
  geometry::Face face;
  const auto add = [&](const geometry::Loop2& loop, std::vector<std::uint32_t>& indices) {
    for (const auto& p : loop)
      indices.push_back(static_cast<std::uint32_t>(flat.points.size())), flat.points.emplace_back(p.x(), p.y(), 0);
  };
  add(region.outer, face.outer);
  for (const auto& hole : region.holes) add(hole, face.holes.emplace_back());
  std::vector<Triangle> triangles;
  Regions parts;
  if (!geometry::triangulate(flat.points, face, triangles)) return parts;
  for (const Triangle& t : triangles)
    parts.push_back({{flat.points[t[0]].head<2>(), flat.points[t[1]].head<2>(), flat.points[t[2]].head<2>()}, {}});
  return parts;
}

// A boundary that is not convex is taken away triangle by triangle; neighbours share their planes and leave nothing
// between.
Result<geometry::PolyMesh> withoutTriangles(const geometry::PolyMesh& host, const geometry::Region2& region,
                                            const Eigen::Isometry3d& position, const PlanBox& box,
                                            const HalfSpace& half) {
  const Regions triangles = trianglesOf(region);
  if (triangles.empty()) return failure(ErrorKind::unusable, "cannot triangulate the boundary");
  geometry::PolyMesh left = host;
  for (const auto& triangle : triangles) {
    const auto tool = prismTool(triangle, position, box, half);
    if (!tool) return tool;
    if (tool->faces.empty()) continue;
    auto next = subtractSimpleTools(left, std::span(&*tool, 1));
    if (!next) return next;
    left = std::move(*next);
  }
  return left;
}

Result<geometry::PolyMesh> withoutPrism(const geometry::PolyMesh& host, const geometry::Region2& region,
                                        const Eigen::Isometry3d& position, const PlanBox& box, const HalfSpace& half) {
  const auto tool = prismTool(region, position, box, half);
  if (!tool) return tool;
  if (tool->faces.empty()) return host;
  if (auto whole = subtractSimpleTools(host, std::span(&*tool, 1))) return whole;
  if (auto parts = withoutTriangles(host, region, position, box, half)) return parts;
  return subtractTools(host, std::span(&*tool, 1));
}

Result<geometry::PolyMesh> withBoundedHalfSpace(const geometry::PolyMesh& host, bool keep_inside, const Entity& entity,
                                                const HalfSpace& half, Scope& scope) {
  const Eigen::Isometry3d position = axisPlacement(entity.ref(2), scope);
  const PlanBox box = planBox(host, position.inverse());
  TRY_ASSIGN(const auto region, boundary(entity, scope));
  const Reach reach = reachOf(region, box);
  if (reach == Reach::nothing) return keep_inside ? geometry::PolyMesh() : host;
  if (reach == Reach::all)
    return keep_inside ? clipSnapped(host, half.normal, half.offset) : clipSnapped(host, -half.normal, -half.offset);
  if (!keep_inside) return withoutPrism(host, region, position, box, half);
  const auto tool = prismTool(region, position, box, half);
  return tool ? geometry::intersect(host, *tool) : tool;
}

Result<geometry::PolyMesh> withHalfSpace(const geometry::PolyMesh& host, std::string_view operation,
                                         const Entity& entity, Scope& scope) {
  TRY_ASSIGN(const auto half, halfSpace(entity, scope));
  if (operation == "UNION") return fail(entity, "the union with an unbounded half-space is unbounded");
  const bool keep_inside = operation == "INTERSECTION";
  if (entity.is("IFCPOLYGONALBOUNDEDHALFSPACE") && !host.faces.empty())
    return withBoundedHalfSpace(host, keep_inside, entity, half, scope);
  return keep_inside ? clipSnapped(host, half.normal, half.offset) : clipSnapped(host, -half.normal, -half.offset);
}

struct Step {
  Entity result;
  std::string_view operation;
  Entity operand;
};

Result<geometry::PolyMesh> apply(const geometry::PolyMesh& host, const Step& step, Scope& scope) {
  if (isHalfSpace(step.operand)) return withHalfSpace(host, step.operation, step.operand, scope);
  auto other = item(step.operand, scope);
  if (!other) return other;
  if (step.operation == "DIFFERENCE") return subtractTools(host, std::span(&*other, 1));
  if (step.operation == "INTERSECTION") return geometry::intersect(host, *other);
  if (step.operation == "UNION") return geometry::unite(host, *other);
  return fail(step.result, "an operation " + std::string(step.operation) + " does not exist");
}

}  // namespace

// Clippings nest to the left, often dozens deep: the chain is walked down first, then applied from the inside out.
Result<geometry::PolyMesh> booleanResult(const Entity& entity, Scope& scope) {
  std::vector<Step> chain;
  Entity base = entity;
  while (base.is("IFCBOOLEANRESULT") || base.is("IFCBOOLEANCLIPPINGRESULT")) {
    if (chain.size() > 5000) return fail(entity, "circular reference between Boolean operands");
    chain.push_back({base, base[0].symbol(), base.ref(2)});
    base = base.ref(1);
  }
  auto mesh = item(base, scope);
  if (!mesh) return mesh;
  for (auto step = chain.rbegin(); step != chain.rend(); ++step) {
    auto next = apply(*mesh, *step, scope);
    if (next)
      *mesh = std::move(*next);
    else
      scope.report.lose(step->result.place(),
                        "the Boolean operation failed; the body is unchanged: " + describe(next.error()));
  }
  return mesh;
}

}  // namespace standpoint::ifc
