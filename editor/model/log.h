// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/environment.h"
#include "core/report.h"

namespace standpoint {

enum class LogLevel { note, done, warning, loss, error };

struct LogEntry {
  LogLevel level = LogLevel::note;
  std::string time;    // "10:41:03"
  std::string source;  // "#1234", "house.ifc line 7"; may be empty
  std::string message;
  bool follows = false;  // one of more than 20 alike, of which the first is listed with their count
};

struct LogFilter {
  bool notes = true, warnings = true, losses = true;  // what is done counts as a note, an error as a loss
  std::string text;
  bool each = false;  // also those that follow others alike
};

bool passes(const LogEntry& entry, const LogFilter& filter);
LogLevel levelOf(Severity severity);
// One entry for each issue, in their order: the first of many alike says how many.
std::vector<LogEntry> entriesOf(const Report& report);
// The product that a source names by its id ("#1234", also inside "house.ifc #1234").
std::optional<std::uint32_t> productOf(const Environment& environment, const std::string& source);
std::string timeOfDay();
std::string dateAndTime();  // "2026-11-24 10.41.03", which a file may be called

}  // namespace standpoint
