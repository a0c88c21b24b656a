// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "editor/shell/actions.h"

namespace standpoint {

// Those rows of the table of actions that look into clouds and measure.
std::span<const Action> inspectActions();

}  // namespace standpoint
