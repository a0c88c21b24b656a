// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>

#include "core/result.h"
#include "editor/model/view_state.h"

namespace standpoint {

// Of a PNG file of at most 4096 pixels a side. Errors: unusable.
Result<std::shared_ptr<const PixelPicture>> readPngPicture(const std::filesystem::path& file);

}  // namespace standpoint
