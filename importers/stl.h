// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/file_bytes.h"
#include "importers/importers.h"

namespace standpoint {

extern const Importer kStlImporter;

bool isBinaryStl(const FileBytes& bytes);

}  // namespace standpoint
