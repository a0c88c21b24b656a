// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "core/result.h"

namespace standpoint::ifc {

// The text of a STEP file: as it is, or unpacked when it is gzip or a zip archive (.ifczip: its first .ifc member).
Result<std::string> readStepBytes(const std::filesystem::path& file);

}  // namespace standpoint::ifc
