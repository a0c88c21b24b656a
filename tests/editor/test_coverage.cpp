// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "demo_verbs.h"
#include "editor/model/coverage_view.h"
#include "editor/model/expected_view.h"
#include "editor/model/shown_holes.h"
#include "editor/shell/actions.h"
#include "item_probe.h"

namespace standpoint {
namespace {

// A wall across +Y at 10 m and a pillar in front of its left part; two stations side by side.
struct Stage {
  std::shared_ptr<const Environment> environment;
  std::shared_ptr<const RayScene> scene;
  Instrument instrument = *readInstrument(dataFolder() / "scanners" / "instruments" / "leica-rtc360.json");
  Document document;

  Stage() {
    auto e = std::make_shared<Environment>();
    e->surfaces.push_back({"grey", {0.5F, 0.5F, 0.5F, 1}});
    const auto plate = [&](float from, float to, float y) {
      auto mesh = std::make_shared<Mesh>();
      mesh->positions = {{from, y, -4}, {to, y, -4}, {to, y, 4}, {from, y, 4}};
      mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
      mesh->surface_of_triangle = {0, 0};
      const auto number = static_cast<std::uint32_t>(e->meshes.size());
      e->meshes.push_back(mesh);
      e->products.emplace_back();
      e->instances.push_back({number, number, Eigen::Affine3d::Identity()});
    };
    plate(-8, 8, 10);
    plate(-1, 0.5, 5);
    environment = e;
    Progress progress;
    scene = *RayScene::build(environment, progress);
    document.imported = environment;
    Job job;
    for (const double x : {0.0, 2.0}) {
      Station station;
      station.name = "S" + std::to_string(job.stations.size() + 1);
      station.true_pose.translation = {x, 0, 0};
      job.stations.push_back(station);
    }
    job.stations[1].scans.push_back({"leica-rtc360", "s2.e57", "e57", {{"resolution", "12mm"}}, 1, 1, 1, 1});
    document.job = std::make_shared<const Job>(job);
  }
};

SurfacePlace onWall(double x) { return {{x, 10, 0}, {0, -1, 0}, 0, 0}; }

TEST(Coverage, CountsTheStationsThatSeeAPlace) {
  Stage stage;
  KeptCoverage kept;
  const auto& scans = kept.planned(stage.document, stage.scene, stage.instrument, {});
  ASSERT_EQ(scans.size(), 2U);
  // The pillar's shadow on the wall: from S1 twice its own width, -2 to 1; from S2 at x = 2 it is -4 to -1.
  EXPECT_EQ(coverageAt(scans, onWall(3), {}).stations, 2);
  EXPECT_EQ(coverageAt(scans, onWall(0), {}).from, std::vector<std::size_t>{1});
  EXPECT_EQ(coverageAt(scans, onWall(-3), {}).from, std::vector<std::size_t>{0});
  EXPECT_EQ(coverageAt(scans, onWall(-1.5), {}).stations, 0);
  EXPECT_EQ(coverageColour(CoverageQuantity::spacing, coverageAt(scans, onWall(-1.5), {})), kHoleColour);
}

TEST(Coverage, SaysHowDenselyAndHowSteeplyTheBestScanMeetsIt) {
  Stage stage;
  KeptCoverage kept;
  const auto& scans = kept.planned(stage.document, stage.scene, stage.instrument, {});
  const auto settings = *resolveSettings(stage.instrument, {});
  const auto there = coverageAt(scans, onWall(7), {});
  EXPECT_EQ(there.stations, 2);
  EXPECT_NEAR(there.incidence_rad, std::atan2(5, 10), 1e-9) << "S2 stands 5 m aside, S1 7 m";
  // Level beams: r² dAz dEl / cos.
  const double range = std::hypot(5, 10);
  const double column = (settings.azimuth_to_rad - settings.azimuth_from_rad) / settings.columns,
               row = (settings.elevation_to_rad - settings.elevation_from_rad) / settings.rows;
  EXPECT_NEAR(there.spacing_m, range * std::sqrt(column * row / (10 / range)), 1e-9);
  EXPECT_EQ(coverageAt(scans, onWall(7), {.max_incidence_rad = 30 * std::numbers::pi / 180}).stations, 1)
      << "as the plan's wishes say";
}

TEST(Coverage, OfScansThatWereMadeTakesTheirOwnSettings) {
  Stage stage;
  KeptCoverage kept;
  const std::vector<Instrument> known = {stage.instrument};
  const double planned =
      coverageAt(kept.planned(stage.document, stage.scene, stage.instrument, {}), onWall(3), {}).spacing_m;
  const auto& made = kept.made(stage.document, stage.scene, known);
  ASSERT_EQ(made.size(), 1U) << "S1 has not scanned";
  EXPECT_EQ(made[0].station, "S2");
  EXPECT_NEAR(coverageAt(made, onWall(3), {}).spacing_m / planned, 2, 0.001) << "12 mm against 6 mm";
}

TEST(Coverage, IsPaintedOverTheSurfaces) {
  Stage stage;
  KeptCoverage kept;
  ExpectedRequest request;
  request.scene = stage.scene;
  request.scans = kept.planned(stage.document, stage.scene, stage.instrument, {});
  request.coverage = CoverageQuantity::stations;
  request.view.camera = {{3, 10, 0}, 10, 0, 0, 0.7, false};
  request.view.edges = false;
  request.width = 120;
  request.height = 90;
  ExpectedView view({});
  view.want(request);
  view.wait();
  const auto picture = view.picture(request.view.camera);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->rgba[45 * 120 + 60], countColour(2));
}

TEST(CoverageMap, IsSwitchedBesideThePlanAndSaysWhyThereIsNone) {
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
  ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
  gui.settle();
  editor.workspace = Workspace::survey;
  editor.wanted_tab[1] = "plan";
  gui.frames(3);
  ASSERT_TRUE(gui.click("###map-spacing"));
  gui.frames(2);
  EXPECT_EQ(editor.view.colour, ColourMode::coverage_spacing);
  EXPECT_NE(gui.find("###coverage-of"), nullptr);
  ASSERT_TRUE(gui.click("###map-spacing"));
  EXPECT_EQ(editor.view.colour, ColourMode::model);
}

class Gaps : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    editor.picker.wait();
  }
  void plan() {
    ASSERT_TRUE(editor.session.start(PlanOptions{.instrument = "leica-rtc360", .samples = 100000}));
    gui.settle();
  }
  // The floor that is shown the nearest to the middle of the view, and a place on it.
  std::pair<const PlanPatch*, Eigen::Vector3d> shownFloor() {
    std::pair<const PlanPatch*, Eigen::Vector3d> found{nullptr, Eigen::Vector3d::Zero()};
    double least = 1e9;
    const auto holes = shownHoles(editor);
    for (const auto& hole : editor.holes_in_sight.of(editor, *holes.patches, editor.viewState())) {
      const auto pixel = project(editor.view.camera, hole.middle, editor.view.size);
      if (hole.patch->shape.normal.z() < 0.9 || !pixel) continue;
      const double away = (*pixel - editor.view.size / 2).norm();
      if (away < least) least = away, found = {hole.patch, hole.middle};
    }
    return found;
  }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(Gaps, AreThereOnceTheCoverageIsComputedAndGoWhenTheProjectChanges) {
  EXPECT_EQ(shownHoles(editor).patches, nullptr);
  EXPECT_NE(whyNot(*findAction("holes-plan"), editor), "");
  plan();
  ASSERT_NE(shownHoles(editor).patches, nullptr);
  EXPECT_EQ(shownHoles(editor).of, ShownHoles::Of::plan);
  ASSERT_TRUE(invoke(editor, "holes-plan"));
  gui.frames(2);
  EXPECT_TRUE(editor.view.holes);
  EXPECT_TRUE(looksStraightDown(editor.view.camera));
  ASSERT_NE(shownFloor().first, nullptr);
  EXPECT_LT(shownFloor().second.z(), *editor.visibility.cut_height_m);
  ASSERT_TRUE(editor.session.start(StationOptions{.remove = "S1"}));
  gui.settle();
  EXPECT_EQ(shownHoles(editor).patches, nullptr) << "nothing sees what it saw";
  editor.session.undo();
  gui.settle();
  EXPECT_NE(shownHoles(editor).patches, nullptr) << "the station is back";
}

TEST_F(Gaps, SayUnderThePointerWhatTheyAreOf) {
  plan();
  ASSERT_TRUE(invoke(editor, "holes-plan"));
  gui.frames(3);
  const auto [patch, square] = shownFloor();
  ASSERT_NE(patch, nullptr);
  const auto* scene = gui.find("###scene");
  ASSERT_NE(scene, nullptr);
  const auto pixel = project(editor.view.camera, square, editor.view.size);
  ASSERT_TRUE(pixel);
  gui.moveTo({scene->rect.Min.x + static_cast<float>(pixel->x()), scene->rect.Min.y + static_cast<float>(pixel->y())});
  gui.frames(2);
  itemProbe().listens = true;
  gui.frame();
  itemProbe().listens = false;
  const auto told = std::find_if(itemProbe().texts.begin(), itemProbe().texts.end(),
                                 [](const auto& t) { return t.find("Not covered: ") != std::string::npos; });
  ASSERT_NE(told, itemProbe().texts.end());
  EXPECT_NE(told->find(" m² of "), std::string::npos) << *told;
}

}  // namespace
}  // namespace standpoint
