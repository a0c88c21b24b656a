// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "project/verb.h"

namespace standpoint {

// A verb and its options as the command line spells them: one source for its help, the page of verbs, the manual pages
// and the completion.

// What stands for a value: "N", "m", "one|two", "X,Y,Z", "PATH".
std::string placeholder(const Parameter& p);
// "--budget", "-o, --output", "files...".
std::string spelling(const Parameter& p);
// As text; empty where there is none, "required" where it has to be given.
std::string defaultOf(const Parameter& p);
// "scan PROJECT --instrument … -o OUT": with what it needs, and without what may be left out.
std::string call(const Verb& verb);
// Whether the verb's first word is a project.
bool takesProject(const Verb& verb);

}  // namespace standpoint
