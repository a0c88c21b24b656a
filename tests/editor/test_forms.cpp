// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "editor/model/option_form.h"
#include "pointclouds/formats.h"
#include "project/verb.h"

namespace standpoint {
namespace {

using nlohmann::json;

TEST(OptionForm, OfEveryVerbGivesOptionsThatTheVerbAccepts) {
  for (const auto& verb : verbs()) {
    OptionForm form(verb);
    for (auto& field : form.fields())  // what must be given is given
      if (field.parameter->required && field.text.empty())
        field.text = std::string_view(field.parameter->name) == "filters" ? "duplicates" : "x";
    EXPECT_EQ(form.problem(), "") << verb.name;
    const auto checked = checkOptions(verb, form.options());
    EXPECT_TRUE(checked) << verb.name << ": " << (checked ? "" : describe(checked.error()));
  }
}

TEST(OptionForm, StartsWithTheDefaultsAndLeavesOutWhatIsOptional) {
  const Verb& optimize = *findVerb(verbs(), "optimize");
  OptionForm form(optimize);
  EXPECT_EQ(form.options(), (json{{"engine", "auto"}, {"max-deviation", 0.015}}));
  form.find("budget")->given = true;
  form.find("budget")->number = 2000;
  EXPECT_EQ(form.options()["budget"], 2000);
  EXPECT_TRUE(form.options()["budget"].is_number_integer());
}

TEST(OptionForm, SplitsLinesIntoAListAndRefusesPairsWithoutEqualsSign) {
  OptionForm form(*findVerb(verbs(), "materials"));
  auto& assign = *form.find("assign");
  assign.given = true;
  assign.text = " class:IfcWall=brick \n\nname:*glas*=glass\n";
  EXPECT_EQ(form.options()["assign"], (json{"class:IfcWall=brick", "name:*glas*=glass"}));
  EXPECT_EQ(form.problem(), "");
  assign.text = "class:IfcWall";
  EXPECT_NE(form.problem().find("class:IfcWall"), std::string::npos);
}

TEST(OptionForm, NamesWhatIsMissing) {
  const OptionForm form(*findVerb(verbs(), "export"));
  EXPECT_EQ(form.problem(), "File is missing");
}

TEST(FileKinds, AreThoseThatTheVerbsWrite) {
  std::vector<std::string> written, offered;
  for (const auto& format : cloudFormats())
    if (format.writer != nullptr) written.emplace_back(format.extension);
  for (const auto& kind : pointKinds()) offered.emplace_back(kind.extension);
  EXPECT_THAT(offered, testing::UnorderedElementsAreArray(written));
  const Verb& verb = *findVerb(verbs(), "export");
  for (const auto& kind : modelKinds()) {
    EXPECT_NE(std::string(OptionForm(verb).find("output")->parameter->help).find(kind.extension), std::string::npos);
    for (const auto option : kind.unknown_options)
      EXPECT_NE(OptionForm(verb).find(std::string(option).c_str()), nullptr) << option;
  }
}

TEST(FileKinds, TakeTheEndingOfAnotherAwayAndNoOther) {
  const auto kinds = pointKinds();
  const auto& las = *kindOf(kinds, "x.LAS");
  EXPECT_STREQ(las.label, "LAS");
  EXPECT_EQ(withKind(kinds, las, "/no/such/walk.e57"), "/no/such/walk.las");
  EXPECT_EQ(withKind(kinds, las, "/no/such/room 1.01"), "/no/such/room 1.01.las");
  EXPECT_EQ(kindOf(kinds, "/no/such/room 1.01"), nullptr);
}

TEST(OptionForm, SendsNothingThatTheFormatHasNoPlaceFor) {
  OptionForm form(*findVerb(verbs(), "export"));
  auto& file = *form.find("output");
  file.kinds = modelKinds();
  file.text = "house.obj";
  form.find("physical")->flag = form.find("physical")->given = true;
  EXPECT_TRUE(form.options().contains("physical"));
  file.text = "house.glb";
  EXPECT_FALSE(form.options().contains("physical"));
  file.text = "house";
  EXPECT_EQ(form.problem(), "Choose a format");
}

TEST(OptionForm, TakesWhatAJobFileSaysAndGivesItBack) {
  const json options = {{"add", "S7"},       {"on", {1.5, 2.5, 0.0}},   {"height", 1.8}, {"yaw-deg", 90.0},
                        {"stand", "tripod"}, {"tilt-towards-deg", 0.0}, {"seed", 1}};
  OptionForm form(*findVerb(verbs(), "station"));
  form.fill(options);
  EXPECT_EQ(form.options(), options);
}

}  // namespace
}  // namespace standpoint
