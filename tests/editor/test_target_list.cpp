// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/model/target_list.h"
#include "item_probe.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

class Targets : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    editor.workspace = Workspace::survey;
    editor.wanted_tab[2] = "targets";
    gui.frames(3);
    editor.target_list.wait();
    gui.frames(2);
  }
  const TargetRow* row(const char* target, const char* station) {
    rows = editor.target_list.rows();
    const auto& job = *editor.session.document().job;
    for (const auto& r : rows)
      if (job.targets[r.target].name == target && job.stations[r.station].name == station) return &r;
    return nullptr;
  }
  std::vector<TargetRow> rows;
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(Targets, AreListedForEachStationWithWhatIsToBeExpected) {
  ASSERT_NE(row("T1", "S1"), nullptr);
  const auto near = *row("T1", "S1");
  EXPECT_NEAR(near.sight.distance_m, (Eigen::Vector3d(1, 1, 1.2) - Eigen::Vector3d(3.2, 2, 1.6)).norm(), 1e-9);
  EXPECT_GT(near.sight.points.value_or(0), 1000);
  EXPECT_EQ(near.sight.why_not, "");
  EXPECT_FALSE(near.scanned);
  ASSERT_NE(row("T1", "S2"), nullptr);
  EXPECT_NE(row("T1", "S2")->sight.why_not.find("Partition"), std::string::npos) << row("T1", "S2")->sight.why_not;
}

TEST_F(Targets, AreChosenByAClick) {
  ASSERT_TRUE(gui.click("###target-row"));
  EXPECT_EQ(editor.survey.target, 0);
}

TEST_F(Targets, AreMeasuredOnceTheirScanIsThere) {
  const TemporaryFolder folder;
  ASSERT_TRUE(editor.session.start("scan", {{"instrument", "faro-focus-s350"},
                                            {"set", {"resolution=1/16", "quality=4x"}},
                                            {"stations", "S1"},
                                            {"output", (folder / "S1.e57").string()}}));
  gui.settle();
  ASSERT_TRUE(editor.session.errors().empty()) << describe(editor.session.errors().front().error);
  // The demo's S2 claims a scan whose file is nowhere.
  editor.target_list.wait();
  gui.frames(2);
  EXPECT_NE(editor.target_list.problem().find("S2.e57"), std::string::npos) << "what could not be read is said";
  Document document = editor.session.document();
  Job job = *document.job;
  job.stations[1].scans.clear();
  document.job = std::make_shared<const Job>(job);
  ASSERT_TRUE(editor.session.adopt({document, {}, {}, "without the lost scan"}));
  gui.frames(2);
  editor.target_list.wait();
  gui.frames(2);
  EXPECT_EQ(editor.target_list.problem(), "");
  const auto measured = *row("T1", "S1");
  ASSERT_TRUE(measured.fit) << measured.why_not;
  const auto& station = editor.session.document().job->stations[0];
  EXPECT_LT((station.true_pose * measured.fit->centre - Eigen::Vector3d(1, 1, 1.2)).norm(), 0.003);
  EXPECT_GT(measured.fit->points, 100U);
  EXPECT_GT(measured.fit->residual_m, 0);
}

}  // namespace
}  // namespace standpoint
