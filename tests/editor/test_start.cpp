// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "demo_verbs.h"
#include "editor/model/png_picture.h"
#include "editor/shell/actions.h"
#include "editor/shell/start_page.h"
#include "editor/widgets/keyboard.h"
#include "item_probe.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

class Start : public ::testing::Test {
 protected:
  void open() {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    gui.frames(2);
  }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(Start, ShowsHowToBeginInsteadOfEmptyPanels) {
  gui.frames(2);
  for (const char* id : {"###welcome-import", "###welcome-open", "###welcome-first-steps", "###sample-house.ifc",
                         "###sample-street.ifc"})
    EXPECT_NE(gui.find(id), nullptr) << id;
  EXPECT_EQ(gui.find("###outliner"), nullptr);
  open();
  EXPECT_EQ(gui.find("###welcome-import"), nullptr);
  EXPECT_NE(gui.find("###outliner"), nullptr);
}

TEST_F(Start, ShowsAllItsSamplesAndUsesTheWidth) {
  for (const ImVec2 size : {ImVec2(1280, 800), ImVec2(1920, 1080)}) {
    ImGui::GetIO().DisplaySize = size;
    gui.frames(3);
    float right = 0;
    for (const char* id :
         {"###sample-house.ifc", "###sample-street.ifc", "###sample-corridor.ifc", "###sample-turbine.ifc"}) {
      const auto* card = gui.find(id);
      ASSERT_NE(card, nullptr) << id;
      EXPECT_FALSE(card->clipped) << id;
      EXPECT_LE(card->rect.Max.y, size.y - 100) << id;
      right = std::max(right, card->rect.Max.x);
    }
    EXPECT_GT(right, 0.85F * size.x);
  }
}

TEST_F(Start, KeepsTheInstrumentAtHandWithoutAModel) {
  gui.frames(2);
  ASSERT_TRUE(gui.click("###welcome-workspace-instrument"));
  gui.frames(2);
  EXPECT_EQ(editor.workspace, Workspace::instrument);
  EXPECT_FALSE(wantsStartPage(editor));
}

TEST_F(Start, LeavesASampleThatWasOnlyOpenedWithoutAQuestion) {
  openSample(editor, "corridor.ifc");
  gui.settle();
  ASSERT_FALSE(editor.session.document().sources.empty());
  bool left = false;
  whenSaved(editor, [&] { left = true; });
  EXPECT_TRUE(left);
  EXPECT_FALSE(editor.dialogs.unsaved);
  ASSERT_TRUE(editor.session.start("bookmark", {{"add", "Door"}}));
  gui.settle();
  ASSERT_EQ(editor.session.history().size(), 3U);
  whenSaved(editor, [] { FAIL() << "work is lost"; });
  EXPECT_TRUE(editor.dialogs.unsaved);
}

TEST_F(Start, SaysOfAPathThatIsGoneThatItIsNotFound) {
  editor.settings.recent = {"/no/such/project"};
  gui.frames(2);
  const auto* row = gui.find("###recent0");
  ASSERT_NE(row, nullptr);
  EXPECT_TRUE(row->disabled);
}

TEST(SamplePictures, AreThereAndOneThatIsBrokenIsRefused) {
  for (const char* name : {"house.ifc.png", "street.ifc.png", "corridor.ifc.png", "turbine.ifc.png"}) {
    const auto picture = readPngPicture(dataFolder() / "sample-pictures" / name);
    ASSERT_TRUE(picture) << describe(picture.error());
    EXPECT_NEAR((*picture)->width / static_cast<double>((*picture)->height), 1 / 0.6, 0.1);
  }
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "broken.png") << "\x89PNG\r\n\x1a\nnothing";
  EXPECT_EQ(readPngPicture(folder.path() / "broken.png").error().source, "broken.png");
  EXPECT_FALSE(readPngPicture(folder.path() / "none.png"));
}

TEST_F(Start, LeadsTheTourFromStepToStepAsEachIsDone) {
  open();
  editor.tour.begin();
  gui.frames(2);
  EXPECT_EQ(editor.tour.step(), 0U);
  EXPECT_NE(gui.find("###tour-skip"), nullptr);
  editor.view.camera.azimuth_rad += 0.5;
  gui.frames(2);
  EXPECT_EQ(editor.tour.step(), 1U) << "the view was turned";
  gui.key('9');
  gui.frames(2);
  EXPECT_EQ(editor.tour.step(), 2U) << "the floor plan was seen";
  gui.key('W');
  editor.walk_ground.wait();
  gui.frames(3);
  ASSERT_TRUE(editor.walk.active());
  EXPECT_EQ(editor.tour.step(), 2U) << "one still walks";
  gui.key(kKeyEscape);
  gui.frames(3);
  EXPECT_EQ(editor.tour.step(), 3U);
  while (editor.tour.step() < Tour::steps().size()) {
    ASSERT_TRUE(gui.click("###tour-skip"));
    gui.frames(2);
  }
  EXPECT_NE(gui.find("###tour-import"), nullptr);
  ASSERT_TRUE(gui.click("###tour-leave"));
  gui.frames(2);
  EXPECT_FALSE(editor.tour.active());
  EXPECT_EQ(gui.find("###tour-leave"), nullptr);
}

}  // namespace
}  // namespace standpoint
