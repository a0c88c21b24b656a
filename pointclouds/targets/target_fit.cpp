// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/targets/target_fit.h"

#include <algorithm>
#include <array>

namespace standpoint {

namespace {

struct Reason {
  NoFit why;
  const char* words;
};
constexpr std::array kReasons = {
    Reason{NoFit::few_points, "too few points"},
    Reason{NoFit::other_radius, "wrong radius"},
    Reason{NoFit::mixed, "mixed with background or partly hidden"},
    Reason{NoFit::parts, "the points do not form a sphere of this radius"},
    Reason{NoFit::no_pattern, "no pattern of two white and two black squares"},
    Reason{NoFit::no_intensity, "the scan has no intensity"},
    Reason{NoFit::two, "two candidates"},
    Reason{NoFit::none, "no target found near the predicted position"},
};

}  // namespace

Error noFit(NoFit why, const std::string& more) {
  const auto* row = std::find_if(kReasons.begin(), kReasons.end(), [&](const Reason& r) { return r.why == why; });
  return {ErrorKind::unusable, row->words + more, {}};
}

NoFit noFitOf(const Error& error) {
  const auto* row = std::find_if(kReasons.begin(), kReasons.end(),
                                 [&](const Reason& r) { return error.message.starts_with(r.words); });
  return row == kReasons.end() ? NoFit::none : row->why;
}

}  // namespace standpoint
