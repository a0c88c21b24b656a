// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "core/progress.h"
#include "pointclouds/e57/e57_document.h"
#include "pointclouds/e57/e57_pictures.h"
#include "pointclouds/e57/e57_vector_reader.h"
#include "pointclouds/files/local_points.h"

namespace standpoint::e57 {

// The scan as the XML describes it: what a data3D says, and what of it is missing or garbled.
struct ScanPlan {
  ScanHeader header;
  std::string source;  // "name.e57 data3D/0"
  std::string prefix;  // of our namespace: "gt:", or empty when the file does not have it
  bool has_index_bounds = false;
  double first_row = 0, first_column = 0;
  double colour_least[3] = {0, 0, 0}, colour_most[3] = {255, 255, 255};
};

// Reads no points; `fields` are those of the prototype.
ScanPlan planScan(const Element& root, const Element& scan, const std::vector<StoredField>& fields, std::string source,
                  Report& report);

// All points of one scan: begin, write…, picture…, end.
Result<void> readScan(PagedReader& file, const Element& points, ScanPlan plan,
                      const std::vector<ListedPicture>& pictures, PointSink& sink, Report& report, Progress& progress);

std::optional<std::size_t> fieldNamed(const std::vector<StoredField>& fields, std::string_view name);

}  // namespace standpoint::e57
