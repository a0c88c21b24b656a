// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "core/result.h"
#include "editor/viewport/offscreen.h"

namespace standpoint {

// A picture of each screen of each emulated device, OUT/<device>/<screen>.png, with a scan of the sample house on it,
// as large as the device is in kLayoutRoom. Returns how many were written.
Result<int> drawDevicePictures(const std::filesystem::path& folder, const std::string& language, float scale);

}  // namespace standpoint
