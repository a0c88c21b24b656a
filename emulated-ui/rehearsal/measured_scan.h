// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "core/result.h"
#include "core/survey.h"
#include "emulated-ui/rehearsal/part_surface.h"
#include "emulated-ui/rehearsal/rehearsal.h"

namespace standpoint {

// A stored setup's points against what is known of them, in cells of where they truly are. Local frame, metres.
struct MeasuredScan {
  static constexpr double kCell_m = 0.25;
  using Cell = std::array<std::int32_t, 3>;

  // Of the points of one surface, seen directly.
  struct Surface {
    double points = 0;
    Eigen::Vector3d offsets = Eigen::Vector3d::Zero();  // Σ of delivered less true place
    double errors = 0, squares = 0;                     // Σ of the range errors, and of their squares
    Eigen::Vector3d offset() const { return offsets / std::max(points, 1.0); }
    double sigma_m() const;  // of the range about its mean error; 0 where no truth is known
  };
  // Of those that belong to no surface, by the bit of point_flag; where they were measured.
  struct Strays {
    std::array<double, 8> points{};
    std::array<Eigen::Vector3d, 8> places{};  // Σ
    Strays() { places.fill(Eigen::Vector3d::Zero()); }
    Eigen::Vector3d middle(std::size_t bit) const { return places[bit] / std::max(points[bit], 1.0); }
  };

  std::string station;
  Pose truth, delivered;  // local frame from the scanner's
  SeenCells seen;
  std::map<Cell, Surface> surfaces;
  std::map<Cell, Strays> strays;

  static Cell cellOf(const Eigen::Vector3d& p);
  const Surface* cellAt(const Eigen::Vector3d& p) const;
};

// Where the work of whoever rehearses puts the setup, and where it truly stood: by the pose in its file, moved by the
// links as the copies for the office are. Errors: the file cannot be read, or its station is gone.
struct SetupPoses {
  Pose truth, delivered;
};
Result<SetupPoses> posesOf(const StoredSetup& setup, const Rehearsal& rehearsal);
Result<MeasuredScan> readMeasured(const StoredSetup& setup, const Rehearsal& rehearsal);

}  // namespace standpoint
