// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>

#include "core/progress.h"
#include "core/result.h"
#include "emulated-ui/device/orders.h"

namespace standpoint {

// Thins a scan with a grid out to at most 512 columns, for the device's small picture.
Result<std::shared_ptr<const ScanPreview>> readPreview(const std::filesystem::path& file, Progress& progress);

}  // namespace standpoint
