// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

namespace standpoint {

// Seconds that one job still takes if it goes on as it went. What is said of it only falls: where it goes slower than
// it began, what was said last stays while it is still near, and then nothing is said until it is true again.
class TimeLeft {
 public:
  // Nothing before a tenth and two seconds of it are done, or ten seconds and a fiftieth.
  std::optional<double> after(double fraction, double seconds_so_far);

 private:
  std::optional<double> said_s_;
};

std::string timeLeftText(std::optional<double> seconds);  // "30 s left"; empty where it is unknown

}  // namespace standpoint
