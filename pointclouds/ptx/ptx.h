// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pointclouds/files/cloud_format.h"

namespace standpoint {

// Leica Cyclone's text of whole grids, scanner column by scanner column, bottom to top.
extern const CloudFormat kPtx;

namespace ptx {
// A point beside the first one of its grid cell does not fit and is listed in the report; points must come in the order
// of PointBlock. A scan without a grid becomes one row.
Result<std::unique_ptr<CloudWriter>> createWriter(const std::filesystem::path& file);
Result<Report> read(const std::filesystem::path& file, PointSink& sink, Progress& progress);
Result<CloudInfo> info(const std::filesystem::path& file);
}  // namespace ptx

}  // namespace standpoint
