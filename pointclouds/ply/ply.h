// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pointclouds/files/cloud_format.h"

namespace standpoint {

// PLY of points alone. Written: binary little-endian, one scan in the file's frame, for tools that train on labelled
// points. Read: ASCII and binary of both byte orders.
extern const CloudFormat kPly;

namespace ply {
// Properties: double x y z, uchar red green blue, and what CloudCompare takes for scalars: float scalar_Intensity, int
// scalar_Label (the material's index), scalar_Product, scalar_Row and scalar_Column, double scalar_Time, uchar
// scalar_ReturnNumber and scalar_NumberOfReturns, double scalar_TrueX … and float scalar_TrueRange … (PointTruth).
// Open3D takes neither uint nor short. Comments hold the lines of scan_text.h, so that the scan comes back.
Result<std::unique_ptr<CloudWriter>> createWriter(const std::filesystem::path& file);

// The vertices' x y z, intensity and colour in any order and type; the report names what else they have. Of a mesh the
// vertices are the points.
Result<Report> read(const std::filesystem::path& file, PointSink& sink, Progress& progress);
Result<CloudInfo> info(const std::filesystem::path& file);  // reads no points
bool hasFaces(const std::filesystem::path& file);           // false also when it cannot be read
}  // namespace ply

}  // namespace standpoint
