// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/survey/error_profile.h"

#include <algorithm>
#include <string_view>

#include "survey/registration/registration.h"

namespace standpoint {

const ErrorProfile* errorProfile(TrajectoryError error, const std::string& mount) {
  const auto named = [](std::string_view id) -> const ErrorProfile* {
    return std::find_if(kErrorProfiles.begin(), kErrorProfiles.end(),
                        [&](const ErrorProfile& p) { return p.id == id; });
  };
  switch (error) {
    case TrajectoryError::none: return nullptr;
    case TrajectoryError::wearable: return named("wearable");
    case TrajectoryError::handheld: return named("handheld");
    case TrajectoryError::poor: return named("poor");
    case TrajectoryError::survey_mms: return named("survey-mms");
    case TrajectoryError::uav: return named("uav");
    case TrajectoryError::mems: return named("mems");
    case TrajectoryError::of_instrument: break;
  }
  if (mount == "body") return named("wearable");
  if (mount == "vehicle") return named("survey-mms");
  if (mount == "aircraft") return named("uav");
  return named("handheld");
}

Result<std::vector<ControlPoint>> controlOf(const std::filesystem::path& file, const Georeference& georeference) {
  if (file.empty()) return std::vector<ControlPoint>{};
  return readControlPoints(file, georeference.shift_m);
}

}  // namespace standpoint
