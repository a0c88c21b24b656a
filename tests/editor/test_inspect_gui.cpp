// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "demo_verbs.h"
#include "editor/shell/actions.h"
#include "editor/widgets/keyboard.h"
#include "item_probe.h"
#include "project/verbs/file_verbs.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

// The demo house from above, its ground floor cut open.
class Inspect : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    editor.picker.wait();
    editor.workspace = Workspace::inspect;
    editor.visibility.cut_height_m = 1.5;
    look(editor.view.camera, StandardView::top);
    editor.view.camera.orthographic = true;
    editor.view.frame_wanted = true;
    gui.frames(4);
  }
  ImVec2 screenOf(const Eigen::Vector3d& point) const {
    const auto pixel = project(editor.view.camera, point, editor.view.size);
    const auto* window = ImGui::FindWindowByName("###viewport");
    return {window->Pos.x + static_cast<float>(pixel->x()), window->Pos.y + static_cast<float>(pixel->y())};
  }
  void clickAt(const Eigen::Vector3d& place) {
    gui.moveTo(screenOf(place));
    gui.frames(2);
    gui.press();
    gui.settle();
  }
  // From both stations.
  void scanInto(const TemporaryFolder& folder) {
    ASSERT_TRUE(editor.session.start(ScanVerbOptions{.instrument = "faro-focus-s350",
                                                     .settings = {{"resolution", "1/20"}, {"quality", "4x"}},
                                                     .ideal = true,
                                                     .output = folder / "scan.e57"}));
    gui.settle();
    ASSERT_TRUE(editor.session.errors().empty()) << describe(editor.session.errors().front().error);
  }
  std::size_t kept() const {
    const auto& measurements = editor.session.document().measurements;
    return measurements ? measurements->size() : 0;
  }
  double first() const { return figuresOf(editor.session.document().measurements->back())[0].value; }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(Inspect, TwoClicksKeepADistanceInTheProjectAndUndoTakesItBack) {
  gui.key('M');
  ASSERT_EQ(editor.view.tool, Tool::measure);
  clickAt({1.5, 5, 0});
  EXPECT_EQ(kept(), 0u);
  clickAt({3.5, 6, 0});
  ASSERT_EQ(kept(), 1u);
  EXPECT_NEAR(first(), std::hypot(2.0, 1.0), 0.05) << "by the pixel";
  EXPECT_EQ(editor.view.tool, Tool::measure) << "for the next one";
  gui.key('Z', true);
  gui.settle();
  EXPECT_EQ(kept(), 0u);
}

TEST_F(Inspect, ADistanceInThePlanHoldsOnToBothWallsAndIsSquareToThem) {
  gui.key('M');
  clickAt({0.33, 4.8, 0});  // beside the west wall, whose inner face is at x = 0.3
  clickAt({4.97, 5.1, 0});  // beside the partition, at x = 5
  ASSERT_EQ(kept(), 1u);
  EXPECT_NEAR(first(), 4.7, 1e-6);
  EXPECT_EQ(editor.session.document().measurements->back().note, "Square to both faces");
}

TEST_F(Inspect, EnterMeasuresToTheFaceOpposite) {
  gui.key('M');
  clickAt({0.33, 4.8, 0});
  EXPECT_TRUE(gui.says("press Enter for the face opposite"));
  gui.key(kKeyEnter);
  gui.settle();
  ASSERT_EQ(kept(), 1u);
  EXPECT_NEAR(first(), 4.7, 1e-6);
}

TEST_F(Inspect, CtrlMeasuresWhereThePointerIs) {
  gui.key('M');
  ImGui::GetIO().KeyCtrl = true;
  clickAt({0.33, 4.8, 0});
  clickAt({4.97, 5.1, 0});
  ImGui::GetIO().KeyCtrl = false;
  ASSERT_EQ(kept(), 1u);
  EXPECT_NEAR(first(), std::hypot(4.64, 0.3), 0.02) << "by the pixel";
  EXPECT_GT(std::abs(first() - 4.7), 1e-3);
}

