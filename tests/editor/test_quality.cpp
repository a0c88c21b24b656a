// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "core/readable_name.h"
#include "demo_verbs.h"
#include "editor/model/walking.h"
#include "editor/panels/quality_panel.h"
#include "editor/shell/actions.h"
#include "editor/widgets/keyboard.h"
#include "editor/widgets/verdict_sign.h"
#include "item_probe.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

class QualityPanel : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    editor.workspace = Workspace::survey;
    editor.wanted_tab[1] = "quality";
    gui.frames(3);
  }
  void scan() {
    const auto file = folder / "scan.e57";
    ASSERT_TRUE(editor.session.start(ScanVerbOptions{.instrument = "faro-focus-s350",
                                                     .settings = {{"resolution", "1/20"}, {"quality", "4x"}},
                                                     .ideal = true,
                                                     .output = file}));
    gui.settle();
    ASSERT_TRUE(editor.session.errors().empty()) << describe(editor.session.errors().front().error);
    editor.wanted_tab[1] = "quality";
    gui.frames(3);
  }
  const AssessAnswer* answer() { return editor.session.lastAnswer<AssessAnswer>("assess"); }
  TemporaryFolder folder;
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor, {1280, 1400}};
};

TEST_F(QualityPanel, WaitsForAScan) {
  Document document = editor.session.document();
  Job job = *document.job;
  for (auto& station : job.stations) station.scans.clear();
  document.job = std::make_shared<const Job>(std::move(job));
  ASSERT_TRUE(editor.session.adopt({document, {}, {}, "not scanned yet"}));
  gui.frames(2);
  ASSERT_NE(gui.find("###assess"), nullptr);
  EXPECT_TRUE(gui.find("###assess")->disabled);
  ASSERT_NO_FATAL_FAILURE(scan());
  EXPECT_FALSE(gui.find("###assess")->disabled);
}

TEST_F(QualityPanel, AssessesAndGoesToTheWorstPlaceOfARow) {
  ASSERT_NO_FATAL_FAILURE(scan());
  EXPECT_EQ(gui.find("###save-quality"), nullptr) << "there is nothing to save yet";
  ASSERT_TRUE(gui.click("###assess"));
  gui.settle();
  ASSERT_NE(answer(), nullptr);
  EXPECT_GT(answer()->good, 0U);
  gui.frames(2);
  ASSERT_GT(answer()->bad + answer()->warn, 0U);
  const auto texts = gui.texts();
  const auto word = std::find(texts.begin(), texts.end(), answer()->bad > 0 ? "Bad" : "Check");
  const auto counts = std::find_if(
      texts.begin(), texts.end(), [&](const auto& t) { return t.find("LOA30") != t.npos && t.find("good") != t.npos; });
  ASSERT_NE(counts, texts.end());
  EXPECT_LT(word, counts) << "a plain word leads";
  EXPECT_NE(gui.find("###save-quality"), nullptr);
  const auto before = editor.view.camera;
  ASSERT_TRUE(gui.click("###go"));  // of the first row that has a place
  gui.frames(2);
  const auto first = worstRow(answer()->rows);
  ASSERT_TRUE(first);
  EXPECT_EQ(editor.panels.of<QualityState>().shown_row, first);
  const auto& worst = *answer()->rows[*first].worst;
  const Eigen::Vector3d at = *worst.at - editor.shift_m();
  EXPECT_LT((editor.view.camera.target - at).norm(), 0.01);
  EXPECT_GT((editor.view.camera.target - before.target).norm(), 0.1);
}

TEST_F(QualityPanel, MarksTheWorstPlaceAndShowsItInSpaceEvenFromAPlan) {
  look(editor.view.camera, StandardView::top);
  editor.view.camera.orthographic = true;
  editor.visibility.cut_height_m = 1.2;
  editor.select(0, true);
  const Eigen::Vector3d place(3, 2, 2.4);
  showWorstPlace(editor, {place, "Incidence 87°"});
  gui.frames(2);
  EXPECT_FALSE(looksStraightDown(editor.view.camera));
  EXPECT_FALSE(editor.view.camera.orthographic);
  EXPECT_GT(editor.visibility.cut_height_m.value_or(100), place.z()) << "a lower cut would hide the place";
  EXPECT_LT((editor.view.camera.target - place).norm(), 0.01);
  EXPECT_TRUE(gui.says("Incidence 87°"));
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_FALSE(gui.says("Incidence 87°")) << "Esc takes the mark away";
}

TEST_F(QualityPanel, ForgetsAWorstPlaceWithTheScansThatItIsOf) {
  ASSERT_NO_FATAL_FAILURE(scan());
  showWorstPlace(editor, {Eigen::Vector3d(3, 2, 2.4), "Incidence 87°"});
  gui.frames(2);
  ASSERT_TRUE(editor.view.worst_place);
  while (!inspectedClouds(editor.session.document()).empty()) {
    gui.key('Z', true);
    gui.settle();
  }
  EXPECT_FALSE(editor.view.worst_place);
}

