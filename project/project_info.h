// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include "project/document.h"

namespace standpoint {

// What a project holds and how far it is: the model, what was made of it, and the survey. Numbers in the file's own
// frame.
nlohmann::json projectInfo(const Document& document);

}  // namespace standpoint
