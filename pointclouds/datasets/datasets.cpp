// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/datasets/datasets.h"

#include "pointclouds/datasets/labelled_folder.h"

namespace standpoint {

std::span<const Dataset> datasets() {
  static constexpr Dataset kSets[] = {
      {"s3dis", "S3DIS: text, a room for each station", dataset::s3dis},
      {"semantic3d", "Semantic3D: text and labels", dataset::semantic3d},
      {"semantickitti", "SemanticKITTI: a frame for each station", dataset::semanticKitti},
      {"custom3d", "Open3D-ML Custom3D: arrays of numpy", dataset::custom3d}};
  return kSets;
}

Result<Report> convertToDataset(const std::filesystem::path& in, const std::filesystem::path& folder,
                                const Dataset& set, ClassMap map, Progress& progress) {
  const CloudFormat* const format = cloudFormatFor(in);
  if (!format || !format->read) return failure(ErrorKind::usage, "unsupported point-cloud format", in.string());
  const auto writer = set.writer(folder, std::move(map));
  TRY(static_cast<LabelledFolder&>(*writer).start());
  TRY_ASSIGN(auto report, format->read(in, *writer, progress));
  TRY(writer->close());
  report.append(writer->report());
  return report;
}

}  // namespace standpoint
