// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/files/file_bytes.h"
#include "importers/files/importer.h"

namespace standpoint {

extern const Importer kStlImporter;

// The size that the count of triangles says: whatever a file is called, it is one then.
bool hasSizeOfBinaryStl(const FileBytes& bytes);

}  // namespace standpoint
