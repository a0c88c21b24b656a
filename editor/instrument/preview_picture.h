// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "editor/model/view_state.h"
#include "emulated-ui/device/orders.h"

namespace standpoint {

// A device's preview as pixels, its first row the uppermost, coloured as the device's user chose.
std::shared_ptr<const PixelPicture> pictureOf(const ScanPreview& preview, const std::string& colouring);

}  // namespace standpoint
