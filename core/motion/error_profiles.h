// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string_view>

#include "core/units.h"

namespace standpoint {

// How a system's solved trajectory errs (mobile.md §4.3), standard deviations all. One that finds its way by what it
// sees drifts: its position and heading walk randomly with the way. One with GNSS and INS does not; its errors are
// Gauss-Markov processes around zero. Roll and pitch never drift, as gravity holds them.
struct ErrorProfile {
  std::string_view id, name;
  double drift_m_sqrt_m = 0;      // position: metres by the root of metres of way, along each axis
  double heading_rad_sqrt_m = 0;  // heading, likewise
  double scale = 0;               // of the whole way's length
  double tilt_rad = 0, tilt_tau_s = 20;
  double plan_m = 0, height_m = 0, heading_rad = 0, tau_s = 120;  // where GNSS holds it; with these it does not drift
  double shake_m = 0, shake_rad = 0;  // within a scan, 5 to 20 Hz, after smoothing: this makes walls thick
  std::string_view source;

  bool drifts() const { return plan_m <= 0; }
};

inline constexpr std::array<ErrorProfile, 6> kErrorProfiles = {{
    {.id = "wearable",
     .name = "Wearable SLAM",
     .drift_m_sqrt_m = 0.0007,
     .heading_rad_sqrt_m = 0.001 * kRadPerDeg,
     .scale = 1e-4,
     .tilt_rad = 0.03 * kRadPerDeg,
     .shake_m = 0.001,
     .shake_rad = 0.02 * kRadPerDeg,
     .source = "fitted to the NavVis VLX sheet (6 mm in 500 m2); the rest unsourced"},
    {.id = "handheld",
     .name = "Handheld SLAM",
     .drift_m_sqrt_m = 0.0014,
     .heading_rad_sqrt_m = 0.002 * kRadPerDeg,
     .scale = 1e-4,
     .tilt_rad = 0.03 * kRadPerDeg,
     .shake_m = 0.002,
     .shake_rad = 0.02 * kRadPerDeg,
     .source = "fitted to the BLK2GO sheet (10 mm on a loop of two minutes) and to 15 to 20 mm against TLS; the rest "
               "unsourced"},
    {.id = "poor",
     .name = "Poor or hurried SLAM",
     .drift_m_sqrt_m = 0.0014,
     .heading_rad_sqrt_m = 0.005 * kRadPerDeg,
     .scale = 1e-4,
     .tilt_rad = 0.03 * kRadPerDeg,
     .shake_m = 0.003,
     .shake_rad = 0.02 * kRadPerDeg,
     .source = "unsourced"},
    {.id = "survey-mms",
     .name = "GNSS/INS of a survey vehicle",
     .tilt_rad = 0.005 * kRadPerDeg,
     .tilt_tau_s = 120,
     .plan_m = 0.020,
     .height_m = 0.030,
     .heading_rad = 0.015 * kRadPerDeg,
     .source = "unsourced"},
    {.id = "uav",
     .name = "GNSS/INS of a UAV",
     .tilt_rad = 0.025 * kRadPerDeg,
     .tilt_tau_s = 120,
     .plan_m = 0.035,
     .height_m = 0.050,
     .heading_rad = 0.08 * kRadPerDeg,
     .source = "unsourced"},
    {.id = "mems",
     .name = "GNSS/INS of MEMS sensors",
     .tilt_rad = 0.1 * kRadPerDeg,
     .tilt_tau_s = 120,
     .plan_m = 0.075,
     .height_m = 0.100,
     .heading_rad = 0.3 * kRadPerDeg,
     .source = "unsourced"},
}};

}  // namespace standpoint
