// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pointclouds/files/cloud_format.h"

namespace standpoint {

// The Point Cloud Library's PCD 0.7. Written: binary, single floats in the scanner's frame and the pose as viewpoint,
// so that a national grid does not spoil them; organised where there is a grid, each line of the "image" a scanner
// column.
extern const CloudFormat kPcd;

namespace pcd {
// Fields: x y z intensity, rgb packed as PCL does, label (the material's index), instance (the product's), time,
// returns and truth (PointTruth); comments hold the lines of scan_text.h. `organised`: missing points are NaN, and a
// cell holds one; else row and column are fields.
Result<std::unique_ptr<CloudWriter>> createWriter(const std::filesystem::path& file, bool organised = true);
// Text and binary; of compressed points only what to do about them.
Result<Report> read(const std::filesystem::path& file, PointSink& sink, Progress& progress);
Result<CloudInfo> info(const std::filesystem::path& file);  // reads no points
}  // namespace pcd

}  // namespace standpoint
