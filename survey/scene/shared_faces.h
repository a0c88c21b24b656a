// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/environment.h"
#include "core/physical_material.h"
#include "optimizer/surface/triangle_tree.h"

namespace standpoint {

// Places where faces of two materials lie in one plane: a wall drawn into the terrain, a door into the wall's face.
// Which of them a beam meets there is chance, in the model as in a scan of it.
class SharedFaces {
 public:
  SharedFaces(const Environment& environment, const MaterialAssignment& assignment);
  // Whether at a place on a face of this material, with this unit normal, there is one of another. Local frame.
  bool at(const Eigen::Vector3d& place, const Eigen::Vector3d& normal, std::int32_t material) const;

 private:
  struct Face {
    Eigen::Vector3d normal;  // unit
    std::int32_t material = -1;
  };
  std::vector<Eigen::Vector3d> positions_;
  std::vector<Triangle> triangles_;
  std::vector<Face> faces_;  // of the triangles
  std::unique_ptr<TriangleTree> tree_;
};

}  // namespace standpoint
