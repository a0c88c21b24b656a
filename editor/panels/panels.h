// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "editor/panels/panel.h"

namespace standpoint {

// The table of panels; within an area they stand in this order.
std::span<const Panel> panels();

}  // namespace standpoint
