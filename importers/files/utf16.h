// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "importers/files/file_bytes.h"

namespace standpoint {

// Begins with UTF-16's byte-order mark.
bool isUtf16(const FileBytes& bytes);

// The text without the mark; a unit that is no character becomes '?'.
Result<std::string> utf8FromUtf16(const FileBytes& bytes);

}  // namespace standpoint
