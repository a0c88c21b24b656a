// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Core>

#include "optimizer/walk/obstacles.h"

namespace standpoint {

// Where somebody stands who points at a surface to be there.
struct Landing {
  Eigen::Vector3d feet = Eigen::Vector3d::Zero();
  std::uint32_t product = 0;  // that is stood on, where there is a floor
  std::string why_not;        // "too steep: 52°, at most 45°", in a few words; empty: one can stand there
};

// `normal`: of the surface at `point`. Beside a wall or an edge over which one would fall it is as near to it as the
// body can be.
Landing landingAt(const Obstacles& obstacles, const Body& body, const Eigen::Vector3d& point,
                  const Eigen::Vector3d& normal);

}  // namespace standpoint
