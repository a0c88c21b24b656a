// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/georeference.h"
#include "core/motion/error_profiles.h"
#include "core/survey.h"
#include "project/survey/survey_verbs.h"
#include "survey/trajectories/carried_motion.h"

namespace standpoint {

// How the trajectory of an instrument that is mounted so errs; null: it is known exactly.
const ErrorProfile* errorProfile(TrajectoryError error, const std::string& mount);

// Those of a text file (survey/registration/registration.h), local frame; none where no file is named.
Result<std::vector<ControlPoint>> controlOf(const std::filesystem::path& file, const Georeference& georeference);

// How a verb's options have a trajectory solved that `profile` says the error of; those have closures, anchors and
// control. An error names the file of control points.
template <class Options>
Result<MotionSolving> motionSolving(const Options& options, const ErrorProfile* profile,
                                    const Georeference& georeference, double max_range_m) {
  TRY_ASSIGN(auto control, controlOf(options.control, georeference));
  return MotionSolving{.profile = profile,
                       .closures = options.closures == Switch::on,
                       .anchors = options.anchors == Switch::on,
                       .control = std::move(control),
                       .max_range_m = max_range_m};
}

}  // namespace standpoint
