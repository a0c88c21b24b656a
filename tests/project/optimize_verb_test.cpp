// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "project/storage/project_files.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

// The house of two rooms with two equal round tables: one in a room, one outside, far above every floor.
Document furnished() {
  auto document = twoStoreyDocument();
  auto e = std::make_shared<Environment>(*document.imported);
  auto ball = std::make_shared<Mesh>();
  constexpr int kRings = 12, kSegments = 24;
  for (int i = 0; i <= kRings; ++i)
    for (int k = 0; k < kSegments; ++k) {
      const double a = M_PI * i / kRings, b = 2 * M_PI * k / kSegments;
      ball->positions.emplace_back(static_cast<float>(0.4 * std::sin(a) * std::cos(b)),
                                   static_cast<float>(0.4 * std::sin(a) * std::sin(b)),
                                   static_cast<float>(0.4 * std::cos(a)));
    }
  for (std::uint32_t i = 0; i < kRings; ++i)
    for (std::uint32_t k = 0; k < kSegments; ++k) {
      const std::uint32_t next = (k + 1) % kSegments, row = i * kSegments, below = row + kSegments;
      ball->triangles.push_back({row + k, below + k, below + next});
      ball->triangles.push_back({row + k, below + next, row + next});
    }
  ball->surface_of_triangle.assign(ball->triangles.size(), 0);
  auto other = std::make_shared<Mesh>(*ball);
  for (auto& p : other->positions) p.z() *= 1.001F;  // not to be found as the same
  for (const auto& [id, mesh, at] :
       {std::tuple{"seen", ball, Eigen::Vector3d(1.5, 2, 1)}, std::tuple{"unseen", other, Eigen::Vector3d(3, 2, 50)}}) {
    e->instances.push_back({static_cast<std::uint32_t>(e->meshes.size()),
                            static_cast<std::uint32_t>(e->products.size()), Eigen::Affine3d(Eigen::Translation3d(at))});
    e->products.emplace_back().id = id;
    e->meshes.push_back(mesh);
  }
  document.imported = e;
  return document;
}

TEST(OptimizeVerb, SaysWhichEngineMadeEachProduct) {
  const json options = {{"budget", 600}, {"max-deviation", 1}, {"engine", "cgal-lt"}};
  const auto outcome = run("optimize", furnished(), options);
  ASSERT_TRUE(outcome) << describe(outcome.error());
  int made = 0;
  for (const auto& row : outcome->answer.at("products")) made += row.value("engine", "") == "cgal-lt" ? 1 : 0;
  EXPECT_GE(made, 2);
  EXPECT_EQ(outcome->document.simplified->request.engine, "cgal-lt");
  EXPECT_TRUE(std::any_of(outcome->report.issues.begin(), outcome->report.issues.end(), [](const Issue& issue) {
    return issue.source == "engine" && issue.message.find("CGAL, Lindstrom and Turk") == 0;
  }));
  auto unknown = options;
  unknown["engine"] = "magic";
  EXPECT_FALSE(run("optimize", furnished(), unknown));
}

TEST(OptimizeVerb, GivesMoreToWhatWalkersSee) {
  auto document = furnished();
  document = run("collide", document, json::object())->document;
  const json options = {{"budget", 400}, {"max-deviation", 1}};
  json by_view = options;
  by_view["by-view"] = true;
  const auto alike = run("optimize", document, options), seen = run("optimize", document, by_view);
  ASSERT_TRUE(seen) << describe(seen.error());
  const auto& even = alike->document.simplified->products;
  const auto& weighed = seen->document.simplified->products;
  const auto n = weighed.size();
  EXPECT_NEAR(static_cast<double>(even[n - 2].triangles_after), static_cast<double>(even[n - 1].triangles_after), 30);
  EXPECT_GT(weighed[n - 2].triangles_after, 2 * weighed[n - 1].triangles_after);
  EXPECT_LE(seen->answer.at("triangles_after").get<int>(), 400);
  const TemporaryFolder folder;
  Progress progress;
  ASSERT_TRUE(saveProject(seen->document, folder.path() / "p", progress));
  const auto loaded = loadProject(folder.path() / "p", progress);
  EXPECT_TRUE(loaded->simplified->request.by_view);
  EXPECT_GT(seen->answer.at("mean_turn_deg").get<double>(), 0.1);  // a ball of fewer corners has other normals
  EXPECT_EQ(loaded->simplified->all.mean_turn_rad, seen->document.simplified->all.mean_turn_rad);
}

TEST(OptimizeVerb, SaysThatWhatWalkersSeeNeedsCollisionShapes) {
  const auto refused = run("optimize", twoStoreyDocument(), {{"budget", 100}, {"by-view", true}});
  ASSERT_FALSE(refused);
  EXPECT_THAT(describe(refused.error()), HasSubstr("walkable surface: compute that first"));
}

}  // namespace
}  // namespace standpoint
