// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "core/environment.h"
#include "editor/camera/camera.h"
#include "editor/clouds/cloud.h"

namespace standpoint {

// How a place is looked at: a surface from before it, edge-on where its thickness or its place counts, and what has no
// surface from where it was measured.
struct ProofLook {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // local frame
  std::optional<Eigen::Vector3d> normal;             // of the surface, unit
  Eigen::Vector3d from = Eigen::Vector3d::Zero();    // the instrument
  double radius_m = 0.5;                             // of what is to be seen
  bool edge_on = false;
};
// The way that an edge-on look goes: along the surface, level.
Eigen::Vector3d alongSurface(const ProofLook& look);
// A camera that has the whole ball of that radius in a picture of this aspect.
Camera cameraOf(const ProofLook& look, Camera camera, double aspect);

// What proves that a rule was broken: the student's points on the left, those of the sample solution on the right, of
// the same place and through one camera, instead of the model. Where nothing was scanned, the place in the model.
struct ShownProof {
  ProofLook look;
  Eigen::Vector3d ring_centre = Eigen::Vector3d::Zero();  // of the place on the true surface, local frame
  double ring_m = 0.5;                                    // its radius
  bool points = true;                                     // it is points that prove it: two views
  std::shared_ptr<const Cloud> yours, good;               // null: not there (yet)
  std::string yours_text, good_text;                      // what stands below them: a figure, or why there is nothing
  Camera camera_before;
};

}  // namespace standpoint
