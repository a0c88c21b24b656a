// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/result.h"
#include "core/survey.h"
#include "survey/scanning/scan_world.h"

namespace standpoint {

// Puts what moves into a world: people and vehicles as products of their own (classes "Person" and "Vehicle"), and of
// the model's products those that turn or slide. They are in the environment at rest and in `bodies` as they move. An
// error names the mover.
Result<void> addMovers(const std::vector<Mover>& movers, ScanWorld& world);

// Where who carries a scanner walks, by the trajectory's clock.
PoseFunctionPtr operatorPath(const PoseFunctionPtr& scanner_path, double height_m, bool carried_in_front);
// Their limbs, in the order of kLimbs.
std::vector<PoseFunctionPtr> operatorLimbs(const PoseFunctionPtr& scanner_path, double height_m, bool carried_in_front);
// Who carries a scanner: walks behind it, or below it, along its path without gait and shaking (class "Operator"). The
// path's poses are of the scanner, `height_m` above the floor; `ahead_s`: the movers' clock of the trajectory's.
void addOperator(const PoseFunctionPtr& scanner_path, double height_m, bool carried_in_front, double ahead_s,
                 ScanWorld& world);

// The ways of people and vehicles as poses on the floor, by the movers' clock.
Result<PoseFunctionPtr> moverPath(const Mover& mover);

// Where a kind has its own.
double usualSpeed(MoverKind kind);  // m/s, of what turns rad/s

}  // namespace standpoint
