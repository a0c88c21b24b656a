// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string_view>

#include "core/motion/lean.h"
#include "core/motion/walked_path.h"
#include "core/units.h"

namespace standpoint {

// How a carrier shakes in one band of frequencies: standard deviations in the body frame.
struct ShakeBand {
  double lowest_hz = 0, highest_hz = 0;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  // along, across, up
  Eigen::Vector3d angle_rad = Eigen::Vector3d::Zero();   // roll, pitch, yaw
};

// What bears a scanner along a path: its pace, how much of a walker's gait reaches the scanner, and its own shaking.
struct Carrier {
  std::string_view id, name;
  PathLimits limits;
  double gait = 0;                  // of the amplitudes of a walker's trunk; 0: it does not walk
  Lean lean;                        // on its path
  std::array<ShakeBand, 3> shakes;  // of standard deviation 0 where it has fewer
  std::string_view source;          // of the figures, or that they have none
};

// The paces and heights above the floor are not sourced. Hand: a camera in a hand, motion capture (TUM RGB-D fr2_desk,
// 99 s), mobile.md §3.1; the others as they say.
inline const std::array<Carrier, 5> kCarriers = {{
    {"hand",
     "Hand",
     {},
     1,
     {},
     {{{0.3, 1, {0.015, 0.015, 0.007}, {0.65 * kRadPerDeg, 0.65 * kRadPerDeg, 1.5 * kRadPerDeg}},
       {1, 3, {0.00175, 0.00175, 0.00175}, {0.3 * kRadPerDeg, 0.3 * kRadPerDeg, 0.3 * kRadPerDeg}},
       {3, 10, {0.00035, 0.00035, 0.00035}, {0.11 * kRadPerDeg, 0.11 * kRadPerDeg, 0.11 * kRadPerDeg}}}},
     "measured on fr2_desk of the TUM RGB-D data set; pace and height unsourced"},
    {"backpack",
     "Backpack",
     {.height_m = 1.9},
     0.85,
     {},
     {{{0.3, 1, {0.005, 0.008, 0.003}, {0.5 * kRadPerDeg, 0.5 * kRadPerDeg, 0.8 * kRadPerDeg}},
       {2, 5, {0.001, 0.001, 0.0015}, {0.15 * kRadPerDeg, 0.15 * kRadPerDeg, 0.1 * kRadPerDeg}},
       {}}},
     "unsourced: gait by 0.7 to 1, a damped mount of 2 to 5 Hz"},
    {"trolley",
     "Trolley",
     {.height_m = 1.7, .speed_mps = 0.7},
     0,
     {},
     {{{3, 10, {0.0003, 0.0003, 0.0005}, {0.05 * kRadPerDeg, 0.05 * kRadPerDeg, 0.02 * kRadPerDeg}}, {}, {}}},
     "unsourced"},
    {"vehicle",
     "Vehicle",
     {.height_m = 2.2,
      .speed_mps = 8,
      .turn_radps = std::numbers::pi / 6,
      .lateral_mps2 = 2,
      .acceleration_mps2 = 1.5,
      .jerk_mps3 = 3,
      .blend_m = 3},
     0,
     {.roll = -0.09, .pitch = -0.05, .most_rad = 4 * kRadPerDeg, .response_s = 0.6, .axis_below_m = 1.7},
     {{{1, 2, {0, 0.002, 0.005}, {0.3 * kRadPerDeg, 0.3 * kRadPerDeg, 0.05 * kRadPerDeg}}, {}, {}}},
     "unsourced: body modes of 1 to 2 Hz, 5 mm and 0.3 degrees, on a city road; leans out of a bend by 5 degrees "
     "at 1 g, about an axis 0.5 m above the road"},
    {"uav",
     "UAV",
     {.height_m = 20,
      .speed_mps = 5,
      .turn_radps = std::numbers::pi / 4,
      .lateral_mps2 = 2,
      .acceleration_mps2 = 1.5,
      .jerk_mps3 = 3,
      .blend_m = 2},
     0,
     {.roll = 1, .pitch = 1, .most_rad = 30 * kRadPerDeg},
     {{{0.3, 1, {0.05, 0.05, 0.03}, {1.6 * kRadPerDeg, 1.6 * kRadPerDeg, 1 * kRadPerDeg}},
       {1, 3, {0.005, 0.005, 0.005}, {1.2 * kRadPerDeg, 1.2 * kRadPerDeg, 0.4 * kRadPerDeg}},
       {}}},
     "unsourced: attitude within 2 degrees on a survey flight, besides the lean of a coordinated turn; 1 to 3 Hz as an "
     "indoor flight (EuRoC V1_02)"},
}};

// Null where no carrier has that id.
inline const Carrier* carrierOf(std::string_view id) {
  for (const auto& carrier : kCarriers)
    if (carrier.id == id) return &carrier;
  return nullptr;
}

// Of the scanner above the floor: as stated, or the carrier's own where 0 is.
inline double carriedHeight_m(std::string_view carrier, double stated_m) {
  const Carrier* const known = carrierOf(carrier);
  return stated_m > 0 || known == nullptr ? stated_m : known->limits.height_m;
}

}  // namespace standpoint
