// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/emulated-ui/x7.h"

namespace standpoint {
namespace {

TEST_F(X7, StartsWithoutItsScannerAndShowsThatItIsNotConnected) {
  start();
  EXPECT_EQ(d.phase(), "disconnected");
  EXPECT_EQ(d.shows("connected"), "not connected");
  ASSERT_TRUE(d.press({"create_new", "create"}));
  EXPECT_EQ(d.screen(), "map_view") << "after Create the Map View opens";
  EXPECT_EQ(d.shows("connected"), "not connected") << "with the red icon";
  ASSERT_TRUE(d.press({"scan_panel"}));
  EXPECT_TRUE(d.refuses("start_scan"));
}

TEST_F(X7, ConnectsByWlanOrByCable) {
  start();
  ASSERT_TRUE(d->trouble("wlan_lost"));
  ASSERT_TRUE(d.press({"connect"}));
  EXPECT_EQ(d.dialog(), "no_connection");
  ASSERT_TRUE(d.press({"ok", "connection=cable", "connect"}));
  d->tick(5);
  EXPECT_EQ(d.phase(), "idle");
  EXPECT_EQ(d.shows("connected"), "connected") << "the icon goes";
  ASSERT_TRUE(d.press({"create_new", "create", "status", "disconnect"}));
  EXPECT_EQ(d.phase(), "disconnected");
  ASSERT_TRUE(d.press({"connection=wlan"}));
  ASSERT_TRUE(d->hand("go_near"));
  ASSERT_TRUE(d.press({"connect"}));
  d->tick(5);
  EXPECT_EQ(d.phase(), "idle");
}

TEST_F(X7, KeepsCreateGreyUntilTheStartIndexIsValid) {
  start();
  ASSERT_TRUE(d.press({"create_new"}));
  EXPECT_EQ(d.shows("first"), "1");
  for (const char* wrong : {"0", "1.5"}) {
    ASSERT_TRUE(d.press({std::string("first=") + wrong}));
    EXPECT_TRUE(d.refuses("create")) << wrong;
  }
  EXPECT_TRUE(d.refuses("first", "1000000"));
  EXPECT_TRUE(d.refuses("first", "-3"));
  for (const char* good : {"999999", "1", "17"}) {
    TestDevice one = d;
    ASSERT_TRUE(one.press({std::string("first=") + good, "create"}));
    EXPECT_EQ(one.shows("next_station"), good);
  }
}

TEST_F(X7, FixesTheStartIndexWithCreate) {
  start();
  ASSERT_TRUE(d.press({"create_new", "first=40", "create"}));
  for (const char* away : {"menu", "all_projects", "project_list=0", "scan_panel"}) {
    EXPECT_TRUE(d.refuses("first", "7")) << d.screen();
    ASSERT_TRUE(d.press({away}));
  }
  EXPECT_EQ(d.fact("project.first"), "40");
}

TEST_F(X7, TakesAStandardNameForAnEmptyOneAndRefusesForbiddenCharacters) {
  start();
  ASSERT_TRUE(d.press({"create_new"}));
  for (const char* sign : {"\\", "/", ":", "*", "?", "\"", "<", ">", "|"}) {
    TestDevice one = d;
    ASSERT_TRUE(one.press({std::string("name=House ") + sign + " 2", "create"}));
    EXPECT_EQ(one.dialog(), "refused") << sign;
    EXPECT_EQ(one.fact("projects"), "0");
  }
  ASSERT_TRUE(d.press({"name=", "first=12", "create"}));
  EXPECT_EQ(d.shows("project"), "Project 001");
  EXPECT_EQ(d.shows("next_station"), "12") << "what was typed stays";
}

TEST_F(X7, DescribesAProjectWithTimeAndUser) {
  start();
  ASSERT_TRUE(d.press({"options", "operator=Olena", "back", "create_new"}));
  EXPECT_EQ(d.shows("note"), "1:00, Olena");
}

TEST_F(X7, ListsProjectsThatHaveAPicture) {
  start();
  ASSERT_TRUE(d.press({"create_new", "name=A", "project_photo=take", "create", "menu", "create_new", "name=B",
                       "project_photo=none", "create", "menu", "all_projects"}));
  const auto screen = d->screen();
  const auto* list = findWidget(screen, "project_list");
  ASSERT_NE(list, nullptr);
  EXPECT_EQ(list->options[0].label, "A  (0)  (with image)");
  EXPECT_EQ(list->options[1].label, "B  (0)");
}

TEST_F(X7, ImportsOnlyRawScansThatAreOnTheCard) {
  start();
  ASSERT_TRUE(d.press({"import_project", "import_format=TDX", "import_now"}));
  EXPECT_EQ(d.dialog(), "refused");
}

TEST_F(X7, ExportsByCableOrWlan) {
  ready();
  scanAt("S1");
  ASSERT_TRUE(d.press({"map", "export", "export_format=E57", "by_wlan"}));
  const auto order = d->takeOrder();
  ASSERT_TRUE(order && std::holds_alternative<TransferOrder>(*order));
  EXPECT_EQ(std::get<TransferOrder>(*order).by, "wlan");
  d->transferDone(std::get<TransferOrder>(*order).files);
  EXPECT_EQ(d.dialog(), "transferred");
  ASSERT_TRUE(d.press({"ok"}));
  EXPECT_EQ(d.shows("untransferred"), "0");
}

TEST_F(X7, ExportsTheFormatsThatCanBeWrittenAndNoOthers) {
  ready();
  scanAt("S1");
  ASSERT_TRUE(d.press({"map", "export"}));
  for (const char* makers : {"TDX", "RCP", "POD", "TZF"}) {
    ASSERT_TRUE(d.press({std::string("export_format=") + makers}));
    EXPECT_TRUE(d.refuses("by_cable")) << makers;
    EXPECT_TRUE(d.refuses("by_wlan")) << makers;
  }
  const std::pair<const char*, const char*> kWritten[] = {{"E57", ""}, {"LAS", ".las"}, {"PTX", ".ptx"}};
  for (const auto& [format, extension] : kWritten) {
    ASSERT_TRUE(d.press({std::string("export_format=") + format, "by_cable"}));
    const auto order = d->takeOrder();
    ASSERT_TRUE(order);
    EXPECT_EQ(std::get<TransferOrder>(*order).extension, extension);
  }
}

}  // namespace
}  // namespace standpoint
