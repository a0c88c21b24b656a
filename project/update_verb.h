// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "importers/importers.h"
#include "project/verb.h"

namespace standpoint {

// Takes in a changed model in place of the one that the document came from. The local frame stays (the old global
// shift), and with it stations, targets, control points and underlays; the user's materials follow their products by
// GlobalId (class and name, or id and name, where a file has none); a map position that the project has stays. What no
// longer has a product is kept and listed in `kept`. `changes` of the answer: added, removed and changed products, each
// with what changed. Of several models the one of the same file name is replaced, the others are read again from where
// they were.
Result<Outcome> updateModels(const Document& document, std::vector<std::filesystem::path> files,
                             const ImportOptions& options, const std::string& crs, Progress& progress);

}  // namespace standpoint
