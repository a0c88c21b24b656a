// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/walk.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/portable_math.h"
#include "emulated-ui/device/device.h"
#include "emulated-ui/device/effects.h"

namespace standpoint {

namespace {

constexpr double kReach_m = 0.5;   // from a known point: nearer than anybody misses it [P]
constexpr double kNothing = 1e-9;  // metres, seconds, radians

double cells_m2(const SeenMap& map, std::uint8_t what) {
  const auto seen =
      std::count_if(map.cells.begin(), map.cells.end(), [&](std::uint8_t cell) { return (cell & what) == what; });
  return static_cast<double>(seen) * map.cell_m * map.cell_m;
}

// The place is part of the way that is recorded.
void markPlace(WalkState& walk) {
  if (!walk.recording || !walk.at) return;
  const std::array<double, 3> here = {walk.at->front(), walk.at->back(), walk.recorded_s};
  if (!walk.way.empty() && here[2] - walk.way.back()[2] < kNothing) return;
  walk.way.push_back(here);
}

void passTime(WalkState& walk, const PaceLimits& most, double seconds) {
  if (!walk.recording) return;
  walk.recorded_s += seconds;
  if (isHurried(walk, most)) walk.hurried_s += seconds;
}

// From where they look to where they go, anticlockwise.
double turnTo(const WalkState& walk, const std::array<double, 2>& towards) {
  const auto& [x, y] = walk.ahead_of;
  return 2 * std::numbers::pi * portable::turnOf(x * towards[1] - y * towards[0], x * towards[0] + y * towards[1]);
}

void turnBy(WalkState& walk, double angle_rad) {
  double sine = 0, cosine = 1;
  portable::sinCos(angle_rad, sine, cosine);
  const auto [x, y] = walk.ahead_of;
  walk.ahead_of = {cosine * x - sine * y, sine * x + cosine * y};
}

// A part of the first leg; gives what it took.
double stepOn(WalkState& walk, const PaceLimits& most, double seconds) {
  const WalkLeg leg = walk.legs.front();
  walk.rested_s = 0;
  walk.rest_told = false;
  auto& [x, y] = *walk.at;
  const double dx = leg.x_m - x, dy = leg.y_m - y, length = std::sqrt(dx * dx + dy * dy);
  if (length < kNothing) {  // the step before ended here, but for rounding
    walk.at = {leg.x_m, leg.y_m};
    walk.legs.erase(walk.legs.begin());
    markPlace(walk);
    return 0;
  }
  const std::array<double, 2> towards = {dx / length, dy / length};
  const double angle = turnTo(walk, towards), rate = kTurn_rad_per_m * leg.speed_mps;
  if (walk.speed_mps == 0 && walk.turn_radps == 0) markPlace(walk);  // they stood until now
  if (std::abs(angle) > kNothing) {
    const double step = std::min(seconds, std::abs(angle) / rate);
    walk.turn_radps = rate, walk.speed_mps = 0;
    passTime(walk, most, step);
    if (step * rate >= std::abs(angle)) {
      walk.ahead_of = towards;
      markPlace(walk);
    } else {
      turnBy(walk, std::copysign(step * rate, angle));
    }
    return step;
  }
  const double step = std::min(seconds, length / leg.speed_mps);
  walk.turn_radps = 0, walk.speed_mps = leg.speed_mps;
  passTime(walk, most, step);
  if (step * leg.speed_mps >= length) {
    walk.at = {leg.x_m, leg.y_m};
    walk.legs.erase(walk.legs.begin());
    markPlace(walk);
  } else {
    x += towards[0] * leg.speed_mps * step;
    y += towards[1] * leg.speed_mps * step;
  }
  return step;
}

void forget(WalkState& walk) {
  walk.recording = false;
  walk.recorded_s = walk.hurried_s = 0;
  walk.way.clear();
  walk.pauses.clear();
  walk.fixes.clear();
  walk.seen.reset();
}

}  // namespace

double SeenMap::floor_m2() const { return cells_m2(*this, kFloor); }
double SeenMap::ceiling_m2() const { return cells_m2(*this, kCeiling); }

double SeenMap::bothShare() const {
  const double both = cells_m2(*this, kFloor | kCeiling), any = floor_m2() + ceiling_m2() - both;
  return any > 0 ? both / any : 0;
}

bool isHurried(const WalkState& walk, const PaceLimits& most) {
  return most.tooFast(walk.speed_mps) || most.turnsTooFast(walk.turn_radps);
}

void walkOn(WalkState& walk, const PaceLimits& most, double seconds) {
  while (seconds > kNothing && !walk.legs.empty() && walk.at) seconds -= stepOn(walk, most, seconds);
  if (!walk.legs.empty()) return;
  walk.speed_mps = walk.turn_radps = 0;
  walk.rested_s += std::max(0.0, seconds);
  passTime(walk, most, std::max(0.0, seconds));
}

double lengthOf(const WalkedWay& way) {
  double length = 0;
  for (std::size_t i = 1; i < way.size(); ++i)
    length += std::hypot(way[i][0] - way[i - 1][0], way[i][1] - way[i - 1][1]);
  return length;
}

void beginWalk(Device& device) {
  auto& walk = device.change().walk;
  forget(walk);
  walk.recording = true;
  walk.rested_s = 0;
  walk.rest_told = false;
  markPlace(walk);
  device.note("walk_started");
}

void pauseWalk(Device& device) {
  auto& walk = device.change().walk;
  walk.pauses.push_back({walk.recorded_s, walk.recorded_s});
  device.note("walk_paused");
}

void resumeWalk(Device& device) {
  auto& walk = device.change().walk;
  if (!walk.pauses.empty() && walk.pauses.back()[0] == walk.pauses.back()[1]) walk.pauses.back()[1] = walk.recorded_s;
}

void endWalk(Device& device) {
  auto& walk = device.change().walk;
  if (!walk.recording) return;
  resumeWalk(device);
  markPlace(walk);
  walk.recording = false;
  walk.legs.clear();
  device.note("walk_ended");
}

std::string pointInReach(const Device& device) {
  const auto& at = device.state().walk.at;
  if (!at) return {};
  const auto& control = device.state().control;
  for (const auto& point : control.targets) {
    const Eigen::Vector3d place = point.place_m + control.shift_m;
    if (std::hypot(place.x() - at->front(), place.y() - at->back()) <= kReach_m) return point.name;
  }
  return {};
}

std::optional<double> nearestFix_m(const Device& device) {
  const auto here = pointInReach(device);
  std::optional<double> nearest;
  if (here.empty()) return nearest;
  const auto& walk = device.state().walk;
  for (const auto& fix : walk.fixes) {
    const double away = std::hypot(fix.x_m - walk.at->front(), fix.y_m - walk.at->back());
    if (fix.point != here) nearest = std::min(nearest.value_or(away), away);
  }
  return nearest;
}

void fixWalk(Device& device) {
  auto& walk = device.change().walk;
  const auto name = pointInReach(device);
  if (name.empty()) return;
  std::erase_if(walk.fixes, [&](const WalkFix& fix) { return fix.point == name; });
  walk.fixes.push_back({name, walk.at->front(), walk.at->back(), walk.recorded_s});
  device.note("walk_fixed", name);
}

void dropWalk(Device& device) {
  forget(device.change().walk);
  device.note("walk_dropped");
}

void orderScene(Device& device) { device.give(SceneOrder{}); }

void orderWalk(Device& device) {
  beginScan(device);
  const auto& walk = device.state().walk;
  ScanOrder order = *device.state().running;
  order.walk = WalkOrder{
      walk.way,       walk.pauses, walk.fixes, device.value("closures") != "off", device.value("static_scans") == "on",
      walk.doors_open};
  device.change().running = order;
  device.give(std::move(order));
}

// Its picture stays with what was made of it.
void storeWalk(Device& device) {
  storeScan(device);
  auto& walk = device.change().walk;
  if (auto* setup = device.newestSetup(); setup != nullptr && setup->walk) setup->walk->seen = walk.seen;
  forget(walk);
}

}  // namespace standpoint
