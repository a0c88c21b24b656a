// SPDX-License-Identifier: GPL-3.0-or-later
// IfcSegmentedReferenceCurve: cant over an alignment. Between the placements of two segments the track is lifted and
// rolls as the curvature of the segment's parent curve goes from its start to its end (IFC 4.3, 8.9.3.63).
#include <algorithm>
#include <cmath>
#include <functional>

#include "importers/ifc/shapes/alignment.h"
#include "importers/ifc/shapes/curve.h"
#include "importers/ifc/shapes/placement.h"

namespace standpoint::ifc {
namespace {

struct Cant {
  double along_m = 0;   // in the plan of the base curve
  double lift_m = 0;    // of the curve above its base: the y of a segment's placement, as all exporters write it
  double roll_rad = 0;  // of "up", to the left
};

Cant cantOf(const Entity& placement, Scope& scope) {
  const Eigen::Vector3d at = cartesianPoint(placement.ref(0), scope),
                        axis = direction(placement.ref(1), Eigen::Vector3d::UnitZ(), scope);
  return {at.x(), at.y(), placement.is("IFCAXIS2PLACEMENT3D") ? std::atan2(axis.y(), axis.z()) : 0};
}

Cant between(const Cant& a, const Cant& b, double fraction, double along_m) {
  return {along_m, a.lift_m + (b.lift_m - a.lift_m) * fraction, a.roll_rad + (b.roll_rad - a.roll_rad) * fraction};
}

// Into how many pieces a change is cut: 16 leave a cosine off by 0.5 % of it, and what is as wide as a track (3 m)
// keeps the usual chord error of 1 mm where its flat pieces twist by a milliradian.
int piecesFor(const Cant& from, const Cant& to) {
  const double lift_m = std::abs(to.lift_m - from.lift_m), roll_rad = std::abs(to.roll_rad - from.roll_rad);
  if (lift_m <= 1e-6 && roll_rad <= 1e-6) return 1;
  return static_cast<int>(std::clamp(std::ceil(roll_rad / 1e-3), 16.0, 1024.0));
}

// Rising along the curve.
std::vector<Cant> cantAlong(const Entity& entity, Scope& scope) {
  std::vector<Cant> stated;
  const auto segments = entity.refs(0);
  for (const Entity& segment : segments) stated.push_back(cantOf(segment.ref(1), scope));
  if (entity.ref(3)) stated.push_back(cantOf(entity.ref(3), scope));
  std::vector<Cant> cant;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Cant& from = stated[i];
    if (!cant.empty() && from.along_m < cant.back().along_m - 1e-6) continue;
    cant.push_back(from);
    if (i + 1 >= stated.size() || stated[i + 1].along_m <= from.along_m) continue;
    const Cant& to = stated[i + 1];
    const int pieces = scope.spend(1024) ? piecesFor(from, to) : 1;
    const auto fraction = curvatureFraction(segments[i], scope);
    for (int k = 1; k <= pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      cant.push_back(between(from, to, k == pieces ? 1 : fraction(t), from.along_m + (to.along_m - from.along_m) * t));
    }
  }
  return cant;
}

// Lifts and rolls one place after the other; they come in rising order.
class Canted {
 public:
  explicit Canted(std::vector<Cant> cant) : cant_(std::move(cant)) {}

  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& forward, double along_m) {
    while (next_ + 1 < cant_.size() && cant_[next_].along_m < along_m) ++next_;
    const Cant &a = cant_[next_ > 0 ? next_ - 1 : 0], &b = cant_[next_];
    const double run = b.along_m - a.along_m;
    const Cant here = between(a, b, run > 0 ? std::clamp((along_m - a.along_m) / run, 0.0, 1.0) : 1, along_m);
    const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(forward).normalized();
    const Eigen::Vector3d lifted = point + Eigen::Vector3d::UnitZ() * here.lift_m;
    if (!path.points.empty() && (path.points.back() - lifted).norm() <= kSamePoint_m) return;
    path.points.push_back(lifted);
    path.ups.push_back(left * std::sin(here.roll_rad) + forward.cross(left) * std::cos(here.roll_rad));
  }

  Path path;

 private:
  std::vector<Cant> cant_;
  std::size_t next_ = 0;
};

}  // namespace

Result<Path> segmentedReferenceCurve(const Entity& entity, Scope& scope) {
  const auto base = curve(entity.ref(2), scope);
  if (!base) return base;
  const std::vector<Cant> cant = cantAlong(entity, scope);
  if (cant.empty() || base->points.size() < 2) return fail(entity, "the curve has no length or no segments");
  Canted canted(cant);
  double at = 0;
  std::size_t corner = 0;
  const auto& p = base->points;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Eigen::Vector3d forward = (i + 1 < p.size() ? p[i + 1] - p[i] : p[i] - p[i - 1]).normalized();
    canted.add(p[i], forward, at);
    if (i + 1 == p.size()) break;
    const double run = (p[i + 1] - p[i]).head<2>().norm();
    for (; corner < cant.size() && cant[corner].along_m < at + run; ++corner)
      if (cant[corner].along_m > at)
        canted.add(p[i] + (p[i + 1] - p[i]) * ((cant[corner].along_m - at) / run), forward, cant[corner].along_m);
    at += run;
  }
  if (canted.path.points.size() < 2) return fail(entity, "the curve has no length");
  return std::move(canted.path);
}

}  // namespace standpoint::ifc
