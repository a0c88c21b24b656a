// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/walk_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/motion/carriers.h"
#include "core/motion/gait.h"
#include "core/number_text.h"
#include "core/portable_math.h"
#include "core/random.h"
#include "project/survey/clicked_places.h"

namespace standpoint {

namespace {

constexpr double kKnot_s = 0.1;
constexpr int kRounded = 4;  // knots to either side over which a body's way is the mean of the straight one [P]
constexpr double kSampled_hz = 200;

// Of one place and time after the other: where, and looking which way.
struct Stand {
  double time_s = 0;
  Eigen::Vector3d place_m = Eigen::Vector3d::Zero();
  double yaw_rad = 0;  // goes on past half a turn
};

double turnFrom(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return 2 * std::numbers::pi * portable::turnOf(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

// Whoever stands before a leg turns to it meanwhile.
void lookAhead(std::vector<Stand>& stands) {
  Eigen::Vector2d before = Eigen::Vector2d::UnitX();
  double yaw = 0;
  for (std::size_t i = 0; i + 1 < stands.size(); ++i) {
    const Eigen::Vector2d leg = (stands[i + 1].place_m - stands[i].place_m).head<2>();
    if (leg.norm() > 1e-9) {
      yaw += turnFrom(before, leg);
      before = leg;
    }
    stands[i].yaw_rad = stands[i + 1].yaw_rad = yaw;
  }
  // The end of a leg looks as the leg did, until the turn begins.
  for (std::size_t i = 1; i + 1 < stands.size(); ++i)
    if ((stands[i + 1].place_m - stands[i].place_m).head<2>().norm() <= 1e-9) stands[i].yaw_rad = stands[i - 1].yaw_rad;
}

Stand between(const std::vector<Stand>& stands, double time_s) {
  const auto next = std::upper_bound(stands.begin(), stands.end(), time_s,
                                     [](double t, const Stand& stand) { return t < stand.time_s; });
  if (next == stands.begin()) return stands.front();
  if (next == stands.end()) return stands.back();
  const Stand &a = next[-1], &b = *next;
  const double part = (time_s - a.time_s) / (b.time_s - a.time_s);
  const bool stays = (b.place_m - a.place_m).head<2>().norm() <= 1e-9;
  return {time_s, a.place_m + part * (b.place_m - a.place_m),
          stays ? a.yaw_rad + part * (b.yaw_rad - a.yaw_rad) : b.yaw_rad};
}

Pose rounded(const std::vector<Stand>& stands, double time_s, double end_s) {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  double yaw = 0;
  for (int k = -kRounded; k <= kRounded; ++k) {
    const Stand at = between(stands, std::clamp(time_s + k * kKnot_s, 0.0, end_s));
    place += at.place_m / (2 * kRounded + 1);
    yaw += at.yaw_rad / (2 * kRounded + 1);
  }
  double sine = 0, cosine = 1;
  portable::sinCos(yaw / 2 - std::numbers::pi * 2 * std::round(yaw / (4 * std::numbers::pi)), sine, cosine);
  return {Eigen::Quaterniond(cosine, 0, 0, sine), place};
}

}  // namespace

const Carrier& carrierOfMount(const std::string& mount) { return *carrierOf(mount == "body" ? "backpack" : "hand"); }

Result<CarriedMotion> motionOf(const WalkedWay& way, const RayScene& scene, const Georeference& georeference,
                               const Carrier& carrier, const std::string& name, std::uint64_t seed) {
  if (way.size() < 2) return failure(ErrorKind::usage, "the scanner did not move", name);
  std::vector<std::string> texts;
  for (const auto& place : way) texts.push_back(exactText(place[0]) + "," + exactText(place[1]));
  const double height_m = carrier.limits.height_m;
  TRY_ASSIGN(const auto floor, waypointsOf(texts, scene, georeference, height_m, "walk"));
  std::vector<Stand> stands;
  for (std::size_t i = 0; i < way.size(); ++i)
    stands.push_back({way[i][2] - way.front()[2], floor[i].floor_m + Eigen::Vector3d(0, 0, height_m), 0});
  lookAhead(stands);
  const double end_s = stands.back().time_s;
  Trajectory knots;
  const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(end_s / kKnot_s - 1e-6)));
  for (std::size_t k = 0; k <= count; ++k) {
    knots.time_s.push_back(k < count ? static_cast<double>(k) * kKnot_s : end_s);
    knots.pose.push_back(rounded(stands, knots.time_s.back(), end_s));
  }
  TRY_ASSIGN(auto spline, PoseSpline::through(knots));
  CarriedMotion carried;
  carried.length_m = lengthOf(way);
  carried.path = std::make_shared<const PoseSpline>(std::move(spline));
  const CarriedPose pose(carried.path, carrier, seed, static_cast<std::uint32_t>(stableHash(name.c_str())));
  TRY_ASSIGN(auto truth, sampled(pose, kSampled_hz));
  carried.truth = std::make_shared<const PoseSpline>(std::move(truth));
  return carried;
}

}  // namespace standpoint
