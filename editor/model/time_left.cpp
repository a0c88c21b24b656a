// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/time_left.h"

#include <cmath>

#include <fmt/format.h>

#include "editor/words/words.h"

namespace standpoint {

std::optional<double> timeLeft(double fraction, double seconds_so_far) {
  constexpr double kSoon = 0.1, kSoon_s = 2;
  if (!(fraction > 0) || fraction >= 1 || !(seconds_so_far > 0) || (fraction < kSoon && seconds_so_far < kSoon_s))
    return std::nullopt;
  return seconds_so_far / fraction * (1 - fraction);
}

std::string timeLeftText(double fraction, double seconds_so_far) {
  const auto left = timeLeft(fraction, seconds_so_far);
  if (!left) return {};
  const auto whole = static_cast<long>(std::ceil(*left));
  return whole < 60 ? trf("{} s left", whole) : trf("{}:{:02} min left", whole / 60, whole % 60);
}

}  // namespace standpoint
