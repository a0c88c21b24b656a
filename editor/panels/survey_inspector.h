// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace standpoint {

class Actions;
class PanelStates;
struct Model;

// What is chosen in the survey and can be edited: a station with its scans, a target or an underlay, and the distance
// that was measured. False when there is none.
bool drawSurveyInspector(const Model& model, PanelStates& states, Actions& actions);

}  // namespace standpoint
