// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "project/verb.h"

namespace standpoint {

// The verb of the emulated instruments: `rehearse`.
std::span<const Verb> rehearsalVerbs();
// It, those of the classroom and those of project/verbs/verbs.cpp in one table, for the doors.
std::span<const Verb> allVerbs();

}  // namespace standpoint
