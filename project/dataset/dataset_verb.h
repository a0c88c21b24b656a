// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "project/answers.h"
#include "project/dataset/forecast.h"
#include "project/fields.h"
#include "project/survey/survey_verbs.h"

namespace standpoint {

enum class DatasetAction {
  check,     // a recipe: is it usable, and what would it make
  run,       // a recipe: make its set, or a shard of it
  verify,    // a set: is each file there and as it was written
  manifest,  // a set: verify it, then describe it
  slurm,     // a recipe: write the job that runs it on a cluster
};
std::span<const Choice<DatasetAction>> choices(DatasetAction);

struct DatasetOptions {
  DatasetAction action = DatasetAction::check;
  std::filesystem::path of;      // recipe, or folder of a set
  std::filesystem::path output;  // folder of the set
  std::optional<Shard> shard;
  bool resume = false;
  int threads = 0;
  unsigned shards = 1;                 // of slurm
  std::size_t samples = 20000;         // of check
  double rate_points_per_s = 1000000;  // of check: that the machine makes
};
const Fields<DatasetOptions>& datasetFields();

const AnswerFields<SetEnvironmentForecast>& answerFields(const SetEnvironmentForecast*);
const AnswerFields<SetClassForecast>& answerFields(const SetClassForecast*);
struct DatasetAnswer {
  std::string recipe;                                     // its name
  std::optional<std::size_t> scans;                       // that there are, or would be
  std::optional<std::uint64_t> points;                    // likewise
  std::optional<std::uint64_t> bytes;                     // of clouds and labels
  std::optional<double> instrument_hours, compute_hours;  // of check
  std::optional<std::size_t> places;                      // of the recipe, or of the shard
  std::vector<SetEnvironmentForecast> environments;       // of check
  std::vector<SetClassForecast> classes;                  // of check
  std::vector<std::string> unmapped;                      // of check
  std::optional<std::size_t> resumed, without_room;       // of run
  std::optional<double> points_per_second;                // of run
  std::optional<std::size_t> files, not_made;             // of verify and manifest
  std::vector<std::string> missing, damaged, unknown;     // likewise
  std::vector<std::string> working;                       // likewise: work folders of other runs
  std::vector<std::string> written;                       // of run, manifest and slurm
};
const AnswerFields<DatasetAnswer>& answerFields(const DatasetAnswer*);
Result<Answered<DatasetAnswer>> runDataset(const Document& document, const DatasetOptions& options, Progress& progress);

}  // namespace standpoint