TEST_F(Inspect, AClickBesideEverythingIsAnsweredWhereItWasMade) {
  editor.view.camera.distance_m *= 3;  // the model is in the middle and nothing around it
  const auto clickBeside = [&] {
    const auto* window = ImGui::FindWindowByName("###viewport");
    gui.moveTo({window->Pos.x + 12, window->Pos.y + 0.6F * window->Size.y});
    gui.frames(2);
    ASSERT_FALSE(editor.view.measured);
    gui.press();
    gui.settle();
  };
  gui.key('M');
  EXPECT_FALSE(gui.says("Nothing to measure here"));
  clickBeside();
  EXPECT_TRUE(gui.says("Nothing to measure here"));
  EXPECT_TRUE(editor.view.measuring.points.empty());
  clickAt({1.5, 5, 0});
  EXPECT_FALSE(gui.says("Nothing to measure here"));
  EXPECT_EQ(editor.view.measuring.points.size(), 1u);
  clickBeside();
  EXPECT_TRUE(gui.says("Nothing to measure here"));
  EXPECT_EQ(editor.view.measuring.points.size(), 1u) << "the first point stays";
}

TEST_F(Inspect, EnterEndsAPolygonAndBackspaceTakesTheLastCornerBack) {
  gui.key('M', true, true);
  clickAt({1.5, 5, 0});
  clickAt({3.5, 5, 0});
  clickAt({3.5, 6, 0});
  clickAt({2.0, 5.5, 0});
  gui.key(259);
  EXPECT_EQ(editor.view.measuring.points.size(), 3u);
  clickAt({1.5, 6, 0});
  gui.key(kKeyEnter);
  gui.settle();
  ASSERT_EQ(kept(), 1u);
  EXPECT_NEAR(first(), 2, 0.1);
}

TEST_F(Inspect, EscBeginsAMeasurementAnewBeforeItLeavesTheTool) {
  gui.key('M');
  clickAt({1.5, 5, 0});
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_EQ(editor.view.tool, Tool::measure);
  EXPECT_TRUE(editor.view.measuring.points.empty());
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_EQ(editor.view.tool, Tool::select);
}

TEST_F(Inspect, DelRemovesTheChosenMeasurement) {
  gui.key('M');
  clickAt({1.5, 5, 0});
  clickAt({3.5, 6, 0});
  ASSERT_EQ(kept(), 1u);
  editor.survey.measurement = 0;
  gui.key(kKeyDelete);
  gui.settle();
  EXPECT_EQ(kept(), 0u);
}

TEST_F(Inspect, AClipBoxHidesFromClicksWhatItCutsAway) {
  ASSERT_TRUE(editor.picker.pick(
      rayThrough(editor.view.camera, *project(editor.view.camera, {3.5, 6, 0}, editor.view.size), editor.view.size),
      editor.viewState()));
  Bounds corner;
  corner.extend(Eigen::Vector3d(0, 0, -1));
  corner.extend(Eigen::Vector3d(2, 2, 3));
  editor.view.clip.box = clipAround(corner, 0);
  EXPECT_FALSE(editor.picker.pick(
      rayThrough(editor.view.camera, *project(editor.view.camera, {3.5, 6, 0}, editor.view.size), editor.view.size),
      editor.viewState()));
}

TEST_F(Inspect, AFaceOfTheClipBoxIsPulledAndEscPutsItBack) {
  Bounds room;
  room.extend(Eigen::Vector3d(1, 4, 0));
  room.extend(Eigen::Vector3d(4, 7, 2));
  editor.view.clip.box = clipAround(room, 0);
  gui.frames(2);
  gui.moveTo(screenOf({4, 5.5, 1}));
  ImGui::GetIO().MouseDown[0] = true;
  gui.frames(2);
  gui.moveTo(screenOf({3, 5.5, 1}));
  gui.frames(2);
  EXPECT_NEAR(editor.view.clip.box->half.x(), 1, 0.05);
  EXPECT_NEAR(editor.view.clip.box->centre.x(), 2, 0.05);
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_NEAR(editor.view.clip.box->half.x(), 1.5, 1e-9);
  ImGui::GetIO().MouseDown[0] = false;
  gui.frames(2);
}

