// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "project/model/import_verb.h"

namespace standpoint {

// Files to be imported, in the order given.
struct ImportFiles {
  std::vector<std::filesystem::path> models, clouds;
};
// A PLY with faces is a model; what is neither counts as a model, whose importer says what is wrong.
ImportFiles sorted(const std::vector<std::filesystem::path>& files);

// Underlays of what `outcome` has. Their points stay in their files.
Result<void> addClouds(Answered<ImportAnswer>& outcome, const std::vector<std::filesystem::path>& clouds,
                       Progress& progress);

// A project of clouds alone: an environment without products, in the frame of the first cloud's file, shifted to be
// near all of them. Its CRS is `crs`, or without one what the first cloud states.
Result<Answered<ImportAnswer>> importClouds(const Document& document, const std::vector<std::filesystem::path>& clouds,
                                            const ImportVerbOptions& options, Progress& progress);

}  // namespace standpoint
