// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/shapes/placement.h"

#include <cmath>
#include <set>
#include <string>

#include "importers/ifc/shapes/alignment.h"
#include "importers/ifc/shapes/grid.h"

namespace standpoint::ifc {
namespace {

Eigen::Vector3d triple(const Entity& entity, Scope& scope) {
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  const Value list = entity[0];
  int i = 0;
  for (auto it = list.begin(); it != list.end() && i < 3; ++it, ++i) v[i] = scope.number(*it, entity);
  if (!list.isList()) scope.misread(entity, std::string(entity.typeName()) + " has no list of numbers");
  return v;
}

// What the attribute refers to; null where it is not given.
Entity referred(const Entity& entity, std::size_t index, Scope& scope) {
  const Value value = entity[index];
  const Entity found = entity.follow(value);
  if (!found && value.isReference()) scope.misread(entity, "refers to " + notInFile(value));
  return found;
}

// The schemas disagree on whether a grid placement has a parent; an argument that is a placement is one.
Entity parentPlacement(const Entity& placement) {
  const Entity first = placement.ref(0);
  const std::string_view name = first.typeName();
  return name == "IFCLOCALPLACEMENT" || name == "IFCGRIDPLACEMENT" || name == "IFCLINEARPLACEMENT" ? first : Entity();
}

}  // namespace

Eigen::Vector3d cartesianPoint(const Entity& point, Scope& scope) {
  return point ? Eigen::Vector3d(triple(point, scope) * scope.model.units.length_m)
               : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

Eigen::Vector3d direction(const Entity& entity, const Eigen::Vector3d& otherwise, Scope& scope) {
  if (!entity) return otherwise;
  Eigen::Vector3d v = triple(entity, scope);
  if (!std::isfinite(v.squaredNorm())) v /= v.cwiseAbs().maxCoeff();
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

Eigen::Isometry3d axisPlacement(const Entity& placement, Scope& scope) {
  if (!placement) return Eigen::Isometry3d::Identity();
  const auto axis = [&](std::size_t index, const Eigen::Vector3d& otherwise) {
    return direction(referred(placement, index, scope), otherwise, scope);
  };
  const Eigen::Vector3d origin = cartesianPoint(referred(placement, 0, scope), scope);
  if (placement.is("IFCAXIS2PLACEMENT2D"))
    return frame(origin, Eigen::Vector3d::UnitZ(), axis(1, Eigen::Vector3d::UnitX()));
  return frame(origin, axis(1, Eigen::Vector3d::UnitZ()), axis(2, Eigen::Vector3d::UnitX()));
}

Axis axis1Placement(const Entity& placement, Scope& scope) {
  return {cartesianPoint(referred(placement, 0, scope), scope),
          direction(referred(placement, 1, scope), Eigen::Vector3d::UnitZ(), scope)};
}

Eigen::Affine3d transformationOperator(const Entity& e, Scope& scope) {
  Eigen::Affine3d t = Eigen::Affine3d::Identity();
  if (!e) return t;
  const bool flat = e.typeName().find("2D") != std::string_view::npos;
  const auto axis = [&](std::size_t index, const Eigen::Vector3d& otherwise) {
    return direction(referred(e, index, scope), otherwise, scope);
  };
  const double scale = scope.number(e[3], e, 1);
  const Eigen::Vector3d z = flat ? Eigen::Vector3d::UnitZ() : axis(4, Eigen::Vector3d::UnitZ());
  const Eigen::Isometry3d f = frame(Eigen::Vector3d::Zero(), z, axis(0, Eigen::Vector3d::UnitX()));
  // Axis2 is only asked on which side it lies: that is how a mirrored operator is written (IfcBaseAxis).
  const Eigen::Vector3d y = axis(1, f.linear().col(1));
  const double side = y.dot(f.linear().col(1)) < 0 ? -1 : 1;
  const bool non_uniform = e.typeName().ends_with("NONUNIFORM");
  const double scale2 = non_uniform ? scope.number(e[flat ? 4 : 5], e, scale) : scale;
  const double scale3 = non_uniform && !flat ? scope.number(e[6], e, scale) : scale;
  t.linear().col(0) = f.linear().col(0) * scale;
  t.linear().col(1) = f.linear().col(1) * (scale2 * side);
  t.linear().col(2) = f.linear().col(2) * (flat ? 1.0 : scale3);
  t.translation() = cartesianPoint(referred(e, 2, scope), scope);
  return t;
}

bool isNear(const Eigen::Vector3d& p) { return p.allFinite() && p.cwiseAbs().maxCoeff() < kFarthest_m; }

Result<Eigen::Isometry3d> Placements::own(const Entity& placement, Report& report) const {
  Scope scope(model_);
  const auto found = [&]() -> Result<Eigen::Isometry3d> {
    if (placement.is("IFCLOCALPLACEMENT")) return axisPlacement(referred(placement, 1, scope), scope);
    if (placement.is("IFCGRIDPLACEMENT")) return gridPlacement(placement, scope);
    if (placement.is("IFCLINEARPLACEMENT")) return linearPlacement(placement, scope);
    return fail(placement, std::string(placement.typeName()) + " is not supported");
  }();
  report.append(scope.report);
  if (found && scope.unread) return failure(*scope.unread);
  return found;
}

Eigen::Isometry3d Placements::world(const Entity& object_placement, Report& report) {
  std::vector<Entity> chain;
  std::set<Id> seen;
  Known at;
  const auto lose = [&](const std::string& place, const std::string& why, Id placement) {
    report.lose(place, why + "; its products are placed at the origin of their parent");
    at.lost = placement;
  };
  for (Entity e = object_placement; e; e = parentPlacement(e)) {
    if (const auto it = known_.find(e.id()); it != known_.end()) {
      at = it->second;
      break;
    }
    if (!seen.insert(e.id()).second) {
      report.lose(e.place(), "circular reference between placements; cut here");
      at.lost = e.id();
      break;
    }
    chain.push_back(e);
    if (const Value parent = e[0]; parent.isReference() && !e.follow(parent))
      lose(e.place(), "is relative to " + notInFile(parent), e.id());
  }
  for (auto it = chain.rbegin(); it != chain.rend(); ++it) {
    const auto relative = own(*it, report);
    const Eigen::Isometry3d here = relative ? at.world * *relative : at.world;
    if (!relative)
      lose(relative.error().source.empty() ? it->place() : relative.error().source, relative.error().message, it->id());
    else if (!isNear(here.translation()))
      lose(it->place(), "is farther than 1e15 m from the origin", it->id());
    else
      at.world = here;
    known_.emplace(it->id(), at);
  }
  return at.world;
}

Id Placements::lost(const Entity& object_placement) const {
  const auto it = known_.find(object_placement.id());
  return it == known_.end() ? 0 : it->second.lost;
}

}  // namespace standpoint::ifc
