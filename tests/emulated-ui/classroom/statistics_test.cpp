// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/classroom/statistics.h"

#include <gtest/gtest.h>

namespace standpoint {
namespace {

Marks marks(const std::vector<bool>& held) {
  Marks m;
  for (std::size_t i = 0; i < held.size(); ++i) {
    MarkedRule r;
    r.id = "r" + std::to_string(i);
    r.held = held[i];
    r.of = 1;
    r.points = held[i] ? 1 : 0;
    m.points += r.points;
    m.of += 1;
    m.rules.push_back(r);
  }
  m.score = m.points / m.of;
  m.passed = m.score >= 0.5;
  return m;
}

std::vector<const Marks*> pointers(const std::vector<Marks>& all) {
  std::vector<const Marks*> found;
  for (const auto& m : all) found.push_back(&m);
  return found;
}

// Twenty results of four items; the figures were computed by Python's statistics module.
TEST(ClassStatistics, AreThoseOfATextbook) {
  std::vector<Marks> all;
  for (int i = 0; i < 20; ++i) all.push_back(marks({i % 4 != 0, i >= 5, i >= 10, i < 18}));
  const auto s = statisticsOf(pointers(all));
  EXPECT_EQ(s.results, 20U);
  ASSERT_EQ(s.criteria.size(), 4U);
  EXPECT_EQ(s.criteria[1].met, 15U);
  EXPECT_DOUBLE_EQ(s.criteria[1].facility, 0.75);
  EXPECT_NEAR(s.criteria[1].facility_low, 0.5313, 5e-4);  // Wilson, 15 of 20
  EXPECT_NEAR(s.criteria[1].facility_high, 0.8881, 5e-4);
  ASSERT_TRUE(s.criteria[2].correlation);
  EXPECT_NEAR(*s.criteria[2].correlation, 0.3015, 1e-3);
  ASSERT_TRUE(s.criteria[3].correlation);
  EXPECT_LT(*s.criteria[3].correlation, 0) << "the best do not meet it: its rule wants reading again";
  ASSERT_TRUE(s.alpha);
  EXPECT_NEAR(*s.alpha, 0.2622, 1e-3);
}

TEST(ClassStatistics, OfFewResultsHaveNoCorrelations) {
  std::vector<Marks> all(19, marks({true, false}));
  const auto s = statisticsOf(pointers(all));
  EXPECT_FALSE(s.alpha);
  EXPECT_FALSE(s.criteria[0].correlation);
  EXPECT_DOUBLE_EQ(s.criteria[0].facility_high, 1);
  EXPECT_NEAR(s.criteria[0].facility_low, 0.8318, 5e-4);  // Wilson, 19 of 19
  EXPECT_EQ(statisticsOf({}).results, 0U);
}

TEST(Mistakes, ComeWithWhatWasRequiredFirst) {
  auto m = marks({false, false, true});
  m.rules[0].mistake = "M01";
  m.rules[1].mistake = "M03";
  m.rules[1].must = true;
  MarkedStep done{.id = "on", .done = true}, missed{.id = "scan"}, after{.id = "look"};
  m.steps = {done, missed, after};
  EXPECT_EQ(mistakesOf(m), (std::vector<std::string>{"M03", "M01", "step scan"}));
}

}  // namespace
}  // namespace standpoint
