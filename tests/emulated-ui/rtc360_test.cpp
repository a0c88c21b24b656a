// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "emulated-ui/menus.h"

namespace standpoint {
namespace {

std::unique_ptr<Menu> rtc360() {
  auto menu = makeMenu(emulatedInstruments()[0]);
  EXPECT_TRUE(menu) << describe(menu.error());
  return *std::move(menu);
}

std::string value(const Menu& menu, const std::string& id) {
  const auto screen = menu.screen();
  const auto* w = findWidget(screen, id);
  return w == nullptr ? "(not there)" : w->value;
}

bool has(const Menu& menu, const std::string& id) {
  const auto screen = menu.screen();
  return findWidget(screen, id) != nullptr;
}

// On, with a job called `job`, standing at S1.
std::unique_ptr<Menu> ready(const std::string& job = "Training") {
  auto menu = rtc360();
  EXPECT_TRUE(menu->act("power"));
  menu->tick(60);
  menu->standAt("S1");
  EXPECT_TRUE(menu->act("job"));
  EXPECT_TRUE(menu->act("new_job"));
  EXPECT_TRUE(menu->act("name", job));
  EXPECT_TRUE(menu->act("create"));
  return menu;
}

StoredScan stored(const ScanRequest& r) {
  return {r.job, r.setup, r.station, r.settings, "scans/" + r.job + "/Setup 001.e57", 1000000, 86};
}

TEST(Rtc360, StartsWithItsKeyAndThenShowsHome) {
  auto menu = rtc360();
  EXPECT_FALSE(menu->busy());
  EXPECT_FALSE(menu->act("scan")) << "it is off";
  ASSERT_TRUE(menu->act("power"));
  EXPECT_TRUE(menu->busy());
  menu->tick(60);
  EXPECT_EQ(menu->screen().id, "home");
}

TEST(Rtc360, MakesNamesAndOpensAJob) {
  auto menu = ready("House");
  EXPECT_EQ(value(*menu, "job"), "House");
  EXPECT_EQ(value(*menu, "next_setup"), "1");
  ASSERT_TRUE(menu->act("job"));
  ASSERT_TRUE(menu->act("new_job"));
  EXPECT_FALSE(menu->act("name", "a/b")) << "the name becomes a folder's";
  ASSERT_TRUE(menu->act("name", "House"));
  ASSERT_TRUE(menu->act("create"));
  EXPECT_TRUE(has(*menu, "message")) << "the name is taken";
  ASSERT_TRUE(menu->act("ok"));
  ASSERT_TRUE(menu->act("name", "Garden"));
  ASSERT_TRUE(menu->act("create"));
  EXPECT_EQ(value(*menu, "job"), "Garden");
  ASSERT_TRUE(menu->act("job"));
  EXPECT_FALSE(menu->act("jobs", "2"));
  ASSERT_TRUE(menu->act("jobs", "0"));
  EXPECT_EQ(value(*menu, "job"), "House");
}

// Times and grids: instrument facts, section 1.4: Low 26 s and 5084 x 2083, images 60 s, Medium below two minutes with images.
TEST(Rtc360, ShowsTheTimeAndThePointsOfItsSettings) {
  auto menu = ready();
  ASSERT_TRUE(menu->act("settings"));
  ASSERT_TRUE(menu->act("resolution", "12mm"));
  ASSERT_TRUE(menu->act("images", "on"));
  ASSERT_TRUE(menu->act("double_scan", "off"));
  EXPECT_EQ(value(*menu, "expected_time"), "1:26");
  EXPECT_EQ(value(*menu, "expected_points"), "10.6 M (5084 × 2083)");
  ASSERT_TRUE(menu->act("images", "off"));
  EXPECT_EQ(value(*menu, "expected_time"), "0:26");
  ASSERT_TRUE(menu->act("double_scan", "on"));
  EXPECT_EQ(value(*menu, "expected_time"), "0:52");
  ASSERT_TRUE(menu->act("resolution", "6mm"));
  ASSERT_TRUE(menu->act("images", "on"));
  ASSERT_TRUE(menu->act("double_scan", "off"));
  EXPECT_EQ(value(*menu, "expected_time"), "1:51");
  EXPECT_FALSE(menu->act("resolution", "5mm"));
}

TEST(Rtc360, RefusesToScanWithoutJobPlaceOrMemoryAndSaysWhy) {
  auto menu = rtc360();
  ASSERT_TRUE(menu->act("power"));
  menu->tick(60);
  ASSERT_TRUE(menu->act("scan"));
  EXPECT_NE(menu->screen().widgets[2].label.find("job"), std::string::npos);
  EXPECT_FALSE(menu->takeRequest());

  menu = ready();
  menu->standAt("");
  ASSERT_TRUE(menu->act("scan"));
  EXPECT_TRUE(has(*menu, "message"));
  ASSERT_TRUE(menu->act("ok"));
  menu->standAt("S1");
  ASSERT_TRUE(menu->act("status"));
  ASSERT_TRUE(menu->act("usb", "off"));
  ASSERT_TRUE(menu->act("back"));
  ASSERT_TRUE(menu->act("scan"));
  EXPECT_TRUE(has(*menu, "message"));
  EXPECT_FALSE(menu->takeRequest());
}

TEST(Rtc360, ScansTakesImagesStoresAndShowsTheDataAtOnce) {
  auto menu = ready("House");
  ASSERT_TRUE(menu->act("settings"));
  ASSERT_TRUE(menu->act("resolution", "12mm"));
  ASSERT_TRUE(menu->act("images", "on"));
  ASSERT_TRUE(menu->act("back"));
  ASSERT_TRUE(menu->act("scan"));
  const auto request = menu->takeRequest();
  ASSERT_TRUE(request);
  EXPECT_EQ(request->job, "House");
  EXPECT_EQ(request->station, "S1");
  EXPECT_FALSE(menu->takeRequest()) << "once";
  menu->tick(13);
  menu->scanMoved(1);
  EXPECT_EQ(value(*menu, "progress"), "15");
  EXPECT_EQ(value(*menu, "remaining"), "1:13");
  menu->tick(20);
  EXPECT_EQ(findWidget(menu->screen(), "doing")->label, "Taking images");
  menu->scanDone(stored(*request));
  menu->tick(53.5);
  EXPECT_FALSE(menu->takeStored());
  menu->tick(2);
  EXPECT_TRUE(menu->takeStored());
  EXPECT_FALSE(menu->busy());
  EXPECT_EQ(menu->screen().id, "setup");
  EXPECT_EQ(value(*menu, "points"), "1000000");
  ASSERT_TRUE(menu->act("view"));
  EXPECT_EQ(menu->takeView()->file, "scans/House/Setup 001.e57");
  ASSERT_TRUE(menu->act("back"));
  ASSERT_TRUE(menu->act("back"));
  EXPECT_EQ(value(*menu, "next_setup"), "2");
}

TEST(Rtc360, WaitsForTheSimulationWhenItIsSlowerThanTheInstrument) {
  auto menu = ready();
  ASSERT_TRUE(menu->act("scan"));
  const auto request = menu->takeRequest();
  menu->scanMoved(0.4);
  menu->tick(100000);
  EXPECT_EQ(value(*menu, "progress"), "40") << "what is shown as done is done";
  EXPECT_TRUE(menu->busy());
  menu->scanDone(stored(*request));
  menu->tick(10);
  EXPECT_TRUE(menu->takeStored());
}

TEST(Rtc360, DiscardsTheSetupWhenStoppedAfterAsking) {
  auto menu = ready();
  ASSERT_TRUE(menu->act("scan"));
  const auto request = menu->takeRequest();
  ASSERT_TRUE(menu->act("stop"));
  ASSERT_TRUE(menu->act("no"));
  EXPECT_FALSE(menu->takeCancel());
  menu->scanDone(stored(*request));
  ASSERT_TRUE(menu->act("stop"));
  ASSERT_TRUE(menu->act("yes"));
  EXPECT_TRUE(menu->takeCancel());
  EXPECT_FALSE(menu->busy());
  menu->tick(1000);
  EXPECT_FALSE(menu->takeStored());
  EXPECT_EQ(value(*menu, "next_setup"), "1");
}

TEST(Rtc360, ShowsWhatTheProjectAlreadyHolds) {
  auto menu = rtc360();
  menu->load({{"House", 1, "S1", {}, "a", 5, 26}, {"House", 4, "S2", {}, "b", 5, 26}, {"Yard", 1, "S3", {}, "c", 5, 26}});
  ASSERT_TRUE(menu->act("power"));
  menu->tick(60);
  ASSERT_TRUE(menu->act("job"));
  ASSERT_EQ(findWidget(menu->screen(), "jobs")->options.size(), 2U);
  ASSERT_TRUE(menu->act("jobs", "0"));
  EXPECT_EQ(value(*menu, "next_setup"), "5");
}

// Whatever is pressed in whatever order: no state without a way out, no crash.
TEST(Rtc360, SurvivesAnyOrderOfPresses) {
  std::uint32_t random = 12345;
  const auto next = [&](std::size_t n) {
    random = random * 1664525U + 1013904223U;
    return (random >> 8U) % n;
  };
  for (int round = 0; round < 50; ++round) {
    auto menu = rtc360();
    menu->standAt("S1");
    for (int i = 0; i < 300; ++i) {
      const auto screen = menu->screen();
      ASSERT_FALSE(screen.widgets.empty());
      const auto& w = screen.widgets[next(screen.widgets.size())];
      std::string argument = w.kind == WidgetKind::choice && !w.options.empty() ? w.options[next(w.options.size())]
                             : w.kind == WidgetKind::list                        ? std::to_string(next(3))
                                                                                 : "n" + std::to_string(i);
      (void)menu->act(w.id, argument);
      if (next(4) == 0) menu->tick(static_cast<double>(next(200)));
      if (const auto request = menu->takeRequest(); request && next(2) == 0) menu->scanDone(stored(*request));
      if (next(40) == 0) menu->scanFailed("disk full");
    }
  }
}

}  // namespace
}  // namespace standpoint
