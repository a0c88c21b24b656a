// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "core/report.h"
#include "project/dataset/recipe.h"

namespace standpoint {

struct SetRunOptions {
  std::filesystem::path set;
  std::optional<Shard> shard;
  bool resume = false;
  int threads = 0;  // 0: all
};
struct SetRunCount {
  std::size_t scans = 0, resumed = 0, places = 0, without_room = 0;
  std::uint64_t points = 0, bytes = 0;
  double seconds = 0;  // of the scans that were made
};

// Makes the scans of a recipe, or of a shard of it, into the folder of its set. The same bytes however they are shared
// out and however often the run was broken off. Scans that are there already are an error unless it resumes.
Result<SetRunCount> runSet(const Recipe& recipe, const SetRunOptions& options, Report& report, Progress& progress);

}  // namespace standpoint
