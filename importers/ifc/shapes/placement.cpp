// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/shapes/placement.h"

#include <algorithm>
#include <string>

#include "importers/ifc/shapes/alignment.h"
#include "importers/ifc/shapes/grid.h"

namespace standpoint::ifc {
namespace {

Eigen::Vector3d triple(const Value& list, double otherwise = 0) {
  Eigen::Vector3d v = Eigen::Vector3d::Constant(otherwise);
  int i = 0;
  for (auto it = list.begin(); it != list.end() && i < 3; ++it, ++i) v[i] = (*it).number(otherwise);
  for (; i < 3; ++i) v[i] = 0;
  return v;
}

// The schemas disagree on whether a grid placement has a parent; an argument that is a placement is one.
Entity parentPlacement(const Entity& placement) {
  const Entity first = placement.ref(0);
  const std::string_view name = first.typeName();
  return name == "IFCLOCALPLACEMENT" || name == "IFCGRIDPLACEMENT" || name == "IFCLINEARPLACEMENT" ? first : Entity();
}

}  // namespace

Eigen::Vector3d cartesianPoint(const Entity& point, const Scope& scope) {
  return point ? Eigen::Vector3d(triple(point[0]) * scope.model.units.length_m)
               : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

Eigen::Vector3d direction(const Entity& entity, const Eigen::Vector3d& otherwise) {
  if (!entity) return otherwise;
  const Eigen::Vector3d v = triple(entity[0]);
  const double length = v.norm();
  return length > 1e-12 ? Eigen::Vector3d(v / length) : otherwise;
}

Eigen::Isometry3d frame(const Eigen::Vector3d& origin, const Eigen::Vector3d& z, const Eigen::Vector3d& x) {
  Eigen::Vector3d flat = x - x.dot(z) * z;
  if (flat.norm() < 1e-9)
    flat = std::abs(z.x()) < 0.9 ? Eigen::Vector3d(Eigen::Vector3d::UnitX() - z.x() * z) : z.unitOrthogonal();
  flat.normalize();
  Eigen::Isometry3d f = Eigen::Isometry3d::Identity();
  f.linear().col(0) = flat;
  f.linear().col(1) = z.cross(flat);
  f.linear().col(2) = z;
  f.translation() = origin;
  return f;
}

Eigen::Isometry3d axisPlacement(const Entity& placement, const Scope& scope) {
  if (!placement) return Eigen::Isometry3d::Identity();
  const Eigen::Vector3d origin = cartesianPoint(placement.ref(0), scope);
  if (placement.is("IFCAXIS2PLACEMENT2D"))
    return frame(origin, Eigen::Vector3d::UnitZ(), direction(placement.ref(1), Eigen::Vector3d::UnitX()));
  return frame(origin, direction(placement.ref(1), Eigen::Vector3d::UnitZ()),
               direction(placement.ref(2), Eigen::Vector3d::UnitX()));
}

Axis axis1Placement(const Entity& placement, const Scope& scope) {
  return {cartesianPoint(placement.ref(0), scope), direction(placement.ref(1), Eigen::Vector3d::UnitZ())};
}

Eigen::Affine3d transformationOperator(const Entity& e, const Scope& scope) {
  Eigen::Affine3d t = Eigen::Affine3d::Identity();
  if (!e) return t;
  const bool flat = e.typeName().find("2D") != std::string_view::npos;
  const double scale = e[3].number(1);
  const Eigen::Vector3d z = flat ? Eigen::Vector3d::UnitZ() : direction(e.ref(4), Eigen::Vector3d::UnitZ());
  const Eigen::Isometry3d f = frame(Eigen::Vector3d::Zero(), z, direction(e.ref(0), Eigen::Vector3d::UnitX()));
  // Axis2 is only asked on which side it lies: that is how a mirrored operator is written (IfcBaseAxis).
  const Eigen::Vector3d y = direction(e.ref(1), f.linear().col(1));
  const double side = y.dot(f.linear().col(1)) < 0 ? -1 : 1;
  const bool non_uniform = e.typeName().ends_with("NONUNIFORM");
  const double scale2 = non_uniform ? e[flat ? 4 : 5].number(scale) : scale;
  const double scale3 = non_uniform && !flat ? e[6].number(scale) : scale;
  t.linear().col(0) = f.linear().col(0) * scale;
  t.linear().col(1) = f.linear().col(1) * (scale2 * side);
  t.linear().col(2) = f.linear().col(2) * (flat ? 1.0 : scale3);
  t.translation() = cartesianPoint(e.ref(2), scope);
  return t;
}

Eigen::Isometry3d Placements::own(const Entity& placement, Report& report) const {
  Scope scope(model_);
  if (placement.is("IFCLOCALPLACEMENT")) return axisPlacement(placement.ref(1), scope);
  if (!placement.is("IFCLINEARPLACEMENT") && !placement.is("IFCGRIDPLACEMENT"))
    return report.lose(placement.place(),
                       std::string(placement.typeName()) +
                           " is not supported: its products are placed at the origin of their parent"),
           Eigen::Isometry3d::Identity();
  const auto found =
      placement.is("IFCGRIDPLACEMENT") ? gridPlacement(placement, scope) : linearPlacement(placement, scope);
  if (found) return *found;
  report.lose(found.error().source, found.error().message + "; its products are placed at the origin of their parent");
  return Eigen::Isometry3d::Identity();
}

Eigen::Isometry3d Placements::world(const Entity& object_placement, Report& report) {
  std::vector<Entity> chain;
  std::vector<Id> seen;
  Eigen::Isometry3d world = Eigen::Isometry3d::Identity();
  for (Entity e = object_placement; e; e = parentPlacement(e)) {
    if (const auto it = known_.find(e.id()); it != known_.end()) {
      world = it->second;
      break;
    }
    if (std::find(seen.begin(), seen.end(), e.id()) != seen.end() || chain.size() > 1000) {
      report.warn(e.place(), "circular reference between placements; cut here");
      break;
    }
    seen.push_back(e.id());
    chain.push_back(e);
  }
  for (auto it = chain.rbegin(); it != chain.rend(); ++it) {
    world = world * own(*it, report);
    known_.emplace(it->id(), world);
  }
  return world;
}

}  // namespace standpoint::ifc
