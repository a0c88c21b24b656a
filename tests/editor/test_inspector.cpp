// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/units.h"
#include "demo_verbs.h"
#include "editor/panels/scan_panel.h"
#include "editor/shell/actions.h"
#include "editor/shell/panel_actions.h"
#include "editor/shell/shell.h"
#include "editor/widgets/keyboard.h"
#include "editor/words/words.h"
#include "item_probe.h"
#include "survey/stations/levelling.h"

namespace standpoint {
namespace {

class Inspector : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    editor.session.wait();
    editor.workspace = Workspace::environment;
    editor.wanted_tab[1] = "inspector";
    gui.frames(3);
  }
  const Job& job() const { return *editor.session.document().job; }
  void typeInto(const char* id, const char* text) {
    ASSERT_TRUE(gui.click(id)) << id;
    gui.type(text);
    gui.key(kKeyEnter);
    gui.settle();
  }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(Inspector, MovesAStationByATypedNumberAndUndoTakesItBack) {
  editor.survey.station = 0;
  gui.frames(3);
  const auto before = job().stations[0];
  typeInto("###inspected-X", fmt::format("{}+10cm", before.true_pose.translation.x() + editor.shift_m().x()).c_str());
  ASSERT_TRUE(editor.session.errors().empty()) << describe(editor.session.errors().front().error);
  EXPECT_NEAR(job().stations[0].true_pose.translation.x(), before.true_pose.translation.x() + 0.1, 1e-9);
  EXPECT_TRUE(job().stations[0].true_pose.rotation.isApprox(before.true_pose.rotation, 1e-9)) << "it keeps its heading";
  editor.session.undo();
  gui.frames(2);
  EXPECT_EQ(job().stations[0].true_pose.translation, before.true_pose.translation);
}

TEST_F(Inspector, SaysOfAStationWhatWasSaidOfItsPlaceWhileItWasHeldThere) {
  editor.picker.wait();
  editor.survey.station = 0;
  gui.frames(4);
  ASSERT_TRUE(editor.placement.ready());
  EXPECT_TRUE(gui.says("Good place"));
  typeInto("###inspected-X", fmt::format("{}", 0.7 + editor.shift_m().x()).c_str());
  ASSERT_TRUE(editor.session.errors().empty());
  EXPECT_TRUE(gui.says("Check: 40 cm from wall")) << "a plain word leads";
  EXPECT_FALSE(gui.says("Good place"));
  speak("de");
  editor.view.refused_place = RefusedPlace{job().stations[0].name, "No floor", "No floor; move it.", std::nullopt};
  EXPECT_TRUE(gui.says("Prüfen: ")) << "in the language of the editor";
  EXPECT_TRUE(gui.says("Schlecht: Kein Boden. S1 bleibt, wo er war"));
  speak("en");
}

TEST_F(Inspector, TheListOfStationsHasTheDecimalsThatWereTyped) {
  editor.workspace = Workspace::survey;
  editor.wanted_tab[0] = "survey";
  editor.settings.areas[static_cast<std::size_t>(Workspace::survey)].left = 500;
  editor.survey.station = 0;
  editor.wanted_tab[1] = "inspector";
  gui.frames(4);
  EXPECT_TRUE(gui.says("500003.20  5800002.00  51.60"));
  typeInto("###inspected-X", "500003.4-0.35");
  EXPECT_TRUE(gui.says("500003.05  5800002.00  51.60"));
  EXPECT_TRUE(gui.says("500007.50  5800005.00  51.60"));
  typeInto("###inspected-X", "500003.055");
  EXPECT_TRUE(gui.says("500003.055  5800002.000  51.600"));
  EXPECT_TRUE(gui.says("500007.500  5800005.000  51.600")) << "all alike";
  editor.settings.areas[static_cast<std::size_t>(Workspace::survey)].left = 300;
  gui.frames(3);
  EXPECT_FALSE(gui.says("500007.500")) << "no room for them";
}

TEST_F(Inspector, OffersTheStandThatTheRefusalOfAPlaceByTheFloorAdvises) {
  editor.survey.station = 0;
  gui.frames(3);
  const auto before = job().stations[0].true_pose.translation;
  typeInto("###inspected-Z", fmt::format("{}-1.3", before.z() + editor.shift_m().z()).c_str());
  EXPECT_TRUE(gui.says("use the stand 'free'")) << "no tripod is so low";
  ASSERT_TRUE(gui.click("###inspected-stand"));
  gui.frames(2);
  ASSERT_TRUE(gui.click("Free"));
  gui.settle();
  EXPECT_NEAR(job().stations[0].true_pose.translation.z(), before.z() - 1.3, 1e-9);
  EXPECT_FALSE(gui.says("use the stand 'free'"));
  typeInto("###inspected-X", fmt::format("{}+0.1", before.x() + editor.shift_m().x()).c_str());
  EXPECT_NEAR(job().stations[0].true_pose.translation.x(), before.x() + 0.1, 1e-9) << "it stays so for the next move";
}

TEST_F(Inspector, WhatCannotBeReadStaysInTheFieldsOfItsOwnStation) {
  ASSERT_GE(job().stations.size(), 2U);
  editor.survey.station = 0;
  gui.frames(3);
  typeInto("###inspected-Z", "abc");
  EXPECT_TRUE(gui.says("Cannot read 'abc'"));
  editor.survey.station = 1;  // as high as the other
  gui.frames(2);
  EXPECT_FALSE(gui.says("Cannot read 'abc'"));
}

TEST_F(Inspector, AStationThatIsChosenTakesThePlaceOfTheProductThatWas) {
  editor.select(0, true);
  gui.frames(2);
  PanelActions(editor).choose(SurveyChoice{.station = 1});
  EXPECT_TRUE(editor.selection.empty());
  EXPECT_EQ(editor.survey.station, 1);
  editor.select(0, true);
  PanelActions(editor).choose(SurveyChoice{});
  EXPECT_FALSE(editor.selection.empty()) << "nothing was chosen in its place";
}

TEST_F(Inspector, OffersToScanFromTheStationItShowsAndNotFromAll) {
  editor.survey.station = 1;
  gui.frames(3);
  ASSERT_TRUE(editor.panels.of<ScanState>().all_stations);
  ASSERT_TRUE(gui.click("###scan-station"));
  gui.frames(2);
  EXPECT_FALSE(editor.panels.of<ScanState>().all_stations);
  EXPECT_EQ(editor.workspace, Workspace::survey);
}

TEST_F(Inspector, ComesForwardForWhatIsChosenInTheSurveyAndAloneHasItsFields) {
  openPanel(editor, Workspace::survey, "scan");
  editor.wanted_tab[0] = "survey";
  gui.frames(3);
  const auto fields = [&] {
    gui.frames(3);
    const auto& items = itemProbe().items;
    return std::count_if(items.begin(), items.end(), [](const auto& i) { return i.label == "###inspected-X"; });
  };
  EXPECT_EQ(fields(), 0);
  ASSERT_TRUE(gui.click("###station"));
  EXPECT_EQ(fields(), 1);
  EXPECT_EQ(editor.front_tab[1], "inspector");
  openPanel(editor, Workspace::survey, "scan");
  gui.frames(3);
  PanelActions(editor).choose(SurveyChoice{.station = 1});  // as in a list of another panel
  gui.frames(3);
  EXPECT_EQ(editor.front_tab[1], "scan");
  openPanel(editor, Workspace::instrument, "survey");
  EXPECT_EQ(fields(), 1) << "where there is no Inspector";
}

TEST_F(Inspector, TurnsAStationToATypedHeading) {
  editor.survey.station = 0;
  gui.frames(3);
  const auto at = job().stations[0].true_pose.translation;
  typeInto("###inspected-heading", "37,5°");
  ASSERT_TRUE(editor.session.errors().empty()) << describe(editor.session.errors().front().error);
  EXPECT_NEAR(yawOf(job().stations[0].true_pose.rotation) / kRadPerDeg, 37.5, 1e-9);
  EXPECT_LT((job().stations[0].true_pose.translation - at).norm(), 1e-6);
}

TEST_F(Inspector, TiltsAStationByTypedNumbersAndKeepsItsHeading) {
  editor.survey.station = 0;
  gui.frames(3);
  typeInto("###inspected-heading", "20");
  gui.frames(3);
  typeInto("###inspected-tilt", "1.5");
  gui.frames(3);
  typeInto("###inspected-tilt-towards", "90");
  ASSERT_TRUE(editor.session.errors().empty()) << describe(editor.session.errors().front().error);
  const auto tilt = tiltOf(job().stations[0].true_pose.rotation);
  EXPECT_NEAR(tilt.angle_rad / kRadPerDeg, 1.5, 1e-9);
  EXPECT_NEAR(tilt.towards_rad / kRadPerDeg, 90, 1e-6);
  EXPECT_NEAR(yawOf(job().stations[0].true_pose.rotation) / kRadPerDeg, 20, 1e-6);
}

TEST_F(Inspector, RenamesAStationAfterF2AndUndoTakesItBack) {
  editor.survey.station = 0;
  gui.frames(3);
  const auto name = job().stations[0].name;
  const auto scans = job().stations[0].scans.size();
  gui.key(kKeyF2);
  gui.frames(3);
  ASSERT_TRUE(ImGui::GetIO().WantTextInput);
  gui.type("Hall");
  gui.key(kKeyEnter);
  gui.settle();
  EXPECT_EQ(job().stations[0].name, "Hall");
  EXPECT_EQ(job().stations[0].scans.size(), scans);
  EXPECT_EQ(editor.session.history().undoDescription(), "Renamed station " + name + " to Hall");
  editor.session.undo();
  gui.frames(2);
  EXPECT_EQ(job().stations[0].name, name);
}

TEST_F(Inspector, SaysARefusalBesideTheFieldsInsteadOfInADialog) {
  ASSERT_GE(job().stations.size(), 2U);
  editor.survey.station = 0;
  gui.frames(3);
  const auto name = job().stations[0].name;
  typeInto("###inspected-name", job().stations[1].name.c_str());
  gui.frames(3);
  EXPECT_EQ(job().stations[0].name, name);
  EXPECT_TRUE(editor.session.errors().empty());
  EXPECT_EQ(ImGui::GetCurrentContext()->OpenPopupStack.Size, 0);
  ASSERT_NE(gui.find("###revert-inspected"), nullptr) << "the reason, and the way back";
  ASSERT_TRUE(gui.click("###revert-inspected"));
  gui.frames(2);
  EXPECT_EQ(gui.find("###revert-inspected"), nullptr);
}

TEST_F(Inspector, MovesAndRenamesATarget) {
  if (job().targets.empty()) {
    ASSERT_TRUE(editor.session.start("target", {{"add", "T1"}, {"at", {2.0, 2.0, 1.2}}}));
    gui.settle();
    ASSERT_FALSE(job().targets.empty());
  }
  editor.survey.target = 0;
  gui.frames(3);
  const double z = job().targets[0].centre.z();
  typeInto("###inspected-Z", fmt::format("{}+5cm", z + editor.shift_m().z()).c_str());
  ASSERT_EQ(gui.find("###revert-inspected"), nullptr);
  EXPECT_NEAR(job().targets[0].centre.z(), z + 0.05, 1e-9);
  typeInto("###inspected-name", "Column");
  EXPECT_EQ(job().targets[0].name, "Column");
}

TEST_F(Inspector, OffersWhatCanBeDoneWithAProduct) {
  editor.select(2, false);
  gui.frames(3);
  ASSERT_TRUE(gui.click("###hide"));
  EXPECT_TRUE(editor.visibility.hidden(2));
}

TEST_F(Inspector, AnswersOfVerbsThatChangeNothingAreShownWithTheirContent) {
  const auto steps = editor.session.history().undoDescription();
  for (const char* verb : {"instruments", "station"}) {
    openVerbForm(editor, verb);
    gui.frames(3);
    ASSERT_TRUE(gui.click("###run")) << verb;
    gui.settle();
    gui.frames(3);
    ASSERT_EQ(editor.session.answers().size(), 1U) << verb;
    const auto& answer = editor.session.answers().front();
    EXPECT_TRUE(!answer.text.empty() || !answer.figures.empty()) << verb;
    EXPECT_NE(gui.find("###close-answer"), nullptr) << verb;
    gui.key(kKeyEscape);
    gui.frames(3);
    EXPECT_TRUE(editor.session.answers().empty()) << verb;
  }
  EXPECT_EQ(editor.session.history().undoDescription(), steps) << "a list is no step to be undone";
}

}  // namespace
}  // namespace standpoint
