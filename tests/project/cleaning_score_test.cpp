// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include <gmock/gmock.h>

#include "pointclouds/formats.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

std::string pageIn(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// A wall of 2000 points, the first 200 of them somebody before it, every tenth of the rest mixed by 2 cm.
class CleaningScore : public ::testing::Test {
 protected:
  void SetUp() override {
    ScanHeader h;
    h.name = "S1";
    h.guid = "{00000000-0000-4000-8000-000000000002}";
    h.rows = 20, h.columns = 100;
    h.has_labels = h.has_truth = true;
    h.products = {{"#1", "", "IfcWall", "wall"}, {"#2", "", "Pedestrian", "Ada"}};
    h.materials = {"brick"};
    PointBlock b;
    for (std::uint32_t i = 0; i < 2000; ++i) {
      const bool is_ada = i < 200, is_mixed = !is_ada && i % 10 == 0;
      const Eigen::Vector3f p(is_ada ? 3.0F : 5.0F, -1 + 0.02F * static_cast<float>(i / 20),
                              0.02F * static_cast<float>(i % 20));
      b.x_m.push_back(p.x()), b.y_m.push_back(p.y()), b.z_m.push_back(p.z()), b.intensity.push_back(0.5F);
      b.row.push_back(i % 20), b.column.push_back(i / 20);
      b.product.push_back(is_ada ? 1 : 0), b.material.push_back(0);
      b.truth.x_m.push_back(p.x()), b.truth.y_m.push_back(p.y()), b.truth.z_m.push_back(p.z());
      b.truth.range_m.push_back(p.norm() + (is_mixed ? 0.02F : 0.0F));
      b.truth.incidence_rad.push_back(0), b.truth.received_db.push_back(-20);
      b.truth.flags.push_back(is_ada ? point_flag::kMoving : is_mixed ? point_flag::kMixed : std::uint8_t{0});
    }
    auto writer = *cloudFormatFor(truth())->writer(truth());
    ASSERT_TRUE(writer->begin(h) && writer->write(b) && writer->end() && writer->close());
  }
  fs::path truth() const { return folder_.path() / "truth.e57"; }
  fs::path in(const char* name) const { return folder_.path() / name; }
  Result<Outcome> score(json options) {
    options["truth"] = truth().string();
    if (!options.contains("cleaning")) options["cleaning"] = true;
    return run("score", Document(), options);
  }
  TemporaryFolder folder_;
};

// What `clean` counts by the number of a point in the file, `score` finds by its place in another file.
TEST_F(CleaningScore, FindsByPlaceWhatCleanCountedByNumber) {
  for (const char* name : {"out.e57", "out.ply", "out.xyz", "out.las"}) {
    const auto cleaned = run(
        "clean", Document(),
        {{"in", truth().string()}, {"output", in(name).string()}, {"filters", {"range:from=3.05", "share:keep=0.9"}}});
    ASSERT_TRUE(cleaned) << describe(cleaned.error());
    const auto done = score({{"predicted", in(name).string()}});
    ASSERT_TRUE(done) << name << ": " << describe(done.error());
    const json &a = done->answer, &filters = cleaned->answer["filters"];
    const auto removed = [&](const char* flag) {
      return filters[0]["truth"][flag]["removed"].get<int>() + filters[1]["truth"][flag]["removed"].get<int>();
    };
    EXPECT_EQ(a["points"], 2000) << name;
    EXPECT_EQ(a["cleaned_points"], cleaned->answer["points_out"]);
    EXPECT_EQ(a["removed"].get<int>(), 2000 - cleaned->answer["points_out"].get<int>());
    for (const char* flag : {"moving", "mixed"}) EXPECT_EQ(a["causes"][flag]["removed"], removed(flag)) << name << flag;
    EXPECT_EQ(a["good"]["removed"].get<int>(),
              filters[0]["good"]["removed"].get<int>() + filters[1]["good"]["removed"].get<int>());
    EXPECT_EQ(a["movers"][0]["name"], "Ada");
    EXPECT_EQ(a["movers"][0]["points"]["removed"], removed("moving"));
    EXPECT_EQ(a["unknown"], 0);
  }
}

TEST_F(CleaningScore, IsAPageWithPicturesOfWhatWasLeftAndLost) {
  ASSERT_TRUE(run("clean", Document(),
                  {{"in", truth().string()}, {"output", in("o.e57").string()}, {"filters", {"share:keep=0.7"}}}));
  const auto done = score({{"predicted", in("o.e57").string()}, {"output", in("page.html").string()}});
  ASSERT_TRUE(done) << describe(done.error());
  const auto page = pageIn(in("page.html"));
  EXPECT_THAT(page, AllOf(HasSubstr("Where most is left that should go"), HasSubstr("Where most good points were lost"),
                          HasSubstr("Ada"), HasSubstr("IfcWall"), HasSubstr("data:image/png;base64,")));
  ASSERT_TRUE(score({{"predicted", in("o.e57").string()}, {"output", in("figures.csv").string()}}));
  EXPECT_THAT(pageIn(in("figures.csv")), HasSubstr("mover,\"Ada\",200,"));
  const auto same = score({{"predicted", truth().string()}});
  ASSERT_TRUE(same);
  EXPECT_EQ(same->answer["removed"], 0);
  EXPECT_EQ(same->answer["flawed"]["recall"], 0);
  EXPECT_EQ(same->answer["flawed"]["precision"], nullptr);
}

TEST_F(CleaningScore, TellsPointsThatTheTruthHasNot) {
  std::ofstream(in("more.xyz")) << "5 0.5 0.1\n5 0.52 0.1\n5 0.54 0.1\n5 0.54 0.1\n9 9 9\n";
  const auto done = score({{"predicted", in("more.xyz").string()}});
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_EQ(done->answer["unknown"], 1);
  EXPECT_EQ(done->answer["doubled"], 1);
  EXPECT_EQ(done->answer["removed"], 1997);
  ASSERT_EQ(done->report.issues.size(), 2U);
}

TEST_F(CleaningScore, RefusesWhatDoesNotGoTogether) {
  const auto refused = [&](const json& options, const char* why) {
    const auto done = score(options);
    ASSERT_FALSE(done) << options;
    EXPECT_THAT(describe(done.error()), HasSubstr(why));
  };
  const auto self = truth().string();
  refused({{"predicted", self}, {"classes", "s3dis"}}, "--classes");
  refused({{"predicted", self}, {"split", "test"}}, "--split");
  refused({{"predicted", self}, {"cleaning", false}, {"tolerance", 0.001}}, "add --cleaning");
  refused({{"predicted", self}, {"cleaning", false}, {"shift", {1, 2, 3}}}, "add --cleaning");
  refused({{"predicted", in("none.e57").string()}}, "file not found");
  std::ofstream(in("truth.xyz")) << "5 0.5 0.1\n";
  const auto plain =
      run("score", Document(), {{"truth", in("truth.xyz").string()}, {"predicted", self}, {"cleaning", true}});
  ASSERT_FALSE(plain);
}

}  // namespace
}  // namespace standpoint
