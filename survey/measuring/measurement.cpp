// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/measuring/measurement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/decompositions.h"
#include "core/units.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;
using Corners = std::vector<Vector3d>;

constexpr double kCoincident_m = 1e-6;
constexpr std::array kKinds = {
    MeasurementKindRow{MeasurementKind::distance, "distance", 2, 2},
    MeasurementKindRow{MeasurementKind::height, "height", 2, 2},
    MeasurementKindRow{MeasurementKind::angle, "angle", 3, 3},
    MeasurementKindRow{MeasurementKind::area, "area", 3, 1000},
    MeasurementKindRow{MeasurementKind::plane, "plane", 3, 1000},
};

double angleBetween(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

// Along the normal of a polygon and as long as its area (Newell). That of a bent one is its area seen along the normal.
Vector3d vectorArea(const Corners& p) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < p.size(); ++i) sum += (p[i] - p[0]).cross(p[(i + 1) % p.size()] - p[0]);
  return sum / 2;
}

struct FittedPlane {
  Vector3d centre = Vector3d::Zero(), normal = Vector3d::UnitZ();
  double breadth_m = 0;  // how far the points reach across their longest line, as a standard deviation
  double distance(const Vector3d& p) const { return normal.dot(p - centre); }
};

FittedPlane fitted(const Corners& points) {
  FittedPlane plane;
  for (const auto& p : points) plane.centre += p - points[0];
  plane.centre = points[0] + plane.centre / static_cast<double>(points.size());
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const auto& p : points) moments += (p - plane.centre) * (p - plane.centre).transpose();
  const auto [values, axes] = principalAxes(moments / static_cast<double>(points.size()));
  plane.normal = axes.col(0);
  plane.breadth_m = std::sqrt(std::max(0.0, values[1]));
  return plane;
}

double farthest(const Corners& points, const FittedPlane& plane) {
  double most = 0;
  for (const auto& p : points) most = std::max(most, std::abs(plane.distance(p)));
  return most;
}

// With n - 3 degrees of freedom; 0 of three points.
double sigma(const Corners& points, const FittedPlane& plane) {
  if (points.size() < 4) return 0;
  double squares = 0;
  for (const auto& p : points) squares += plane.distance(p) * plane.distance(p);
  return std::sqrt(squares / static_cast<double>(points.size() - 3));
}

double steepness(const Vector3d& normal) { return std::asin(std::clamp(std::abs(normal.z()), 0.0, 1.0)); }

bool edgesCross(const Corners& points) {
  const Vector3d normal = fitted(points).normal;
  const Vector3d u = (points[1] - points[0]).normalized(), v = normal.cross(u);
  const auto flat = [&](std::size_t i) {
    const Vector3d d = points[i % points.size()] - points[0];
    return Eigen::Vector2d(d.dot(u), d.dot(v));
  };
  const auto side = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
  };
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = i + 2; k < points.size(); ++k) {
      if (i == 0 && k + 1 == points.size()) continue;  // neighbours round the end
      const auto a = flat(i), b = flat(i + 1), c = flat(k), d = flat(k + 1);
      if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) return true;
    }
  return false;
}

double perimeter(const Corners& points) {
  double length = 0;
  for (std::size_t i = 0; i < points.size(); ++i) length += (points[(i + 1) % points.size()] - points[i]).norm();
  return length;
}

}  // namespace

bool operator==(const Measurement& a, const Measurement& b) {
  return a.name == b.name && a.kind == b.kind && a.points == b.points && a.note == b.note;
}

std::span<const MeasurementKindRow> measurementKinds() { return kKinds; }

const MeasurementKindRow& rowOf(MeasurementKind kind) { return kKinds.at(static_cast<std::size_t>(kind)); }

