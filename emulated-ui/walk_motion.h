// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "core/georeference.h"
#include "core/motion/carriers.h"
#include "core/result.h"
#include "emulated-ui/device/walk.h"
#include "scanners/engine/ray_engine.h"
#include "survey/trajectories/carried_motion.h"

namespace standpoint {

// What carries a scanner that is mounted so: the hand, or the back where it is worn ("body").
const Carrier& carrierOfMount(const std::string& mount);

// The way as a body goes it with a scanner: on the floor of the scene, starts and turns rounded as nobody moves by
// jerks, gait and shaking of what carries it added, from 0 s on. The same for the same seed and name. An error says at
// which place nobody can walk.
Result<CarriedMotion> motionOf(const WalkedWay& way, const RayScene& scene, const Georeference& georeference,
                               const Carrier& carrier, const std::string& name, std::uint64_t seed);

}  // namespace standpoint
