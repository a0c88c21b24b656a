// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "core/csv_text.h"
#include "emulated-ui/classroom/collect.h"

namespace standpoint {

namespace {

// In one line, as a grade book shows it.
std::string feedback(const CollectedResult& r) {
  const auto& m = *r.verification.marks;
  auto text = fmt::format("{}: {} of {} points", m.passed ? "Passed" : "Not passed", m.points, m.of);
  if (!m.must_broken.empty()) text += "; required criterion not met: " + brokenDemands(m);
  if (!m.in_time) text += "; over the time limit";
  if (const auto mistakes = mistakesOf(m); !mistakes.empty())
    text += fmt::format("; mistakes: {}", fmt::join(mistakes, ", "));
  if (r.late) text += "; handed in late";
  return text;
}

}  // namespace

std::string moodleCsv(const CollectedClass& c) {
  const auto id = c.assignment.id();
  std::string csv = fmt::format("username,{},{}\r\n", id, id + " feedback");
  for (const auto& student : c.list.students)
    if (const auto* r = c.of(student.id))
      csv +=
          fmt::format("{},{:.2f},{}\r\n", student.username, 100 * r->verification.marks->score, csvText(feedback(*r)));
  return csv;
}

}  // namespace standpoint
