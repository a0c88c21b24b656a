// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "core/progress.h"
#include "core/result.h"
#include "pointclouds/datasets/class_map.h"
#include "pointclouds/datasets/label_array.h"

namespace standpoint {

// Labels that are scored, and what they are scored against.
struct ScoredPair {
  std::filesystem::path truth, predicted;
  std::filesystem::path instances;  // of the truth, where they have a file of their own
  std::filesystem::path cloud;      // whose points they are; empty where only labels are given
  std::string scene;                // the environment in a set: its clouds are in one frame
};

struct PairLabels {
  PointLabels truth, predicted;  // of the same points, with an instance for each, 0: of none
};
Result<PairLabels> readPair(const ScoredPair& pair, const ClassMap& map, Progress& progress);

}  // namespace standpoint
