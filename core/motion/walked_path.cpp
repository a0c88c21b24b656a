// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/walked_path.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/motion/rotation_vector.h"
#include "core/motion/time_law.h"
#include "core/units.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kNearest_m = 0.01;  // two waypoints
constexpr double kLongest_m = 50e3;  // at a person's pace a million knots
constexpr double kStraight_m = 1;    // legs above this are kept straight
constexpr double kBend_m = 0.5;      // at each of their ends but for this
constexpr double kFine_m = 0.01;     // steps in which a length is measured
constexpr double kGrid_m = 0.05;
constexpr double kKnot_s = 0.05;
constexpr double kSlowest_mps = 0.02;  // through a cusp, where a path goes back the way it came

Vector3d vectorOf(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

Result<void> checkPath(std::span<const Waypoint> waypoints, const PathLimits& limits) {
  if (waypoints.size() < 2) return failure(ErrorKind::unusable, "a path needs at least two waypoints");
  for (const double limit : {limits.speed_mps, limits.turn_radps, limits.lateral_mps2, limits.acceleration_mps2,
                             limits.jerk_mps3, limits.blend_m})
    if (!std::isfinite(limit) || limit <= 0)
      return failure(ErrorKind::usage, "the limits of a path are numbers above zero");
  double length = 0;
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const auto& w = waypoints[i];
    const auto wrong = [&](const std::string& what) {
      return failure(ErrorKind::unusable, what, fmt::format("waypoint {}", i + 1));
    };
    if (!w.floor_m.allFinite() || !std::isfinite(w.look_rad.value_or(0))) return wrong("is not a number");
    if (!(w.stop_s >= 0) || w.stop_s > 86400) return wrong("stands for less than no time, or for more than a day");
    if (i == 0) continue;
    const double leg = (w.floor_m - waypoints[i - 1].floor_m).norm();
    if (leg < kNearest_m) return wrong(fmt::format("is where waypoint {} is; delete one of them", i));
    length += leg;
  }
  if (length > kLongest_m)
    return failure(ErrorKind::unusable, fmt::format("a path of {:.0f} km is too long; the longest is {:.0f} km",
                                                    length / 1000, kLongest_m / 1000));
  return {};
}

// The waypoints, and points on long legs that keep these straight.
class Curve {
 public:
  Curve(std::span<const Waypoint> waypoints, double height_m) {
    const Vector3d up(0, 0, height_m);
    add(waypoints[0].floor_m + up);
    waypoint_.push_back(0);
    for (std::size_t i = 1; i < waypoints.size(); ++i) {
      const Vector3d from = waypoints[i - 1].floor_m + up, leg = waypoints[i].floor_m + up - from;
      const double length = leg.norm();
      if (length > kStraight_m) {
        const double inner = length - 2 * kBend_m;
        const auto pieces = static_cast<int>(std::ceil(inner / kStraight_m));
        for (int k = 0; k <= pieces; ++k) add(from + leg * ((kBend_m + inner * k / pieces) / length));
      }
      add(from + leg);
      waypoint_.push_back(knots_.size() - 1);
    }
    fillSlopes<3>(knots_);
    measure();
  }

  double length_m() const { return by_way_.back().at; }
  std::vector<double> waypointWays() const {
    std::vector<double> ways;
    for (const std::size_t knot : waypoint_) ways.push_back(knot_way_[knot]);
    return ways;
  }

  struct Place {
    Vector3d position, tangent, bend;  // by the parameter: p, p', p''
  };
  Place at(double way_m) const {
    const std::size_t fine = pieceAt<1>(by_way_, 0, by_way_.size() - 1, way_m);
    const double u = between(by_way_[fine], by_way_[fine + 1], way_m)[0];
    const std::size_t i = pieceAt<3>(knots_, 0, knots_.size() - 1, u);
    const auto slopes = slopesBetween(knots_[i], knots_[i + 1], u);
    return {vectorOf(between(knots_[i], knots_[i + 1], u)), vectorOf(slopes[0]), vectorOf(slopes[1])};
  }

 private:
  void add(const Vector3d& place) {
    if (!knots_.empty()) {
      const double step = (place - vectorOf(knots_.back().value)).norm();
      if (step < 1e-6) return;  // a leg that is hardly longer than its bends
      knots_.push_back({knots_.back().at + step, {place.x(), place.y(), place.z()}, {}});
    } else {
      knots_.push_back({0, {place.x(), place.y(), place.z()}, {}});
    }
  }

  // The parameter over the way, whose slope is the inverse of the speed; the way by Simpson's rule.
  void measure() {
    double way = 0;
    const auto speedAt = [&](std::size_t i, double u) {
      return vectorOf(slopesBetween(knots_[i], knots_[i + 1], u)[0]).norm();
    };
    const auto note = [&](double u, double speed) { by_way_.push_back({way, {u}, {1 / std::max(speed, 0.05)}}); };
    note(0, speedAt(0, 0));
    knot_way_.push_back(0);
    for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
      const double width = knots_[i + 1].at - knots_[i].at;
      const auto steps = static_cast<int>(std::ceil(width / kFine_m));
      double speed = speedAt(i, knots_[i].at);
      for (int k = 0; k < steps; ++k) {
        const double u = knots_[i].at + width * (k + 1) / steps, step = width / steps;
        const double middle = speedAt(i, u - step / 2), end = speedAt(i, u);
        const double part = step * (speed + 4 * middle + end) / 6;
        speed = end;
        if (part < 1e-9) continue;  // in a cusp
        way += part;
        note(u, end);
      }
      knot_way_.push_back(way);
    }
  }

  std::vector<SplineKnot<3>> knots_;  // by lengths of chords
  std::vector<std::size_t> waypoint_;
  std::vector<SplineKnot<1>> by_way_;
  std::vector<double> knot_way_;
};

