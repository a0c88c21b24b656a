// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/events.h"

#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "project/verb.h"
#include "tests/emulated-ui/support.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;

// What the sources of the devices note.
std::set<std::string> notedInSources() {
  static const std::regex kNote("\\bnote\\(\"([a-z_]+)\"");
  std::set<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(SOURCE_DIR "/emulated-ui")) {
    if (entry.path().extension() != ".cpp") continue;
    std::ifstream in(entry.path());
    const std::string text(std::istreambuf_iterator<char>(in), {});
    for (auto at = std::sregex_iterator(text.begin(), text.end(), kNote); at != std::sregex_iterator(); ++at)
      found.insert((*at)[1]);
  }
  return found;
}

TEST(Events, TheTableHasAllThatDevicesNoteAndNothingElse) {
  std::set<std::string> table;
  for (const auto& row : eventRows())
    if (row.logged) {
      EXPECT_TRUE(table.insert(row.name).second) << row.name;
    }
  EXPECT_EQ(table, notedInSources());
}

TEST(Events, EachSaysInEveryLanguageThatItNeverCame) {
  std::set<std::string> own;
  for (const auto& device : emulatedDevices()) {
    const auto type = *loadDevice(device);
    for (const auto& language : type->words->languages())
      for (const auto& event : device.program().events)
        EXPECT_TRUE(type->words->has(device.id, std::string("never.") + event.name, language))
            << device.id << " " << event.name << " " << language;
    for (const auto& event : device.program().events) own.insert(event.name);
  }
  TestDevice focus("faro-focus");
  const auto& words = *focus->type().words;
  for (const auto& language : words.languages()) {
    EXPECT_TRUE(words.has({}, "never_asked", language)) << language;
    for (const auto& row : eventRows())
      if (row.logged && !own.contains(row.name)) {
        EXPECT_TRUE(words.has({}, std::string("never.") + row.name, language)) << row.name << " " << language;
      }
  }
}

// What a device really notes is never refused in an exercise.
TEST(Events, WhatADeviceNotesCanBeCounted) {
  TestDevice focus("faro-focus");
  ASSERT_TRUE(focus.press({"power"}));
  focus.settle();
  ASSERT_TRUE(focus.press({"parameters", "resolution_quality", "resolution=1/20"}));
  ASSERT_TRUE(focus->hand("stand_at", "S1"));
  for (const auto& event : focus->state().log) {
    const auto name =
        "count." + event.what + (event.detail.empty() ? "" : "." + event.detail.substr(0, event.detail.find('=')));
    EXPECT_EQ(wrongCounter(name, *focus), std::nullopt) << name;
  }
}

TEST(Events, AnUnknownOneOrAnUnknownDetailIsTold) {
  TestDevice focus("faro-focus");
  EXPECT_NE(wrongCounter("count.xyz", *focus), std::nullopt);
  EXPECT_NE(wrongCounter("count.hand.juggle", *focus), std::nullopt);
  EXPECT_NE(wrongCounter("count.woken.twice", *focus), std::nullopt);
  EXPECT_NE(wrongEvent("scan_begun"), std::nullopt);
  EXPECT_NE(wrongEvent("targets_moved"), std::nullopt) << "it is counted only: no rule can be asked at it";
  EXPECT_EQ(wrongEvent("scan_started"), std::nullopt);
}

}  // namespace
}  // namespace standpoint
