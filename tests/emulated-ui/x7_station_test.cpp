// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <limits>

#include "tests/emulated-ui/x7.h"

namespace standpoint {
namespace {

TEST_F(X7, ShowsAllTheLatestOrTheNearestStations) {
  std::vector<StoredSetup> stored;
  for (int i = 1; i <= 7; ++i) {
    StoredSetup s;
    s.project = "House";
    s.number = i;
    s.name = "Station 00" + std::to_string(i);
    s.file = s.name;
    s.plan_x_m = i == 1 ? 7.5 : i;
    stored.push_back(s);
  }
  d->load(stored);
  start();
  ASSERT_TRUE(d.press({"all_projects", "project_list=0"}));
  const auto rows = [&] { return findWidget(d->screen(), "station_list")->options; };
  EXPECT_EQ(rows().size(), 7U);
  ASSERT_TRUE(d.press({"view_filter=latest"}));
  EXPECT_EQ(rows().front().value, "2");
  EXPECT_EQ(rows().size(), 5U);
  ASSERT_TRUE(d.press({"view_filter=nearest"}));
  ASSERT_EQ(rows().size(), 3U);
  EXPECT_EQ(rows()[1].value, "0") << "station 1 stands beside station 7";
  EXPECT_EQ(d.shows("next_station"), "8");
}

TEST_F(X7, ShowsHowMuchOfTheStationViewIsUnmeasured) {
  ready();
  scanAt("S1");
  auto preview = std::make_shared<ScanPreview>();
  preview->columns = 2;
  preview->rows = 2;
  preview->x_m = preview->y_m = preview->z_m = {1, 2, 3, std::numeric_limits<float>::quiet_NaN()};
  d->previewDone("scans/House/Station 001.e57", preview);
  EXPECT_EQ(d.shows("unmeasured"), "25 %");
}

// Slope distance, horizontal distance, vertical clearance [S13].
TEST_F(X7, MeasuresSlopePlanAndHeightBetweenTwoTaps) {
  ready();
  scanAt("S1");
  auto picture = std::make_shared<ScanPreview>();
  picture->columns = 2, picture->rows = 1;
  picture->x_m = {1, 4};
  picture->y_m = {1, 5};
  picture->z_m = {2, -10};
  picture->grey.assign(2, 0);
  d->shownSetup()->preview = picture;
  ASSERT_TRUE(d.press({"preview=0.1,0.5"}));
  EXPECT_EQ(d.shows("measured_vertical"), "–");
  ASSERT_TRUE(d.press({"preview=0.9,0.5"}));
  EXPECT_EQ(d.shows("measured"), "13.00 m");
  EXPECT_EQ(d.shows("measured_horizontal"), "5.00 m");
  EXPECT_EQ(d.shows("measured_vertical"), "-12.00 m");
  ASSERT_TRUE(d.press({"preview=0.1,0.5"}));
  EXPECT_EQ(d.shows("measured_horizontal"), "–") << "a third tap begins anew";
}

TEST_F(X7, KeepsAnnotationsWithTheirStation) {
  ready();
  scanAt("S1");
  ASSERT_TRUE(d.press({"annotation=Door was shut", "add_annotation"}));
  EXPECT_EQ(findWidget(d->screen(), "annotation_list")->options.at(0).label, "Door was shut");
  ASSERT_TRUE(d.press({"add_annotation"}));
  EXPECT_EQ(d.dialog(), "refused") << "it is empty";
}

TEST_F(X7, ListsItsErrorsWithLevelAndDescription) {
  ready();
  ASSERT_TRUE(d.press({"back", "status"}));
  EXPECT_TRUE(findWidget(d->screen(), "error_list")->options.empty());
  ASSERT_TRUE(d->trouble("card_locked"));
  const auto screen = d->screen();
  const auto* errors = findWidget(screen, "error_list");
  ASSERT_EQ(errors->options.size(), 1U);
  EXPECT_TRUE(errors->options[0].label.starts_with("Error | "));
}

TEST_F(X7, PointsItsLaserAtWhatIsTappedInTheStationView) {
  ready();
  scanAt("S1");
  auto picture = std::make_shared<ScanPreview>();
  picture->columns = 4, picture->rows = 2;
  picture->x_m = {1, 0, -1, 0, 1, 0, -1, std::nanf("")};
  picture->y_m = {0, -1, 0, 1, 0, -1, 0, 1};
  picture->z_m = {0, 0, 0, 0, 1, 1, 1, 1};
  picture->grey.assign(8, 0);
  d->shownSetup()->preview = picture;
  EXPECT_EQ(d.shows("pointer_spot"), "(not there)");
  ASSERT_TRUE(d.press({"pointer=on", "preview=0.3,0.9"}));
  EXPECT_EQ(d.shows("pointer_spot"), "1.00 m  H 90.0°  V 90.0°");
  EXPECT_EQ(d.fact("entry.measured_from"), "") << "a tap points and does not measure";
  ASSERT_TRUE(d.press({"preview=0.99,0.1"}));
  EXPECT_EQ(d.dialog(), "refused") << "no point came back from there";
  ASSERT_TRUE(d.press({"ok"}));
  ASSERT_TRUE(d->hand("stand_at", "S2"));
  EXPECT_EQ(d->fact("pointer.range")->number, 0) << "it was carried away";
  ASSERT_TRUE(d.press({"preview=0.3,0.9"}));
  EXPECT_EQ(d.dialog(), "refused");
  ASSERT_TRUE(d.press({"ok", "pointer=off", "preview=0.3,0.9"}));
  EXPECT_NE(d.fact("entry.measured_from"), "");
}

}  // namespace
}  // namespace standpoint
