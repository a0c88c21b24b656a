// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "project/model/bookmarks.h"
#include "project/storage/project_files.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

Document with(const Document& document, const json& options) {
  auto outcome = run("bookmark", document, options);
  EXPECT_TRUE(outcome) << describe(outcome.error());
  return outcome ? outcome->document : document;
}

TEST(Bookmark, LooksFromWhereItWasSetAndLastsInTheProject) {
  const TemporaryFolder folder;
  const auto whole = twoStoreyDocument();
  const Eigen::Vector3d shift = whole.georeference->shift_m;
  const auto marked = with(whole, {{"add", "Stair"},
                                   {"at", {shift.x() + 1, shift.y() + 2, shift.z() + 1.6}},
                                   {"azimuth-deg", 90},
                                   {"elevation-deg", -10},
                                   {"cut", shift.z() + 4},
                                   {"on-foot", true}});
  ASSERT_TRUE(marked.bookmarks);
  const auto& b = marked.bookmarks->front();
  EXPECT_NEAR((b.eye - Eigen::Vector3d(1, 2, 1.6)).norm(), 0, 1e-6);
  EXPECT_NEAR(b.forward().x(), std::cos(10 * kRadPerDeg), 1e-9) << "to the east";
  EXPECT_NEAR(b.forward().z(), -std::sin(10 * kRadPerDeg), 1e-9);
  Progress progress;
  ASSERT_TRUE(saveProject(marked, folder.path() / "p", progress));
  const auto back = loadProject(folder.path() / "p", progress);
  ASSERT_TRUE(back);
  ASSERT_TRUE(back->bookmarks);
  EXPECT_EQ(bookmarksToJson(*back->bookmarks), bookmarksToJson(*marked.bookmarks));
  const auto listed = run("bookmark", *back, json::object());
  EXPECT_NEAR(listed->answer.at("bookmarks").at(0).at("at").at(0).get<double>(), shift.x() + 1, 1e-6);
  EXPECT_NEAR(listed->answer.at("bookmarks").at(0).at("cut_m").get<double>(), shift.z() + 4, 1e-6);
}

TEST(Bookmark, OfAnOverviewSeesTheWholeModel) {
  const auto whole = twoStoreyDocument();
  const auto b = with(whole, {{"add", "All"}}).bookmarks->front();
  const auto box = bounds(*whole.imported);
  for (const Eigen::Vector3d& p : {box.min, box.max})
    EXPECT_GT((p - b.eye).normalized().dot(b.forward()), std::cos(b.view_angle_rad / 2) - 1e-9);
}

TEST(Bookmark, IsMovedRenamedAndRemovedByItsName) {
  const auto one = with(twoStoreyDocument(), {{"add", "A"}});
  const auto moved = with(one, {{"add", "A"}, {"at", {0, 0, 0}}});
  EXPECT_EQ(moved.bookmarks->size(), 1U);
  const auto renamed = with(moved, {{"rename", "A"}, {"name", "B"}});
  EXPECT_EQ(renamed.bookmarks->front().name, "B");
  EXPECT_FALSE(with(renamed, {{"remove", "B"}}).bookmarks);
  const auto two = with(renamed, {{"add", "C"}});
  const auto same = run("bookmark", two, {{"rename", "C"}, {"name", "B"}});
  ASSERT_FALSE(same);
  EXPECT_THAT(describe(same.error()), HasSubstr("already exists"));
  const auto unknown = run("bookmark", two, {{"remove", "D"}});
  ASSERT_FALSE(unknown);
  EXPECT_THAT(describe(unknown.error()), HasSubstr("available: B, C"));
  EXPECT_FALSE(run("bookmark", two, {{"remove", "B"}, {"add", "E"}}));
}

}  // namespace
}  // namespace standpoint
