// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/variants.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "emulated-ui/rehearsal/exercise.h"
#include "tests/emulated-ui/classroom/class_exercise.h"

namespace standpoint {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

TEST(VariantFigures, AreDrawnWithinTheirLimitsAndTheSameOnEveryComputer) {
  const auto figures = *variantFigures(classExercise(), "x");
  ASSERT_EQ(figures.size(), 2U);
  EXPECT_EQ(figures[0].values, (std::vector<json>{3, 3.5, 4}));
  EXPECT_EQ(countVariants(figures), 9U);
  std::map<std::string, int> drawn;
  for (std::uint64_t seed = 0; seed < 900; ++seed) ++drawn[json(drawnFigures(figures, seed)).dump()];
  EXPECT_EQ(drawn.size(), 9U);
  for (const auto& [variant, count] : drawn) EXPECT_NEAR(count, 100, 40) << variant;
  // Written down once: a program of another version must draw the same.
  std::string numbers;
  for (std::uint64_t seed = 0; seed < 8; ++seed)
    numbers += drawnFigures(figures, seed).at("number").get<std::string>() + ' ';
  EXPECT_EQ(numbers, "two two two two one one three two ");
}

TEST(VariantFigures, FillTheirPlacesAsNumbersAndInTexts) {
  const auto filled =
      *withFigures(json::parse(R"({"variants": {}, "a": "${x}", "b": ["at ${x} m, {fact}, $5"]})"), {{"x", 2.5}}, "f");
  EXPECT_EQ(filled, json::parse(R"({"a": 2.5, "b": ["at 2.5 m, {fact}, $5"]})"));
  const auto unknown = withFigures(json::parse(R"({"a": [{"b": "${leen}"}]})"), {{"lean", 1}}, "f");
  ASSERT_FALSE(unknown);
  EXPECT_THAT(describe(unknown.error()), HasSubstr("f /a/0/b: unknown figure 'leen'; did you mean 'lean'?"));
}

TEST(VariantFigures, ThatAreNoneAreRefusedWithTheirPlace) {
  const auto said = [](const char* variants) {
    const auto read = variantFigures({{"variants", json::parse(variants)}}, "f");
    return read ? std::string("read") : describe(read.error());
  };
  EXPECT_THAT(said(R"({"x": {"from": 2, "to": 1, "step": 1}})"), HasSubstr("f /variants/x/to"));
  EXPECT_THAT(said(R"({"x": {"from": 0, "to": 1e6, "step": 1e-6}})"), HasSubstr("f /variants/x/step"));
  EXPECT_THAT(said(R"({"x": {"from": 0, "to": 1, "step": 0}})"), HasSubstr("f /variants/x/step"));
  EXPECT_THAT(said(R"({"x": {"choices": []}})"), HasSubstr("f /variants/x/choices"));
  EXPECT_THAT(said(R"({"x": {"choices": [1, true]}})"), HasSubstr("f /variants/x/choices"));
  EXPECT_THAT(said(R"({"X y": {"choices": [1]}})"), HasSubstr("can contain only"));
  EXPECT_THAT(said(R"({"x": {"choices": [1], "more": 1}})"), HasSubstr("f /variants/x/more"));
  EXPECT_THAT(said(R"({"x": 1})"), HasSubstr("f /variants/x"));
}

TEST(ExerciseHash, IsTheSameWithoutTheSolutionAndAnotherForAnyOtherChange) {
  auto exercise = classExercise();
  const auto hash = exerciseHash(exercise);
  EXPECT_EQ(hash.size(), 64U);
  exercise.erase("solution");
  exercise.erase("mistakes");
  EXPECT_EQ(exerciseHash(exercise), hash);
  exercise["pass_mark"] = 0.71;
  EXPECT_NE(exerciseHash(exercise), hash);
}

}  // namespace
}  // namespace standpoint
