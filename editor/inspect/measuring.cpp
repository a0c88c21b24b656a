// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/inspect/measuring.h"

namespace standpoint {

bool isFull(const Measuring& measuring) { return measuring.points.size() >= rowOf(measuring.kind).most; }
bool isEnough(const Measuring& measuring) { return measuring.points.size() >= rowOf(measuring.kind).fewest; }

std::string hintOf(const Measuring& measuring) {
  const auto& row = rowOf(measuring.kind);
  const std::size_t there = measuring.points.size();
  if (row.most > row.fewest && isEnough(measuring))
    return "Click the next point, Enter to finish   Backspace to remove the last   Esc to leave";
  switch (measuring.kind) {
    case MeasurementKind::distance:
      return there == 0 ? "Click where the distance begins   Esc to leave"
                        : "Click where the distance ends   Esc to start over";
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
