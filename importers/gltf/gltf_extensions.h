// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/report.h"
#include "importers/gltf/gltf_file.h"

namespace standpoint {

// A required extension that we do not know is a fault of the file; one that is only used, or that says what a scanned
// building at rest does not need, is named in the report.
void checkGltfExtensions(GltfFile& file, Report& report);

// What lies in the file and in no scene that is read: other scenes, animations, cameras, lights. `seen` says which
// nodes were.
void listGltfRest(GltfFile& file, const std::vector<bool>& seen, Report& report);

}  // namespace standpoint
