// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of curves between two of their own parameters (ISO 10303-42): what sweeps name the ends of their directrix by.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "importers/ifc/shapes/alignment.h"
#include "importers/ifc/shapes/curve.h"

namespace standpoint::ifc {
namespace {

// A polyline's parameter is the number of its point.
Path polylinePortion(const Path& path, double t0, double t1) {
  const auto& p = path.points;
  const auto at = [&](double t) {
    const double clamped = std::clamp(t, 0.0, static_cast<double>(p.size() - 1));
    const auto i = std::min(static_cast<std::size_t>(clamped), p.size() - 2);
    return Eigen::Vector3d(p[i] + (p[i + 1] - p[i]) * (clamped - static_cast<double>(i)));
  };
  Path part;
  appendPoint(part, at(t0));
  for (std::size_t i = 0; i < p.size(); ++i)
    if (static_cast<double>(i) > t0 && static_cast<double>(i) < t1) appendPoint(part, p[i]);
  appendPoint(part, at(t1));
  return part.points.size() >= 2 ? part : path;
}

// How much parameter a segment's curve takes, whose points are `path`; nothing where that is not known.
std::optional<double> span(const Entity& parent, const Path& path, const Scope& scope) {
  if (parent.is("IFCPOLYLINE")) return static_cast<double>(parent[0].size()) - 1;
  if (!parent.is("IFCTRIMMEDCURVE")) return {};
  const Entity basis = parent.ref(0);
  if (basis.is("IFCLINE"))
    if (const double unit = scope.metres(basis.ref(1)[1].number(1)); unit > 0) return length(path) / unit;
  if (basis.is("IFCCIRCLE"))
    if (const double radius = scope.metres(basis[1].number(0)); radius > 0) {
      // The chords are shorter than their arcs, by the same share each.
      const double chord = path.points.size() > 1 ? (path.points[1] - path.points[0]).norm() : 0;
      const double turn =
          2 * std::asin(std::min(chord / (2 * radius), 1.0)) * static_cast<double>(path.points.size() - 1);
      return turn / scope.model.units.angle_rad;
    }
  return {};
}

// A composite curve's parameter is the sum of what its segments take. A cut within a segment goes by its length, which
// is the same on lines and circles.
Result<Path> compositePortion(const Entity& composite, const Path& whole, double t0, double t1, Scope& scope) {
  Path part;
  double before = 0;
  for (const Entity& segment : composite.refs(0)) {
    const Entity parent = segment.ref(2);
    auto path = curve(parent, scope);
    if (!path) return path;
    const auto stated =
        segment.is("IFCREPARAMETRISEDCOMPOSITECURVESEGMENT") ? segment[3].number() : span(parent, *path, scope);
    if (!stated || !(*stated > 0)) {
      scope.report.warn(composite.place(),
                        "kept untrimmed: its parameters on " + std::string(parent.typeName()) + " are not known");
      return whole;
    }
    if (path->closed) path->points.push_back(path->points.front()), path->closed = false;
    if (segment[1].symbol() == "F") reverse(*path);
    const double from = std::max(t0 - before, 0.0), to = std::min(t1 - before, *stated);
    before += *stated;
    if (to <= from) continue;
    const bool by_points = parent.is("IFCPOLYLINE") && static_cast<double>(path->points.size()) == *stated + 1;
    const double metres = length(*path) / *stated;
    const Path piece = by_points ? polylinePortion(*path, from, to) : portion(*path, from * metres, to * metres);
    for (const auto& p : piece.points) appendPoint(part, p);
  }
  return part.points.size() >= 2 ? part : whole;
}

}  // namespace

Result<Path> trimmedDirectrix(const Entity& directrix, const Value& start, const Value& end, Scope& scope) {
  const double t0 = start.number(0);
  if (directrix.is("IFCCIRCLE") || directrix.is("IFCELLIPSE")) {
    const double from = t0 * scope.model.units.angle_rad, sweep = end.number(0) * scope.model.units.angle_rad - from;
    if (const auto c = conic(directrix, scope); c && sweep > 1e-9 && sweep < 2 * std::numbers::pi - 1e-9)
      return arc(*c, from, sweep, scope);
  }
  auto path = curve(directrix, scope);
  if (!path || path->closed || (!start.present() && !end.present())) return path;
  const double whole = length(*path);
  const bool alignment = directrix.is("IFCGRADIENTCURVE") || directrix.is("IFCSEGMENTEDREFERENCECURVE");
  if (alignment || start.typeName().ends_with("LENGTHMEASURE") || end.typeName().ends_with("LENGTHMEASURE")) {
    const auto along = [&](double file_length) {
      return alignment ? lengthTo(*path, scope.metres(file_length)) : scope.metres(file_length);
    };
    Path part = portion(*path, along(t0), end.present() ? along(end.number(0)) : whole);
    return part.points.size() >= 2 ? part : *path;
  }
  if (directrix.is("IFCLINE")) {  // one parameter is one vector long
    const Eigen::Vector3d from = path->points.front(), along = path->points.back() - from;
    return Path{{from + along * t0, from + along * end.number(1)}, false};
  }
  const bool composite = directrix.is("IFCCOMPOSITECURVE") && !directrix.refs(0).empty() &&
                         !directrix.refs(0).front().is("IFCCURVESEGMENT");
  // Of other curves the trims repeat what the curve says.
  if (!composite && !directrix.is("IFCPOLYLINE") && !directrix.is("IFCINDEXEDPOLYCURVE")) return path;
  const double t1 = end.number(composite ? 1e300 : static_cast<double>(path->points.size() - 1));
  // Many exporters write 0 … 1 for the whole of any curve, which is what they draw, too; or count segments.
  const bool normalised = t0 == 0 && (t1 == 1 || (composite && t1 == static_cast<double>(directrix.refs(0).size())));
  if (t1 <= t0 || normalised) return path;
  return composite ? compositePortion(directrix, *path, t0, t1, scope) : Result<Path>(polylinePortion(*path, t0, t1));
}

}  // namespace standpoint::ifc
