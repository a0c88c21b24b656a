// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The table from entity names to functions. A new entity is a function in the file of its kind, its declaration
// (solid.h, curve.h, profile.h, surfaces.h) and a line in mapping.cpp. A function reads the entity's attributes by
// index (model/step_file.h) and what it refers to by the calls below.

#include <span>
#include <vector>

#include <Eigen/Core>

#include "importers/ifc/model/model.h"
#include "importers/ifc/shapes/surface.h"

namespace standpoint::ifc {

struct Path {  // a curve as points in metres; of 2D curves z is 0
  std::vector<Eigen::Vector3d> points;
  bool closed = false;  // then the first point is not repeated
  // Where it is known that the curve itself leaves and arrives in other directions than its first and last chord; unit,
  // or zero.
  Eigen::Vector3d start_tangent = Eigen::Vector3d::Zero(), end_tangent = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> ups;  // of an alignment with cant, one per point: where "up" leans to; else none
};
using Regions = std::vector<geometry::Region2>;

struct Mapping {       // an entity may be of several kinds
  const char* entity;  // upper case
  Result<geometry::PolyMesh> (*item)(const Entity&, Scope&) = nullptr;
  Result<Path> (*curve)(const Entity&, Scope&) = nullptr;
  Result<Regions> (*profile)(const Entity&, Scope&) = nullptr;
  Result<SurfacePtr> (*surface)(const Entity&, Scope&) = nullptr;
};

std::span<const Mapping> mappings();  // the table

std::shared_ptr<CurveCache> newCurveCache();

// By Record::type of that file.
std::vector<const Mapping*> mappingOfTypes(const StepFile& file);

// A solid or surface by its name that no row of the table makes a body of.
bool isUnreadBody(const Entity& item, const Model& model);

// The guarded calls through the table; an entity that the table lacks is an error that names it.
Result<geometry::PolyMesh> item(const Entity& entity, Scope& scope);
Result<Path> curve(const Entity& entity, Scope& scope);
Result<Regions> profile(const Entity& entity, Scope& scope);
Result<SurfacePtr> surface(const Entity& entity, Scope& scope);

}  // namespace standpoint::ifc
