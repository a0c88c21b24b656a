// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/dataset/scored_labels.h"

#include <fmt/format.h>

#include "pointclouds/scores/true_classes.h"

namespace standpoint {

namespace {

// As readPointLabels; an error tells the folder, too: the files of a set have the same names in each.
Result<PointLabels> labelsIn(const std::filesystem::path& file, Progress& progress) {
  auto labels = readPointLabels(file, progress);
  if (labels) return labels;
  auto error = std::move(labels).error();
  if (error.source.starts_with(file.filename().string())) error.source = (file.parent_path() / error.source).string();
  return failure(std::move(error));
}

}  // namespace

Result<PairLabels> readPair(const ScoredPair& pair, const ClassMap& map, Progress& progress) {
  PairLabels labels;
  auto &truth = labels.truth, &predicted = labels.predicted;
  TRY_ASSIGN(predicted, labelsIn(pair.predicted, progress));
  TRY_ASSIGN(truth, isLabelFile(pair.truth) ? labelsIn(pair.truth, progress) : trueClasses(pair.truth, map, progress));
  if (truth.ids.size() != predicted.ids.size())
    return failure(ErrorKind::unusable,
                   fmt::format("has labels of {} points, and the truth {} has {} points", predicted.ids.size(),
                               pair.truth.string(), truth.ids.size()),
                   pair.predicted.string());
  if (!pair.instances.empty() && !predicted.instances.empty()) {
    TRY_ASSIGN(auto instances, labelsIn(pair.instances, progress));
    if (instances.ids.size() != truth.ids.size())
      return failure(ErrorKind::unusable, "has another number of points than the labels beside it; verify the set",
                     pair.instances.string());
    truth.instances = std::move(instances.ids);
  }
  truth.instances.resize(truth.ids.size());
  predicted.instances.resize(truth.ids.size());
  return labels;
}

}  // namespace standpoint
