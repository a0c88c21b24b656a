// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "project/verb.h"

namespace standpoint {

// Every verb with every option as a page, from the tables that command line, job files and forms use: name, what it may
// be, default value, what it does. `introduction` comes first, with the rows of its table of verbs made anew.
std::string verbList(std::span<const Verb> verbs, const std::string& introduction);

// The head of that table.
inline constexpr const char* kVerbTableHead = "| verb | does |\n|---|---|\n";

// Where the introduction of docs/reference/verbs.md ends: what follows this line is generated.
inline constexpr const char* kVerbListMark = "<!-- From here on written by list-verbs. -->\n";

}  // namespace standpoint
