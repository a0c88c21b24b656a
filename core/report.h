// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace standpoint {

enum class Severity {
  note,     // worth knowing, nothing is lost
  warning,  // something was guessed or repaired
  loss,     // something of the input is not in the result; the command line then exits with 3 unless --allow-loss
};

struct Issue {
  Severity severity = Severity::note;
  std::string source;  // "#1234", "/meshes/3", "line 7"
  std::string message;
};

// What a step lost or guessed. Order is the order of the input, never of threads.
struct Report {
  std::vector<Issue> issues;

  void note(std::string source, std::string message);
  void warn(std::string source, std::string message);
  void lose(std::string source, std::string message);
  void append(const Report& other);
  std::size_t losses() const;
};

const char* name(Severity severity);

}  // namespace standpoint
