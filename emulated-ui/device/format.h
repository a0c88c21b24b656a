// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "emulated-ui/device/program.h"

namespace standpoint {

// Figures as instruments show them.
std::string clockText(double seconds);       // "4:34"
std::string bytesText(double bytes);         // "136.4 MB"
std::string pointsText(double points);       // "43.7 M"
std::string factText(const Fact& fact, FactUnit unit);

}  // namespace standpoint