// The mean over a window around each place; beyond the ends it is what it is there.
std::vector<double> meanAround(const std::vector<double>& values, std::size_t reach) {
  std::vector<double> sum(values.size() + 1, 0), mean(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) sum[i + 1] = sum[i] + values[i];
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t from = i < reach ? 0 : i - reach, to = std::min(values.size(), i + reach + 1);
    const double before = static_cast<double>(reach - (i - from)), after = static_cast<double>(i + reach + 1 - to);
    mean[i] = (sum[to] - sum[from] + before * values.front() + after * values.back()) / (2.0 * reach + 1);
  }
  return mean;
}

// What the path is on a grid of its length.
struct Grid {
  double step_m = 0;
  std::vector<double> heading_rad, fastest_mps;
};

Grid gridOf(const Curve& curve, std::span<const Waypoint> waypoints, const std::vector<double>& ways,
            const PathLimits& limits) {
  const auto steps = static_cast<std::size_t>(std::ceil(curve.length_m() / kGrid_m));
  Grid grid{curve.length_m() / static_cast<double>(steps), {}, {}};
  std::vector<double> raw, curvature;
  std::size_t leg = 0;
  double ahead = 0;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double way = std::min(static_cast<double>(i) * grid.step_m, curve.length_m());
    while (leg + 2 < ways.size() && way >= ways[leg + 1]) ++leg;
    const auto place = curve.at(way);
    if (place.tangent.head<2>().norm() > 1e-6)
      ahead = kRadPerTurn * portable::turnOf(place.tangent.y(), place.tangent.x());
    double heading = waypoints[leg].look_rad.value_or(ahead);
    if (!raw.empty()) heading -= kRadPerTurn * std::floor((heading - raw.back()) / kRadPerTurn + 0.5);
    raw.push_back(heading);
    const double speed = std::max(place.tangent.norm(), 1e-3);
    curvature.push_back(place.tangent.cross(place.bend).norm() / (speed * speed * speed));
  }
  // Twice half the window: the turn begins and ends gently.
  const auto reach = static_cast<std::size_t>(std::floor(limits.blend_m / (4 * grid.step_m)));
  grid.heading_rad = meanAround(meanAround(raw, reach), reach);
  for (std::size_t i = 0; i <= steps; ++i) {
    const double turned = std::max(i > 0 ? std::abs(grid.heading_rad[i] - grid.heading_rad[i - 1]) : 0.0,
                                   i < steps ? std::abs(grid.heading_rad[i + 1] - grid.heading_rad[i]) : 0.0);
    double fastest = std::min(limits.speed_mps, std::sqrt(limits.lateral_mps2 / std::max(curvature[i], 1e-9)));
    fastest = std::min(fastest, limits.turn_radps * grid.step_m / std::max(turned, 1e-12));
    grid.fastest_mps.push_back(std::max(fastest, std::min(kSlowest_mps, limits.speed_mps)));
  }
  return grid;
}

std::vector<TimeLaw::Stop> stopsOf(std::span<const Waypoint> waypoints, const std::vector<double>& ways,
                                   const Grid& grid) {
  std::vector<TimeLaw::Stop> stops;
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    if (waypoints[i].stop_s <= 0) continue;
    const auto place =
        std::min(static_cast<std::size_t>(std::llround(ways[i] / grid.step_m)), grid.heading_rad.size() - 1);
    if (!stops.empty() && stops.back().place == place)
      stops.back().hold_s += waypoints[i].stop_s;
    else
      stops.push_back({place, waypoints[i].stop_s});
  }
  return stops;
}

}  // namespace

Result<WalkedPath> walkPath(std::span<const Waypoint> waypoints, const PathLimits& limits) {
  TRY(checkPath(waypoints, limits));
  const Curve curve(waypoints, limits.height_m);
  const auto ways = curve.waypointWays();
  const Grid grid = gridOf(curve, waypoints, ways, limits);
  const TimeLaw law(grid.fastest_mps, grid.step_m, stopsOf(waypoints, ways, grid), limits.acceleration_mps2,
                    limits.jerk_mps3);
  std::vector<SplineKnot<1>> heading;
  for (std::size_t i = 0; i < grid.heading_rad.size(); ++i)
    heading.push_back({static_cast<double>(i) * grid.step_m, {grid.heading_rad[i]}, {}});
  fillSlopes<1>(heading);

  Trajectory samples;
  const auto count = static_cast<std::size_t>(std::ceil(law.duration_s() / kKnot_s));
  for (std::size_t k = 0; k <= count; ++k) {
    const double time = law.duration_s() * static_cast<double>(k) / static_cast<double>(count);
    const double way = law.way_m(time);
    const std::size_t i = pieceAt<1>(heading, 0, heading.size() - 1, way);
    const double yaw = between(heading[i], heading[i + 1], way)[0];
    samples.time_s.push_back(time);
    samples.pose.push_back({unitRotation(rotationOf({0, 0, yaw})), curve.at(way).position});
  }
  TRY_ASSIGN(auto poses, PoseSpline::through(samples));
  WalkedPath path{std::move(poses), curve.length_m(), {}};
  for (const double way : ways) path.reached_s.push_back(law.reached_s(way));
  return path;
}

}  // namespace standpoint
