// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <Eigen/Core>

#include "core/environment.h"
#include "editor/camera/camera.h"
#include "editor/clouds/cloud.h"

namespace standpoint {

struct Model;

// Which places of the local frame are drawn, and not cut away.
using KeptPlace = std::function<bool(const Eigen::Vector3d&)>;

// How much of a picture of `size_px` has points of the cloud in it: of its 16 by 9 parts, 0 to 1.
double shareWithPoints(const Cloud& cloud, const Camera& camera, const Eigen::Vector2d& size_px, const KeptPlace& kept);

// Around most points that are drawn, local frame: without the few that were met far away through a window. Empty where
// none is.
Bounds boundsOfMost(const Cloud& cloud, const KeptPlace& kept);

// Of the cloud that is shown in place of the model: the camera stays where it sees enough of it, and flies else to
// where it does, from above and aslant with the ceilings cut away. Alt+Left leads back.
void bringPointsIntoView(Model& model);

}  // namespace standpoint
