// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/shortest_rotation.h"

namespace standpoint {

Eigen::Quaterniond shortestRotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d a = from.normalized(), b = to.normalized();
  const double cosine = (a + b).norm() / 2;  // of half the angle; |a x b| is twice its product with the sine
  const Eigen::Vector3d turned = cosine > 1e-8 ? Eigen::Vector3d(a.cross(b) / (2 * cosine)) : a.unitOrthogonal();
  return Eigen::Quaterniond(cosine, turned.x(), turned.y(), turned.z()).normalized();
}

}  // namespace standpoint
