// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/inspect/measuring.h"

#include <cmath>
#include <utility>

namespace standpoint {

namespace {

constexpr double kParallel = 0.9994;  // cosine of 2°
constexpr double kSameFace_m = 0.002;

}  // namespace

bool isFull(const Measuring& measuring) { return measuring.points.size() >= rowOf(measuring.kind).most; }
bool isEnough(const Measuring& measuring) { return measuring.points.size() >= rowOf(measuring.kind).fewest; }

std::string hintOf(const Measuring& measuring) {
  const auto& row = rowOf(measuring.kind);
  const std::size_t there = measuring.points.size();
  if (row.most > row.fewest && isEnough(measuring))
    return "Click the next point, Enter to finish   Backspace to remove the last   Esc to leave";
  switch (measuring.kind) {
    case MeasurementKind::distance:
      return there == 0                    ? "Click where the distance begins   Ctrl not to snap   Esc to leave"
             : !towardsOpposite(measuring) ? "Click where the distance ends   Ctrl not to snap   Esc to start over"
                                           : "Click where the distance ends, or press Enter for the face opposite   "
                                             "Esc to start over";
    case MeasurementKind::height:
      return there == 0 ? "Click the first point   Esc to leave"
                        : "Click the point whose height above it you want   Esc to start over";
    case MeasurementKind::angle:
      return there == 0   ? "Click a point on the first leg   Esc to leave"
             : there == 1 ? "Click the corner   Esc to start over"
                          : "Click a point on the second leg   Esc to start over";
    case MeasurementKind::area: return "Click the corners one after the other   Esc to leave";
    case MeasurementKind::plane: return "Click three points or more on the plane   Esc to leave";
  }
  return {};
}

Measuring with(Measuring measuring, const MeasurablePlace& place) {
  if (measuring.points.empty()) measuring.faces = place.normals;
  measuring.points.push_back(place.position);
  measuring.square = place.square;
  return measuring;
}

MeasurablePlace squared(const Measuring& measuring, MeasurablePlace place) {
  if (measuring.kind != MeasurementKind::distance || measuring.points.size() != 1) return place;
  if (place.snap == Snap::edge || place.snap == Snap::corner) return place;
  const Eigen::Vector3d way = place.position - measuring.points[0];
  for (const auto& face : measuring.faces)
    for (const auto& other : place.normals) {
      const double apart = face.dot(way);
      if (std::abs(face.dot(other)) < kParallel || std::abs(apart) < kSameFace_m) continue;
      place.position = measuring.points[0] + face * apart;
      place.square = true;
      return place;
    }
  return place;
}

std::optional<Eigen::Vector3d> towardsOpposite(const Measuring& measuring) {
  if (measuring.kind != MeasurementKind::distance || measuring.points.size() != 1 || measuring.faces.size() != 1)
    return std::nullopt;
  return measuring.faces[0];
}

std::optional<Measurement> measuredSoFar(const Measuring& measuring, const std::optional<Eigen::Vector3d>& next) {
  Measurement m{{}, measuring.kind, measuring.points, {}};
  if (next && !isFull(measuring)) m.points.push_back(*next);
  if (!checkMeasurement(m)) return std::nullopt;
  return m;
}

Eigen::Vector3d labelPlace(const Measurement& measurement) {
  if (measurement.kind == MeasurementKind::angle) return measurement.points[1];
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& p : measurement.points) sum += p;
  return sum / static_cast<double>(measurement.points.size());
}

}  // namespace standpoint
