// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/inspect/cloud_difference.h"

namespace standpoint {

ShownDifference shownDifference(const CloudDistances& distances, const Pose& local_from_cloud,
                                const Eigen::Vector3d& shift_m) {
  Cloud cloud{.shift_m = shift_m, .points_in_file = distances.place_m.size()};
  cloud.header.origin_m = local_from_cloud * distances.origin_m + shift_m;
  cloud.header.stations.emplace_back();
  cloud.header.stations.back().points = distances.place_m.size();
  const Eigen::Matrix3f turn = local_from_cloud.rotation.toRotationMatrix().cast<float>();
  cloud.points.reserve(distances.place_m.size());
  for (const auto& place : distances.place_m) {
    const Eigen::Vector3f turned = turn * place;
    cloud.points.emplace_back().position_m = {turned.x(), turned.y(), turned.z()};
  }
  auto coloured = colourDistances(distances.distance_m);
  cloud.colours = std::move(coloured.colours);
  return {std::make_shared<const Cloud>(std::move(cloud)), std::move(coloured.legend)};
}

}  // namespace standpoint
