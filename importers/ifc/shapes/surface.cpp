// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/shapes/surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "importers/ifc/shapes/bspline.h"
#include "importers/ifc/shapes/curve.h"
#include "importers/ifc/shapes/mapping.h"
#include "importers/ifc/shapes/placement.h"
#include "importers/ifc/shapes/surfaces.h"

namespace standpoint::ifc {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

double nearTurn(double angle, double near) { return angle + kTurn * std::round((near - angle) / kTurn); }

class Plane : public ParametricSurface {
 public:
  explicit Plane(const Eigen::Isometry3d& f) : frame_(f), inverse_(f.inverse()) {}
  Eigen::Vector3d at(const Eigen::Vector2d& uv) const override { return frame_ * Eigen::Vector3d(uv.x(), uv.y(), 0); }
  Eigen::Vector2d parameters(const Eigen::Vector3d& p, const Eigen::Vector2d&) const override {
    return (inverse_ * p).head<2>();
  }
  std::optional<Eigen::Vector2d> fromFile(const Eigen::Vector2d& uv, double length_m, double) const override {
    return uv * length_m;
  }

 private:
  Eigen::Isometry3d frame_, inverse_;
};

// Cylinder, sphere and torus: around the z axis of the frame with u; v is height, latitude, or the angle in the tube.
class Round : public ParametricSurface {
 public:
  enum class Kind { cylinder, sphere, torus };
  Round(Kind kind, const Eigen::Isometry3d& f, double major, double minor)
      : kind_(kind), frame_(f), inverse_(f.inverse()), major_(major), minor_(minor) {}

  Eigen::Vector3d at(const Eigen::Vector2d& uv) const override {
    const double tube = kind_ == Kind::cylinder ? 0 : minor_;
    const double r = major_ + tube * std::cos(uv.y()), z = kind_ == Kind::cylinder ? uv.y() : tube * std::sin(uv.y());
    return frame_ * Eigen::Vector3d(r * std::cos(uv.x()), r * std::sin(uv.x()), z);
  }
  Eigen::Vector2d parameters(const Eigen::Vector3d& p, const Eigen::Vector2d& near) const override {
    const Eigen::Vector3d q = inverse_ * p;
    const double r = q.head<2>().norm();
    const double u = r > 1e-9 ? nearTurn(std::atan2(q.y(), q.x()), near.x()) : near.x();
    if (kind_ == Kind::cylinder) return {u, q.z()};
    const double v = std::atan2(q.z(), r - major_);
    return {u, kind_ == Kind::torus ? nearTurn(v, near.y()) : v};
  }
  std::optional<Eigen::Vector2d> fromFile(const Eigen::Vector2d& uv, double length_m, double angle_rad) const override {
    return Eigen::Vector2d(uv.x() * angle_rad, uv.y() * (kind_ == Kind::cylinder ? length_m : angle_rad));
  }
  Eigen::Vector2d period() const override { return {kTurn, kind_ == Kind::torus ? kTurn : 0}; }

 private:
  Kind kind_;
  Eigen::Isometry3d frame_, inverse_;
  double major_, minor_;
};

// Any surface that can only be evaluated: its parameters are searched, from a grid and then by Gauss and Newton.
class Searched : public ParametricSurface {
 public:
  Eigen::Vector2d parameters(const Eigen::Vector3d& p, const Eigen::Vector2d& near) const override {
    Eigen::Vector2d best = refine(p, clamp(near));
    if ((at(best) - p).norm() < 1e-5) return best;
    constexpr int kSteps = 16;
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; j <= kSteps; ++j) {
        const Eigen::Vector2d uv = low() + (high() - low()).cwiseProduct(Eigen::Vector2d(i, j) / kSteps);
        if ((at(uv) - p).squaredNorm() < (at(best) - p).squaredNorm()) best = uv;
      }
    return refine(p, best);
  }

 private:
  Eigen::Vector2d clamp(const Eigen::Vector2d& uv) const { return uv.cwiseMax(low()).cwiseMin(high()); }

