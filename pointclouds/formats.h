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

namespace standpoint {

struct ScanInfo {
  ScanHeader header;
  std::uint64_t points = 0;  // that the file holds
};
struct CloudInfo {
  std::string format;
  std::vector<ScanInfo> scans;
  Report report;
  std::string crs;  // that the file states: OGC WKT or "EPSG:n"; empty when it says nothing
};

// A PointSink that writes a file. Needs what core/points.h promises: coordinates are finite, indices lie in the grid of
// the header and labels in its tables; anything else is an error. A header with rows == 0 or columns == 0 has no grid,
// and the row and column of its points are not used; intensity_min == intensity_max says that there is no intensity.
class CloudWriter : public PointSink {
 public:
  const Report& report() const { return report_; }  // what the format could not hold; complete after close()
  Result<void> picture(const StationPicture& picture) override {  // of most formats
    report_.warn(picture.name, "the format has no place for a station's picture");
    return {};
  }

 protected:
  Report report_;
};

// Another way to write a format, for who needs it: `convert --as NAME`, `scan --as NAME`.
struct CloudVariant {
  const char* name;  // "scaled"
  const char* description;
  Result<std::unique_ptr<CloudWriter>> (*writer)(const std::filesystem::path&);
};

struct CloudFormat {
  const char* name;  // "e57"
  const char* description;
  const char* extension;  // ".e57"
  bool many_scans;        // one file holds several stations
  using Writer = Result<std::unique_ptr<CloudWriter>> (*)(const std::filesystem::path&);
  Writer writer;  // null when it cannot be written
  // Streams every scan of a file to `sink` (begin, write…, end for each; not close). Null when it cannot be read.
  Result<Report> (*read)(const std::filesystem::path&, PointSink& sink, Progress&);
  Result<CloudInfo> (*info)(const std::filesystem::path&);
  std::span<const CloudVariant> variants{};
};

// The table of formats; a new one is one file and one line in formats.cpp.
std::span<const CloudFormat> cloudFormats();
const CloudFormat* cloudFormatFor(const std::filesystem::path& file);  // by extension; null when unknown
// Of the variant `as`, or of the format itself when that is empty.
Result<CloudFormat::Writer> writerOf(const CloudFormat& format, const std::string& as);
// As cloudFormatFor, but looks into what can be either: a PLY with faces is a model, and the answer null.
const CloudFormat* readableCloudFormat(const std::filesystem::path& file);

struct CloudExtent {
  std::string format;
  std::uint64_t points = 0;
  Bounds bounds_file_m;  // of the points in the file's own frame, poses applied; empty without points
  std::string crs;       // as in CloudInfo
  Report report;
};
// Reads all points once, in memory that does not grow with them.
Result<CloudExtent> measureCloud(const std::filesystem::path& file, Progress& progress);

// Writers create `file` + ".part" and rename it in close(), so a full disk or a crash leaves the old file as it was.

// Copies all scans of IN to OUT; OUT's format must be writable. When OUT cannot hold many scans and IN has several,
// each gets its own file: name-<station>.ext. `as` names a variant of OUT's format, or is empty. `through` may put a
// sink of its own before the writer's, which passes on what it wants. Returns the files written.
using SinkBefore = std::function<std::unique_ptr<PointSink>(PointSink& writer)>;
Result<std::vector<std::filesystem::path>> convertCloud(const std::filesystem::path& in,
                                                        const std::filesystem::path& out, const std::string& as,
                                                        Report& report, Progress& progress,
                                                        const SinkBefore& through = {});

}  // namespace standpoint