TEST_F(QualityPanel, ShowsTheWorstPlaceWithTheRoomAroundIt) {
  const auto& rooms = editor.room_labels.of(editor.session.document().imported);
  ASSERT_FALSE(rooms.empty());
  const double half = std::sqrt(rooms.front().floor_area_m2) / 2;
  ASSERT_GT(half, 1.6);
  showWorstPlace(editor, {rooms.front().anchor, "Here"});
  gui.frames(2);
  const auto& camera = editor.view.camera;
  EXPECT_LT((camera.target - rooms.front().anchor).norm(), 0.01);
  EXPECT_TRUE(editor.picker.sees(camera.eye(), rooms.front().anchor, editor.viewState()));
  if (!(camera.view_angle_rad < 1)) return;  // from within, as far as its walls allow
  EXPECT_GT(camera.heightAtTarget_m(), 2 * half);
}

TEST_F(QualityPanel, IsOpenedByTheGuideAtItsWorstRowAndFliesThere) {
  ASSERT_NO_FATAL_FAILURE(scan());
  ASSERT_TRUE(gui.click("###assess"));
  gui.settle();
  ASSERT_NE(answer(), nullptr);
  const auto row = worstRow(answer()->rows);
  ASSERT_TRUE(row) << "S1 alone cannot see all of the house";
  editor.workspace = Workspace::environment;
  editor.view.worst_place.reset();
  gui.frames(3);
  const auto& step = editor.guide.of(editor)[static_cast<std::size_t>(Workspace::inspect)];
  ASSERT_STREQ(step.command, "worst-place");
  invoke(editor, step.command);
  gui.frames(2);
  EXPECT_EQ(editor.panels.of<QualityState>().shown_row, row);
  ASSERT_TRUE(editor.view.worst_place);
  EXPECT_LT((editor.view.worst_place->at - (*answer()->rows[*row].worst->at - editor.shift_m())).norm(), 1e-6);
  EXPECT_TRUE(editor.picker.sees(editor.view.camera.eye(),
                                 editor.view.worst_place->at - 0.05 * editor.view.camera.forward(), editor.viewState()))
      << "no wall hides it";
}

TEST_F(QualityPanel, LooksDownIntoTheRoomOfAWorstPlaceAndBringsTheViewBeforeBack) {
  const auto before = editor.view.camera;
  const auto cut = editor.visibility.cut_height_m;
  const Eigen::Vector3d place(3, 4, 0.02);
  showWorstPlace(editor, {place, "Point spacing 40 mm"});
  gui.frames(2);
  ASSERT_TRUE(editor.visibility.cut_height_m) << "the roof and the upper floor would hide it";
  EXPECT_LT(*editor.visibility.cut_height_m, 2.8);
  EXPECT_GT(editor.view.camera.elevation_rad, 0.7);
  EXPECT_TRUE(editor.picker.sees(editor.view.camera.eye(), place + Eigen::Vector3d(0, 0, 0.02), editor.viewState()));
  ASSERT_TRUE(gui.click("###back-from-place"));
  gui.frames(2);
  EXPECT_EQ(editor.view.camera, before);
  EXPECT_EQ(editor.visibility.cut_height_m, cut);
  EXPECT_FALSE(editor.view.worst_place);
}

TEST_F(QualityPanel, DrawsWhatWasMeasuredAroundAWorstPlaceUntilItIsHidden) {
  ASSERT_NO_FATAL_FAILURE(scan());
  editor.showClouds({folder / "scan.e57"});
  gui.settle();
  ASSERT_TRUE(editor.cloud());
  const Eigen::Vector3d place(3, 4, 0.02);
  showWorstPlace(editor, {place, "Here", {"S1"}});
  EXPECT_FALSE(editor.cloud()) << "the model is what the points are of";
  editor.place_points.wait();
  gui.frames(2);
  ASSERT_TRUE(editor.view.worst_place);
  ASSERT_TRUE(editor.place_points.shown());
  const auto around = editor.viewState().underlays;
  ASSERT_EQ(around.size(), 1U);
  for (const auto& p : around.front().cloud->points) {
    const Eigen::Vector4d at =
        around.front().local_from_cloud * Eigen::Vector4d(p.position_m[0], p.position_m[1], p.position_m[2], 1);
    ASSERT_LT((at.head<3>() - place).norm(), 8) << "not those of the whole building";
  }
  ASSERT_TRUE(gui.click("###view_place-points"));
  gui.frames(2);
  EXPECT_TRUE(editor.viewState().underlays.empty());
  showWorstPlace(editor, {place + Eigen::Vector3d(1, 0, 0), "There"});
  editor.place_points.wait();
  gui.frames(2);
  EXPECT_TRUE(editor.viewState().underlays.empty()) << "whoever hid them does not want them";
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_FALSE(editor.place_points.shown()) << "they go with the mark";
  goBackInViews(editor);
  goBackInViews(editor);
  gui.settle();
  EXPECT_TRUE(editor.cloud()) << "the points that were looked at before";
}