  Eigen::Vector2d refine(const Eigen::Vector3d& p, Eigen::Vector2d uv) const {
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector2d h = (high() - low()) * 1e-5;
      const Eigen::Vector3d here = at(uv);
      const double su = uv.x() + h.x() > high().x() ? -1 : 1, sv = uv.y() + h.y() > high().y() ? -1 : 1;
      const Eigen::Vector3d du = (at({uv.x() + su * h.x(), uv.y()}) - here) / (su * h.x()),
                            dv = (at({uv.x(), uv.y() + sv * h.y()}) - here) / (sv * h.y());
      const double a = du.dot(du), b = du.dot(dv), c = dv.dot(dv), det = a * c - b * b;
      if (!(std::abs(det) > 1e-30)) return uv;
      const Eigen::Vector3d r = p - here;
      const Eigen::Vector2d step((c * du.dot(r) - b * dv.dot(r)) / det, (a * dv.dot(r) - b * du.dot(r)) / det);
      const Eigen::Vector2d next = clamp(uv + step);
      if ((next - uv).cwiseQuotient(high() - low()).norm() < 1e-9) return next;
      uv = next;
    }
    return uv;
  }
};

class Spline : public Searched {
 public:
  explicit Spline(SplineSurface s) : spline_(std::move(s)) {
    const Eigen::Vector2d middle = (low() + high()) / 2;
    if ((spline_.at(low().x(), middle.y()) - spline_.at(high().x(), middle.y())).norm() < 1e-6)
      period_.x() = high().x() - low().x();
    if ((spline_.at(middle.x(), low().y()) - spline_.at(middle.x(), high().y())).norm() < 1e-6)
      period_.y() = high().y() - low().y();
  }
  Eigen::Vector3d at(const Eigen::Vector2d& uv) const override {
    return spline_.at(wrapped(uv.x(), 0), wrapped(uv.y(), 1));
  }
  Eigen::Vector2d parameters(const Eigen::Vector3d& p, const Eigen::Vector2d& near) const override {
    Eigen::Vector2d uv = Searched::parameters(p, {wrapped(near.x(), 0), wrapped(near.y(), 1)});
    for (int k = 0; k < 2; ++k)
      if (period_[k] > 0) uv[k] += period_[k] * std::round((near[k] - uv[k]) / period_[k]);
    return uv;
  }
  std::optional<Eigen::Vector2d> fromFile(const Eigen::Vector2d& uv, double, double) const override { return uv; }
  Eigen::Vector2d low() const override { return {spline_.u.from(), spline_.v.from()}; }
  Eigen::Vector2d high() const override { return {spline_.u.to(), spline_.v.to()}; }
  Eigen::Vector2d period() const override { return period_; }

 private:
  double wrapped(double t, int k) const {
    if (!(period_[k] > 0) || (t >= low()[k] && t <= high()[k])) return t;
    return t - period_[k] * std::floor((t - low()[k]) / period_[k]);
  }
  SplineSurface spline_;
  Eigen::Vector2d period_ = Eigen::Vector2d::Zero();
};

// A polyline by its length; finds the nearest place after a projection.
class Profile {
 public:
  explicit Profile(Path path) : points_(std::move(path.points)) {
    if (path.closed) points_.push_back(points_.front());
    lengths_.push_back(0);
    for (std::size_t i = 1; i < points_.size(); ++i)
      lengths_.push_back(lengths_.back() + (points_[i] - points_[i - 1]).norm());
  }
  double length() const { return lengths_.back(); }
  const std::vector<Eigen::Vector3d>& points() const { return points_; }
  Eigen::Vector3d at(double u) const {
    const auto it = std::upper_bound(lengths_.begin(), lengths_.end(), u);
    const auto i = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(it - lengths_.begin(), 1, static_cast<std::ptrdiff_t>(lengths_.size()) - 1));
    return points_[i - 1] + (u - lengths_[i - 1]) / (lengths_[i] - lengths_[i - 1]) * (points_[i] - points_[i - 1]);
  }
  // The ends may be overrun in a straight line: faces reach a little beyond the curve they were made from.
  double nearest(const Eigen::Vector3d& p, const Eigen::Matrix3d& flatten) const {
    double best = 0, off = 1e300;
    for (std::size_t i = 1; i < points_.size(); ++i) {
      const Eigen::Vector3d a = flatten * (p - points_[i - 1]), d = flatten * (points_[i] - points_[i - 1]);
      double t = d.squaredNorm() > 0 ? a.dot(d) / d.squaredNorm() : 0;
      t = std::clamp(t, i == 1 ? -1e9 : 0.0, i + 1 == points_.size() ? 1e9 : 1.0);
      if (const double r = (a - t * d).squaredNorm(); r < off)
        off = r, best = lengths_[i - 1] + t * (lengths_[i] - lengths_[i - 1]);
    }
    return best;
  }

 private:
  std::vector<Eigen::Vector3d> points_;
  std::vector<double> lengths_;
};

