// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/log.h"

#include <algorithm>
#include <cctype>
#include <ctime>

#include "core/alike_issues.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

bool containsText(const std::string& text, const std::string& part) {
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
  };
  return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

std::string now(const char* format) {
  const std::time_t seconds = std::time(nullptr);
  std::tm local{};
  localtime_r(&seconds, &local);
  char text[32];
  std::strftime(text, sizeof text, format, &local);
  return text;
}

}  // namespace

bool passes(const LogEntry& entry, const LogFilter& filter) {
  if (entry.follows && !filter.each && filter.text.empty()) return false;
  switch (entry.level) {
    case LogLevel::note:
    case LogLevel::done:
      if (!filter.notes) return false;
      break;
    case LogLevel::warning:
      if (!filter.warnings) return false;
      break;
    case LogLevel::loss:
    case LogLevel::error:
      if (!filter.losses) return false;
      break;
  }
  return filter.text.empty() || containsText(entry.source + " " + trSentence(entry.message), filter.text);
}

LogLevel levelOf(Severity severity) {
  switch (severity) {
    case Severity::note: return LogLevel::note;
    case Severity::warning: return LogLevel::warning;
    case Severity::loss: return LogLevel::loss;
  }
  return LogLevel::note;
}

std::vector<LogEntry> entriesOf(const Report& report) {
  const std::string time = timeOfDay();
  std::vector<LogEntry> entries;
  for (const Issue& issue : report.issues)
    entries.push_back({levelOf(issue.severity), time, issue.source, issue.message, false});
  for (const auto& alike : alikeIssues(report)) {
    for (const auto other : alike.others) entries[other].follows = true;
    if (!alike.others.empty()) entries[alike.first].message += fmt::format(" (first of {} similar)", alike.count());
  }
  return entries;
}

std::optional<std::uint32_t> productOf(const Environment& environment, const std::string& source) {
  if (source.empty()) return std::nullopt;
  const auto space = source.find_last_of(' ');
  const std::string last = space == std::string::npos ? source : source.substr(space + 1);
  for (std::uint32_t i = 0; i < environment.products.size(); ++i)
    if (const auto& id = environment.products[i].id; !id.empty() && (id == source || id == last)) return i;
  return std::nullopt;
}

std::string timeOfDay() { return now("%H:%M:%S"); }

std::string dateAndTime() { return now("%Y-%m-%d %H.%M.%S"); }

}  // namespace standpoint
