// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "project/verb.h"

namespace standpoint {

// The verbs of the emulated instruments: `rehearse`. The doors join them with those of project/verbs/verbs.cpp.
std::span<const Verb> rehearsalVerbs();
// Both tables in one.
std::span<const Verb> allVerbs();

}  // namespace standpoint
