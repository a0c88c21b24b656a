// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/widgets/time_left.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "editor/words/words.h"

namespace standpoint {

namespace {

bool isEnough(double fraction, double seconds_so_far) {
  return (fraction >= 0.1 && seconds_so_far >= 2) || (fraction >= 0.02 && seconds_so_far >= 10);
}

}  // namespace

std::optional<double> TimeLeft::after(double fraction, double seconds_so_far) {
  constexpr double kNear = 1.5, kNear_s = 2;
  if (!(fraction > 0) || fraction >= 1 || !isEnough(fraction, seconds_so_far)) return std::nullopt;
  const double left = seconds_so_far / fraction * (1 - fraction);
  const double said = std::min(left, said_s_.value_or(left));
  said_s_ = said;
  if (left > std::max(kNear * said, said + kNear_s)) return std::nullopt;
  return said;
}

std::string timeLeftText(std::optional<double> seconds) {
  if (!seconds) return {};
  const auto whole = static_cast<long>(std::ceil(*seconds));
  return whole < 60 ? trf("{} s left", whole) : trf("{}:{:02} min left", whole / 60, whole % 60);
}

}  // namespace standpoint
