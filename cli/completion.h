// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "project/verb.h"

namespace standpoint {

// Completion for bash of verbs, their options, words of choices and ids of instruments; paths are left to bash. It
// needs no functions of others.
std::string bashCompletion(std::span<const Verb> verbs);

}  // namespace standpoint
