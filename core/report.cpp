// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/report.h"

#include <algorithm>
#include <utility>

namespace standpoint {

void Report::note(std::string source, std::string message) {
  issues.push_back({Severity::note, std::move(source), std::move(message)});
}

void Report::warn(std::string source, std::string message) {
  issues.push_back({Severity::warning, std::move(source), std::move(message)});
}

void Report::lose(std::string source, std::string message) {
  issues.push_back({Severity::loss, std::move(source), std::move(message)});
}

void Report::append(const Report& other) { issues.insert(issues.end(), other.issues.begin(), other.issues.end()); }

std::size_t Report::losses() const {
  return static_cast<std::size_t>(
      std::count_if(issues.begin(), issues.end(), [](const Issue& i) { return i.severity == Severity::loss; }));
}

const char* name(Severity severity) {
  switch (severity) {
    case Severity::note: return "note";
    case Severity::warning: return "warning";
    case Severity::loss: return "loss";
  }
  return "note";
}

}  // namespace standpoint
