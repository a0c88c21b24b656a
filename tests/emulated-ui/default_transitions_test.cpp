// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/default_transitions.h"

#include <algorithm>
#include <string_view>

#include <gtest/gtest.h>

namespace standpoint {
namespace {

using Rows = std::vector<Transition>;

Rows of(const Rows& rows, std::string_view event) {
  Rows found;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(found),
               [&](const Transition& t) { return event == t.event; });
  return found;
}

DeviceRoles everything() {
  DeviceRoles roles;
  roles.working = roles.measuring = roles.holding = "scanning photographing";
  roles.camera = "photographing";
  roles.kept = "storing";
  roles.scans = "scans";
  roles.tools = "tools";
  roles.tilted = "level == out";
  roles.near = "nearest < 1";
  return roles;
}

TEST(DefaultTransitions, StandBehindTheDevicesOwn) {
  const auto rows = withDefaults({{"scanning", "tripod_moved", "tilt > 1", "idle"}}, everything());
  const auto moved = of(rows, "tripod_moved");
  ASSERT_EQ(moved.size(), 3U);  // its own, that of a scan, and that of adjusting
  EXPECT_STREQ(moved[0].guard, "tilt > 1");
  EXPECT_STREQ(moved[1].to, "error");
}

TEST(DefaultTransitions, GiveWayToAnOwnRowThatTakesAllTheirPhases) {
  const auto partly = withDefaults({{"scanning", "stop", "", "idle"}}, everything());
  EXPECT_EQ(of(partly, "stop").size(), 2U);
  const auto wholly =
      withDefaults({{"scanning", "stop", "", "idle"}, {"photographing", "stop", "", "idle"}}, everything());
  EXPECT_EQ(of(wholly, "stop").size(), 2U);
  for (const auto& row : of(wholly, "stop")) EXPECT_STREQ(row.to, "idle");
}

TEST(DefaultTransitions, GiveWayToAnOwnRowOfTheSameConditionOnly) {
  const auto rows = of(withDefaults({{"idle", "format_confirmed", "card == present", "", "start"}}, everything()),
                       "format_confirmed");
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_STREQ(rows[0].show, "start");
  EXPECT_STREQ(rows[1].ask, "card_absent");
  EXPECT_STREQ(rows[2].ask, "card_locked");
}

TEST(DefaultTransitions, AreNotThereForWhatADeviceDoesNotHave) {
  auto roles = everything();
  roles.card_needed = roles.tools = roles.tilted = roles.off = nullptr;
  roles.links = false;
  const auto rows = withDefaults({}, roles);
  for (const char* event : {"card_removed", "adjust", "power_key", "battery_empty", "linked"})
    EXPECT_TRUE(of(rows, event).empty()) << event;
  for (const auto& row : rows)
    for (const char* part : {row.from, row.event, row.guard, row.to, row.show, row.ask}) ASSERT_NE(part, nullptr);
  for (const auto& row : of(rows, "start")) EXPECT_STRNE(row.ask, "tilt_question");
}

TEST(DefaultTransitions, RefuseBeforeTheyAskAndAskBeforeTheyStart) {
  auto roles = everything();
  roles.first_questions = {{"idle", "start", "setups > 0", "", "", "first"}};
  roles.last_questions = {{"idle", "start", "setups > 1", "", "", "last"}};
  std::vector<std::string> asked;
  for (const auto& row : of(withDefaults({}, roles), "start")) asked.emplace_back(row.ask);
  EXPECT_EQ(asked, (std::vector<std::string>{"no_project", "no_station", "card_absent", "card_locked", "card_full",
                                             "battery_critical", "first", "temperature_question", "not_warm_question",
                                             "tilt_question", "near_question", "last", ""}));
}

TEST(DefaultTransitions, CarryTheDevicesMarks) {
  auto roles = everything();
  roles.marks = {{"S1", "tripod_moved start/card_full"}};
  for (const auto& row : withDefaults({}, roles)) {
    const bool marked = rowName(row) == "tripod_moved" || rowName(row) == "start/card_full";
    EXPECT_STREQ(row.source, marked ? "S1" : "P") << rowName(row);
  }
}

}  // namespace
}  // namespace standpoint
