// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "emulated-ui/device/device.h"

namespace standpoint {

// Help in place: what the widget does (its word with a question mark: "resolution?"), what each of its choices costs in
// time, points and noise by the scanner's own data, and the way to it on the device ("Home › Scan settings").
std::string widgetHelp(const Device& device, const WidgetRow& row);

// The screens that one passes from where the device starts to this one, by their titles.
std::string wayTo(const Device& device, const std::string& screen);

}  // namespace standpoint
