// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "project/dataset/recipe.h"

namespace standpoint {

struct SlurmJob {
  std::filesystem::path recipe, set, program;  // whole paths
  unsigned shards = 1;
  int threads = 1;
};

// Writes set/slurm/: array.sbatch, a task for each shard that resumes what it or its twin began; manifest.sbatch, which
// verifies all and describes it; and submit, which gives both to Slurm. Returns the files, from the set's folder on.
Result<std::vector<std::string>> writeSlurmJob(const SlurmJob& job, const Recipe& recipe);

// As a word of a shell, in single quotes.
std::string shellWord(const std::string& text);

}  // namespace standpoint
