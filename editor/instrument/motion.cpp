// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/instrument/motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

namespace standpoint {

namespace {

constexpr double kOneTurn = 2 * std::numbers::pi;

struct NamedLamp {
  std::string_view name;
  LampColour colour;
};
constexpr std::array<NamedLamp, 6> kLamps = {{{"green", {70, 230, 110}},
                                              {"yellow", {255, 205, 60}},
                                              {"orange", {255, 150, 50}},
                                              {"red", {255, 66, 50}},
                                              {"blue", {70, 150, 255}},
                                              {"white", {245, 248, 255}}}};

// A head that takes pictures stops for each of them.
double stepped(double share, int shots) {
  constexpr double kStands = 0.6;  // of the time of each
  const double at = share * shots, whole = std::floor(at);
  const double turning = std::clamp((at - whole - kStands) / (1 - kStands), 0.0, 1.0);
  return (whole + turning * turning * (3 - 2 * turning)) / shots;
}

}  // namespace

std::optional<LampColour> lampAt(const std::string& lamp, double wall_s, bool ticks) {
  const auto space = lamp.find(' ');
  const std::string_view name = std::string_view(lamp).substr(0, space);
  const std::string_view mode =
      space == std::string::npos ? std::string_view() : std::string_view(lamp).substr(space + 1);
  const auto known = std::find_if(kLamps.begin(), kLamps.end(), [&](const auto& l) { return l.name == name; });
  if (known == kLamps.end()) return std::nullopt;
  if (!ticks) return known->colour;
  // Once a second: more than three flashes a second are unsafe for some.
  const double beat = wall_s - std::floor(wall_s);
  if ((mode == "flashing" || mode == "blinking") && beat > 0.55) return std::nullopt;
  LampColour colour = known->colour;
  if (mode == "pulsating")
    for (auto& c : colour) c = static_cast<std::uint8_t>(c * (0.65 + 0.35 * std::cos(kOneTurn * beat)));
  return colour;
}

SweepShape MotionOfDevice::shape(const Device& device) const {
  return sweepShapeOf(bodyOf(device.type().instrument.id), device.expected());
}

WorkingMotion MotionOfDevice::of(const Device& device, double wall_s, bool ticks) {
  const auto& state = device.state();
  const auto* phase = findPhase(device.type().definition, state.phase);
  if (phase_ != state.phase) {
    phase_ = state.phase;
    at_phase_rad_ = std::remainder(head_rad_, kOneTurn);
  }
  WorkingMotion motion;
  motion.lamp = phase->on ? lampAt(phase->lamp, wall_s, ticks) : std::nullopt;
  if (ticks && phase->lamp.ends_with("spinning")) {
    motion.ring_from = static_cast<int>((wall_s - std::floor(wall_s)) * kRingSegments);
    motion.ring_lit = 2;
  }
  const double lasts_s = device.number("phase.lasts");
  const double done = lasts_s > 0 ? std::clamp(state.elapsed_s / lasts_s, 0.0, 1.0) : 0;
  const auto shape_now = shape(device);
  turns_.reset();
  if (phase->laser && state.running) {
    turns_ = lasts_s > 0 ? state.laser_s / lasts_s : 0;
    head_rad_ = shape_now.from_rad + *turns_ * shape_now.turn_rad;
    motion.mirror_turns = ticks;
  } else if (phase->lasts_fact == "expected.imaging") {
    head_rad_ = at_phase_rad_ + kOneTurn * stepped(done, std::max(4, device.expected().camera.shots));
  } else if (phase->id == "calibrating") {  // the beam looks down, and the head turns once around
    head_rad_ = kOneTurn * done;
  } else if (state.running && phase->ends()) {  // back to where it was
    head_rad_ = at_phase_rad_ * (1 - done);
    motion.mirror_turns = ticks && phase->id == "spin_up";
  } else if (!state.running) {
    head_rad_ = 0;
  }
  motion.head_rad = head_rad_;
  return motion;
}

}  // namespace standpoint
