// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pointclouds/datasets/class_map.h"
#include "pointclouds/formats.h"

namespace standpoint {

// A labelled set that networks are trained on: a folder instead of a file.
struct Dataset {
  const char* name;  // "s3dis"; its classes are pointclouds/classes/s3dis.json
  const char* description;
  std::unique_ptr<CloudWriter> (*writer)(const std::filesystem::path& folder, ClassMap map);  // not yet started
};
std::span<const Dataset> datasets();

// All scans of IN, which must have labels, into a new folder. What stands there already is an error.
Result<Report> convertToDataset(const std::filesystem::path& in, const std::filesystem::path& folder,
                                const Dataset& set, ClassMap map, Progress& progress);

namespace dataset {
std::unique_ptr<CloudWriter> s3dis(const std::filesystem::path& folder, ClassMap map);
std::unique_ptr<CloudWriter> semantic3d(const std::filesystem::path& folder, ClassMap map);
std::unique_ptr<CloudWriter> semanticKitti(const std::filesystem::path& folder, ClassMap map);
std::unique_ptr<CloudWriter> custom3d(const std::filesystem::path& folder, ClassMap map);
}  // namespace dataset

}  // namespace standpoint
