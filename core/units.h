// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>

namespace standpoint {

constexpr double kRadPerDeg = std::numbers::pi / 180;
constexpr double kRadPerArcsec = kRadPerDeg / 3600;
constexpr double kRadPerTurn = 2 * std::numbers::pi;
constexpr double kRadPerGon = std::numbers::pi / 200;
constexpr double kSpeedOfLight_m_s = 299792458.0;

}  // namespace standpoint
