// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/alike_issues.h"

#include <gtest/gtest.h>

namespace standpoint {
namespace {

Report bolts(int count) {
  Report report;
  report.warn("line 1", "missing header");
  for (int i = 0; i < count; ++i) {
    report.lose("#" + std::to_string(i),
                "IfcBolt 2O2Fr$t4X7Zf8NOew3FL" + std::to_string(10 + i) + " 'M " + std::to_string(i) + "' has no body");
    report.note("#" + std::to_string(i), i % 2 == 0 ? "even" : "odd");
  }
  return report;
}

TEST(AlikeIssues, AreOneWithTheirCountWhereTheyAreMoreThanTwenty) {
  const Report report = bolts(50);
  const auto alike = alikeIssues(report);
  ASSERT_EQ(alike.size(), 4U);
  EXPECT_EQ(alike[0].count(), 1U);
  EXPECT_EQ(report.issues[alike[1].first].source, "#0");
  EXPECT_EQ(alike[1].count(), 50U);
  EXPECT_EQ(report.issues[alike[1].others.back()].source, "#49");
  EXPECT_EQ(report.issues[alike[2].first].message, "even");
  EXPECT_EQ(alike[2].count(), 25U);
  EXPECT_EQ(report.issues[alike[3].first].message, "odd");
}

TEST(AlikeIssues, StandOneByOneWhereTheyAreFew) {
  const Report report = bolts(20);
  const auto alike = alikeIssues(report);
  ASSERT_EQ(alike.size(), report.issues.size());
  for (std::size_t i = 0; i < alike.size(); ++i) EXPECT_EQ(alike[i].first, i);
}

TEST(AlikeIssues, DifferByTheirWordsAndTheirSeverity) {
  Report report;
  for (int i = 0; i < 15; ++i) {
    report.warn("#1", "IFCSPHERE is not supported");
    report.warn("#1", "IFCBLOCK is not supported");
    report.lose("#1", "IFCSPHERE is not supported");
  }
  EXPECT_EQ(alikeIssues(report).size(), 45U);
}

TEST(AlikeIssues, AreThoseWhoseGlobalIdsHaveNoDigit) {
  Report report;
  for (int i = 0; i < 30; ++i)
    report.lose("#1", "IfcBolt " + std::string(22, static_cast<char>('a' + i % 26)) + " is lost");
  const auto alike = alikeIssues(report);
  ASSERT_EQ(alike.size(), 1U);
  EXPECT_EQ(alike[0].count(), 30U);
}

}  // namespace
}  // namespace standpoint
