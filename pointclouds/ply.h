// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pointclouds/formats.h"

namespace standpoint {

// Binary little-endian PLY of one scan in the file's frame, for tools that train on labelled points. Only written.
extern const CloudFormat kPly;

namespace ply {
// Properties: double x y z, float scalar_Intensity, uchar red green blue, int scalar_Label (the material's index) and
// int scalar_Product, int scalar_Row and scalar_Column. CloudCompare takes no others than "scalar_…", Open3D neither
// uint nor short; comments in the header name the labels.
Result<std::unique_ptr<CloudWriter>> createWriter(const std::filesystem::path& file);
}  // namespace ply

}  // namespace standpoint