TEST_F(Inspect, StationsTargetsAndMeasurementsBesideTheClipBoxAreNotDrawn) {
  gui.key('M');
  clickAt({1.5, 5, 0});
  clickAt({3.5, 6, 0});
  gui.key(kKeyEscape);
  gui.frames(3);
  for (const char* name : {"S1", "S2", "T1", "M1   "}) EXPECT_TRUE(gui.says(name)) << name;
  Bounds around;
  around.extend(Eigen::Vector3d(2.5, 1.5, 0));
  around.extend(Eigen::Vector3d(4, 2.5, 2));
  editor.workspace = Workspace::environment;  // its panels list none of them
  editor.view.clip.box = clipAround(around, 0);
  gui.frames(3);
  EXPECT_TRUE(gui.says("S1"));
  for (const char* name : {"S2", "T1", "M1   "}) EXPECT_FALSE(gui.says(name)) << name;
}

TEST_F(Inspect, AStationOnAFloorThatIsCutAwayIsNotDrawn) {
  editor.workspace = Workspace::environment;
  gui.frames(3);
  EXPECT_TRUE(gui.says("S1")) << "higher than the cut, but of the storey that is cut open";
  editor.visibility.cut_height_m = -0.1;
  gui.frames(3);
  EXPECT_FALSE(gui.says("S1"));
}

TEST_F(Inspect, TheClipBoxIsUndoneByStepsOfWhichADragIsOne) {
  const auto& history = editor.session.history();
  const auto steps = history.size();
  const bool modified = editor.session.modified();
  const auto revision = editor.session.revision();
  Bounds room;
  room.extend(Eigen::Vector3d(1, 4, 0));
  room.extend(Eigen::Vector3d(4, 7, 2));
  editor.view.clip.box = clipAround(room, 0);
  gui.frames(3);
  ASSERT_EQ(history.size(), steps + 1);
  EXPECT_EQ(history.undoDescription(), "Clip box set");
  gui.moveTo(screenOf({4, 5.5, 1}));
  ImGui::GetIO().MouseDown[0] = true;
  gui.frames(2);
  for (const double x : {3.6, 3.3, 3.0}) {
    gui.moveTo(screenOf({x, 5.5, 1}));
    gui.frames(2);
  }
  EXPECT_EQ(history.size(), steps + 1) << "while it is dragged";
  ImGui::GetIO().MouseDown[0] = false;
  gui.frames(3);
  ASSERT_EQ(history.size(), steps + 2);
  EXPECT_EQ(history.undoDescription(), "Clip box changed");
  ASSERT_TRUE(invoke(editor, "clip-none"));
  gui.frames(3);
  EXPECT_EQ(history.undoDescription(), "Clip box removed");
  EXPECT_EQ(editor.session.modified(), modified) << "it is in no file";
  EXPECT_EQ(editor.session.revision(), revision) << "nothing is out of date";
  gui.key('Z', true);
  gui.frames(2);
  ASSERT_TRUE(editor.view.clip.box);
  EXPECT_NEAR(editor.view.clip.box->half.x(), 1, 0.05);
  gui.key('Z', true);
  gui.frames(2);
  ASSERT_TRUE(editor.view.clip.box);
  EXPECT_NEAR(editor.view.clip.box->half.x(), 1.5, 1e-9);
  gui.key('Z', true);
  gui.frames(2);
  EXPECT_FALSE(editor.view.clip.box);
  gui.key('Y', true);
  gui.frames(2);
  ASSERT_TRUE(editor.view.clip.box);
  EXPECT_NEAR(editor.view.clip.box->half.x(), 1.5, 1e-9);
  EXPECT_EQ(history.size(), steps + 3) << "going back makes no steps";
  editor.session.goTo(steps + 2);
  gui.frames(2);
  EXPECT_FALSE(editor.view.clip.box);
}

TEST_F(Inspect, AClipBoxIsMadeAroundTheChosenStation) {
  editor.selection.clear();
  editor.survey.station = 1;
  const Eigen::Vector3d centre = editor.session.document().job->stations[1].true_pose.translation;
  ASSERT_TRUE(invoke(editor, "clip-box"));
  ASSERT_TRUE(editor.view.clip.box);
  EXPECT_TRUE(editor.view.clip.box->contains(centre));
  EXPECT_LT(editor.view.clip.box->half.maxCoeff(), 4);
}

