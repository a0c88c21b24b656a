// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/language/plural.h"

#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace standpoint {
namespace {

using testing::ElementsAre;

// What Intl.PluralRules of node 20 says (CLDR 48).
TEST(PluralForms, AreThoseOfUnicode) {
  const std::map<std::string, std::map<std::string, std::vector<double>>> told = {
      {"en", {{"one", {1}}, {"other", {0, 1.5, 2, 5, 11, 21, 22, 101, 1000, 1000000}}}},
      {"de", {{"one", {1}}, {"other", {0, 1.5, 2, 5, 11, 21, 22, 101, 1000, 1000000}}}},
      {"es", {{"one", {1}}, {"other", {0, 1.5, 2, 5, 11, 21, 22, 101, 1000}}, {"many", {1000000, 2000000}}}},
      {"it", {{"one", {1}}, {"other", {0, 1.5, 2, 5, 11, 21, 22, 101, 1000}}, {"many", {1000000, 2000000}}}},
      {"fr", {{"one", {0, 1, 1.5}}, {"other", {2, 3, 5, 11, 21, 22, 101, 1000}}, {"many", {1000000, 2000000}}}},
      {"pl",
       {{"one", {1}},
        {"few", {2, 3, 4, 22, 24, 102}},
        {"many", {0, 5, 10, 11, 12, 14, 15, 21, 25, 100, 101, 111, 112, 121, 1000, 1000000}},
        {"other", {1.5}}}},
      {"uk",
       {{"one", {1, 21, 101, 121}},
        {"few", {2, 3, 4, 22, 24, 102}},
        {"many", {0, 5, 10, 11, 12, 14, 15, 25, 100, 111, 112, 1000, 1000000}},
        {"other", {1.5}}}}};
  for (const auto& [language, forms] : told)
    for (const auto& [form, counts] : forms)
      for (const double count : counts) EXPECT_EQ(pluralForm(language, count), form) << language << ' ' << count;
}

TEST(PluralForms, OfALanguageThatIsNotKnownAreTheEnglishOnes) {
  EXPECT_EQ(pluralForm("cs", 1), "one");
  EXPECT_EQ(pluralForm("cs", 3), "other");
  EXPECT_THAT(pluralForms("cs"), ElementsAre("one", "other"));
}

TEST(CountedParts, TakeTheFormOfTheirLanguage) {
  const auto part = countedPart("setups|one=skan|few=skany|many=skanów");
  EXPECT_EQ(part.fact, "setups");
  EXPECT_EQ(formFor(part, "pl", 1), "skan");
  EXPECT_EQ(formFor(part, "pl", 23), "skany");
  EXPECT_EQ(formFor(part, "pl", 21), "skanów");
  EXPECT_EQ(formFor(part, "pl", 1.5), "skanów") << "the last where a form is missing";
  EXPECT_EQ(formFor(countedPart("setups|one=scan|other=de scans"), "fr", 1000000), "de scans");
  EXPECT_TRUE(countedPart("battery").forms.empty());
  EXPECT_EQ(formFor(countedPart("setups|"), "en", 1), "");
}

TEST(NumbersInSentences, HaveTheDecimalSignOfTheLanguage) {
  EXPECT_EQ(numberInSentence("6.1 mm", "en"), "6.1 mm");
  for (const auto* language : {"de", "uk", "pl", "es", "fr", "it"})
    EXPECT_EQ(numberInSentence("6.1 mm", language), "6,1 mm") << language;
  EXPECT_EQ(numberInSentence("2:34", "de"), "2:34");
  EXPECT_EQ(numberInSentence("45 %", "es"), "45 %");
  EXPECT_EQ(numberInSentence("45 %", "pl"), "45%");
  EXPECT_EQ(numberInSentence("1.", "de"), "1.");
}

}  // namespace
}  // namespace standpoint
