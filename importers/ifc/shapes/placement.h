// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>

#include <Eigen/Geometry>

#include "importers/ifc/model/model.h"

namespace standpoint::ifc {

Eigen::Vector3d cartesianPoint(const Entity& point, const Scope& scope);  // metres; missing coordinates are 0
Eigen::Vector3d direction(const Entity& direction, const Eigen::Vector3d& otherwise);  // unit
// Of IfcAxis2Placement2D and 3D; the null entity is the identity.
Eigen::Isometry3d axisPlacement(const Entity& placement, const Scope& scope);
struct Axis {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
};
Axis axis1Placement(const Entity& placement, const Scope& scope);
// Of IfcCartesianTransformationOperator2D, 3D and their non-uniform kin; may mirror.
Eigen::Affine3d transformationOperator(const Entity& entity, const Scope& scope);
// (x axis, z axis) → right-handed frame at `origin`, whatever the input.
Eigen::Isometry3d frame(const Eigen::Vector3d& origin, const Eigen::Vector3d& z, const Eigen::Vector3d& x);

// Chains of IfcLocalPlacement (and grid and linear placements) to the file frame, each evaluated once.
class Placements {
 public:
  explicit Placements(const Model& model) : model_(model) {}
  Eigen::Isometry3d world(const Entity& object_placement, Report& report);

 private:
  Eigen::Isometry3d own(const Entity& placement, Report& report) const;
  const Model& model_;
  std::map<Id, Eigen::Isometry3d> known_;
};

}  // namespace standpoint::ifc