TEST_F(Inspect, ASectionIsLookedAtAlongItsThinSide) {
  editor.clipSection({2, 5, 1}, Eigen::Vector3d::UnitX());
  editor.lookAlongClip();
  EXPECT_TRUE(editor.view.camera.orthographic);
  EXPECT_NEAR(std::abs(editor.view.camera.forward().x()), 1, 1e-9);
}

// A scan of two points, 1 m along the scanner's X and Y.
std::string ptxAt(const Eigen::Vector3d& place) {
  const auto at = fmt::format("{} {} {}", place.x(), place.y(), place.z());
  return "2\n1\n" + at + "\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n" + at + " 1\n1 0 0 0.5\n0 1 0 0.5\n";
}

TEST_F(Inspect, ThePointsOfTheChosenStationAreExported) {
  Document document = editor.session.document();
  Job job = *document.job;
  for (auto& station : job.stations) station.scans = {{.file = "/scans/" + station.name + ".e57", .points = 2}};
  document.job = std::make_shared<const Job>(job);
  ASSERT_TRUE(editor.session.adopt({document, {}, {}, "scanned"}));
  for (const int station : {0, 1}) {
    editor.survey.station = station;
    ASSERT_TRUE(invoke(editor, "export-points"));
    EXPECT_EQ(editor.dialogs.verb.form.find("in")->text, "/scans/S" + std::to_string(station + 1) + ".e57");
    EXPECT_FALSE(editor.dialogs.verb.form.options().contains("with"));
    editor.dialogs.verb.open = false;
  }
}

TEST_F(Inspect, ThePointsOfAllStationsAreExportedIntoOneFile) {
  Document document = editor.session.document();
  Job job = *document.job;
  for (auto& station : job.stations)
    station.scans = {{.file = "/scans/old-" + station.name + ".e57"}, {.file = "/scans/" + station.name + ".e57"}};
  document.job = std::make_shared<const Job>(job);
  ASSERT_TRUE(editor.session.adopt({document, {}, {}, "scanned"}));
  editor.survey.station = 0;
  ASSERT_TRUE(invoke(editor, "export-points"));
  gui.frames(3);
  const auto& form = editor.dialogs.verb.form;
  const auto chooseOf = [&](const char* entry) {
    ASSERT_TRUE(gui.click("###value"));
    gui.frames(2);
    ASSERT_TRUE(gui.click(entry));
    gui.frames(2);
  };
  chooseOf("###all");
  EXPECT_EQ(form.options()["in"], "/scans/S1.e57");
  EXPECT_EQ(form.options()["with"], nlohmann::json({"/scans/S2.e57"}));
  EXPECT_EQ(gui.find("###given"), nullptr) << "the files are not shown one by one";
  chooseOf("###1");
  EXPECT_EQ(form.options()["in"], "/scans/old-S1.e57");
  EXPECT_FALSE(form.options().contains("with"));
  editor.dialogs.verb.open = false;

  editor.survey.station = -1;
  ASSERT_TRUE(invoke(editor, "export-points"));
  EXPECT_EQ(editor.dialogs.verb.form.options()["with"], nlohmann::json({"/scans/S2.e57"})) << "none is chosen";
}

