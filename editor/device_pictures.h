// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "core/result.h"
#include "editor/viewport/offscreen.h"

namespace standpoint {

constexpr std::array<float, 2> kDevicePicture = {460, 640};  // points

// A picture of each screen of each emulated device, OUT/<device>/<screen>.png, with a scan of the sample house on it.
// Returns how many were written.
Result<int> drawDevicePictures(Offscreen& offscreen, const std::filesystem::path& folder, const std::string& language,
                               float scale);

}  // namespace standpoint
