// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/gltf/gltf_material.h"
#include "importers/gltf/gltf_model.h"

namespace standpoint {

// A surface as a glTF material without its image: what glTF has words for in them, so that any program sees it, and all
// of it bit for bit in `extras`.
tinygltf::Material gltfMaterial(const Surface& surface);

bool isFinite(const Surface& surface);

}  // namespace standpoint