TEST_F(Inspect, ScansAreShownTogetherAndWhereRegistrationBelievesThemToBe) {
  const TemporaryFolder folder;
  Document document = editor.session.document();
  Job job = *document.job;
  job.stations.resize(1);
  job.stations.push_back(job.stations.front());
  job.stations.back().name = "S2";
  for (auto& station : job.stations) {
    const Eigen::Vector3d place = station.true_pose.translation + editor.shift_m();
    station.scans = {{.file = folder.write(station.name + ".ptx", ptxAt(place)).string(), .points = 2}};
  }
  document.job = std::make_shared<const Job>(job);
  ASSERT_TRUE(editor.session.adopt({document, {}, {}, "scanned"}));
  editor.wanted_tab[0] = "points";
  gui.frames(3);
  ASSERT_NE(gui.find("Solved poses"), nullptr);
  EXPECT_TRUE(gui.find("Solved poses")->disabled) << "nothing is registered";
  ASSERT_TRUE(gui.click("###show-together"));
  gui.settle();
  ASSERT_TRUE(editor.cloud());
  ASSERT_EQ(editor.cloud()->points.size(), 4u);
  const auto before = editor.cloud()->points;
  EXPECT_FALSE(gui.says("Model colours")) << "the picture shows none";
  ASSERT_TRUE(gui.click("###colour"));
  gui.frames(2);
  ASSERT_TRUE(gui.click(rowOf(ColourBy::height).name));
  gui.frames(2);
  EXPECT_EQ(editor.view.points_by, ColourBy::height);

  job.stations[1].solved_pose = job.stations[1].true_pose;
  job.stations[1].solved_pose->translation.x() += 0.5;
  document.job = std::make_shared<const Job>(job);
  ASSERT_TRUE(editor.session.adopt({document, {}, {}, "registered"}));
  gui.frames(3);
  ASSERT_TRUE(gui.click("Solved poses"));
  gui.frames(3);
  const auto& after = editor.cloud()->points;
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(after[i].position_m[0] - before[i].position_m[0], i < 2 ? 0 : 0.5, 1e-5) << i;
  itemProbe().listens = true;
  gui.frame();
  itemProbe().listens = false;
  EXPECT_THAT(itemProbe().texts, testing::IsSupersetOf({"S2 is off by 500.0 mm and 0.0000°", "S1 is not registered"}));
  ASSERT_TRUE(gui.click("Solved poses"));
  gui.frames(3);
  EXPECT_EQ(editor.cloud()->points[3].position_m, before[3].position_m);
  ASSERT_TRUE(gui.click("###show-together"));
  gui.settle();
  EXPECT_FALSE(editor.cloud()) << "back to the model";
  EXPECT_TRUE(gui.says("Model colours"));
}

Eigen::Vector3d placeOf(const Cloud& cloud, std::size_t point) {
  const auto& p = cloud.points.at(point).position_m;
  return cloud.pointsOrigin_m() + Eigen::Vector3d(p[0], p[1], p[2]);
}

TEST_F(Inspect, AnUnderlayIsShownInsteadOfTheModelWhereItStandsHoweverFarItsFileLies) {
  const TemporaryFolder folder;
  const Eigen::Vector3d scanner(4500000.25, 5300000.5, 112.75), wanted(2, 3, 1);
  Underlay underlay{.name = "Old scan", .file = folder.write("old.ptx", ptxAt(scanner)).string(), .points = 2};
  Document document = editor.session.document();
  document.job = nullptr;
  const auto placeAt = [&](const Eigen::Vector3d& local, double yaw_rad) {
    underlay.file_from_cloud.rotation = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ());
    underlay.file_from_cloud.translation = local + editor.shift_m() - underlay.file_from_cloud.rotation * scanner;
    document.underlays = {std::make_shared<const Underlay>(underlay)};
    return editor.session.adopt({document, {}, {}, "placed"});
  };
  ASSERT_TRUE(placeAt(wanted, std::numbers::pi / 2));
  editor.wanted_tab[0] = "points";
  gui.frames(3);
  ASSERT_TRUE(gui.click("###show-points"));
  gui.settle();
  ASSERT_TRUE(editor.cloud());
  ASSERT_EQ(editor.cloud()->points.size(), 2u);
  // The scanner's X is the model's Y now.
  EXPECT_LT((placeOf(*editor.cloud(), 0) - wanted - Eigen::Vector3d(0, 1, 0)).norm(), 1e-5);
  EXPECT_LT((placeOf(*editor.cloud(), 1) - wanted + Eigen::Vector3d(1, 0, 0)).norm(), 1e-5);

  gui.moveTo(screenOf({1.5, 5, 0}));
  EXPECT_FALSE(editor.view.hover) << "the floor is not seen";

  ASSERT_TRUE(placeAt(wanted + Eigen::Vector3d(0, 0, 4), 0));
  gui.frames(2);
  gui.settle();
  ASSERT_TRUE(editor.cloud()) << "it is shown still";
  EXPECT_LT((placeOf(*editor.cloud(), 0) - wanted - Eigen::Vector3d(1, 0, 4)).norm(), 1e-5);
}

