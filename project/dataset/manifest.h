// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"
#include "project/dataset/set_verify.h"

namespace standpoint {

// What describes a set that is whole: scans.csv (a row for each scan), croissant.json (Croissant 1.0), card.html and
// README.md with charts of the balance of classes, a STAC item of each environment that is somewhere on a map, and
// SHA256SUMS of all files, those included. The same set has the same bytes. `check` must be whole. Returns the files,
// from the set's folder on.
Result<std::vector<std::string>> writeManifest(const std::filesystem::path& set, const Recipe& recipe,
                                               const SetCheck& check, Progress& progress);

// Parts of it.
std::string scansCsv(const Recipe& recipe, const SetCheck& check);
std::string croissantText(const Recipe& recipe, const SetCheck& check, const std::string& scans_csv);

std::string balanceFile(const RecipeClasses& map);  // "balance/s3dis.svg"
std::string cloudMediaType(const Recipe& recipe);   // of its clouds

// Points of the classes of one map in one split.
struct SplitBalance {
  std::string split;
  std::vector<std::uint64_t> points;  // of each class of the map
  std::uint64_t counted = 0;          // those of classes that are not ignored
};
std::vector<SplitBalance> balanceOf(const Recipe& recipe, const SetCheck& check, std::size_t map);
std::string cardMarkdown(const Recipe& recipe, const SetCheck& check);
std::string cardHtml(const Recipe& recipe, const SetCheck& check);

}  // namespace standpoint
