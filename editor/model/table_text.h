// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace standpoint {

// What a verb has answered, as a spreadsheet takes it in: fields between tabs. Single values are rows of name and
// value; a list of rows is a table with a head, below its name.
std::string tableText(const nlohmann::json& figures);

using TableRows = std::vector<std::vector<std::string>>;  // the head is the first
std::string rowsText(const TableRows& rows);

}  // namespace standpoint
