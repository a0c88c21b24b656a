// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/report.h"
#include "core/result.h"
#include "pointclouds/scores/instance_scores.h"
#include "project/dataset/score_verb.h"
#include "project/dataset/scored_labels.h"

namespace standpoint {

struct ScoredLabels {
  const ClassMap& map;
  const std::vector<ScoredPair>& pairs;
  std::vector<std::uint64_t> wrong;  // points of each pair
  PairLabels last;                   // of the last pair, so that a single cloud is not read once more
  const InstanceTally* instances;    // of the pairs in their order; null where nobody predicted any
};

// Where the wrong points are, as a part of a page: a plan and two elevations of the scenes that have the most of them,
// and close-ups of the most frequent confusions and of the largest missed instances. Nothing where nothing is wrong.
// Reads the clouds of these scenes twice; memory is that of the labels of one of them.
Result<std::string> picturesOfErrors(const ScoreAnswer& answer, ScoredLabels labels, Report& report,
                                     Progress& progress);

}  // namespace standpoint
