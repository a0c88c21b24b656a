// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "core/progress.h"
#include "project/verb.h"

namespace standpoint {

// Exit codes of the design.
constexpr int kDone = 0;
constexpr int kWrongUsage = 2;
constexpr int kLossOrUnusable = 3;
constexpr int kFileSystem = 4;
constexpr int kCancelled = 130;

int exitCode(ErrorKind kind);

struct Streams {
  std::ostream& out;  // answers
  std::ostream& err;  // errors, issues, progress
  bool bar = false;   // err is a terminal: draw a progress bar
};

// The whole command without process or terminal: parses the words (without the program's name) against the verb table,
// runs, prints, and returns the exit code.
int runCommandLine(std::span<const Verb> table, const std::vector<std::string>& words, const Streams& streams,
                   Progress& progress);

}  // namespace standpoint
