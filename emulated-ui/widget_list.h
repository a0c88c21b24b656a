// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/result.h"

namespace standpoint {

// Every widget of every emulated device as a page: device, screen, label, kind, what it does, mark of its source, and
// the test that presses it (tests/emulated-ui/widgets_test.cpp goes by the same tables). A widget that stands on
// several screens of a device counts once.
Result<std::string> widgetList();

}  // namespace standpoint
