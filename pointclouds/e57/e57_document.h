// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "core/report.h"
#include "core/survey.h"
#include "pointclouds/e57/e57_paged_file.h"
#include "pointclouds/e57/e57_xml.h"

namespace standpoint::e57 {

// An open file with its XML section parsed.
struct Document {
  PagedReader file;
  std::unique_ptr<Element> root;
};
Result<Document> openDocument(const std::filesystem::path& path);

// Value of an Integer, ScaledInteger or Float element; an empty one is 0 (E2807 8.3.1), a missing or garbled one
// `otherwise`.
double real(const Element* element, double otherwise);
// The pose that a scan or a picture has; what is missing or senseless of it is mended with a warning.
Pose readPose(const Element& holder, const std::string& source, Report& report, std::string_view name = "pose");
std::string text(const Element& parent, std::string_view name);

}  // namespace standpoint::e57
