// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ctime>
#include <string>

#include "core/result.h"

namespace standpoint {

// Moments of files are UTC, "2026-11-22T10:15:00Z": as texts they are in the order of time.
std::string utcText(std::time_t moment);
std::string utcNow();
// From "2026-12-01T18:00" (of this computer's time zone), "2026-12-01" (the end of that day), or with a Z (UTC).
Result<std::string> utcFrom(const std::string& text, const std::string& option);
// As people of this computer's time zone read it: "2026-12-01 18:00".
std::string localText(const std::string& utc);

}  // namespace standpoint
