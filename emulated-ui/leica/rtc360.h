// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "emulated-ui/menu.h"

namespace standpoint {

// The RTC360's touch display: home, jobs, scan settings, scanning, stored setups, status.
// States: off → booting → ready → scanning (one or two passes) → photographing → storing → ready.
Result<std::unique_ptr<Menu>> makeRtc360(const Instrument& instrument);

}  // namespace standpoint
