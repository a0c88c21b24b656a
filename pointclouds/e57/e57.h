// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pointclouds/e57/e57_coordinates.h"
#include "pointclouds/files/cloud_format.h"

namespace standpoint {

// ASTM E2807. Written as single floats, so that a PointBlock returns bit for bit, or in one of its variants.
extern const CloudFormat kE57;

namespace e57 {
Result<std::unique_ptr<CloudWriter>> createWriter(const std::filesystem::path& file,
                                                  Coordinates kind = Coordinates::cartesian);
Result<Report> read(const std::filesystem::path& file, PointSink& sink, Progress& progress);
Result<CloudInfo> info(const std::filesystem::path& file);
}  // namespace e57

}  // namespace standpoint
