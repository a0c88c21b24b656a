// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/georeference.h"
#include "importers/gltf/gltf_file.h"

namespace standpoint {

// How our GLB carries a georeference: /asset/extras/standpoint, doubles as JSON numbers that read back bit for bit. The
// coordinates of the file stay local, so that other programs, which compute in float, see them exactly.
nlohmann::json toJson(const Georeference& georeference);

// Nothing when the file is not one of ours.
std::optional<Georeference> readGltfGeoreference(GltfFile& file);

}  // namespace standpoint
