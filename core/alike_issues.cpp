// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/alike_issues.h"

#include <algorithm>
#include <map>
#include <string>

namespace standpoint {

namespace {

bool isWordChar(char c) {
  return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '$' || c == '.';
}

// The message with a # for each name in quotes, each word with a digit in it, and each GlobalId.
std::string causeOf(const Issue& issue) {
  constexpr std::size_t kGlobalIdLength = 22;
  const std::string& m = issue.message;
  std::string cause(name(issue.severity));
  for (std::size_t i = 0; i < m.size();) {
    std::size_t end = i + 1;
    bool named = false;
    if (const auto quote = m[i] == '\'' ? m.find('\'', i + 1) : std::string::npos; quote != std::string::npos) {
      end = quote + 1;
      named = true;
    } else if (isWordChar(m[i])) {
      while (end < m.size() && isWordChar(m[end])) ++end;
      named = end - i == kGlobalIdLength ||
              std::any_of(m.begin() + static_cast<std::ptrdiff_t>(i), m.begin() + static_cast<std::ptrdiff_t>(end),
                          [](char c) { return c >= '0' && c <= '9'; });
    }
    named ? cause += '#' : cause.append(m, i, end - i);
    i = end;
  }
  return cause;
}

}  // namespace

std::vector<AlikeIssues> alikeIssues(const Report& report) {
  std::map<std::string, std::vector<std::size_t>> of_cause;
  std::vector<std::string> causes;
  for (const Issue& issue : report.issues) {
    causes.push_back(causeOf(issue));
    of_cause[causes.back()].push_back(causes.size() - 1);
  }
  std::vector<AlikeIssues> result;
  for (std::size_t i = 0; i < causes.size(); ++i) {
    const auto& alike = of_cause[causes[i]];
    if (alike.size() <= kMostAlike)
      result.push_back({i, {}});
    else if (alike.front() == i)
      result.push_back({i, {alike.begin() + 1, alike.end()}});
  }
  return result;
}

}  // namespace standpoint
