// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>

#include "editor/panels/panel.h"

namespace standpoint {

// The table of panels; within an area they stand in this order.
std::span<const Panel> panels();
Area areaOf(std::string_view panel, Workspace workspace);  // none: this workspace does not have it

}  // namespace standpoint
