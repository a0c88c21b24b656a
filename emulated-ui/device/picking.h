// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "emulated-ui/device/device.h"

namespace standpoint {

// A target is picked in the picture of the set-up on view: the picture is moved under a cross that stays where it is,
// kind and name are said, and what is fitted is what is seen there. A name that is mistaken stays mistaken.

// Actions.
Result<void> beginPicking(Device& device, const std::string&);  // with the picture, and a name that is free
Result<void> aim(Device& device, const std::string& place);     // "u,v" of the picture
Result<void> pickAimed(Device& device, const std::string&);

}  // namespace standpoint
