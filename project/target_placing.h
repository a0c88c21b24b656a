// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "project/survey_verbs.h"
#include "scanners/engine/ray_engine.h"
#include "scanners/instruments/target_kinds.h"

namespace standpoint {

// Shape and size as said by --type, --kind and --size; place and normal are not set.
Result<Target> targetArticleFrom(const TargetKinds& kinds, const TargetOptions& options);

// Where the target comes to be by --at (its centre), --on (a floor below its tripod) or --on-surface (stuck to what is
// nearest), in the local frame. `stands` says on what. Refused where it does not fit, is inside a solid, or has nothing
// to stand on.
Result<Target> placedTarget(const Document& document, const RayScene& scene, Target target,
                            const TargetOptions& options, std::string& stands, Report& report);

// "IfcWall #12 'west'"
std::string nameOf(const Product& product);

}  // namespace standpoint
