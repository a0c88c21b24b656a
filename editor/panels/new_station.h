// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace standpoint {

class Actions;
class PanelStates;
struct Model;

// The numbers of the station that is being added, while its tool waits for a click: those of the last place under
// the pointer where one can stand, until somebody types others.
void drawNewStation(const Model& model, PanelStates& states, Actions& actions);

}  // namespace standpoint
