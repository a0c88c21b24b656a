// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace standpoint {

struct Model;

// Brings what is selected into sight: from where one looks already if most of what can be seen of it is seen from
// there, else from another side, else with what lies over it cut away. The view before comes back with Alt+Left.
void showSelection(Model& model);

}  // namespace standpoint
