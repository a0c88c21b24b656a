// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/panels/optimise_panel.h"
#include "editor/panels/panels.h"
#include "editor/shell/actions.h"
#include "editor/shell/shell.h"
#include "editor/widgets/keyboard.h"
#include "item_probe.h"
#include "project/survey/assess_verb.h"
#include "tests/temporary_folder.h"

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
  TemporaryFolder folder;
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

TEST_F(GuideTest, DoesAtOnceWhatItAdvisesWhereNothingHasToBeChosen) {
  open();
  ASSERT_EQ(step(Workspace::materials).advice, std::string("Assign materials"));
  ASSERT_TRUE(gui.click("###next-step"));
  gui.settle();
  ASSERT_NE(editor.session.lastOf("materials"), nullptr);
  EXPECT_NE(step(Workspace::materials).state, State::open);
}

TEST_F(GuideTest, BeginsTheAssessmentThatItAdvises) {
  open();
  ASSERT_TRUE(editor.session.start(ScanVerbOptions{.instrument = "faro-focus-s350",
                                                   .settings = {{"resolution", "1/20"}, {"quality", "4x"}},
                                                   .ideal = true,
                                                   .output = folder / "scan.e57"}));
  gui.settle();
  const auto& assess = step(Workspace::inspect);
  ASSERT_EQ(assess.advice, std::string("Assess the survey"));
  editor.workspace = Workspace::environment;
  takeStep(editor, assess);
  ASSERT_FALSE(editor.session.running().empty()) << "a job with progress and cancel";
  gui.frames(2);
  EXPECT_NE(gui.find("###cancel-task"), nullptr);
  EXPECT_EQ(editor.workspace, Workspace::inspect);
  gui.settle();
  EXPECT_NE(editor.session.lastAnswer<AssessAnswer>("assess"), nullptr);
}

TEST_F(GuideTest, LeadsToTheFieldOfWhatHasToBeChosen) {
  open();
  editor.panels.of<OptimiseState>().only_lossless = true;
  ASSERT_TRUE(invoke(editor, "choose-budget"));
  gui.frames(4);
  EXPECT_EQ(editor.workspace, Workspace::optimise);
  ASSERT_TRUE(ImGui::GetIO().WantTextInput);
  gui.type("100");
  gui.key(kKeyEnter);
  const auto triangles = static_cast<double>(sceneTriangleCount(*editor.session.document().imported));
  EXPECT_NEAR(editor.panels.of<OptimiseState>().budget_fraction, 100 / triangles, 1e-9);
}

// So that none only opens a panel and looks as if nothing had happened.
TEST_F(GuideTest, AdvisesNothingThatItsButtonDoesNotDo) {
  const auto check = [&] {
    for (const auto& s : editor.guide.of(editor)) {
      if (*s.advice == 0) {
        EXPECT_STREQ(s.command, "") << s.title;
      } else if (s.state == State::open) {
        EXPECT_NE(findAction(s.command), nullptr) << s.advice;
      }
    }
  };
  check();
  open();
  check();
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
