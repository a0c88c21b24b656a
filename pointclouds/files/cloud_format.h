// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
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
    report_.warn(picture.name, "the format cannot store images");
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

}  // namespace standpoint
