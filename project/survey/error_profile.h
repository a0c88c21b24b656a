// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/georeference.h"
#include "core/motion/error_profiles.h"
#include "core/survey.h"
#include "project/survey/survey_verbs.h"

namespace standpoint {

// How the trajectory of an instrument that is mounted so errs; null: it is known exactly.
const ErrorProfile* errorProfile(TrajectoryError error, const std::string& mount);

// Those of a text file (survey/registration/registration.h), local frame; none where no file is named.
Result<std::vector<ControlPoint>> controlOf(const std::filesystem::path& file, const Georeference& georeference);

}  // namespace standpoint
