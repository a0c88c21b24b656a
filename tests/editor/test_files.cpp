// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <chrono>
#include <fstream>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

#include "editor/desktop/file_list.h"
#include "editor/desktop/interface_scale.h"
#include "editor/desktop/window_place.h"
#include "editor/model/settings.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;

class Folder : public ::testing::Test {
 protected:
  void SetUp() override {
    root = fs::path(BINARY_DIR) / "test_editor_files" / ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(root);
    fs::create_directories(root);
  }
  void write(const fs::path& file, const std::string& text = "x") {
    fs::create_directories((root / file).parent_path());
    std::ofstream(root / file) << text;
  }
  fs::path root;
};

TEST_F(Folder, ListsFoldersFirstThenFilesOfTheWantedKinds) {
  write("b.ifc", "12345");
  write("A.IFC");
  write("c.txt");
  write(".hidden.ifc");
  write("zoo/project.json", "{}");
  const std::vector<std::string> kinds = {".ifc"};
  const auto listing = listFolder(root, kinds, FileOrder::name, false);
  ASSERT_EQ(listing.rows.size(), 3U);
  EXPECT_EQ(listing.rows[0].name, "zoo");
  EXPECT_TRUE(listing.rows[0].project);
  EXPECT_EQ(listing.rows[1].name, "A.IFC");
  EXPECT_EQ(listing.rows[2].bytes, 5U);
  const auto by_size = listFolder(root, kinds, FileOrder::size, true);
  EXPECT_EQ(by_size.rows[1].name, "b.ifc");
}

TEST_F(Folder, SaysWhyItCannotBeRead) {
  const auto listing = listFolder(root / "nowhere", {}, FileOrder::name, false);
  EXPECT_TRUE(listing.rows.empty());
  EXPECT_FALSE(listing.problem.empty());
}

TEST_F(Folder, KeepsSettingsFromOneStartToTheNext) {
  Settings settings;
  settings.remember("/models/house.ifc");
  settings.remember("/models/school.ifc");
  settings.remember("/models/house.ifc");
  settings.areas[1].left = 444;
  settings.window = WindowPlace{-1920, 40, 1700, 950, true};
  settings.drag_turns_head = false;
  settings.user_scale = 1.25;
  settings.graphics = GraphicsChoice::medium;
  settings.theme = Theme::light;
  ASSERT_TRUE(writeSettings(settings, root / "deep" / "editor.json"));
  const auto stored = readSettings(root / "deep" / "editor.json");
  EXPECT_EQ(stored.settings, settings);
  EXPECT_EQ(stored.problem, "");
  EXPECT_EQ(settings.recent, (std::vector<std::string>{"/models/house.ifc", "/models/school.ifc"}));
}

TEST_F(Folder, KeepsSettingsWhileTheEditorRunsThoughItIsKilledLater) {
  Settings settings;
  SettingsKeeper keeper(root / "editor.json", settings);
  keeper.keep(settings);
  EXPECT_LT(keeper.untilDue_s(), 0);
  settings.language = "de";
  settings.remember("/models/house.ifc");
  keeper.keep(settings);
  const double due = keeper.untilDue_s();
  ASSERT_GT(due, 0);
  ASSERT_LT(due, 2);
  EXPECT_FALSE(fs::exists(root / "editor.json")) << "not in every frame of a drag";
  std::this_thread::sleep_for(std::chrono::duration<double>(due));
  keeper.keep(settings);
  EXPECT_EQ(readSettings(root / "editor.json").settings, settings);
  EXPECT_LT(keeper.untilDue_s(), 0);
}

TEST(Scale, GoesUpAndDownAndEnds) {
  EXPECT_DOUBLE_EQ(neighbourScale(1, 1), 1.1);
  EXPECT_DOUBLE_EQ(neighbourScale(1, -1), 0.9);
  EXPECT_DOUBLE_EQ(neighbourScale(2.5, 1), 2.5);
  EXPECT_DOUBLE_EQ(neighbourScale(0.75, -1), 0.75);
  EXPECT_DOUBLE_EQ(neighbourScale(1.6, 0), 1.5) << "a size that is not on the list";
}

TEST(Scale, NeverOutgrowsTheWindow) {
  EXPECT_DOUBLE_EQ(fittingScale(1, 1, 1280, 800), 1);
  EXPECT_DOUBLE_EQ(fittingScale(1, 2.5, 3840, 2160), 2.5);
  EXPECT_DOUBLE_EQ(fittingScale(1, 2.5, 1280, 800), 1.5);
  EXPECT_DOUBLE_EQ(fittingScale(2, 1.25, 3840, 2160), 2.5);
  EXPECT_DOUBLE_EQ(fittingScale(1, 2.5, 300, 200), 0.75);
}

