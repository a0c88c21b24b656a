// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pointclouds/formats.h"

namespace standpoint {

// Points as lines of numbers. Only read: x y z, x y z intensity, x y z r g b, or x y z intensity r g b.
extern const CloudFormat kPts;  // a line with the number of points before each block of them
extern const CloudFormat kXyz;  // a line or two of words may stand first

namespace text_points {
Result<Report> readPts(const std::filesystem::path& file, PointSink& sink, Progress& progress);
Result<Report> readXyz(const std::filesystem::path& file, PointSink& sink, Progress& progress);
Result<CloudInfo> infoPts(const std::filesystem::path& file);
Result<CloudInfo> infoXyz(const std::filesystem::path& file);
}  // namespace text_points

}  // namespace standpoint
