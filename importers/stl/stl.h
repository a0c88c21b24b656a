// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/files/file_bytes.h"
#include "importers/files/importer.h"

namespace standpoint {

extern const Importer kStlImporter;

// The size that the count of triangles says: whatever a file is called, it is one then.
bool hasSizeOfBinaryStl(const FileBytes& bytes);
// Of a file that is called .stl: binary, whole or not, and no text.
bool isBinaryStl(const FileBytes& bytes);

}  // namespace standpoint
