// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/motion/error_profiles.h"
#include "project/survey/survey_verbs.h"

namespace standpoint {

// How the trajectory of an instrument that is mounted so errs; null: it is known exactly.
const ErrorProfile* errorProfile(TrajectoryError error, const std::string& mount);

}  // namespace standpoint
