// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace standpoint {

// What a verb has answered, as a spreadsheet takes it in: fields between tabs. Single values are rows of name and
// value; a list of rows is a table with a head, below its name.
std::string tableText(const nlohmann::json& figures);

}  // namespace standpoint
