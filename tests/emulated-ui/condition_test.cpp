// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/condition.h"

#include <map>

#include <gtest/gtest.h>

namespace standpoint {
namespace {

const std::map<std::string, Fact> kFacts = {{"battery", numberFact(0.5)},           {"card", wordFact("present")},
                                            {"card.free", numberFact(100)},         {"need", numberFact(40)},
                                            {"name", wordFact("Flat 2")},           {"link", wordFact("yes")},
                                            {"setting.resolution", wordFact("1/4")}};

bool holds(const std::string& text) {
  const auto condition = Condition::parse(text);
  EXPECT_TRUE(condition) << text << ": " << (condition ? "" : condition.error().message);
  return condition && condition->holds([](const std::string& name) -> std::optional<Fact> {
    const auto found = kFacts.find(name);
    return found == kFacts.end() ? std::nullopt : std::optional(found->second);
  });
}

TEST(Condition, ComparesNumbersWordsAndFacts) {
  EXPECT_TRUE(holds(""));
  EXPECT_TRUE(holds("battery > 0.1"));
  EXPECT_FALSE(holds("battery >= 0.51"));
  EXPECT_TRUE(holds("battery == 0.50"));
  EXPECT_TRUE(holds("card == present"));
  EXPECT_TRUE(holds("card != absent"));
  EXPECT_TRUE(holds("name == 'Flat 2'"));
  EXPECT_TRUE(holds("card.free >= @need"));
  EXPECT_FALSE(holds("need > @card.free"));
  EXPECT_TRUE(holds("setting.resolution in {1/2, 1/4}"));
  EXPECT_TRUE(holds("link"));
  EXPECT_FALSE(holds("card"));
}

TEST(Condition, BindsNotBeforeAndBeforeOr) {
  EXPECT_TRUE(holds("card == absent and link or link"));
  EXPECT_FALSE(holds("card == absent and (link or link)"));
  EXPECT_TRUE(holds("not card == absent and link"));
  EXPECT_FALSE(holds("not (card == present and link)"));
}

TEST(Condition, DoesNotHoldForAFactThatIsNotThere) {
  EXPECT_FALSE(holds("nothing == 1"));
  EXPECT_FALSE(holds("nothing != 1"));
  EXPECT_FALSE(holds("battery < @nothing"));
}

TEST(Condition, RefusesWhatItCannotReadWithTheColumn) {
  const std::pair<const char*, const char*> kWrong[] = {
      {"battery >", "column 10"},  {"== 3", "column 1"},       {"a == b c", "column 8"}, {"(a == b", "column 8"},
      {"a == 'b", "column 6"},     {"a in b", "column 6"},     {"a in {b", "column 8"},  {"a ? b", "column 3"},
      {"a == b and", "column 11"}, {"a in {@b, @c}", "column"}};
  for (const auto& [text, place] : kWrong) {
    const auto condition = Condition::parse(text);
    ASSERT_FALSE(condition) << text;
    EXPECT_NE(condition.error().message.find(place), std::string::npos) << text << ": " << condition.error().message;
  }
  EXPECT_FALSE(Condition::parse(std::string(40, '(') + "a" + std::string(40, ')')));
  EXPECT_FALSE(Condition::parse(std::string(3000, 'a')));
}

std::string fault(const std::string& text) {
  const auto condition = Condition::parse(text);
  EXPECT_TRUE(condition) << text;
  const auto ok = condition->check([](const std::string& name) -> std::optional<FactDomain> {
    if (name == "battery") return FactDomain{{}, true, 0, 1};
    if (name == "card") return FactDomain{{"present", "absent"}};
    if (name == "name") return FactDomain{};
    return std::nullopt;
  });
  return ok ? "" : ok.error().message;
}

TEST(Condition, FindsWhatCanNeverHold) {
  EXPECT_EQ(fault("battery > 0.3 and battery < 0.4"), "");
  EXPECT_NE(fault("battery > 0.4 and battery < 0.3"), "");
  EXPECT_NE(fault("battery > 1"), "");
  EXPECT_EQ(fault("battery >= 1"), "");
  EXPECT_NE(fault("battery < 0.4 and not battery < 0.5"), "");
  EXPECT_EQ(fault("battery < 0.4 and not battery < 0.5 or card == absent"), "");
  EXPECT_NE(fault("card == present and card == absent"), "");
  EXPECT_NE(fault("card != present and card != absent"), "");
  EXPECT_NE(fault("not card in {present, absent}"), "");
  EXPECT_EQ(fault("name != a and name != b"), "");
  EXPECT_NE(fault("name == a and name == b"), "");
  EXPECT_NE(fault("battery == 0.5 and battery > 0.6"), "");
}

// Each half has 4096 cases, which are allowed; together they would be sixteen million.
TEST(Condition, RefusesTooManyCasesBeforeItWritesThemDown) {
  std::string half = "(name == a or name == b)";
  for (int i = 1; i < 12; ++i) half += " and (name == a or name == b)";
  EXPECT_EQ(fault(half), "");
  EXPECT_NE(fault("(" + half + ") and (" + half + ")").find("too many cases"), std::string::npos);
}

TEST(Condition, FindsUnknownFactsAndWrongWords) {
  EXPECT_NE(fault("batery > 0.3").find("batery"), std::string::npos);
  EXPECT_NE(fault("card == presnt").find("present, absent"), std::string::npos);
  EXPECT_NE(fault("battery == full"), "");
  EXPECT_NE(fault("card > 3"), "");
  EXPECT_NE(fault("battery > @nothing"), "");
}

}  // namespace
}  // namespace standpoint