TEST_F(Inspect, AWallIsPickedOnlyWhereThereIsACloudAndElseSaysWhy) {
  const auto* action = findAction("pick-wall");
  const auto why = whyNot(*action, editor);
  if (inspectedClouds(editor.session.document()).empty()) {
    EXPECT_FALSE(why.empty());
  }
}

TEST_F(Inspect, ThePanoramaOfTheChosenStationIsAPressAway) {
  const TemporaryFolder folder;
  ASSERT_NO_FATAL_FAILURE(scanInto(folder));
  editor.showClouds({});
  editor.survey.station = 1;
  editor.wanted_tab[2] = "panorama";
  gui.frames(3);
  EXPECT_EQ(editor.panorama.result(), nullptr) << "nothing is read unasked";
  ASSERT_TRUE(gui.click("###panorama-show"));
  editor.panorama.wait();
  gui.frames(2);
  ASSERT_NE(editor.panorama.result(), nullptr);
  const auto& scans = editor.session.document().job->stations[1].scans;
  EXPECT_EQ(editor.panorama.result()->request.file, scans.back().file);
  EXPECT_EQ(gui.find("###panorama-show"), nullptr);
}

// A is chosen by keys, as a list is gone through.
TEST_F(Inspect, ShowsWhereTwoCloudsDifferOnceTheyAreCompared) {
  const TemporaryFolder folder;
  ASSERT_NO_FATAL_FAILURE(scanInto(folder));
  editor.wanted_tab[2] = "compare";
  gui.frames(3);
  for (const char* list : {"###compare-a", "###compare-b"}) {
    ASSERT_TRUE(gui.click(list));
    gui.frames(2);
    gui.key(kKeyHome);
    if (std::string(list).ends_with("b")) gui.key(kKeyDown);
    gui.key(kKeyEnter);
  }
  ASSERT_TRUE(gui.click("###compare-clouds"));
  gui.settle();
  gui.frames(2);
  ASSERT_TRUE(editor.session.errors().empty()) << describe(editor.session.errors().front().error);
  const auto* answer = editor.session.lastAnswer<CompareAnswer>("compare");
  ASSERT_NE(answer, nullptr);
  EXPECT_GT(answer->a_from_b_m.median, 0);
  ASSERT_TRUE(editor.cloud());
  const bool b_first = answer->b_largest->distance_m > answer->a_largest->distance_m;
  EXPECT_EQ(editor.cloud()->points.size(), (b_first ? answer->b_distances : answer->a_distances)->place_m.size())
      << "the one that has more to show";
  ASSERT_NE(editor.pointLegend(), nullptr);
  EXPECT_EQ(editor.pointLegend()->unit, "mm");
  EXPECT_TRUE(gui.says(b_first ? "B by distance to A, mm" : "A by distance to B, mm"));
  ASSERT_TRUE(gui.click("###difference-a"));
  gui.frames(2);
  EXPECT_EQ(editor.cloud()->points.size(), answer->a_distances->place_m.size());
  ASSERT_TRUE(gui.click("###most-difference"));
  gui.frames(2);
  ASSERT_TRUE(editor.view.worst_place);
  EXPECT_LT((editor.view.worst_place->at - (answer->a_largest->at_m - editor.shift_m())).norm(), 1e-6);
  EXPECT_TRUE(editor.cloud()) << "among the points that differ";
  EXPECT_TRUE(gui.says("points of A in one cubic metre, on average")) << "no distance of a single point";
  ASSERT_TRUE(gui.click("###difference-b"));
  gui.frames(2);
  EXPECT_EQ(editor.cloud()->points.size(), answer->b_distances->place_m.size());
  ASSERT_TRUE(gui.click("###cloud"));
  gui.frames(2);
  EXPECT_FALSE(editor.cloud());
  EXPECT_EQ(editor.pointLegend(), nullptr);
}

}  // namespace
}  // namespace standpoint
