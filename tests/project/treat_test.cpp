// SPDX-License-Identifier: GPL-3.0-or-later
// What the author says of single products: left out of the scene, kept, or held to limits of their own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "project/storage/project_files.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

Outcome treated(const Document& document, const json& options) {
  auto outcome = run("treat", document, options);
  EXPECT_TRUE(outcome) << describe(outcome.error());
  return outcome ? *outcome : Outcome{document, {}, {}, {}};
}

Document without(const Document& document, const std::string& selector) {
  return treated(document, {{"products", {selector}}, {"as", "excluded"}}).document;
}

std::uint32_t tableProduct(const Document& d) { return static_cast<std::uint32_t>(d.imported->products.size()) - 1; }

TEST(Treat, WhatIsExcludedIsNeitherCountedNorWalkedOnNorExported) {
  const TemporaryFolder folder;
  const auto whole = twoStoreyDocument();
  const auto bare = without(whole, "class:IfcFurniture");
  EXPECT_TRUE(bare.imported->products.back().excluded);
  const auto before = run("optimize", whole, {{"budget", 1000}}), after = run("optimize", bare, {{"budget", 1000}});
  EXPECT_EQ(before->answer.at("triangles_before").get<int>() - after->answer.at("triangles_before").get<int>(), 12);
  const auto solid = run("collide", whole, json::object()), open = run("collide", bare, json::object());
  EXPECT_EQ(solid->document.collision->products[tableProduct(whole)].shapes, 1U);
  EXPECT_EQ(open->document.collision->products[tableProduct(whole)].shapes, 0U);
  // The table is 1 m × 1 m in the corner region of a room: without it, at least that much more floor can be walked on.
  EXPECT_GT(open->document.collision->walkable_area_m2, solid->document.collision->walkable_area_m2 + 1.0);
  const auto file = (folder.path() / "bare.obj").string();
  const auto exported = run("export", bare, {{"output", file}});
  EXPECT_EQ(exported->answer.at("triangles"), 11 * 12);
  EXPECT_EQ(exported->answer.at("bytes"),
            std::filesystem::file_size(file) + std::filesystem::file_size(folder.path() / "bare.mtl"));
}

TEST(Treat, NoBeamMeetsWhatIsExcluded) {
  const auto whole = twoStoreyDocument();
  const json on_floor = {{"add", "S1"}, {"on", {500004.5, 5600003.0}}};
  const auto blocked = run("station", whole, on_floor), free = run("station", without(whole, "table"), on_floor);
  ASSERT_TRUE(free) << describe(free.error());
  // Where the table stands, the lowest floor with room above it is its top, and without it the slab.
  const double low = free->document.job->stations[0].true_pose.translation.z();
  EXPECT_NEAR(low, 1.6, 1e-3);
  EXPECT_TRUE(!blocked || blocked->document.job->stations[0].true_pose.translation.z() > low + 0.5);
}

TEST(Treat, TakingItBackBringsEverythingBackAndEmptiesTheList) {
  const auto whole = twoStoreyDocument();
  const auto bare = without(without(whole, "class:IfcFurniture"), "class:IfcWall");
  EXPECT_EQ(treated(bare, json::object()).answer.at("excluded_products"), 9);
  const auto back = treated(bare, {{"products", {"class:IfcWall", "class:IfcFurniture"}}, {"as", "rules"}});
  EXPECT_EQ(back.answer.at("excluded_products"), 0);
  EXPECT_TRUE(back.answer.at("treatments").empty());
  const auto one_back = treated(bare, {{"products", {"south0"}}, {"as", "rules"}});
  EXPECT_EQ(one_back.answer.at("excluded_products"), 8);
}

TEST(Treat, ALaterWordReplacesTheOneBefore) {
  const auto bare = without(twoStoreyDocument(), "class:IfcFurniture");
  const auto again = treated(bare, {{"products", {"class:IfcFurniture"}}, {"as", "kept"}});
  ASSERT_EQ(again.answer.at("treatments").size(), 1U);
  EXPECT_EQ(again.answer.at("treatments")[0].at("as"), "kept");
  EXPECT_EQ(again.answer.at("excluded_products"), 0);
}

TEST(Treat, WhatIsKeptStaysWhereTheBudgetTakesEverythingElse) {
  const json tiny = {{"budget", 13}, {"max-deviation", 100}};
  const auto whole = twoStoreyDocument();
  const auto kept = treated(whole, {{"products", {"class:IfcFurniture"}}, {"as", "kept"}});
  const auto lost = run("optimize", whole, tiny), stays = run("optimize", kept.document, tiny);
  EXPECT_LT(lost->document.simplified->products[tableProduct(whole)].triangles_after, 12U);
  EXPECT_EQ(stays->document.simplified->products[tableProduct(whole)].triangles_after, 12U);
  EXPECT_NEAR(stays->document.simplified->products[tableProduct(whole)].max_deviation_m, 0, 1e-9);
}

TEST(Treat, OwnLimitsHoldWhereTheOthersMayMoveFurther) {
  const auto whole = twoStoreyDocument();
  const auto limited =
      treated(whole, {{"products", {"class:IfcFurniture"}}, {"as", "simplified"}, {"max-deviation", 0.001}});
  const auto light = run("optimize", limited.document, {{"budget", 1}, {"max-deviation", 100}});
  EXPECT_LE(light->document.simplified->products[tableProduct(whole)].max_deviation_m, 0.001);
  EXPECT_FALSE(light->answer.at("budget_reached").get<bool>());
  EXPECT_EQ(light->answer.at("smallest_budget"), 12);
}

TEST(Treat, SurvivesTheProjectsFolder) {
  const TemporaryFolder folder;
  auto document = without(twoStoreyDocument(), "class:IfcFurniture");
  document = run("optimize", document, {{"budget", 100}, {"max-deviation", 0.01}})->document;
  Progress progress;
  ASSERT_TRUE(saveProject(document, folder.path() / "p", progress));
  const auto loaded = loadProject(folder.path() / "p", progress);
  ASSERT_TRUE(loaded) << describe(loaded.error());
  EXPECT_TRUE(loaded->imported->products.back().excluded);
  EXPECT_TRUE(loaded->simplified->environment->products.back().excluded);
  EXPECT_EQ(treated(*loaded, json::object()).answer, treated(document, json::object()).answer);
  EXPECT_EQ(loaded->simplified->request.budget, 100U);
}

TEST(Treat, SaysWhatIsWrong) {
  const auto whole = twoStoreyDocument();
  const auto nobody = run("treat", whole, {{"products", {"class:IfcPiano"}}, {"as", "kept"}});
  ASSERT_FALSE(nobody);
  EXPECT_THAT(describe(nobody.error()), HasSubstr("class:IfcPiano"));
  EXPECT_FALSE(run("treat", whole, {{"products", {"table"}}}));
  EXPECT_FALSE(run("treat", whole, {{"as", "kept"}}));
  EXPECT_FALSE(run("treat", whole, {{"products", {"table"}}, {"as", "kept"}, {"weight", 2}}));
  EXPECT_FALSE(run("treat", whole, {{"products", {"table"}}, {"as", "melted"}}));
}

}  // namespace
}  // namespace standpoint
