// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "project/survey/survey_verbs.h"
#include "scanners/engine/ray_engine.h"

namespace standpoint {

// A station where the options say, checked as the verb `station` checks it; without a place where it adds most to what
// the stations of the document see. `scene` is of document.environment(). A place where no tripod can stand is an error
// of kind unusable.
Result<Station> placeStation(const Document& document, const RayScene& scene, const std::string& name,
                             const StationOptions& options, Report& report, Progress& progress);

}  // namespace standpoint
