// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/points.h"
#include "core/progress.h"
#include "core/report.h"
#include "pointclouds/e57/e57_document.h"

namespace standpoint::e57 {

// images2D (E2807 8.4.11): a picture is a blob section of its own and a few lines of XML.

// Writes the blob; returns its physical offset.
Result<std::uint64_t> writeBlob(PagedWriter& out, std::span<const std::uint8_t> bytes);
void appendPicture(XmlWriter& xml, const StationPicture& picture, std::uint64_t blob_offset, const std::string& guid,
                   const std::string& scan_guid);

// Which of the file's pictures belong to which scan: each to the first scan of its guid; where the file has one scan,
// those without a guid to that.
struct ListedPicture {
  const Element* element = nullptr;
  std::string source;  // "name.e57 images2D/0"
};
std::vector<std::vector<ListedPicture>> picturesOfScans(const Document& document, std::size_t scans, Report& report);

// The picture, or why it cannot be read; a warning for what of it stays behind.
Result<StationPicture> readPicture(PagedReader& file, const ListedPicture& listed, Report& report);

}  // namespace standpoint::e57