class Extruded : public ParametricSurface {
 public:
  Extruded(Path path, const Eigen::Isometry3d& frame, const Eigen::Vector3d& along)
      : profile_(std::move(path)), frame_(frame), inverse_(frame.inverse()), along_(along) {}
  Eigen::Vector3d at(const Eigen::Vector2d& uv) const override {
    return frame_ * (profile_.at(uv.x()) + along_ * uv.y());
  }
  Eigen::Vector2d parameters(const Eigen::Vector3d& p, const Eigen::Vector2d&) const override {
    const Eigen::Vector3d q = inverse_ * p;
    const double u = profile_.nearest(q, Eigen::Matrix3d::Identity() - along_ * along_.transpose());
    return {u, (q - profile_.at(u)).dot(along_)};
  }

 private:
  Profile profile_;
  Eigen::Isometry3d frame_, inverse_;
  Eigen::Vector3d along_;
};

// v is the angle from the plane of the profile, u runs along the profile.
class Revolved : public ParametricSurface {
 public:
  Revolved(Path path, const Eigen::Isometry3d& frame, const Axis& axis)
      : profile_(std::move(path)), frame_(frame), inverse_(frame.inverse()), axis_(axis) {
    for (const auto& p : profile_.points())
      if (const Eigen::Vector3d r = radial(p); r.norm() > reference_.norm()) reference_ = r;
  }
  Eigen::Vector3d at(const Eigen::Vector2d& uv) const override { return frame_ * turned(profile_.at(uv.x()), uv.y()); }
  Eigen::Vector2d parameters(const Eigen::Vector3d& p, const Eigen::Vector2d& near) const override {
    const Eigen::Vector3d q = inverse_ * p, r = radial(q);
    double v = near.y();
    if (r.norm() > 1e-9)
      v = nearTurn(std::atan2(reference_.cross(r).dot(axis_.direction), reference_.dot(r)), near.y());
    return {profile_.nearest(turned(q, -v), Eigen::Matrix3d::Identity()), v};
  }
  Eigen::Vector2d period() const override { return {0, kTurn}; }

 private:
  Eigen::Vector3d radial(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d d = p - axis_.point;
    return d - d.dot(axis_.direction) * axis_.direction;
  }
  Eigen::Vector3d turned(const Eigen::Vector3d& p, double angle) const {
    return axis_.point + Eigen::AngleAxisd(angle, axis_.direction) * (p - axis_.point);
  }
  Profile profile_;
  Eigen::Isometry3d frame_, inverse_;
  Axis axis_;
  Eigen::Vector3d reference_ = Eigen::Vector3d::Zero();
};

SurfacePtr round(Round::Kind kind, const Entity& e, double major, double minor, Scope& s) {
  return std::make_shared<Round>(kind, axisPlacement(e.ref(0), s), major, minor);
}

}  // namespace

Result<SurfacePtr> planeSurface(const Entity& e, Scope& s) {
  return std::make_shared<Plane>(axisPlacement(e.ref(0), s));
}

Result<SurfacePtr> basisSurface(const Entity& e, Scope& s) { return surface(e.ref(0), s); }

