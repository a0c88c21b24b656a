// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/json_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/core/own_seconds.h"

namespace standpoint {
namespace {

std::string saysOfText(const std::string& text) {
  const auto parsed = parseJson(text, "f.json");
  return parsed ? "read" : describe(parsed.error());
}

TEST(JsonFile, IsRefusedWithTheLineThatIsNoJson) {
  EXPECT_THAT(saysOfText("[\n1,\n2,,\n3]"), testing::StartsWith("f.json line 3: is not JSON"));
  EXPECT_THAT(saysOfText(""), testing::StartsWith("f.json line 1: is not JSON"));
  EXPECT_THAT(saysOfText("[1e999]"), testing::StartsWith("f.json: is not JSON"));
}

TEST(JsonFile, IsRefusedWhereAKeyIsThereTwiceInOneObject) {
  EXPECT_EQ(saysOfText("{\"a\": 1, \"b\": [{\"c\": 1, \"c\": 2}]}"),
            "f.json: has the key 'c' more than once in one object");
  EXPECT_EQ(saysOfText("[{\"a\": 1}, {\"a\": {\"a\": 2}}]"), "read");
}

TEST(JsonFile, IsRefusedWhereItIsNestedTooDeep) {
  const auto nested = [](std::size_t levels) { return std::string(levels, '[') + std::string(levels, ']'); };
  EXPECT_EQ(saysOfText(nested(32)), "read");
  EXPECT_EQ(saysOfText(nested(33)), "f.json: is nested deeper than 32 levels");
  EXPECT_EQ(saysOfText(std::string(1'000'000, '[')), "f.json: is nested deeper than 32 levels");
}

TEST(JsonFile, OfManyObjectsTakesNoLongerForEachOfThem) {
  std::string text = "[";
  for (int i = 0; i < 200'000; ++i) text += "{\"press\": \"start\"},";
  text.back() = ']';
  const double start = test::ownSeconds();
  EXPECT_EQ(parseJson(text, "f.json")->size(), 200'000U);
  EXPECT_LT(test::ownSeconds() - start, 5) << "13 s where each walks through all";
}

}  // namespace
}  // namespace standpoint
