// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/environment.h"
#include "core/physical_material.h"
#include "core/survey.h"
#include "scanners/engine/ray_engine.h"

namespace standpoint {

// The environment that a scan sees: the model, with the targets standing in it as products of their own (class
// "Target") of stated reflectance.
struct ScanWorld {
  std::shared_ptr<const Environment> environment;
  MaterialAssignment assignment;
  std::vector<RoundInstance> balls;  // the targets that are spheres: rays meet the sphere, not its triangles
  std::vector<MovingBody> bodies;    // what moves (survey/movers/moving_world.h); nothing until it is added
};
ScanWorld scanWorld(const std::shared_ptr<const Environment>& model, const std::vector<Target>& targets,
                    const MaterialAssignment& assignment);

}  // namespace standpoint
