// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace standpoint {

class Actions;
class PanelStates;
struct CarriedTrajectory;
struct Model;

// The trajectories of a job in a list, with what takes one in from a file.
void drawTrajectories(const Model& model, Actions& actions);
// The fields of the chosen one, its waypoints and its scans.
void drawTrajectory(const Model& model, PanelStates& states, Actions& actions, const CarriedTrajectory& trajectory);

}  // namespace standpoint
