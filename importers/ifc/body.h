// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// From products to placed triangles: which representations are needed, each evaluated once, openings cut where there
// are some, everything brought to small local frames.

#include <memory>
#include <vector>

#include "core/environment.h"
#include "core/progress.h"
#include "importers/ifc/model/model.h"
#include "importers/ifc/model/relations.h"

namespace standpoint::ifc {

// Triangles in a local frame small enough for float; faces carry their style's tag.
struct Body {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> tags;                   // per triangle
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // of the local frame, in the frame of the items
  Bounds bounds;                                     // in the frame of the items
};

struct PlacedBody {
  std::shared_ptr<const Body> body;
  Eigen::Affine3d file_from_items = Eigen::Affine3d::Identity();
  std::uint32_t style = 0;  // for triangles without a tag
};

struct Bodies {
  std::vector<std::vector<PlacedBody>> of_product;  // in step with the entities
  bool any = false;                                 // a product has a body in the file, even if it is lost here
  Report report;
};

Result<Bodies> buildBodies(const std::vector<Entity>& products, const Relations& relations, const Model& model,
                           Progress& progress);

}  // namespace standpoint::ifc
