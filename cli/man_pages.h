// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "project/verb.h"

namespace standpoint {

// standpoint-VERB(1), from the tables that command line, job files and forms use.
std::string manPage(const Verb& verb);

// `page` with a row for each verb in place of the line kManVerbsMark: standpoint(1) from packaging/man.
std::string manPageWithVerbs(std::span<const Verb> verbs, std::string page);

inline constexpr const char* kManVerbsMark = ".\\\" @VERBS@\n";

}  // namespace standpoint
