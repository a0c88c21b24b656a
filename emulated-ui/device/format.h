// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "emulated-ui/device/program.h"

namespace standpoint {

// Figures as instruments show them.
std::string clockText(double seconds);  // "4:34"
std::string bytesText(double bytes);    // "136.4 MB"
std::string pointsText(double points);  // "43.7 M"
// With `feet` lengths are in feet and inches, temperatures in degrees Fahrenheit.
constexpr double kMetresPerFoot = 0.3048;
std::string lengthText(double metres, bool feet);       // "12.34 m", "40.49 ft"
std::string smallLengthText(double metres, bool feet);  // "6.1 mm", "0.240 in"
std::string factText(const Fact& fact, FactUnit unit, bool feet = false);

}  // namespace standpoint
