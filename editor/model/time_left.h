// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

namespace standpoint {

// Seconds that a job still takes if it goes on as it went; nothing before a tenth or two seconds of it are done.
std::optional<double> timeLeft(double fraction, double seconds_so_far);
std::string timeLeftText(double fraction, double seconds_so_far);  // "30 s left"; empty where it is unknown

}  // namespace standpoint
