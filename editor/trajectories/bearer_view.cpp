// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/trajectories/bearer_view.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/units.h"
#include "editor/camera/camera_flight.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kViewAngle_rad = 60 * kRadPerDeg;
constexpr double kNearest_m = 0.8, kStep_m = 0.2;
constexpr double kCome_s = 0.5;  // from where the camera was
constexpr double kCalm_s = 0.3;  // that it lags behind, so that no step and no corner jolts it

// Behind what is carried, and above it where there is room.
struct Place {
  double behind_m;
  std::array<double, 2> above_m;
};

Place usualPlace(const std::string& carrier) {
  if (carrier == "vehicle" || carrier == "uav") return {8, {2, 0.5}};
  return {2.6, {0.55, 0.15}};
}

// The last sample that is not later.
std::size_t sampleAt(const TrajectoryWay& way, double after_s) {
  const auto later = std::upper_bound(way.samples.begin(), way.samples.end(), after_s,
                                      [](double time_s, const PathSample& s) { return time_s < s.after_s; });
  return later == way.samples.begin() ? 0 : static_cast<std::size_t>(later - way.samples.begin()) - 1;
}

Vector3d placeAt(const TrajectoryWay& way, double after_s) {
  const std::size_t i = sampleAt(way, after_s);
  const PathSample& sample = way.samples[i];
  if (i + 1 == way.samples.size()) return sample.position_m;
  const PathSample& next = way.samples[i + 1];
  const double share = std::clamp((after_s - sample.after_s) / (next.after_s - sample.after_s), 0.0, 1.0);
  return sample.position_m + share * (next.position_m - sample.position_m);
}

// Where it sets out to, seen from above.
Vector3d firstHeading(const TrajectoryWay& way) {
  constexpr double kUnderWay_m = 0.3;
  for (const auto& sample : way.samples) {
    Vector3d gone = sample.position_m - way.samples.front().position_m;
    gone.z() = 0;
    if (gone.norm() > kUnderWay_m) return gone.normalized();
  }
  return Vector3d::UnitX();
}

// So far before the place along the way; before the way begins, straight on.
Vector3d placeBehind(const TrajectoryWay& way, double after_s, double behind_m) {
  Vector3d from = placeAt(way, after_s);
  for (std::size_t i = sampleAt(way, after_s) + 1; i-- > 0;) {
    const Vector3d leg = way.samples[i].position_m - from;
    if (leg.norm() >= behind_m) return from + leg * (behind_m / leg.norm());
    behind_m -= leg.norm();
    from = way.samples[i].position_m;
  }
  return from - behind_m * firstHeading(way);
}

// The farthest from which nothing hides it.
Vector3d eyeBehind(const TrajectoryWay& way, const Place& place, double after_s, const BearerView::Sees& sees) {
  const Vector3d carried = placeAt(way, after_s);
  for (double behind_m = place.behind_m; behind_m > kNearest_m; behind_m -= kStep_m)
    for (const double above_m : place.above_m) {
      const Vector3d eye = placeBehind(way, after_s, behind_m) + Vector3d(0, 0, above_m);
      if (sees(carried, eye)) return eye;
    }
  return placeBehind(way, after_s, kNearest_m);
}

void lookFrom(const Vector3d& eye, const Vector3d& target, Camera& camera) {
  constexpr double kLevel_m = 0.05;  // seen from above: right above or below it the heading stays
  const Vector3d way = target - eye;
  camera.orthographic = false;
  camera.view_angle_rad = kViewAngle_rad;
  camera.distance_m = std::max(way.norm(), kLevel_m);
  if (way.head<2>().norm() > kLevel_m) camera.azimuth_rad = std::atan2(-way.x(), way.y());
  camera.elevation_rad = std::asin(std::clamp(-way.z() / camera.distance_m, -1.0, 1.0));
  camera.target = eye + camera.forward() * camera.distance_m;
}

}  // namespace

void BearerView::begin(const Camera& camera) {
  from_ = camera;
  last_.reset();
  gone_s_ = 0;
}

bool BearerView::isMoved(const Camera& camera) const {
  constexpr double kSame = 1e-9;
  return last_ && ((camera.target - last_->target).norm() > kSame || (camera.eye() - last_->eye()).norm() > kSame);
}

void BearerView::follow(const TrajectoryWay& way, const std::string& carrier, double after_s, double passed_s,
                        const Sees& sees, Camera& camera) {
  const Vector3d eye = eyeBehind(way, usualPlace(carrier), after_s, sees), target = placeAt(way, after_s);
  const double share = last_ ? 1 - std::exp(-passed_s / kCalm_s) : 1;
  eye_ += share * (eye - eye_);
  target_ += share * (target - target_);
  gone_s_ += passed_s;
  lookFrom(eye_, target_, camera);
  if (const double come = gone_s_ / kCome_s; come < 1) camera = between(*from_, camera, come * come * (3 - 2 * come));
  last_ = camera;
}

}  // namespace standpoint
