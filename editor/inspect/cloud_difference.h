// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "core/survey.h"
#include "editor/clouds/cloud.h"
#include "editor/inspect/point_colour.h"
#include "pointclouds/statistics/cloud_distances.h"

namespace standpoint {

// A cloud whose points have the colour of their distance to another one, and how to read it.
struct ShownDifference {
  std::shared_ptr<const Cloud> cloud;
  PointLegend legend;
};
// `shift_m` leads from the local frame to the project's files.
ShownDifference shownDifference(const CloudDistances& distances, const Pose& local_from_cloud,
                                const Eigen::Vector3d& shift_m);

}  // namespace standpoint