TEST_F(QualityPanel, ListsWhatIsBadFirst) {
  const auto row = [](Verdict verdict) {
    AssessRow r;
    r.verdict = verdict;
    return r;
  };
  const std::vector<AssessRow> rows = {row(Verdict::good), row(Verdict::warn),    row(Verdict::bad),
                                       row(Verdict::good), row(Verdict::unknown), row(Verdict::bad)};
  EXPECT_EQ(worstFirst(rows), (std::vector<std::size_t>{2, 5, 1, 0, 3, 4}));
  ASSERT_NO_FATAL_FAILURE(scan());
  ASSERT_TRUE(gui.click("###assess"));
  gui.settle();
  ASSERT_NE(answer(), nullptr);
  gui.frames(2);
  std::vector<std::string> expected, signs;
  for (const auto k : worstFirst(answer()->rows))
    if (const auto& r = answer()->rows[k]; !r.good_text.empty()) expected.push_back(verdictSign(r.verdict));
  const auto texts = gui.texts();
  const std::vector<std::string> all = {verdictSign(Verdict::bad), verdictSign(Verdict::warn),
                                        verdictSign(Verdict::good), verdictSign(Verdict::unknown)};
  for (auto drawn = std::find(texts.begin(), texts.end(), "Figures"); drawn != texts.end(); ++drawn)
    if (signs.size() < expected.size() && std::find(all.begin(), all.end(), *drawn) != all.end())
      signs.push_back(*drawn);
  EXPECT_EQ(signs, expected);
}

TEST_F(QualityPanel, NamesRoomAndStoreyOfAWorstPlace) {
  const auto& environment = editor.session.document().imported;
  const auto& rooms = editor.room_labels.of(environment);
  ASSERT_FALSE(rooms.empty());
  const auto& room = rooms.front();
  const auto* body = editor.room_labels.roomAt(environment, room.anchor);
  ASSERT_NE(body, nullptr);
  const Eigen::Vector3d floor(room.anchor.x(), room.anchor.y(), body->box.min.z() - 0.05);
  EXPECT_EQ(editor.room_labels.roomAt(environment, floor), body) << "its floor lies below it";
  EXPECT_EQ(editor.room_labels.roomAt(environment, room.anchor + Eigen::Vector3d(0, 0, 100)), nullptr);
  const auto name = readableName(environment->products[room.product]);
  showWorstPlace(editor, {floor, "Incidence 87°"});
  ASSERT_TRUE(editor.view.worst_place);
  EXPECT_TRUE(editor.view.worst_place->where.starts_with(name)) << editor.view.worst_place->where;
  EXPECT_NE(editor.view.worst_place->where.find(" · "), std::string::npos) << "and the storey";
  EXPECT_TRUE(gui.says("Incidence 87°\n" + editor.view.worst_place->where) ||
              gui.says("Incidence 87°   " + editor.view.worst_place->where));
}

TEST_F(QualityPanel, TakesABadRowBeforeOneToCheckAndNoneWithoutAPlace) {
  const AssessPlace place{Eigen::Vector3d(1, 2, 3), {}, {}};
  const auto row = [&](Verdict verdict, bool placed) {
    AssessRow r;
    r.verdict = verdict;
    if (placed) r.worst = place;
    return r;
  };
  EXPECT_EQ(worstRow({row(Verdict::good, true), row(Verdict::warn, true), row(Verdict::bad, true)}), 2U);
  EXPECT_EQ(worstRow({row(Verdict::warn, true), row(Verdict::bad, false)}), 0U);
  EXPECT_EQ(worstRow({row(Verdict::good, true), row(Verdict::unknown, true)}), std::nullopt);
}

// It takes minutes; what changes nothing that it judges leaves it as it is.
TEST_F(QualityPanel, IsNotOutOfDateAfterAMeasurementOrABookmark) {
  ASSERT_NO_FATAL_FAILURE(scan());
  ASSERT_TRUE(gui.click("###assess"));
  gui.settle();
  const auto& session = editor.session;
  ASSERT_NE(session.lastOf("assess"), nullptr);
  ASSERT_TRUE(editor.session.start("bookmark", {{"add", "here"}}));
  gui.settle();
  EXPECT_FALSE(session.isOutOfDate(*session.lastOf("assess")));
  ASSERT_TRUE(editor.session.start("station", {{"rename", "S1"}, {"name", "K1"}}));
  gui.settle();
  EXPECT_TRUE(session.isOutOfDate(*session.lastOf("assess")));
}

}  // namespace
}  // namespace standpoint