Result<SurfacePtr> cylindricalSurface(const Entity& e, Scope& s) {
  const double r = s.metres(e[1].number(0));
  if (!(r > 0)) return fail(e, "the radius is not positive");
  return round(Round::Kind::cylinder, e, r, 0, s);
}

Result<SurfacePtr> sphericalSurface(const Entity& e, Scope& s) {
  const double r = s.metres(e[1].number(0));
  if (!(r > 0)) return fail(e, "the radius is not positive");
  return round(Round::Kind::sphere, e, 0, r, s);
}

Result<SurfacePtr> toroidalSurface(const Entity& e, Scope& s) {
  const double major = s.metres(e[1].number(0)), minor = s.metres(e[2].number(0));
  if (!(major > 0 && minor > 0)) return fail(e, "a radius is not positive");
  return round(Round::Kind::torus, e, major, minor, s);
}

Result<SurfacePtr> bSplineSurface(const Entity& e, Scope& s) {
  SplineSurface spline;
  const Value rows = e[2], weights = e[12];
  const bool rational = e.typeName().starts_with("IFCRATIONAL");
  auto weight_row = weights.begin();
  for (const Value row : rows) {
    std::vector<Eigen::Vector4d> line;
    const Value weight_list = rational && weight_row != weights.end() ? *weight_row : Value();
    auto w = weight_list.begin();
    for (const Value v : row) {
      const Eigen::Vector3d p = cartesianPoint(e.follow(v), s);
      double weight = 1;
      if (w != weight_list.end()) weight = (*w).number(1), ++w;
      line.push_back(Eigen::Vector4d(p.x(), p.y(), p.z(), 1) * (weight > 0 ? weight : 1));
    }
    if (rational && weight_row != weights.end()) ++weight_row;
    if (!spline.control.empty() && line.size() != spline.control[0].size())
      return fail(e, "the rows of control points differ in length");
    if (!s.spend(line.size())) return fail(e, "too many points");
    spline.control.push_back(std::move(line));
  }
  const auto degree = [&](std::size_t i) {
    return static_cast<int>(std::clamp<std::int64_t>(e[i].integer(1), 0, 100));
  };
  if (spline.control.empty()) return fail(e, "there are no control points");
  spline.u = knotVector(degree(0), spline.control.size(), e[7], e[9]);
  spline.v = knotVector(degree(1), spline.control[0].size(), e[8], e[10]);
  if (spline.u.knots.empty() || spline.v.knots.empty())
    return fail(e, "the degree does not match the number of control points");
  return std::make_shared<Spline>(std::move(spline));
}

namespace {

Result<Path> sweptCurve(const Entity& e, Scope& s) {
  auto path = profileCurve(e.ref(0), s);
  if (path && path->points.size() < 2) return fail(e, "the swept curve has no length");
  return path;
}

}  // namespace

Result<SurfacePtr> surfaceOfLinearExtrusion(const Entity& e, Scope& s) {
  TRY_ASSIGN(auto path, sweptCurve(e, s));
  return std::make_shared<Extruded>(std::move(path), axisPlacement(e.ref(1), s),
                                    direction(e.ref(2), Eigen::Vector3d::UnitZ(), s));
}

Axis axisOfRevolution(const Entity& e, const Eigen::Isometry3d& position, Scope& s) {
  const Axis axis = axis1Placement(e.ref(2), s);
  // The axis lies in the plane of the profile. Revit states it in the frame of the shape, not of the surface's
  // position.
  const auto in_plane = [](const Axis& a) { return std::abs(a.point.z()) < 1e-4 && std::abs(a.direction.z()) < 1e-4; };
  const Axis of_shape{position.inverse() * axis.point, position.linear().transpose() * axis.direction};
  return !in_plane(axis) && in_plane(of_shape) ? of_shape : axis;
}

Result<SurfacePtr> surfaceOfRevolution(const Entity& e, Scope& s) {
  TRY_ASSIGN(auto path, sweptCurve(e, s));
  const Eigen::Isometry3d position = axisPlacement(e.ref(1), s);
  return std::make_shared<Revolved>(std::move(path), position, axisOfRevolution(e, position, s));
}

}  // namespace standpoint::ifc
