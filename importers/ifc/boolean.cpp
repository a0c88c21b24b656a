// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "importers/ifc/curve.h"
#include "importers/ifc/placement.h"
#include "importers/ifc/solid.h"

namespace standpoint::ifc {
namespace {

// Material where n·p <= offset.
struct HalfSpace {
  Eigen::Vector3d normal;
  double offset;
};

bool isHalfSpace(const Entity& e) { return e.is("IFCHALFSPACESOLID") || e.is("IFCBOXEDHALFSPACE") || e.is("IFCPOLYGONALBOUNDEDHALFSPACE"); }

Result<HalfSpace> halfSpace(const Entity& entity, const Scope& scope) {
  const Entity plane = entity.ref(0);
  if (!plane.is("IFCPLANE")) return fail(entity, "a half-space whose surface is no plane (" + std::string(plane.typeName()) + ") is not supported");
  const Eigen::Isometry3d f = axisPlacement(plane.ref(0), scope);
  const double side = entity[1].symbol() == "F" ? -1 : 1;
  const Eigen::Vector3d n = f.linear().col(2) * side;
  return HalfSpace{n, n.dot(f.translation())};
}

struct Extent {
  double low = 1e300, high = -1e300;
};

bool inside(const geometry::Loop2& loop, const Eigen::Vector2d& p) {
  bool in = false;
  for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++)
    if ((loop[i].y() > p.y()) != (loop[j].y() > p.y()) &&
        p.x() < (loop[j].x() - loop[i].x()) * (p.y() - loop[i].y()) / (loop[j].y() - loop[i].y()) + loop[i].x())
      in = !in;
  return in;
}

bool isConvex(const geometry::Loop2& loop) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Eigen::Vector2d a = loop[(i + 1) % loop.size()] - loop[i], b = loop[(i + 2) % loop.size()] - loop[(i + 1) % loop.size()];
    if (a.x() * b.y() - a.y() * b.x() < -1e-12) return false;
  }
  return true;
}

// The polygon of a bounded half-space as a prism that is long enough for this host, cut by the plane. Where the polygon
// holds all of the host, nothing, and the plane alone does it.
Result<std::optional<geometry::PolyMesh>> boundedTool(const Entity& entity, const HalfSpace& half, const geometry::PolyMesh& host, Scope& scope) {
  const Eigen::Isometry3d position = axisPlacement(entity.ref(2), scope);
  const auto path = curve(entity.ref(3), scope);
  if (!path) return failure(path.error());
  geometry::Region2 region{loop2(*path), {}};
  geometry::normalise(region);
  if (region.outer.size() < 3) return fail(entity, "the boundary of the half-space encloses nothing");
  Extent z;
  bool all_inside = isConvex(region.outer);
  const Eigen::Isometry3d to_position = position.inverse();
  for (const auto& p : host.points) {
    const Eigen::Vector3d q = to_position * p;
    z.low = std::min(z.low, q.z());
    z.high = std::max(z.high, q.z());
    all_inside = all_inside && inside(region.outer, q.head<2>());
  }
  if (all_inside) return std::optional<geometry::PolyMesh>();
  const double margin = 1 + 0.1 * (z.high - z.low);
  geometry::PolyMesh prism = geometry::extrude(region, Eigen::Vector3d::UnitZ(), z.high - z.low + 2 * margin);
  geometry::transform(prism, Eigen::Affine3d(position * Eigen::Translation3d(0, 0, z.low - margin)));
  auto cut = geometry::clip(prism, half.normal, half.offset);
  if (!cut) return failure(cut.error());
  return std::optional(std::move(*cut));
}

Result<geometry::PolyMesh> withHalfSpace(const geometry::PolyMesh& host, std::string_view operation, const Entity& entity, Scope& scope) {
  const auto half = halfSpace(entity, scope);
  if (!half) return failure(half.error());
  const bool keep_inside = operation == "INTERSECTION";
  if (operation == "UNION") return fail(entity, "the union with an unbounded half-space is unbounded");
  if (entity.is("IFCPOLYGONALBOUNDEDHALFSPACE")) {
    auto tool = boundedTool(entity, *half, host, scope);
    if (!tool) return failure(tool.error());
    if (*tool) {
      if ((*tool)->faces.empty()) return host;
      return keep_inside ? geometry::intersect(host, **tool) : geometry::subtract(host, std::span(&**tool, 1));
    }
  }
  return keep_inside ? geometry::clip(host, half->normal, half->offset) : geometry::clip(host, -half->normal, -half->offset);
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
  if (step.operation == "DIFFERENCE") return geometry::subtract(host, std::span(&*other, 1));
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
    if (chain.size() > 5000) return fail(entity, "the Boolean operands refer to each other in a circle");
    chain.push_back({base, base[0].symbol(), base.ref(2)});
    base = base.ref(1);
  }
  auto mesh = item(base, scope);
  if (!mesh) return mesh;
  for (auto step = chain.rbegin(); step != chain.rend(); ++step) {
    auto next = apply(*mesh, *step, scope);
    if (next) *mesh = std::move(*next);
    else scope.report.lose(step->result.place(), "the Boolean operation was not done, the body stays as it was: " + describe(next.error()));
  }
  return mesh;
}

}  // namespace standpoint::ifc
