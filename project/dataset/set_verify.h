// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"
#include "project/dataset/set_folder.h"

namespace standpoint {

// A scan that a set has, by its record.
struct SetScan {
  SetPlace place;
  SetVariant variant;
  SetFiles files;
  SetRecord record;
};

struct SetCheck {
  std::vector<std::string> missing;  // files that should be there
  std::vector<std::string> damaged;  // that hold something else than was written
  std::vector<std::string> unknown;  // that are of no scan of the recipe
  std::size_t not_made = 0;          // scans of the recipe without a record
  std::size_t files = 0;             // that were looked at
  std::uint64_t bytes = 0;
  std::vector<SetScan> scans;   // in the order of the recipe
  std::vector<SetFile> others;  // recipe, classes, environments, their pictures and records, with their sums
  std::vector<SetEnvironmentRecord> environments;  // in the order of the recipe, where all could be read; of shard 1
  bool isWhole() const { return missing.empty() && damaged.empty() && not_made == 0; }
};

// Reads every byte of a set, or of the scans of a shard, and compares it with its records and, where there is one, its
// list of checksums. What is of no scan belongs to the first shard, so that the shards of a set together look at each
// file once.
Result<SetCheck> checkSet(const std::filesystem::path& set, const Recipe& recipe, const Shard& shard,
                          Progress& progress);

inline constexpr const char* kSumsFile = "SHA256SUMS";

}  // namespace standpoint
