// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace standpoint {

struct Model;

// Looks straight down at a storey that is cut above tables and sills: that of whoever walks, else the one at the
// ground; when a plan is looked at already, the next storey up, and after the top one the lowest. Without storeys the
// cut is at half the height of what is shown.
void lookAtNextPlan(Model& model);

}  // namespace standpoint
