// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pointclouds/files/cloud_format.h"

namespace standpoint {

// Points as lines of numbers: x y z, x y z intensity, x y z r g b, or x y z intensity r g b; or what a header names.
extern const CloudFormat kPts;  // a line with the number of points before each block of them
extern const CloudFormat kXyz;  // a line or two of words may stand first
extern const CloudFormat kCsv;  // written with the names of its columns first, all channels among them

namespace text_points {
// One scan in the file's frame, places to 0.01 mm.
Result<std::unique_ptr<CloudWriter>> createPtsWriter(const std::filesystem::path& file);
Result<std::unique_ptr<CloudWriter>> createXyzWriter(const std::filesystem::path& file);
Result<std::unique_ptr<CloudWriter>> createCsvWriter(const std::filesystem::path& file);
Result<Report> readPts(const std::filesystem::path& file, PointSink& sink, Progress& progress);
Result<Report> readXyz(const std::filesystem::path& file, PointSink& sink, Progress& progress);
Result<CloudInfo> infoPts(const std::filesystem::path& file);
Result<CloudInfo> infoXyz(const std::filesystem::path& file);
Result<CloudInfo> infoCsv(const std::filesystem::path& file);
}  // namespace text_points

}  // namespace standpoint