std::vector<MeasuredFigure> figuresOf(const Measurement& measurement) {
  using U = MeasuredUnit;
  const auto& p = measurement.points;
  switch (measurement.kind) {
    case MeasurementKind::distance: {
      const Vector3d way = p[1] - p[0];
      return {{"distance", "Distance", way.norm()},
              {"horizontal", "Horizontal", way.head<2>().norm()},
              {"vertical", "Vertical", way.z()},
              {"slope", "Slope", std::atan2(way.z(), way.head<2>().norm()), U::radian}};
    }
    case MeasurementKind::height: {
      const Vector3d way = p[1] - p[0];
      return {{"height", "Height difference", way.z()}, {"horizontal_m", "Horizontal", way.head<2>().norm()}};
    }
    case MeasurementKind::angle: {
      const Vector3d a = p[0] - p[1], b = p[2] - p[1];
      return {{"angle", "Angle", angleBetween(a, b), U::radian},
              {"first_leg", "First leg", a.norm()},
              {"second_leg", "Second leg", b.norm()}};
    }
    case MeasurementKind::area: {
      const Vector3d area = vectorArea(p);
      return {{"area", "Area", area.norm(), U::square_metre},
              {"plan_area", "Area in plan", std::abs(area.z()), U::square_metre},
              {"perimeter", "Perimeter", perimeter(p)},
              {"out_of_plane", "Out of plane", farthest(p, fitted(p)), U::millimetre}};
    }
    case MeasurementKind::plane: {
      const FittedPlane plane = fitted(p);
      const double steep = steepness(plane.normal);
      const bool level = steep > std::numbers::pi / 4;
      return {{"tilt", level ? "Tilt from level" : "Tilt from plumb", level ? std::numbers::pi / 2 - steep : steep,
               U::radian},
              {"sigma", "Sigma", sigma(p, plane), U::millimetre},
              {"max", "Largest residual", farthest(p, plane), U::millimetre}};
    }
  }
  return {};
}

std::string figureText(const MeasuredFigure& figure) {
  const auto written = [&](double value, int decimals, const char* unit) {
    const double least = std::pow(10, -decimals) / 2;  // what would be written as -0
    return fmt::format("{:.{}f}{}", std::abs(value) < least ? 0.0 : value, decimals, unit);
  };
  switch (figure.unit) {
    case MeasuredUnit::metre: return written(figure.value, 3, " m");
    case MeasuredUnit::millimetre: return written(figure.value * 1000, 1, " mm");
    case MeasuredUnit::radian: return written(figure.value / kRadPerDeg, 2, "°");
    case MeasuredUnit::square_metre: return written(figure.value, 2, " m²");
  }
  return {};
}

Result<void> checkMeasurement(const Measurement& measurement) {
  const auto& row = rowOf(measurement.kind);
  const auto& p = measurement.points;
  if (p.size() < row.fewest || p.size() > row.most)
    return failure(ErrorKind::usage,
                   row.fewest == row.most
                       ? fmt::format("{} needs {} points; {} given", row.name, row.fewest, p.size())
                       : fmt::format("{} needs {} points or more; {} given", row.name, row.fewest, p.size()));
  for (const auto& point : p)
    if (!point.allFinite()) return failure(ErrorKind::usage, "a coordinate is no number");
  for (std::size_t i = 0; i + 1 < p.size(); ++i)
    if ((p[i + 1] - p[i]).norm() < kCoincident_m)
      return failure(ErrorKind::usage, fmt::format("points {} and {} are the same", i + 1, i + 2));
  if (measurement.kind != MeasurementKind::area && measurement.kind != MeasurementKind::plane) return {};
  if (fitted(p).breadth_m < kCoincident_m)
    return failure(ErrorKind::usage, "the points lie on one line: add one beside it");
  if (measurement.kind == MeasurementKind::area && edgesCross(p))
    return failure(ErrorKind::usage, "edges of the polygon cross: click its corners in their order");
  return {};
}

std::string measurementText(const Measurement& measurement, const Vector3d& shift_m) {
  std::string text = fmt::format("{}\t{}\n", measurement.name, rowOf(measurement.kind).name);
  for (const auto& figure : figuresOf(measurement)) text += fmt::format("{}\t{}\n", figure.label, figureText(figure));
  for (std::size_t i = 0; i < measurement.points.size(); ++i) {
    const Vector3d at = measurement.points[i] + shift_m;
    text += fmt::format("Point {}\t{:.3f}\t{:.3f}\t{:.3f}\n", i + 1, at.x(), at.y(), at.z());
  }
  if (!measurement.note.empty()) text += measurement.note + "\n";
  return text;
}

}  // namespace standpoint
