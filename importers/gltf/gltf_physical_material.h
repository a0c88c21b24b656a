// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include "core/physical_material.h"

namespace standpoint {

// The extension that carries the physics of a surface in a glTF material; docs/reference/formats/gltf.md has its
// schema.
constexpr const char* kGltfPhysicalMaterial = "STANDPOINT_physical_material";

nlohmann::json gltfPhysicalMaterial(const PhysicalMaterial& material);

}  // namespace standpoint
