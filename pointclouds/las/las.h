// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pointclouds/files/cloud_format.h"

namespace standpoint {

// ASPRS LAS: 1.0 to 1.4 and all point formats are read, 1.4 with point formats 6 to 8 is written; of a compressed file
// (LAZ) only what is in the way.
extern const CloudFormat kLas;
extern const CloudFormat kLaz;

namespace las {
// All scans in one file, in the file's frame and steps of 0.1 mm; a point's source is its station's number from 1.
// Labels, grid and truth are extra bytes, and a record of ours behind the points says the rest, so that the scans come
// back.
Result<std::unique_ptr<CloudWriter>> createWriter(const std::filesystem::path& file, bool near_infrared = false);
// Position, intensity, colour, time, returns; the report names the fields that stay behind. One scan, without a grid,
// unless the file is ours.
Result<Report> read(const std::filesystem::path& file, PointSink& sink, Progress& progress);
Result<CloudInfo> info(const std::filesystem::path& file);  // reads no points
}  // namespace las

}  // namespace standpoint
