// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace standpoint::ifc {

// A surface with two parameters, in metres and radians. Plane and the elementary surfaces, splines, swept curves.
class ParametricSurface {
 public:
  virtual ~ParametricSurface() = default;
  virtual Eigen::Vector3d at(const Eigen::Vector2d& uv) const = 0;
  // The parameters of a point on it (or near it); `near` chooses among several turns and starts a search.
  virtual Eigen::Vector2d parameters(const Eigen::Vector3d& point, const Eigen::Vector2d& near) const = 0;
  // Parameters as the file counts them (ISO 10303-42, in its units) as ours; nothing on swept surfaces, whose count is
  // that of the curve they were made from.
  virtual std::optional<Eigen::Vector2d> fromFile(const Eigen::Vector2d&, double /*length_m*/,
                                                  double /*angle_rad*/) const {
    return {};
  }
  virtual Eigen::Vector2d period() const { return Eigen::Vector2d::Zero(); }  // 0: does not close
  // Ends of the parameters where the surface has them (lo.x > hi.x: unbounded).
  virtual Eigen::Vector2d low() const { return Eigen::Vector2d::Constant(1); }
  virtual Eigen::Vector2d high() const { return Eigen::Vector2d::Constant(-1); }
};
using SurfacePtr = std::shared_ptr<const ParametricSurface>;

}  // namespace standpoint::ifc
