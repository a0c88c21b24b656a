// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/panels/material_card_panel.h"
#include "editor/panels/optimise_panel.h"
#include "editor/panels/outliner_panel.h"
#include "editor/panels/panels.h"
#include "editor/shell/actions.h"
#include "editor/shell/dialogs.h"
#include "editor/shell/shell.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/keyboard.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/words.h"
#include "item_probe.h"

namespace standpoint {
namespace {

constexpr int kEnter = 257;

class Gui : public ::testing::Test {
 protected:
  void open() {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    editor.session.wait();
  }
  ImVec2 screenOf(const Eigen::Vector3d& point) {
    const auto pixel = project(editor.view.camera, point, editor.view.size);
    const auto* window = ImGui::FindWindowByName("###viewport");
    return {window->Pos.x + static_cast<float>(pixel->x()), window->Pos.y + static_cast<float>(pixel->y())};
  }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

// As when the work of a crash is offered while the model of the command line is read.
TEST_F(Gui, ShowsItsPanelsOverTheirGroundWhereTheyFirstAppearUnderADialog) {
  editor.dialogs.preferences = true;
  gui.frames(3);
  open();
  gui.frames(3);
  editor.dialogs.preferences = false;
  gui.frames(3);
  const auto& windows = ImGui::GetCurrentContext()->Windows;  // what lies behind comes first
  const auto place = [&](const char* name) {
    return std::find(windows.begin(), windows.end(), ImGui::FindWindowByName(name)) - windows.begin();
  };
  for (const char* panel : {"###left", "###right", "###bottom", "###viewport"})
    EXPECT_LT(place("###splitters"), place(panel)) << panel;
}

TEST_F(Gui, ShowsEveryPanelInSomeWorkspace) {
  open();
  std::set<std::string> seen;
  for (int w = 0; w < kWorkspaces; ++w) {
    editor.workspace = static_cast<Workspace>(w);
    gui.frames(2);
    for (const auto& panel : panels())
      if (gui.find(std::string("###") + panel.id) != nullptr) seen.insert(panel.id);
  }
  EXPECT_EQ(seen.size(), panels().size());
}

TEST_F(Gui, SelectsInTheOutlinerAndShowsItInTheInspector) {
  open();
  editor.panels.of<OutlinerState>().filter = "Wall east OG";
  gui.frames(2);
  const auto wall = productNamed(*editor.environment(), "Wall east OG");
  const GuiItem* row = nullptr;
  for (const auto& item : itemProbe().items)
    if (item.label == "###row") row = &item;  // the last one is the product
  ASSERT_NE(row, nullptr);
  gui.moveTo(row->rect.GetCenter());
  gui.press();
  EXPECT_EQ(editor.selection.products(), std::vector<std::uint32_t>{wall});
}

TEST_F(Gui, SelectsWhatIsClickedInTheView) {
  open();
  if (!editor.picker.ready()) GTEST_SKIP() << "no ray scene";
  gui.moveTo(screenOf({5, 4, 6.3}));
  ASSERT_TRUE(editor.view.hover);
  EXPECT_EQ(editor.view.hover->product, productNamed(*editor.environment(), "Roof"));
  gui.press();
  EXPECT_EQ(editor.selection.products(), std::vector<std::uint32_t>{productNamed(*editor.environment(), "Roof")});
  gui.key('H');
  EXPECT_TRUE(editor.visibility.hidden(productNamed(*editor.environment(), "Roof")));
  gui.moveTo(screenOf({5, 4, 6.3}));
  ASSERT_TRUE(editor.view.hover);
  EXPECT_NE(editor.view.hover->product, productNamed(*editor.environment(), "Roof"))
      << "what is hidden lets the pointer through";
}

TEST_F(Gui, ADragTurnsTheViewAndSelectsNothing) {
  open();
  const auto before = editor.view.camera;
  gui.moveTo(screenOf({5, 4, 6.3}));
  ImGui::GetIO().MouseDown[0] = true;
  gui.frame();
  for (int i = 1; i <= 5; ++i) {
    ImGui::GetIO().MousePos.x += 12;
    gui.frame();
  }
  ImGui::GetIO().MouseDown[0] = false;
  gui.frames(2);
  EXPECT_NE(editor.view.camera.azimuth_rad, before.azimuth_rad);
  EXPECT_TRUE(editor.selection.empty());
}

TEST_F(Gui, SetsUpAStationWhereTheFloorIsClickedAndUndoesIt) {
  open();
  if (!editor.picker.ready()) GTEST_SKIP() << "no ray scene";
  editor.visibility.cut_height_m = 1.5;
  invoke(editor, "add-station");
  look(editor.view.camera, StandardView::top);
  editor.view.frame_wanted = true;
  gui.frames(3);
  gui.moveTo(screenOf({1.2, 6, 0}));
  ASSERT_TRUE(editor.view.hover);
  gui.press();
  gui.settle();
  ASSERT_TRUE(editor.session.errors().empty()) << describe(editor.session.errors().front().error);
  ASSERT_EQ(editor.session.document().job->stations.size(), 3U);
  const auto& station = editor.session.document().job->stations.back();
  EXPECT_EQ(station.name, "S3");
  EXPECT_NEAR(station.true_pose.translation.x(), 1.2, 0.05);
  EXPECT_NEAR(station.true_pose.translation.z(), 1.6, 0.01);
  EXPECT_EQ(editor.survey.station, 2) << "its numbers can be typed at once";
  gui.key('Z', true);
  EXPECT_EQ(editor.session.document().job->stations.size(), 2U);
}

TEST_F(Gui, AssignsAMaterialThroughTheVerb) {
  open();
  const auto& library = editor.catalogue().materials;
  if (library.empty()) GTEST_SKIP() << editor.catalogue().problem;
  const auto table = productNamed(*editor.environment(), "Table EG");
  editor.select(table, true);
  gui.frames(3);
  ASSERT_TRUE(gui.click("###assign"));
  gui.frames(2);
  const std::string label = "###" + library.front().id;
  ASSERT_TRUE(gui.click(label));
  gui.settle();
  ASSERT_TRUE(editor.session.errors().empty()) << describe(editor.session.errors().front().error);
  ASSERT_TRUE(editor.session.document().materials);
  const auto& assignment = editor.session.document().materials->result.assignment;
  const auto material = materialOf(assignment, table, 3);
  ASSERT_GE(material, 0);
  EXPECT_EQ(assignment.materials[static_cast<std::size_t>(material)].id, library.front().id);
}

TEST_F(Gui, OpensTheListOfMaterialsForAWallAndIsNoHigherThanWhatIsFound) {
  open();
  const auto& library = editor.catalogue().materials;
  if (library.empty()) GTEST_SKIP() << editor.catalogue().problem;
  EXPECT_FALSE(invoke(editor, "assign-material")) << "nothing is selected";
  editor.select(productNamed(*editor.environment(), "Wall east OG"), true);
  editor.workspace = Workspace::materials;
  editor.wanted_tab[1] = "material";
  gui.frames(3);
  EXPECT_TRUE(gui.says("Wall east OG: no physical material is assigned")) << "it does not deny the selection";
  ASSERT_TRUE(invoke(editor, "assign-material"));
  gui.frames(4);
  EXPECT_EQ(editor.front_tab[1], "inspector");
  const auto* row = gui.find("###" + library.front().id);
  ASSERT_NE(row, nullptr);
  const auto* list = ImGui::FindWindowByName(row->window.c_str());
  ASSERT_NE(list, nullptr);
  const float whole = list->Size.y, wide = list->ParentWindow->Size.x;
  gui.type(library.front().id);
  gui.frames(12);
  EXPECT_LT(list->Size.y, whole / 3) << "nothing below what is found";
  EXPECT_EQ(list->ParentWindow->Size.x, wide) << "nor beside it";
  ASSERT_TRUE(gui.click("###" + library.front().id));
  gui.settle();
  EXPECT_TRUE(editor.session.document().materials);
  ASSERT_TRUE(invoke(editor, "assign-material"));
  gui.frames(4);
  gui.type("no such thing");
  gui.frames(2);
  EXPECT_TRUE(gui.says("No matches"));
}

TEST_F(Gui, EditsTheRowsOfAMetalAndUndoTakesItOutAgain) {
  open();
  const auto& library = editor.catalogue().materials;
  const auto metal = std::find_if(library.begin(), library.end(),
                                  [](const PhysicalMaterial& m) { return m.complex_index.size() > 2; });
  if (metal == library.end()) GTEST_SKIP() << editor.catalogue().problem;
  ASSERT_TRUE(editor.session.start("materials", nlohmann::json::object()));
  gui.settle();
  editor.workspace = Workspace::materials;
  editor.material.id = metal->id;
  editor.wanted_tab[1] = "material";
  gui.frames(3);
  ASSERT_TRUE(gui.click("###edit-material"));
  gui.frames(2);
  auto& edit = editor.panels.of<MaterialCardState>().edit;
  ASSERT_TRUE(edit && edit->metal);
  for (const char* button : {"###take0", "###add0"}) {
    const auto rows = edit->complex_index.size();
    const auto* item = gui.find(button);
    ASSERT_NE(item, nullptr) << button;
    if (auto* fields = ImGui::FindWindowByName(item->window.c_str()))
      ImGui::SetScrollY(fields, fields->ScrollMax.y);  // the rows are below the fold
    gui.frames(2);
    ASSERT_TRUE(gui.click(button));
    gui.frames(2);
    EXPECT_NE(edit->complex_index.size(), rows) << button;
  }
  EXPECT_EQ(edit->complex_index.size(), metal->complex_index.size());
  const auto id = edit->id;
  ASSERT_TRUE(gui.click("###keep-material"));
  gui.settle();
  ASSERT_TRUE(editor.session.errors().empty()) << describe(editor.session.errors().front().error);
  ASSERT_EQ(editor.session.document().materials->own.size(), 1U);
  EXPECT_EQ(editor.session.document().materials->own[0].id, id);
  EXPECT_EQ(editor.session.document().materials->own[0].complex_index.size(), metal->complex_index.size());
  EXPECT_EQ(editor.session.history().undoDescription(),
            "Added material '" + editor.session.document().materials->own[0].label + "'")
      << "not the file that it went through";
  editor.session.undo();
  gui.frames(2);
  EXPECT_TRUE(editor.session.document().materials->own.empty());
}

TEST(Actions, HaveAnIdAndKeysOfTheirOwn) {
  std::set<std::string> ids, keys;
  for (const auto& action : actions()) {
    EXPECT_TRUE(ids.insert(action.id).second) << action.id;
    if (const auto text = shortcutText(action.shortcut); !text.empty()) EXPECT_TRUE(keys.insert(text).second) << text;
  }
}

TEST_F(Gui, TicksSwitchesThatAreOnAndTheChoiceThatHolds) {
  open();
  int ticked = 0;
  for (const auto& action : actions()) {
    if (action.on == nullptr || !whyNot(action, editor).empty()) continue;
    ++ticked;
    const bool before = action.on(editor);
    action.run(editor);
    const bool once = action.on(editor);
    action.run(editor);
    const bool twice = action.on(editor);
    EXPECT_TRUE((once && twice) || (once != before && twice == before)) << action.id;
  }
  EXPECT_GT(ticked, 15);
  chooseLanguage(editor, "en");
}

TEST_F(Gui, ChoosesItsLanguageInTheMenuViewToo) {
  open();
  ASSERT_TRUE(gui.click("View"));
  gui.frames(2);
  ASSERT_TRUE(gui.click("Language###menu-language"));
  gui.frames(2);
  ASSERT_TRUE(gui.click("###language-de"));
  gui.frames(3);
  EXPECT_EQ(editor.settings.language, "de");
  EXPECT_EQ(tr("Undo"), "Rückgängig");
  EXPECT_TRUE(findAction("language-de")->on(editor));
  chooseLanguage(editor, "en");
}

TEST_F(Gui, SaysNothingOfATrajectoryAtEnterWhereNoneIsAdded) {
  open();
  const auto said = editor.notice.text;
  gui.key(kEnter);
  gui.key(kKeyBackspace);
  EXPECT_EQ(editor.notice.text, said);
}

TEST_F(Gui, ShowsAnotherModelInItsOwnColours) {
  open();
  editor.view.colour = ColourMode::material;
  editor.session.clear();
  gui.settle();
  EXPECT_EQ(editor.view.colour, ColourMode::model);
}

TEST_F(Gui, ListsTheMaterialLibraryByTheNamesThatItShows) {
  open();
  const auto listed = byShownName(editor.offeredMaterials());
  ASSERT_EQ(listed.size(), editor.offeredMaterials().size());
  const auto place = [&](const std::string& label) {
    return std::find_if(listed.begin(), listed.end(), [&](const auto* m) { return m->label == label; }) -
           listed.begin();
  };
  EXPECT_LT(place("Aerated concrete"), place("Basalt")) << "its id begins with concrete";
  EXPECT_LT(place("Brick, red, bare"), place("Brick, red, paving"));
  EXPECT_EQ(editor.offeredByName(), listed);
  EXPECT_EQ(&editor.offeredByName(), &editor.offeredByName());
  speak("de");
  EXPECT_EQ(editor.offeredByName(), byShownName(editor.offeredMaterials())) << "by German names";
  speak("en");
}

// White letters on a white wall could not be seen.
TEST_F(Gui, PutsAPlateUnderTheSwitchesOverTheView) {
  open();
  gui.frames(3);
  const auto* item = gui.find("###view_walkable");
  ASSERT_NE(item, nullptr);
  const ImRect rect = item->rect;
  const auto& drawn = ImGui::FindWindowByName("###viewport")->DrawList->VtxBuffer;
  float left = rect.Max.x, right = rect.Min.x;
  for (const auto& v : drawn)
    if (v.col == ImU32(tone::kOverlay) && v.pos.y > rect.Min.y - 1 && v.pos.y < rect.Max.y + 1) {
      left = std::min(left, v.pos.x);
      right = std::max(right, v.pos.x);
    }
  EXPECT_LE(left, rect.Min.x);
  EXPECT_GE(right, rect.Max.x);
}

TEST_F(Gui, TheRunMenuSaysWhatEachVerbDoesAndHasNothingTwice) {
  open();
  ASSERT_TRUE(gui.click("Run"));
  gui.frames(2);
  ASSERT_TRUE(gui.click("###group-model"));
  gui.frames(3);
  EXPECT_TRUE(gui.says("Optimise the model…"));
  EXPECT_FALSE(gui.says("Optimize"));
  for (const char* elsewhere : {"###run-import", "###run-export", "###run-convert", "###run-scan"})
    EXPECT_EQ(gui.find(elsewhere), nullptr) << elsewhere;
  EXPECT_EQ(verbTitle("measure"), "Measure") << "its name, where that says it";
}

TEST_F(Gui, TheRunMenuGathersItsVerbsInGroups) {
  open();
  ASSERT_TRUE(gui.click("Run"));
  gui.frames(2);
  std::vector<std::string> alone;
  for (const auto& item : itemProbe().items)
    if (const auto id = item.label.find("###run-"); id != std::string::npos) alone.push_back(item.label.substr(id));
  EXPECT_EQ(alone, std::vector<std::string>{"###run-demo"}) << "of the test";
  for (const char* group : {"model", "materials", "survey", "scans", "points", "files"}) {
    ASSERT_TRUE(gui.click(fmt::format("###group-{}", group))) << group;
    gui.frames(2);
    EXPECT_TRUE(std::any_of(itemProbe().items.begin(), itemProbe().items.end(), [](const GuiItem& item) {
      return item.label.find("###run-") != std::string::npos;
    })) << group;
  }
}

TEST_F(Gui, ShowsTheLabelsOfItsFieldsWholeInALanguageWithLongerWords) {
  open();
  openPanel(editor, Workspace::georeference, "georeference");
  speak("de");
  gui.frames(3);
  EXPECT_TRUE(gui.says("Ursprung auf der Karte"));
  speak("en");
}

TEST(GeoreferencePanel, OffersTheRotationThatTheTrueNorthOfAFileAsksFor) {
  auto table = verbsWithDemo();
  table.push_back({"with-north",
                   "Make the demo house with a true north",
                   VerbScope::creates,
                   {},
                   [](const Document&, const nlohmann::json&, Progress&) -> Result<Outcome> {
                     Outcome outcome;
                     outcome.document = demoHouse();
                     auto georeference = *outcome.document.georeference;
                     georeference.true_north_rad = 0.5;
                     outcome.document.georeference = std::make_shared<const Georeference>(georeference);
                     outcome.description = "Made the demo house";
                     return outcome;
                   }});
  Editor editor(table, [] {});
  GuiDriver gui(editor);
  ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
  gui.settle();
  openPanel(editor, Workspace::georeference, "georeference");
  gui.frames(3);
  EXPECT_EQ(gui.find("###take-north"), nullptr) << "its file states none";
  ASSERT_TRUE(editor.session.start("with-north", nlohmann::json::object()));
  gui.settle();
  gui.frames(3);
  EXPECT_TRUE(gui.says("turns nothing"));
  ASSERT_TRUE(gui.click("###take-north"));
  gui.frames(3);
  EXPECT_EQ(gui.find("###take-north"), nullptr);
  EXPECT_TRUE(gui.says("28.647890"));
}

TEST_F(Gui, TypingDoesNotTriggerShortcuts) {
  open();
  const auto* search = gui.find("###search");
  ASSERT_NE(search, nullptr);
  gui.moveTo(search->rect.GetCenter());
  gui.press();
  const auto before = editor.view.camera;
  gui.key('7');
  EXPECT_EQ(editor.view.camera, before);
}

TEST_F(Gui, AShortcutThatCanDoNothingSaysWhy) {
  open();
  const std::string why = editor.session.whyNotRedo();
  ASSERT_FALSE(why.empty());
  gui.key('Y', true);
  EXPECT_EQ(editor.notice.text, "Redo: " + why);
}

TEST_F(Gui, AShortcutThatEditsNoTextWorksFromATextField) {
  open();
  const auto* search = gui.find("###search");
  ASSERT_NE(search, nullptr);
  gui.moveTo(search->rect.GetCenter());
  gui.press();
  const bool could_undo = editor.session.history().canUndo();
  gui.key('Z', true);
  EXPECT_EQ(editor.session.history().canUndo(), could_undo);
  EXPECT_FALSE(editor.dialogs.file.open);
  gui.key('I', true);
  EXPECT_TRUE(editor.dialogs.file.open);
}

TEST_F(Gui, DrawsATreeOfThousandsInAMoment) {
  open();
  editor.outliner.tree.expandAll(true);
  gui.frames(2);
  EXPECT_LT(itemProbe().items.size(), 400U) << "rows that are not seen are not drawn";
}

TEST_F(Gui, ExcludesTheSelectionFromTheSceneAndTakesItBack) {
  open();
  const auto roof = productNamed(*editor.environment(), "Roof");
  const auto triangles = editor.triangles();
  editor.select(roof, true);
  gui.frames(2);
  gui.key('X');
  gui.settle();
  ASSERT_TRUE(editor.session.errors().empty()) << describe(editor.session.errors().front().error);
  EXPECT_TRUE(editor.environment()->products[roof].excluded);
  EXPECT_EQ(editor.selection.products(), std::vector<std::uint32_t>{roof})
      << "it stays chosen, so that it can be taken back";
  EXPECT_EQ(editor.triangles(), triangles - 12);
  if (editor.picker.ready()) {
    gui.moveTo(screenOf({5, 4, 6.3}));
    EXPECT_TRUE(!editor.view.hover || editor.view.hover->product != roof);
  }
  editor.session.undo();
  gui.frames(2);
  EXPECT_FALSE(editor.environment()->products[roof].excluded);
}

TEST_F(Gui, ShowsTheOriginalBesideTheLighterModelWithTheirDistances) {
  open();
  ASSERT_TRUE(editor.session.start("optimize", {{"budget", 60}, {"max-deviation", 0.5}}));
  gui.settle();
  gui.key('B');
  EXPECT_EQ(editor.view.side, ModelSide::both);
  invoke(editor, "colour-deviation");
  gui.frames(2);
  editor.deviation.wait();
  gui.frames(2);
  const auto both = editor.deviation.of(editor.session.document());
  ASSERT_TRUE(both);
  EXPECT_EQ(editor.originalState().environment, editor.session.document().imported);
  EXPECT_EQ(editor.originalState().deviation, both->original);
  EXPECT_EQ(editor.viewState().deviation, both->lighter);
  double area = 0, far = 0;
  for (std::size_t i = 0; i < both->histogram.area_m2.size(); ++i) area += both->histogram.area_m2[i];
  for (std::size_t i = 4; i < both->histogram.area_m2.size(); ++i) far += both->histogram.area_m2[i];
  double expected = 0;
  for (const auto& e : {*editor.session.document().imported, *editor.environment()})
    for (const auto& i : e.instances)
      if (e.products[i.product].inScene()) expected += standpoint::area(*e.meshes[i.mesh]);
  EXPECT_NEAR(area, expected, 1e-3 * expected);
  EXPECT_GT(far, 0);
  editor.session.undo();  // the lighter model is gone, and with it what compares
  gui.frames(3);
  EXPECT_EQ(editor.view.side, ModelSide::lighter);
  EXPECT_EQ(editor.view.colour, ColourMode::model);
}

// Boxes cannot have fewer triangles: any budget below theirs is out of reach.
TEST_F(Gui, OptimisesByItsDefaultsWithoutALoss) {
  open();
  editor.workspace = Workspace::optimise;
  editor.wanted_tab[1] = "optimise";
  gui.frames(3);
  EXPECT_TRUE(gui.says("as far towards the budget as the maximum deviation allows")) << "before it is pressed";
  editor.session.clearLog();
  ASSERT_TRUE(gui.click("###run-optimise"));
  gui.settle();
  const auto& light = editor.session.document().simplified;
  ASSERT_NE(light, nullptr);
  for (const auto& entry : editor.session.log()) EXPECT_LT(entry.level, LogLevel::loss) << entry.message;
  EXPECT_EQ(light->request.budget, light->all.triangles_after) << "which the verb reaches again, without a loss";
  EXPECT_GT(light->all.triangles_after, sceneTriangleCount(*editor.session.document().imported) / 4);
  EXPECT_TRUE(gui.says("cannot be reached within this deviation"));
}

TEST_F(Gui, OptimisingBeginsWithTheRequestOfTheProjectThatIsOpened) {
  open();
  gui.settle();
  ASSERT_TRUE(editor.session.start(SimplificationRequest{.budget = 40, .max_deviation_m = 0.03}));
  gui.settle();
  ASSERT_NE(editor.session.document().simplified, nullptr);
  editor.workspace = Workspace::optimise;
  editor.wanted_tab[1] = "optimise";
  gui.frames(3);
  const auto whole = static_cast<double>(sceneTriangleCount(*editor.session.document().imported));
  const auto& form = editor.panels.of<OptimiseState>();
  EXPECT_NEAR(form.budget_fraction * whole, static_cast<double>(*editor.session.document().simplified->request.budget),
              1e-6);
  EXPECT_NEAR(form.max_deviation_mm, 30, 1e-9);
}

TEST_F(Gui, TakesTheBudgetInTrianglesToo) {
  open();
  editor.workspace = Workspace::optimise;
  editor.wanted_tab[1] = "optimise";
  gui.frames(3);
  ASSERT_TRUE(gui.click("###budget-triangles"));
  gui.frames(2);
  gui.key('A', true);
  gui.type("30");
  gui.key(kEnter);
  gui.frames(2);
  const auto whole = static_cast<double>(sceneTriangleCount(*editor.session.document().imported));
  EXPECT_NEAR(editor.panels.of<OptimiseState>().budget_fraction * whole, 30, 1e-6);
}

TEST_F(Gui, FollowsTheBudgetsSliderAtOnceAndForgetsItWhenOptimised) {
  open();
  editor.workspace = Workspace::optimise;
  editor.wanted_tab[1] = "optimise";
  editor.panels.of<OptimiseState>().live = true;
  editor.panels.of<OptimiseState>().max_deviation_mm = 500;
  const auto whole = sceneTriangleCount(*editor.environment());
  const auto shownAt = [&](double fraction) -> std::uint64_t {
    editor.panels.of<OptimiseState>().budget_fraction = fraction;
    const auto budget = static_cast<std::uint64_t>(std::llround(fraction * static_cast<double>(whole)));
    for (int i = 0; i < 400; ++i) {
      gui.frame();
      const auto state = editor.budget_preview.state();
      if (state.shown && !state.preparing && state.triangles <= budget && state.triangles + 4 >= budget)
        return sceneTriangleCount(*editor.viewState().environment);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return 0;
  };
  const auto half = shownAt(0.5), quarter = shownAt(0.25);
  EXPECT_GT(half, quarter);
  EXPECT_GT(quarter, 0U);
  EXPECT_EQ(editor.session.document().simplified, nullptr) << "a look changes nothing";
  ASSERT_TRUE(gui.click("###run-optimise"));
  gui.settle();
  EXPECT_FALSE(editor.panels.of<OptimiseState>().live);
  EXPECT_EQ(editor.viewState().environment, editor.session.document().simplified->environment);
}

TEST_F(Gui, ShowsTheMaterialsThatSomebodyHasAssigned) {
  open();
  editor.workspace = Workspace::materials;
  gui.frames(3);
  ASSERT_EQ(editor.view.colour, ColourMode::model);
  ASSERT_TRUE(gui.click("###assign-rules"));
  gui.settle();
  gui.frames(2);
  EXPECT_EQ(editor.view.colour, ColourMode::material);
  EXPECT_TRUE(gui.says("shows the assigned materials")) << "and how to come back";
  editor.view.colour = ColourMode::model;
  ASSERT_TRUE(editor.session.start("materials", nlohmann::json::object()));
  gui.settle();
  gui.frames(2);
  EXPECT_EQ(editor.view.colour, ColourMode::model) << "nobody has asked for it";
  editor.view.colour = ColourMode::reflectance;
  ASSERT_TRUE(gui.click("###assign-rules"));
  gui.settle();
  gui.frames(2);
  EXPECT_EQ(editor.view.colour, ColourMode::reflectance) << "it shows them already";
}

TEST_F(Gui, AssignsTheChosenMaterialToWhatWasSelectedBeforeTheList) {
  open();
  ASSERT_TRUE(editor.session.start("materials", nlohmann::json::object()));
  gui.settle();
  editor.workspace = Workspace::materials;
  gui.frames(3);
  ASSERT_NE(gui.find("###assign-selected"), nullptr);
  EXPECT_TRUE(gui.find("###assign-selected")->disabled) << "nothing is chosen";
  const auto wall = productNamed(*editor.environment(), "Wall east OG");
  editor.select(wall, true);
  gui.frames(2);
  const auto materialOf = [&] {
    const auto& result = editor.session.document().materials->result;
    for (const auto& use : result.report.uses)
      if (std::find(use.products.begin(), use.products.end(), wall) != use.products.end()) return use.material;
    return std::string("none");
  };
  const auto before = materialOf();
  const auto& uses = editor.session.document().materials->result.report.uses;
  const auto other = std::find_if(uses.begin(), uses.end(),
                                  [&](const MaterialUse& u) { return !u.material.empty() && u.material != before; });
  ASSERT_NE(other, uses.end());
  const auto wanted = other->material;
  editor.material = {wanted};
  gui.frames(2);
  EXPECT_FALSE(gui.find("###assign-selected")->disabled);
  EXPECT_TRUE(gui.says("Assign to Wall east OG"));
  ASSERT_TRUE(gui.click("###assign-selected"));
  gui.settle();
  EXPECT_EQ(materialOf(), wanted);
  EXPECT_EQ(editor.selection.products(), std::vector<std::uint32_t>{wall});
  EXPECT_EQ(editor.view.colour, ColourMode::material) << "so that it is seen";
}

TEST_F(Gui, HasItsTabsInTheFirstFrameOfAWorkspace) {
  open();
  editor.laid_out = editor.workspace;
  editor.workspace = Workspace::survey;
  itemProbe().texts.clear();
  itemProbe().listens = true;
  const int before = ImGui::GetFrameCount();
  drawFrame(editor);
  itemProbe().listens = false;
  EXPECT_EQ(ImGui::GetFrameCount(), before + 2) << "of which the second is seen";
  const auto& drawn = itemProbe().texts;
  EXPECT_TRUE(std::any_of(drawn.begin(), drawn.end(), [](const auto& t) { return t.ends_with("Inspector"); }));
  drawFrame(editor);
  EXPECT_EQ(ImGui::GetFrameCount(), before + 3);
}

TEST_F(Gui, ShowsATooltipBesideThePanelOnceThePointerHasRested) {
  open();
  editor.workspace = Workspace::optimise;
  editor.wanted_tab[1] = "optimise";
  gui.frames(3);
  const auto* item = gui.find("Lossless only");
  ASSERT_NE(item, nullptr);
  gui.moveTo(item->rect.GetCenter());
  const auto shown = [] {
    const auto* tooltip = ImGui::FindWindowByName("##Tooltip_00");
    return tooltip != nullptr && tooltip->Active ? tooltip : nullptr;
  };
  gui.frames(5);
  EXPECT_EQ(shown(), nullptr) << "who passes by is not held up";
  for (int i = 0; i < 30 && shown() == nullptr; ++i) {
    EXPECT_GE(ui::tooltipDue_s(), 0) << "the window wakes for it";
    gui.frame();
  }
  EXPECT_EQ(ui::tooltipDue_s(), 0) << "its first frame only measures it";
  gui.frame();
  const auto* tooltip = shown();
  ASSERT_NE(tooltip, nullptr);
  EXPECT_LT(ui::tooltipDue_s(), 0);
  EXPECT_LE(tooltip->Pos.x + tooltip->Size.x, ImGui::FindWindowByName("###right")->Pos.x) << "over no control of it";
}

TEST_F(Gui, ShowsTheTooltipOfAWorkspaceOverNoButtonOfTheView) {
  open();
  gui.frames(3);
  const auto* item = gui.find("###workspace-survey");
  ASSERT_NE(item, nullptr);
  const ImRect tab = item->rect;
  gui.moveTo(tab.GetCenter());
  const auto* tooltip = ImGui::FindWindowByName("##Tooltip_00");
  for (int i = 0; i < 60 && (tooltip == nullptr || !tooltip->Active); ++i) {
    gui.frame();
    tooltip = ImGui::FindWindowByName("##Tooltip_00");
  }
  gui.frames(2);
  ASSERT_TRUE(tooltip != nullptr && tooltip->Active);
  EXPECT_LT(tooltip->Pos.y + tooltip->Size.y, tab.GetCenter().y);
  EXPECT_GE(tooltip->Pos.y, 0);
}

TEST_F(Gui, KeepsTheViewWhereItIsWhenTheWorkspaceChanges) {
  open();
  std::optional<ImRect> view;
  for (const auto workspace : {Workspace::environment, Workspace::optimise, Workspace::materials,
                               Workspace::georeference, Workspace::survey, Workspace::instrument, Workspace::inspect}) {
    editor.workspace = workspace;
    gui.frames(3);
    const auto* window = ImGui::FindWindowByName("###viewport");
    if (!view) view = window->Rect();
    EXPECT_EQ(window->Pos.x, view->Min.x) << nameOf(workspace);
    if (workspace == Workspace::instrument) continue;  // its device has the room that it needs
    EXPECT_EQ(window->Size.x, view->GetWidth()) << nameOf(workspace);
    EXPECT_EQ(window->Size.y, view->GetHeight()) << nameOf(workspace);
  }
}

// Whatever is drawn in these windows ends before their right edge.
void expectNothingCut(const char* window_name) {
  const auto* window = ImGui::FindWindowByName(window_name);
  ASSERT_NE(window, nullptr) << window_name;
  for (const auto& item : itemProbe().items)
    if (item.window == window_name && item.label.find("###scene") == std::string::npos) {
      EXPECT_LE(item.rect.Max.x, window->Pos.x + window->Size.x) << item.label;
    }
}

TEST_F(Gui, CutsNoToolAtASmallWindowNorAtALargeScale) {
  open();
  ASSERT_TRUE(editor.session.start("optimize", {{"budget", 60}, {"max-deviation", 0.5}}));
  gui.settle();
  for (const float scale : {1.0F, 1.5F}) {
    editor.scale = scale;
    applyTheme(scale);
    editor.fonts = buildFonts(scale);
    unsigned char* pixels = nullptr;
    int w = 0, h = 0;
    ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &w, &h);
    editor.visibility.cut_height_m = 1.5;
    for (const auto mode : {ColourMode::model, ColourMode::reflectance, ColourMode::expected_intensity}) {
      editor.view.colour = mode;
      for (int w2 = 0; w2 < kWorkspaces; ++w2) {
        editor.workspace = static_cast<Workspace>(w2);
        gui.frames(3);
        expectNothingCut("###toolbar");
        expectNothingCut("###viewport");
      }
    }
  }
}

TEST_F(Gui, ShowsTheLabelsOfItsChipsWhole) {
  open();
  ASSERT_TRUE(editor.session.start(SimplificationRequest{.budget = 60, .max_deviation_m = 0.5}));
  gui.settle();
  editor.visibility.cut_height_m = 123.4;
  gui.frames(3);
  for (const auto& [chip, label] :
       {std::pair{"###side", ICON_COMPRESS "  Simplified model"}, std::pair{"###colour", ICON_PAINT "  Model colours"},
        std::pair{"###cut", ICON_CUT "  Cut at 123.40 m"}}) {
    const auto* drawn = gui.find(chip);
    ASSERT_NE(drawn, nullptr) << chip;
    EXPECT_GE(drawn->rect.GetWidth(), ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x) << chip;
  }
}

}  // namespace
}  // namespace standpoint
