// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/paced_way.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/motion/mechanisms.h"
#include "core/motion/rotation_vector.h"

namespace standpoint {

namespace {

constexpr double kTurned_s = 1;      // to turn back
constexpr double kWalks_mps = 0.15;  // below this nobody's direction is one
constexpr double kTurnsMost_radps = std::numbers::pi;

double wrapped(double radians) { return radians - kRadPerTurn * std::floor(radians / kRadPerTurn + 0.5); }

// Where they go at each place; nothing where they stand.
std::vector<std::optional<double>> directions(const std::vector<Eigen::Vector3d>& places, double step_s) {
  std::vector<std::optional<double>> found(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, places.size() - 1);
    const Eigen::Vector3d way = places[after] - places[before];
    if (way.head<2>().norm() > kWalks_mps * step_s * static_cast<double>(after - before))
      found[i] = kRadPerTurn * portable::turnOf(way.y(), way.x());
  }
  return found;
}

// Without jumps by whole turns; where they stand evenly from one direction to the next.
std::vector<double> headings(const std::vector<std::optional<double>>& directions) {
  std::vector<double> heading(directions.size(), 0);
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    if (!directions[i]) continue;
    if (!last) {
      std::fill_n(heading.begin(), i + 1, *directions[i]);
    } else {
      const double from = heading[*last], turn = wrapped(*directions[i] - from);
      for (std::size_t k = *last + 1; k <= i; ++k)
        heading[k] = from + turn * static_cast<double>(k - *last) / static_cast<double>(i - *last);
    }
    last = i;
  }
  if (last) std::fill(heading.begin() + static_cast<std::ptrdiff_t>(*last), heading.end(), heading[*last]);
  return heading;
}

// A head turns no faster than that; what is left of a turn comes later.
void slowTurns(std::vector<double>& heading, double step_s) {
  const double most = kTurnsMost_radps * step_s;
  for (std::size_t i = 1; i < heading.size(); ++i)
    heading[i] = heading[i - 1] + std::clamp(wrapped(heading[i] - heading[i - 1]), -most, most);
}

}  // namespace

Result<PoseSpline> pacedWay(std::span<const Eigen::Vector3d> places_m, double step_s, bool returns) {
  if (places_m.size() < 2) return failure(ErrorKind::unusable, "a way needs at least two places");
  std::vector<Eigen::Vector3d> places(places_m.begin(), places_m.end());
  if (returns) {
    places.insert(places.end(), static_cast<std::size_t>(std::ceil(kTurned_s / step_s)), places.back());
    places.insert(places.end(), places_m.rbegin(), places_m.rend());
  }
  std::vector<double> heading = headings(directions(places, step_s));
  slowTurns(heading, step_s);
  Trajectory samples;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double before = heading[i == 0 ? 0 : i - 1], after = heading[std::min(i + 1, heading.size() - 1)];
    samples.time_s.push_back(static_cast<double>(i) * step_s);
    samples.pose.push_back({unitRotation(rotationOf({0, 0, (before + 2 * heading[i] + after) / 4})), places[i]});
  }
  return PoseSpline::through(samples);
}

Result<PoseFunctionPtr> wayOnFoot(const PoseFunction& carried) {
  constexpr double kPlaces_s = 0.2, kSample_s = 0.1;
  constexpr int kReach = 6;  // samples to either side
  const double first = carried.first_s(), last = carried.last_s();
  if (!std::isfinite(last - first)) return failure(ErrorKind::unusable, "nobody walks for ever");
  const auto count = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil((last - first) / kPlaces_s)));
  std::vector<Eigen::Vector3d> places;
  for (std::size_t i = 0; i <= count; ++i) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int k = -kReach; k <= kReach; ++k)
      sum += carried.pose(first + static_cast<double>(i) * kPlaces_s + k * kSample_s).translation;
    places.push_back(sum / (2 * kReach + 1));
  }
  TRY_ASSIGN(auto way, pacedWay(places, kPlaces_s, false));
  return std::make_shared<const TimedPose>(std::make_shared<const PoseSpline>(std::move(way)), first, false);
}

}  // namespace standpoint
