// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/numbers.h"
#include "tests/emulated-ui/support.h"

namespace standpoint {
namespace {

Leads leads(TestDevice& d, const std::string& widget) {
  const auto screen = d->screen();
  const auto* w = findWidget(screen, widget);
  EXPECT_NE(w, nullptr) << widget;
  return w == nullptr ? Leads::nowhere : w->leads;
}

TEST(Screen, SaysWhetherAPressLeadsOnBackOrNowhere) {
  TestDevice d("generic");
  ASSERT_TRUE(d.press({"power"}));
  d->tick(30);
  EXPECT_EQ(leads(d, "project"), Leads::onwards);
  EXPECT_EQ(leads(d, "start_scan"), Leads::nowhere);
  ASSERT_TRUE(d.press({"scans"}));
  EXPECT_EQ(leads(d, "back"), Leads::back);
  EXPECT_EQ(leads(d, "home"), Leads::back) << "one came from there";
  ASSERT_TRUE(d.press({"home", "project", "new_project"}));
  EXPECT_EQ(leads(d, "create"), Leads::nowhere) << "it does something";
}

TEST(Screen, TellsAListThatIsOnlyReadFromOneThatIsPressed) {
  TestDevice d("generic");
  ASSERT_TRUE(d.press({"power"}));
  d->tick(30);
  ASSERT_TRUE(d.press({"project"}));
  EXPECT_TRUE(findWidget(d->screen(), "project_list")->acts);
  d->show("targets");
  EXPECT_FALSE(findWidget(d->screen(), "target_list")->acts);
}

TEST(Screen, ShowsHowFarAStartIsOnEveryDevice) {
  for (const auto& row : emulatedDevices()) {
    TestDevice d(row.id);
    const auto key = d->screen().body.front().id;
    ASSERT_TRUE(d.press({key}));
    const double lasts = d->fact("phase.lasts")->number.value();
    ASSERT_GT(lasts, 0) << row.id;
    d->tick(lasts / 2);
    EXPECT_EQ(d->screen().title, "Starting") << row.id;
    EXPECT_EQ(d.shows("phase_progress"), "50 %") << row.id;
  }
}

TEST(Screen, CallsAShutdownByItsName) {
  for (const auto& row : emulatedDevices()) {
    TestDevice d(row.id);
    const std::string key = d->screen().body.front().id;
    ASSERT_TRUE(d.press({key}));
    d->tick(d->fact("phase.lasts")->number.value() + 1);
    const bool held = key == "key";  // on its body; others ask on the screen
    ASSERT_TRUE(held ? d->act("key", "", Gesture::hold).has_value() : bool(d.press({"power", "yes"}))) << row.id;
    EXPECT_EQ(d->screen().title, "Shutting down") << row.id;
  }
}

TEST(Screen, ProposesAProjectSoThatNobodyHasToType) {
  TestDevice d("riegl-vz-i");
  ASSERT_TRUE(d.press({"power"}));
  d->tick(100);
  ASSERT_TRUE(d.press({"project", "load_or_create"}));
  EXPECT_EQ(d.fact("project"), "Project 001");
}

TEST(Screen, SaysInTheDevicesLanguageWhatIsWrongWithAName) {
  TestDevice d("generic");
  ASSERT_TRUE(d.press({"power"}));
  d->tick(30);
  ASSERT_TRUE(d.press({"options", "language=de", "back", "project", "new_project", "name=", "create"}));
  EXPECT_EQ(d->screen().dialog.text, "Der Name ist leer.");
}

TEST(Screen, NamesLanguagesInThemselves) {
  TestDevice d("generic");
  ASSERT_TRUE(d.press({"power"}));
  d->tick(30);
  ASSERT_TRUE(d.press({"options", "language=uk"}));
  EXPECT_EQ(d.shows("language"), "Українська");
  EXPECT_EQ(findWidget(d->screen(), "language")->options[1].label, "Deutsch");
}

TEST(Screen, StepsANumberInThePlaceOfItsLastDigit) {
  EXPECT_EQ(stepped("0.04", 1, 0, 360), "0.05");
  EXPECT_EQ(stepped("1.7", -1, 0, 5), "1.6");
  EXPECT_EQ(stepped("30", 1, 0, 360), "31");
  EXPECT_EQ(stepped("360", 1, 0, 360), "360");
  EXPECT_EQ(stepped("0.00", -1, 0, 360), "0.00");
  EXPECT_EQ(stepped("", 1, 1, 999), "1");
}

}  // namespace
}  // namespace standpoint