TEST_F(Folder, ReadsSettingsOfTheTimeWhenWorkspacesHadNoNames) {
  write("editor.json", R"({"areas": [{"left": 444, "right": 300, "bottom": 100}], "user_scale": 1})");
  const auto stored = readSettings(root / "editor.json");
  EXPECT_EQ(stored.problem, "");
  EXPECT_EQ(stored.settings.areas, Settings().areas);
}

TEST(Areas, AreAsWideInEachWorkspaceUnlessTheyWereDragged) {
  Settings settings;
  const AreaSizes usual = settings.sizesIn(Workspace::environment);
  for (int w = 0; w < kWorkspaces; ++w) {
    const AreaSizes sizes = settings.sizesIn(static_cast<Workspace>(w));
    EXPECT_EQ(sizes.left, usual.left) << w;
    EXPECT_EQ(sizes.bottom, usual.bottom) << w;
    if (static_cast<Workspace>(w) != Workspace::instrument) {
      EXPECT_EQ(sizes.right, usual.right) << w;
    }
  }
  settings.draggedIn(Workspace::survey).left = 500;
  EXPECT_EQ(settings.sizesIn(Workspace::survey).left, 500);
  EXPECT_EQ(settings.sizesIn(Workspace::inspect).left, usual.left);
}

TEST_F(Folder, KeepsWhatWasDraggedWhenEachWorkspaceHadSizesOfItsOwn) {
  write("editor.json", R"({"areas": {"materials": {"left": 350, "right": 320, "bottom": 170},
                                     "survey": {"left": 410, "right": 340, "bottom": 170}}})");
  const auto stored = readSettings(root / "editor.json");
  EXPECT_EQ(stored.problem, "");
  Settings wanted;
  wanted.draggedIn(Workspace::survey).left = 410;
  EXPECT_EQ(stored.settings, wanted);
}

TEST_F(Folder, BearsAWindowOfGarbage) {
  for (const char* window : {"7", "null", R"({"x": "left"})", R"({"width": 1e300, "height": -4})"}) {
    write("editor.json", std::string(R"({"window": )") + window + "}");
    const auto stored = readSettings(root / "editor.json");
    EXPECT_TRUE(stored.problem.starts_with("Preferences")) << window;
    const auto place = stored.settings.window.value_or(WindowPlace());
    EXPECT_GE(place.width, 800) << window;
    EXPECT_GE(place.height, 500) << window;
  }
}

TEST(WindowPlace, IsWhollyOnAMonitorThatExists) {
  const std::array monitors = {MonitorArea{0, 30, 1920, 1050}, MonitorArea{1920, 0, 1280, 800}};
  const WindowPlace kept{2000, 50, 1000, 700, true};
  EXPECT_EQ(onMonitors(kept, monitors), kept);
  EXPECT_EQ(onMonitors({-300, 0, 1000, 700}, monitors), (WindowPlace{0, 30, 1000, 700}));
  EXPECT_EQ(onMonitors({1800, 100, 1200, 700}, monitors), (WindowPlace{1920, 100, 1200, 700})) << "most of it is there";
  EXPECT_EQ(onMonitors({5000, 5000, 3000, 2000}, monitors), (WindowPlace{0, 30, 1920, 1050})) << "its monitor is gone";
  EXPECT_EQ(onMonitors(kept, {}), kept);
}

TEST_F(Folder, StartsWithDefaultsWhenTheSettingsAreBroken) {
  for (const char* text :
       {"", "{", "[1,2]",
        "{\"areas\": {\"optimise\": {\"left\": \"wide\"}, \"survey\": 3}, \"user_scale\": 1e99, \"recent\": [7]}",
        R"({"graphics": "ultra", "theme": 7})", R"({"graphics": null, "theme": ["light"], "recovery": "yes"})"}) {
    write("editor.json", text);
    const auto stored = readSettings(root / "editor.json");
    const auto& settings = stored.settings;
    EXPECT_EQ(settings.graphics, GraphicsChoice::automatic) << text;
    EXPECT_EQ(settings.theme, Theme::dark) << text;
    EXPECT_TRUE(stored.problem.starts_with("Preferences")) << text;
    EXPECT_EQ(settings.areas, Settings().areas) << text;
    EXPECT_LE(settings.user_scale, kUserScales.back()) << text;
    EXPECT_TRUE(settings.recent.empty()) << text;
  }
}

TEST_F(Folder, NamesTheSettingsThatMakeNoSense) {
  write("editor.json", R"({"graphics": "ultra", "theme": "light", "user_scale": 40})");
  const auto stored = readSettings(root / "editor.json");
  EXPECT_EQ(stored.settings.theme, Theme::light);
  EXPECT_EQ(stored.problem, "Preferences without a valid value, changed to what is valid: user_scale, graphics");
  EXPECT_EQ(readSettings(root / "none.json").problem, "") << "the first start";
}

TEST(ReadableSize, HasThreeDigitsOrSo) {
  EXPECT_EQ(readableSize(12), "12 B");
  EXPECT_EQ(readableSize(2400000), "2.4 MB");
}

}  // namespace
}  // namespace standpoint
