// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/environment.h"
#include "core/points.h"
#include "core/progress.h"
#include "core/report.h"
#include "core/result.h"
#include "pointclouds/files/cloud_format.h"

namespace standpoint {

// The table of formats; a new one is one file and one line in formats.cpp.
std::span<const CloudFormat> cloudFormats();
const CloudFormat* cloudFormatFor(const std::filesystem::path& file);  // by extension; null when unknown
// Of the variant `as`, or of the format itself when that is empty.
Result<CloudFormat::Writer> writerOf(const CloudFormat& format, const std::string& as);
// As cloudFormatFor, but looks into what can be either: a PLY with faces is a model, and the answer null.
const CloudFormat* readableCloudFormat(const std::filesystem::path& file);

// Streams every scan of a file to `sink`, whatever its format: as CloudFormat::read.
Result<Report> readCloud(const std::filesystem::path& file, PointSink& sink, Progress& progress);

struct CloudExtent {
  std::string format;
  std::uint64_t points = 0;
  Bounds bounds_file_m;  // of the points in the file's own frame, poses applied; empty without points
  std::string crs;       // as in CloudInfo
  Report report;
};
// Reads all points once, in memory that does not grow with them.
Result<CloudExtent> measureCloud(const std::filesystem::path& file, Progress& progress);

// Writers make the file by PartFile, so a full disk or a crash leaves the old one as it was.

// Copies all scans of the files IN (one at least), in this order, to OUT; OUT's format must be writable. When OUT
// cannot hold many scans and there are several, each gets its own file: name-<station>.ext. `as` names a variant of
// OUT's format, or is empty. `through` may put a sink of its own before the writer's, which passes on what it wants.
// Returns the files written. Of one file the caller's stage of `progress` advances; of several each is a stage.
using SinkBefore = std::function<std::unique_ptr<PointSink>(PointSink& writer)>;
Result<std::vector<std::filesystem::path>> convertCloud(const std::vector<std::filesystem::path>& in,
                                                        const std::filesystem::path& out, const std::string& as,
                                                        Report& report, Progress& progress,
                                                        const SinkBefore& through = {});

}  // namespace standpoint
