// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/files/file_bytes.h"
#include "importers/files/importer.h"

namespace standpoint {

extern const Importer kStlImporter;

bool isBinaryStl(const FileBytes& bytes);

}  // namespace standpoint
