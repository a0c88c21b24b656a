// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "project/verb.h"

namespace standpoint {

// The verbs of the classroom: `assign`, `collect`, `scorm`.
std::span<const Verb> classroomVerbs();

}  // namespace standpoint
