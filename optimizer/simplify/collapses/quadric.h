// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace standpoint {

// Weighted sum of squared distances to planes (Garland and Heckbert 1997): p'Ap + 2 b'p + c.
struct Quadric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  double bx = 0, by = 0, bz = 0, c = 0;
  double weight = 0;  // sum of the planes' weights: value / weight is the mean squared distance

  void addPlane(const Eigen::Vector3d& unit_normal, const Eigen::Vector3d& point, double w) {
    const auto& n = unit_normal;
    const double d = -n.dot(point);
    xx += w * n.x() * n.x(), xy += w * n.x() * n.y(), xz += w * n.x() * n.z();
    yy += w * n.y() * n.y(), yz += w * n.y() * n.z(), zz += w * n.z() * n.z();
    bx += w * d * n.x(), by += w * d * n.y(), bz += w * d * n.z();
    c += w * d * d;
    weight += w;
  }

  Quadric& operator+=(const Quadric& o) {
    xx += o.xx, xy += o.xy, xz += o.xz, yy += o.yy, yz += o.yz, zz += o.zz;
    bx += o.bx, by += o.by, bz += o.bz, c += o.c, weight += o.weight;
    return *this;
  }

  void scale(double s) {
    xx *= s, xy *= s, xz *= s, yy *= s, yz *= s, zz *= s;
    bx *= s, by *= s, bz *= s, c *= s, weight *= s;
  }

  double operator()(const Eigen::Vector3d& p) const {
    const double x = p.x(), y = p.y(), z = p.z();
    const double value =
        x * (xx * x + 2 * (xy * y + xz * z + bx)) + y * (yy * y + 2 * (yz * z + by)) + z * (zz * z + 2 * bz) + c;
    return value > 0 ? value : 0;
  }

  // The point of least value that is nearest to `start` along directions in which the value hardly changes.
  Eigen::Vector3d minimum(const Eigen::Vector3d& start) const {
    const double damping = 1e-6 * (xx + yy + zz) + 1e-300;  // well above what rounding does to the determinant
    const double axx = xx + damping, ayy = yy + damping, azz = zz + damping;
    const double x = start.x(), y = start.y(), z = start.z();
    const Eigen::Vector3d r(-(xx * x + xy * y + xz * z + bx), -(xy * x + yy * y + yz * z + by),
                            -(xz * x + yz * y + zz * z + bz));
    const double m00 = ayy * azz - yz * yz, m01 = xz * yz - xy * azz, m02 = xy * yz - xz * ayy;
    const double m11 = axx * azz - xz * xz, m12 = xy * xz - axx * yz, m22 = axx * ayy - xy * xy;
    const double determinant = axx * m00 + xy * m01 + xz * m02;
    if (!(determinant > 0)) return start;
    return start + Eigen::Vector3d(m00 * r.x() + m01 * r.y() + m02 * r.z(), m01 * r.x() + m11 * r.y() + m12 * r.z(),
                                   m02 * r.x() + m12 * r.y() + m22 * r.z()) /
                       determinant;
  }

  // The same among the points with normal.p = offset; where nothing tells, near `start`.
  Eigen::Vector3d minimumInPlane(const Eigen::Vector3d& start, const Eigen::Vector3d& normal, double offset) const {
    const double squared = normal.squaredNorm();
    if (!(squared > 0)) return minimum(start);
    const Eigen::Vector3d foot = start + normal * ((offset - normal.dot(start)) / squared);
    const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u) / std::sqrt(squared);
    const auto times = [&](const Eigen::Vector3d& p) {
      return Eigen::Vector3d(xx * p.x() + xy * p.y() + xz * p.z(), xy * p.x() + yy * p.y() + yz * p.z(),
                             xz * p.x() + yz * p.y() + zz * p.z());
    };
    const Eigen::Vector3d r = -(times(foot) + Eigen::Vector3d(bx, by, bz)), au = times(u), av = times(v);
    const double damping = 1e-6 * (xx + yy + zz) + 1e-300;
    const double a = u.dot(au) + damping, b = u.dot(av), d = v.dot(av) + damping, ru = u.dot(r), rv = v.dot(r);
    const double determinant = a * d - b * b;
    if (!(determinant > 0)) return foot;
    return foot + u * ((d * ru - b * rv) / determinant) + v * ((a * rv - b * ru) / determinant);
  }
};

}  // namespace standpoint
