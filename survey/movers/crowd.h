// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/mesh.h"
#include "core/motion/pose_function.h"
#include "core/progress.h"
#include "core/report.h"
#include "core/result.h"
#include "core/survey.h"

namespace standpoint {

// Centres of people's bodies are never nearer than this; unsourced.
inline constexpr double kBodyDiameter_m = 0.5;

// What a crowd makes way for: somebody or something on the floor, by the movers' clock.
struct CrowdObstacle {
  PoseFunctionPtr local_from_obstacle;
  double radius_m = kBodyDiameter_m / 2;
};

struct CrowdWish {
  std::string name;
  int count = 10;
  double speed_mps = 0;  // mean of those that people have who are alone; 0: usualSpeed()
  std::uint64_t seed = 1;
  double until_s = 0;  // of the movers' clock: so long they walk before they come back, if it is longer than usual
};

// People who walk about on the walkable surface, and give way to each other and to what is in their way: from a random
// place to another, with pauses, by social forces (mobile.md §6.1; all values are unsourced) in steps of 20 ms. The
// more people there are around somebody, the slower they want to go, and who walks straight on does so, within a tenth,
// by crowdedSpeed of the density. They keep to the surface, and who gets nowhere for a while goes elsewhere. They set
// off within the 20 s after 30 s before the movers' clock shows 0, go on until 90 s at least, each stops at a time of
// its own in the last 20 s, and they go back the way they came, and so on; for an hour, or two million places of all of
// them, at most, and the report says where that is less than `until_s`. Centres keep kBodyDiameter_m of each other
// whatever happens; what does not make way itself may come nearer.
//
// The same arguments give the same ways, on any processor. Time: half a minute for 1000 people, half a second for 100.
// Who finds no place to begin is left out, and the report says how many; an error where there is no walkable surface of
// 2 m² or more.
Result<std::vector<Mover>> crowdOn(const Mesh& walkable, const CrowdWish& wish,
                                   std::span<const CrowdObstacle> obstacles, Report& report, Progress& progress);

// The mean speed at a density, as a part of that without anybody else; 0 to 1. After Weidmann, unsourced.
double crowdedSpeed(double people_per_m2);

}  // namespace standpoint
