// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/panels/panels.h"
#include "editor/shell/actions.h"
#include "item_probe.h"

namespace standpoint {
namespace {

using State = GuideStep::State;

class GuideTest : public ::testing::Test {
 protected:
  void open() {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    gui.frames(2);
  }
  const GuideStep& step(Workspace workspace) { return editor.guide.of(editor)[static_cast<std::size_t>(workspace)]; }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(GuideTest, BeginsWithAModel) {
  gui.frames(2);
  EXPECT_EQ(nextStep(editor.guide.of(editor)), 0U);
  EXPECT_EQ(step(Workspace::environment).state, State::open);
}

TEST_F(GuideTest, LeadsOnFromTheModelToItsMaterialsAndSaysWhatIsOptional) {
  open();
  EXPECT_EQ(step(Workspace::environment).state, State::attention) << "the import lost something";
  EXPECT_EQ(step(Workspace::optimise).state, State::optional) << "a small model needs no budget";
  EXPECT_EQ(step(Workspace::instrument).state, State::optional);
  const auto next = nextStep(editor.guide.of(editor));
  ASSERT_TRUE(next);
  EXPECT_EQ(*next, static_cast<std::size_t>(Workspace::materials));
}

TEST_F(GuideTest, SpeaksTheLanguageThatIsChosenMeanwhileAndCountsWhatBeamsMeet) {
  open();
  EXPECT_EQ(step(Workspace::environment).status, fmt::format("{} products, {} triangles; 1 lost on import",
                                                             editor.session.document().imported->products.size(),
                                                             sceneTriangleCount(*editor.session.document().imported)));
  speak("de");
  EXPECT_NE(step(Workspace::environment).status.find("Dreiecke"), std::string::npos)
      << step(Workspace::environment).status;
  speak("en");
  EXPECT_NE(step(Workspace::environment).status.find("triangles"), std::string::npos);
}

TEST_F(GuideTest, FollowsWhatIsDoneAndUndone) {
  open();
  ASSERT_EQ(step(Workspace::materials).state, State::open);
  ASSERT_TRUE(editor.session.start("materials", nlohmann::json::object()));
  gui.settle();
  EXPECT_NE(step(Workspace::materials).state, State::open);
  editor.session.undo();
  gui.frames(2);
  EXPECT_EQ(step(Workspace::materials).state, State::open);
}

TEST_F(GuideTest, CountsTheStationsThatWereNotScanned) {
  open();
  EXPECT_EQ(step(Workspace::survey).status, "2 stations, 1 not scanned");
  EXPECT_EQ(step(Workspace::survey).state, State::open);
}

TEST_F(GuideTest, OpensThePanelOfTheNextStepFromTheStatusBar) {
  open();
  ASSERT_TRUE(gui.click("###next-step"));
  gui.frames(2);
  EXPECT_EQ(editor.workspace, Workspace::materials);
  EXPECT_NE(gui.find("###material"), nullptr);
}

TEST_F(GuideTest, NamesAPanelOfItsWorkspaceForEachStep) {
  for (const auto& s : editor.guide.of(editor))
    EXPECT_TRUE(std::any_of(panels().begin(), panels().end(), [&](const Panel& p) {
      return p.id == std::string(s.tab) && p.area[static_cast<std::size_t>(s.workspace)] != Area::none;
    })) << s.title;
}

TEST_F(GuideTest, GoesToEachWorkspaceByItsNumber) {
  open();
  for (int w = 0; w < kWorkspaces; ++w) {
    invoke(editor, fmt::format("workspace-{}", nameOf(static_cast<Workspace>(w))).c_str());
    EXPECT_EQ(editor.workspace, static_cast<Workspace>(w));
  }
}

}  // namespace
}  // namespace standpoint
