// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "emulated-ui/device/orders.h"

namespace standpoint {

// The setup's preview as a PNG in base64; reads the scan where the device has not shown it. Empty when it cannot be
// read.
std::string setupPicture(const StoredSetup& setup);

}  // namespace standpoint
