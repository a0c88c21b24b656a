// SPDX-License-Identifier: GPL-3.0-or-later
// Alignments of IFC4X3: a plan curve of segments (lines, arcs, clothoids …) and a gradient over it.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "importers/ifc/shapes/alignment.h"
#include "importers/ifc/shapes/curve.h"
#include "importers/ifc/shapes/placement.h"

namespace standpoint::ifc {
namespace {

// A parent curve in its own plane, by a parameter in metres (arc length; for polynomials their x), with its heading
// there.
struct Parent {
  std::function<Eigen::Vector2d(double)> at;
  std::function<double(double)> heading;
};

Parent lineParent(const Entity& line_entity, Scope& scope) {
  const Eigen::Vector3d d = direction(line_entity.ref(1).ref(0), Eigen::Vector3d::UnitX(), scope);
  const Eigen::Vector2d along = d.head<2>().normalized();
  return {[along](double s) { return Eigen::Vector2d(along * s); },
          [along](double) { return std::atan2(along.y(), along.x()); }};
}

Parent circleParent(double radius) {
  return {[radius](double s) { return Eigen::Vector2d(radius * std::cos(s / radius), radius * std::sin(s / radius)); },
          [radius](double s) { return s / radius + std::numbers::pi / 2; }};
}

// A curve that is known by its heading along its length. Points relative to the one at `start`: far along a spiral the
// differences would drown.
Parent headedParent(const std::function<double(double)>& heading, double start) {
  const auto at = [heading, start](double s) {
    constexpr std::array kNodes{-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831, 0.9061798459386640};
    constexpr std::array kWeights{0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
                                  0.2369268850561891};
    const int pieces = static_cast<int>(std::clamp(std::abs(heading(s) - heading(start)) * 4, 8.0, 500.0));
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    const double half = (s - start) / pieces / 2;
    for (int i = 0; i < pieces; ++i)
      for (std::size_t k = 0; k < kNodes.size(); ++k) {
        const double h = heading(start + half * (2 * i + 1 + kNodes[k]));
        sum += half * kWeights[k] * Eigen::Vector2d(std::cos(h), std::sin(h));
      }
    return sum;
  };
  return {at, heading};
}

// A term A of order n bends the curve by sign(A) · s^n / |A|^(n+1) (IFC 4.3, 8.9.3.66 IfcSpiral and its subtypes).
struct SpiralTerm {
  int order;
  double a_m;
};

double headingOf(const std::vector<SpiralTerm>& terms, double s) {
  double sum = 0;
  for (const SpiralTerm& t : terms)
    sum += (t.a_m < 0 ? -1 : 1) * std::pow(s / std::abs(t.a_m), t.order + 1) / (t.order + 1);
  return sum;
}

std::vector<SpiralTerm> terms(const Entity& entity, const Scope& scope) {
  std::vector<SpiralTerm> found;
  const auto add = [&](std::size_t index, int order) {
    if (const double a = scope.metres(entity[index].number(0)); std::abs(a) > 1e-9) found.push_back({order, a});
  };
  if (entity.is("IFCCLOTHOID")) add(1, 1);
  const int highest = entity.is("IFCSECONDORDERPOLYNOMIALSPIRAL")    ? 2
                      : entity.is("IFCTHIRDORDERPOLYNOMIALSPIRAL")   ? 3
                      : entity.is("IFCSEVENTHORDERPOLYNOMIALSPIRAL") ? 7
                                                                     : -1;
  for (int order = highest; order >= 0; --order) add(static_cast<std::size_t>(highest - order + 1), order);
  if (entity.is("IFCSINESPIRAL")) add(2, 1), add(3, 0);
  if (entity.is("IFCCOSINESPIRAL")) add(2, 0);
  return found;
}

// The waves of a cosine or sine spiral are as long as the segment (a half and a whole one).
std::function<double(double)> spiralHeading(const Entity& entity, double length_m, const Scope& scope) {
  const std::vector<SpiralTerm> polynomial_part = terms(entity, scope);
  const double wave = scope.metres(entity[1].number(0)), l = std::abs(length_m);
  if (entity.is("IFCCOSINESPIRAL") && std::abs(wave) > 1e-9)
    return [=](double s) {
      return headingOf(polynomial_part, s) + l / (std::numbers::pi * wave) * std::sin(std::numbers::pi * s / l);
    };
  if (entity.is("IFCSINESPIRAL") && std::abs(wave) > 1e-9)
    return [=](double s) {
      return headingOf(polynomial_part, s) +
             l / (2 * std::numbers::pi * wave) * (1 - std::cos(2 * std::numbers::pi * s / l));
    };
  if (polynomial_part.empty()) return {};
  return [=](double s) { return headingOf(polynomial_part, s); };
}

std::vector<double> coefficients(const Value& list) {
  std::vector<double> c;
  for (const Value v : list) c.push_back(v.number(0));
  return c;
}

double polynomial(const std::vector<double>& c, double t) {
  double sum = 0;
  for (auto it = c.rbegin(); it != c.rend(); ++it) sum = sum * t + *it;
  return sum;
}

double slope(const std::vector<double>& c, double t) {
  double sum = 0;
  for (std::size_t i = c.size(); i-- > 1;) sum = sum * t + c[i] * static_cast<double>(i);
  return sum;
}

Parent polynomialParent(const Entity& entity, double unit) {
  const auto x = coefficients(entity[1]), y = coefficients(entity[2]);
  return {[=](double s) { return Eigen::Vector2d(polynomial(x, s / unit) * unit, polynomial(y, s / unit) * unit); },
          [=](double s) { return std::atan2(slope(y, s / unit), slope(x, s / unit)); }};
}

Result<Parent> parentOf(const Entity& entity, double start_m, double length_m, Scope& scope) {
  if (entity.is("IFCLINE")) return lineParent(entity, scope);
  if (entity.is("IFCCIRCLE"))
    if (const double r = scope.metres(entity[1].number(0)); r > 0) return circleParent(r);
  if (const auto heading = spiralHeading(entity, length_m, scope)) return headedParent(heading, start_m);
  if (entity.is("IFCPOLYNOMIALCURVE")) return polynomialParent(entity, scope.model.units.length_m);
  return fail(entity, std::string(entity.typeName()) + " is not supported as a part of an alignment");
}

// A measure of a segment: a length, or a parameter, which on a circle is an angle.
double segmentMeasure(const Value& value, const Entity& parent, const Scope& scope) {
  const double x = value.number(0);
  if (value.typeName() != "IFCPARAMETERVALUE") return scope.metres(x);
  if (parent.is("IFCCIRCLE")) return x * scope.model.units.angle_rad * scope.metres(parent[1].number(0));
  if (parent.is("IFCLINE")) return x * scope.metres(parent.ref(1)[1].number(1));
  return scope.metres(x);
}

// The segment is the piece of its parent moved so that it begins at its placement (IfcCurveSegment).
Result<Path> segmentPath(const Entity& segment, Scope& scope) {
  const Entity parent_entity = segment.ref(4);
  const double start = segmentMeasure(segment[2], parent_entity, scope),
               length_m = segmentMeasure(segment[3], parent_entity, scope);
  Path path;
  if (std::abs(length_m) < 1e-9) return path;  // the last segment of an alignment only marks its end
  TRY_ASSIGN(const auto parent, parentOf(parent_entity, start, length_m, scope));
  const double sign = length_m < 0 ? -1 : 1;
  const double turn = -(parent.heading(start) + (sign < 0 ? std::numbers::pi : 0));
  const Eigen::Vector2d origin = parent.at(start);
  const Eigen::Isometry3d placed = axisPlacement(segment.ref(1), scope);
  const auto at = [&](double u) {
    const Eigen::Vector2d q = Eigen::Rotation2Dd(turn) * (parent.at(start + sign * u) - origin);
    return Eigen::Vector3d(placed * Eigen::Vector3d(q.x(), q.y(), 0));
  };
  path = sample(at, 0, std::abs(length_m), parent_entity.is("IFCLINE") ? 1 : 4, scope);
  return scope.spend(path.points.size()) ? Result<Path>(path) : fail(segment, "too many points");
}

Result<Path> segmentsPath(const Entity& entity, Scope& scope) {
  Path path;
  for (const Entity& segment : entity.refs(0)) {
    const auto part = segmentPath(segment, scope);
    if (!part) return part;
    for (const auto& p : part->points)
      if (path.points.empty() || (path.points.back() - p).norm() > 1e-4) path.points.push_back(p);
  }
  if (path.points.size() < 2) return fail(entity, "the alignment has no length");
  return path;
}

}  // namespace

std::function<double(double)> curvatureFraction(const Entity& segment, Scope& scope) {
  const Entity parent_entity = segment.ref(4);
  const double start = segmentMeasure(segment[2], parent_entity, scope),
               length_m = segmentMeasure(segment[3], parent_entity, scope);
  const auto parent = parentOf(parent_entity, start, length_m, scope);
  const double step = 1e-4 * length_m;
  if (!parent || std::abs(step) < 1e-12) return [](double t) { return t; };
  const auto curvature = [heading = parent->heading, start, length_m, step](double t) {
    const double at = start + length_m * t;
    return (heading(at + step) - heading(at - step)) / (2 * step);
  };
  const double first = curvature(0), change = curvature(1) - first;
  if (!(std::abs(change) > 1e-6 * std::abs(first) + 1e-12)) return [](double t) { return t; };
  return [=](double t) { return (curvature(t) - first) / change; };
}

Result<Path> alignmentPlan(const Entity& entity, Scope& scope) { return segmentsPath(entity, scope); }

Result<Path> gradientCurve(const Entity& entity, Scope& scope) {
  const auto plan = curve(entity.ref(2), scope);
  if (!plan) return plan;
  const auto gradient = segmentsPath(entity, scope);
  if (!gradient) return gradient;
  // Every corner of either curve becomes a point: distance along the plan → height.
  const auto& g = gradient->points;
  std::size_t next = 0;
  const auto height = [&](double d) {
    while (next + 2 < g.size() && g[next + 1].x() < d) ++next;
    const double run = g[next + 1].x() - g[next].x();
    return run > 0 ? g[next].y() + (g[next + 1].y() - g[next].y()) * (d - g[next].x()) / run : g[next].y();
  };
  Path path;
  double at = 0;
  std::size_t corner = 0;
  for (std::size_t i = 0; i < plan->points.size(); ++i) {
    if (i > 0) {
      const Eigen::Vector3d from = plan->points[i - 1], step = plan->points[i] - from;
      const double run = step.head<2>().norm();
      for (; corner < g.size() && g[corner].x() < at + run; ++corner)
        if (g[corner].x() > at + 1e-6) {
          Eigen::Vector3d p = from + step * ((g[corner].x() - at) / run);
          p.z() = height(g[corner].x());
          appendPoint(path, p);
        }
      at += run;
    }
    Eigen::Vector3d p = plan->points[i];
    p.z() = height(at);
    appendPoint(path, p);
  }
  return path;
}

}  // namespace standpoint::ifc
