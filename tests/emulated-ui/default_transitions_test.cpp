// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/default_transitions.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace standpoint {
namespace {

using Rows = std::vector<Transition>;

Rows of(const Rows& rows, const EventId& event) {
  Rows found;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(found),
               [&](const Transition& t) { return t.event == event; });
  return found;
}

const PhaseId kIdle{"idle"}, kScanning{"scanning"}, kPhotographing{"photographing"};

DeviceRoles everything() {
  DeviceRoles roles;
  roles.working = roles.measuring = roles.holding = {kScanning, kPhotographing};
  roles.camera = {kPhotographing};
  roles.kept = PhaseId{"storing"};
  roles.scans = "scans";
  roles.tools = "tools";
  roles.tilted = "level == out";
  roles.near = "nearest < 1";
  return roles;
}

TEST(DefaultTransitions, StandBehindTheDevicesOwn) {
  const auto rows = withDefaults(
      {{.from = {kScanning}, .event = EngineEvent::tripod_moved, .guard = "tilt > 1", .to = kIdle}}, everything());
  const auto moved = of(rows, "tripod_moved");
  ASSERT_EQ(moved.size(), 3U);  // its own, that of a scan, and that of adjusting
  EXPECT_EQ(moved[0].guard, "tilt > 1");
  EXPECT_EQ(moved[1].to.name, "error");
}

TEST(DefaultTransitions, GiveWayToAnOwnRowThatTakesAllTheirPhases) {
  const auto partly = withDefaults({{.from = {kScanning}, .event = "stop", .to = kIdle}}, everything());
  EXPECT_EQ(of(partly, "stop").size(), 2U);
  const auto wholly = withDefaults(
      {{.from = {kScanning}, .event = "stop", .to = kIdle}, {.from = {kPhotographing}, .event = "stop", .to = kIdle}},
      everything());
  EXPECT_EQ(of(wholly, "stop").size(), 2U);
  for (const auto& row : of(wholly, "stop")) EXPECT_EQ(row.to, kIdle);
}

TEST(DefaultTransitions, GiveWayToAnOwnRowOfTheSameConditionOnly) {
  const auto rows =
      of(withDefaults({{.from = {kIdle}, .event = "format_confirmed", .guard = "card == present", .show = "start"}},
                      everything()),
         "format_confirmed");
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].show, "start");
  EXPECT_EQ(rows[1].ask, "card_absent");
  EXPECT_EQ(rows[2].ask, "card_locked");
}

TEST(DefaultTransitions, AreNotThereForWhatADeviceDoesNotHave) {
  auto roles = everything();
  roles.card_needed = roles.tools = roles.tilted = std::nullopt;
  roles.off.reset();
  roles.links = false;
  const auto rows = withDefaults({}, roles);
  for (const char* event : {"card_removed", "adjust", "power_key", "battery_empty", "linked"})
    EXPECT_TRUE(of(rows, event).empty()) << event;
  for (const auto& row : rows) EXPECT_FALSE(row.from.empty()) << rowName(row);
  for (const auto& row : of(rows, "start")) EXPECT_NE(row.ask, "tilt_question");
}

TEST(DefaultTransitions, RefuseBeforeTheyAskAndAskBeforeTheyStart) {
  auto roles = everything();
  roles.first_questions = {{.from = {kIdle}, .event = "start", .guard = "setups > 0", .ask = "first"}};
  roles.last_questions = {{.from = {kIdle}, .event = "start", .guard = "setups > 1", .ask = "last"}};
  std::vector<std::string> asked;
  for (const auto& row : of(withDefaults({}, roles), "start")) asked.emplace_back(row.ask);
  EXPECT_EQ(asked, (std::vector<std::string>{"no_project", "no_station", "card_absent", "card_locked", "card_full",
                                             "battery_critical", "first", "temperature_question", "not_warm_question",
                                             "tilt_question", "near_question", "last", ""}));
}

TEST(DefaultTransitions, CarryTheDevicesMarks) {
  auto roles = everything();
  roles.marks = {{"S1", rowsOf("tripod_moved start/card_full")}};
  for (const auto& row : withDefaults({}, roles)) {
    const bool marked = rowName(row) == "tripod_moved" || rowName(row) == "start/card_full";
    EXPECT_EQ(row.source, marked ? "S1" : "P") << rowName(row);
  }
}

}  // namespace
}  // namespace standpoint
