// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>

#include <Eigen/Geometry>

#include "importers/ifc/model/model.h"

namespace standpoint::ifc {

// What cannot be read in these is noted as Scope::misread and stands for 0, or for what the attribute is by default.
Eigen::Vector3d cartesianPoint(const Entity& point, Scope& scope);  // metres; missing coordinates are 0
Eigen::Vector3d direction(const Entity& direction, const Eigen::Vector3d& otherwise, Scope& scope);  // unit
// Of IfcAxis2Placement2D and 3D; the null entity is the identity.
Eigen::Isometry3d axisPlacement(const Entity& placement, Scope& scope);
struct Axis {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
};
Axis axis1Placement(const Entity& placement, Scope& scope);
// Of IfcCartesianTransformationOperator2D, 3D and their non-uniform kin; may mirror.
Eigen::Affine3d transformationOperator(const Entity& entity, Scope& scope);
// (x axis, z axis) → right-handed frame at `origin`, whatever the input.
Eigen::Isometry3d frame(const Eigen::Vector3d& origin, const Eigen::Vector3d& z, const Eigen::Vector3d& x);

constexpr double kFarthest_m = 1e15;  // what is farther from its origin than that cannot be meant
bool isNear(const Eigen::Vector3d& p);

// Chains of IfcLocalPlacement (and grid and linear placements) to the file frame, each evaluated once. What cannot be
// read, leads in a circle or out of all bounds is a loss, and stands where its parent does.
class Placements {
 public:
  explicit Placements(const Model& model) : model_(model) {}
  Eigen::Isometry3d world(const Entity& object_placement, Report& report);
  // The placement in the chain, from a known one to the file frame, that was lost; 0: all of it holds.
  Id lost(const Entity& object_placement) const;

 private:
  struct Known {
    Eigen::Isometry3d world = Eigen::Isometry3d::Identity();
    Id lost = 0;
  };
  Result<Eigen::Isometry3d> own(const Entity& placement, Report& report) const;
  const Model& model_;
  std::map<Id, Known> known_;
};

}  // namespace standpoint::ifc
