// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "core/progress.h"
#include "core/result.h"
#include "emulated-ui/device/orders.h"

namespace standpoint {

// Thins a scan with a grid out to at most 512 columns, for the device's small picture.
Result<std::shared_ptr<const ScanPreview>> readPreview(const std::filesystem::path& file, Progress& progress);

// How a cell is shown. `colouring` is what the user chose: "luminance" (grey, what was not measured red), "true_colour"
// (the points' colours where the scan has them, the rest red), "panorama" (the same, the rest dark); empty: grey, the
// rest dark.
std::array<std::uint8_t, 3> pixelOf(const ScanPreview& preview, std::size_t cell, const std::string& colouring);

}  // namespace standpoint
