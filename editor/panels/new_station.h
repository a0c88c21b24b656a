// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace standpoint {

class Actions;
class PanelStates;
struct Model;

// The numbers of the station that is being added, while its tool waits for a click: those of the place under the
// pointer, until somebody types others.
void drawNewStation(const Model& model, PanelStates& states, Actions& actions);

}  // namespace standpoint
