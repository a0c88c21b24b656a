// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "editor/shell/actions.h"

namespace standpoint {

// Those rows of the table of actions that change what is seen: of the model, of the camera, and of the window.
std::span<const Action> viewActions();

}  // namespace standpoint
