// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "importers/files/importer.h"

namespace standpoint {

Eigen::Vector3d chooseShift(const ImportOptions& options, const Bounds& bounds_file_m) {
  constexpr double kNear_m = 2000;
  if (options.shift == ShiftMode::given) return options.given_shift_m.array().round();
  if (options.shift == ShiftMode::none || bounds_file_m.empty()) return Eigen::Vector3d::Zero();
  const double far = std::max(bounds_file_m.min.cwiseAbs().maxCoeff(), bounds_file_m.max.cwiseAbs().maxCoeff());
  if (far < kNear_m) return Eigen::Vector3d::Zero();
  return ((bounds_file_m.min + bounds_file_m.max) / 2).array().round();
}

}  // namespace standpoint
