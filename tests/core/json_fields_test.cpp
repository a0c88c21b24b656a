// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/json_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace standpoint {
namespace {

using nlohmann::json;

// What is said after `read` of an object at /rules/0 of a file.
template <class Read>
std::string saysOf(const json& object, const Read& read) {
  JsonFault fault("r.json");
  JsonFields fields(fault, object, "/rules/0");
  read(fields);
  fields.close();
  const auto result = fault.result();
  return result ? std::string() : describe(result.error());
}

TEST(JsonFields, ReadWhatIsThere) {
  const json object = {{"name", "S1"}, {"height_m", 1.6}, {"level", true}, {"colour", "#2e3033"}, {"unit", ""}};
  EXPECT_EQ(saysOf(object,
                   [](JsonFields& f) {
                     EXPECT_EQ(f.text("name"), "S1");
                     EXPECT_EQ(f.number("height_m", 0, 2), 1.6);
                     EXPECT_TRUE(f.flagOr("level", false));
                     EXPECT_EQ(f.colourOr("colour", 0), 0x2e3033U);
                     EXPECT_EQ(f.anyText("unit"), "");
                   }),
            "");
}

TEST(JsonFields, TakeTheDefaultForWhatIsNotThere) {
  EXPECT_EQ(saysOf(json::object(),
                   [](JsonFields& f) {
                     EXPECT_EQ(f.textOr("name", "S1"), "S1");
                     EXPECT_EQ(f.numberOr("height_m", 1.6, 0, 1), 1.6);
                     EXPECT_EQ(f.optionalNumber("height_m", 0, 1), std::nullopt);
                     EXPECT_TRUE(f.texts("stations").empty());
                   }),
            "");
}

TEST(JsonFields, NameTheFileAndThePointerOfWhatIsWrong) {
  const auto name = [](JsonFields& f) { f.text("name"); };
  const auto height = [](JsonFields& f) { f.number("height_m", 0, 2); };
  const std::pair<std::string, std::string> kFaults[] = {
      {saysOf(json::object(), name), "r.json /rules/0/name: is missing"},
      {saysOf({{"name", " "}}, name), "r.json /rules/0/name: must not be empty"},
      {saysOf({{"name", 7}}, name), "r.json /rules/0/name: must be a text, in quotes, not the number 7; write \"7\""},
      {saysOf({{"height_m", 3}}, height), "r.json /rules/0/height_m: must be a number from 0 to 2, not the number 3"},
      {saysOf({{"height_m", "1.6"}}, height),
       "r.json /rules/0/height_m: must be a number from 0 to 2, without quotes, not the text \"1.6\""},
      {saysOf({{"nam", "S1"}}, [](JsonFields& f) { f.skip("name"); }),
       "r.json /rules/0/nam: unknown key; did you mean 'name'? available: name"},
      {saysOf({{"a/b", 1}}, [](JsonFields&) {}), "r.json /rules/0/a~1b: unknown key; none"},
      {saysOf(json::array(), [](JsonFields&) {}), "r.json /rules/0: must be an object in braces, not a list"}};
  for (const auto& [said, expected] : kFaults) EXPECT_EQ(said, expected);
}

TEST(JsonFields, GoDownIntoObjectsAndLists) {
  const json object = {{"steps", {{{"id", "scan"}}, {{"id", 5}}}}};
  std::vector<std::string> ids;
  EXPECT_THAT(
      saysOf(object,
             [&](JsonFields& f) { f.list("steps", [&](JsonFields& step) { ids.push_back(step.text("id")); }); }),
      testing::HasSubstr("r.json /rules/0/steps/1/id: must be a text"));
  EXPECT_EQ(ids, (std::vector<std::string>{"scan", ""}));
}

TEST(JsonFault, KeepsTheFirst) {
  JsonFault fault("r.json");
  EXPECT_TRUE(fault.result());
  fault.say("", "is first");
  fault.say("/a", "is second");
  EXPECT_EQ(describe(*fault.error()), "r.json: is first");
}

}  // namespace
}  // namespace standpoint
