// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "core/environment.h"
#include "core/report.h"
#include "importers/gltf_file.h"

namespace standpoint {

// The triangles of /meshes/<index> in the order of its primitives. Surfaces are the file's materials, one to one; a
// primitive without a material gets `no_material`. Primitives that share a POSITION accessor share their vertices.
// What is not a surface (points, lines) or not applied (morph targets) goes to the report.
Mesh readGltfMesh(GltfFile& file, std::size_t index, std::uint32_t no_material, Report& report);

// One surface for each of the file's materials, in order.
std::vector<Surface> readGltfSurfaces(GltfFile& file, Report& report);

// KHR_draco_mesh_compression: vertices and triangles of one primitive, or a fault of the file.
struct DracoPrimitive {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Triangle> triangles;
};
DracoPrimitive decodeDraco(GltfFile& file, const nlohmann::json& extension, const std::string& place);

// glTF colours are linear, ours are sRGB (IEC 61966-2-1).
float srgbFromLinear(float linear);
float linearFromSrgb(float srgb);

}  // namespace standpoint
