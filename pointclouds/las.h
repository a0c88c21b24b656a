// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pointclouds/formats.h"

namespace standpoint {

// ASPRS LAS 1.0 to 1.4, all point formats. Only read; of a compressed file (LAZ) only what is in the way.
extern const CloudFormat kLas;
extern const CloudFormat kLaz;

namespace las {
// Position, intensity and colour; the report names the fields that stay behind. One scan, without a grid.
Result<Report> read(const std::filesystem::path& file, PointSink& sink, Progress& progress);
Result<CloudInfo> info(const std::filesystem::path& file);  // reads no points
}  // namespace las

}  // namespace standpoint
