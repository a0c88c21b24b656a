// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>

#include "pointclouds/formats.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

std::string textOfReport(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Ten points on a wall (x = 1 … 10 m): the first four are mixed, the second and the third by more than 1 cm, the last
// is a drop of rain.
class CleanVerb : public ::testing::Test {
 protected:
  void SetUp() override {
    ScanHeader h;
    h.name = "S1";
    h.guid = "{00000000-0000-4000-8000-000000000001}";
    h.rows = 10, h.columns = 1;
    h.has_labels = h.has_truth = true;
    h.products = {{"#1", "", "IfcWall", "a \"wall\""}, {"", "", "Nothing", "no surface"}};
    h.materials = {"brick"};
    PointBlock b;
    for (std::uint32_t i = 0; i < 10; ++i) {
      const float x = static_cast<float>(i) + 1, off = i == 1 || i == 2 ? 0.05F : 0.001F;
      b.x_m.push_back(x), b.y_m.push_back(0), b.z_m.push_back(0), b.intensity.push_back(0.5F);
      b.row.push_back(i), b.column.push_back(0), b.product.push_back(i == 9 ? 1 : 0), b.material.push_back(0);
      b.truth.x_m.push_back(x + off), b.truth.y_m.push_back(0), b.truth.z_m.push_back(0),
          b.truth.range_m.push_back(x + off);
      b.truth.incidence_rad.push_back(0), b.truth.received_db.push_back(-20);
      b.truth.flags.push_back(i < 4 ? point_flag::kMixed : i == 9 ? point_flag::kWeather : std::uint8_t{0});
    }
    auto writer = *cloudFormatFor(in())->writer(in());
    ASSERT_TRUE(writer->begin(h) && writer->write(b) && writer->end() && writer->close());
  }
  fs::path in() const { return folder_.path() / "in.e57"; }
  Result<Outcome> clean(json options) {
    options["in"] = in().string();
    if (!options.contains("output")) options["output"] = (folder_.path() / "out.e57").string();
    return run("clean", Document(), options);
  }
  TemporaryFolder folder_;
};

// From 3 m to 8 m stay: of four mixed points two go (1 and 2 m), of them one by over 1 cm; of five good ones one (9 m);
// the drop.
const json kGate = {"range:from=2.5,to=8.5"};

TEST_F(CleanVerb, AnswersWhatEachFilterTookOfTheTruth) {
  const auto done = clean({{"filters", kGate}});
  ASSERT_TRUE(done) << describe(done.error());
  const json& a = done->answer;
  EXPECT_EQ(a.at("points_in"), 10);
  EXPECT_EQ(a.at("points_out"), 6);
  ASSERT_EQ(a.at("filters").size(), 1U);
  const json& row = a["filters"][0];
  EXPECT_EQ(row.at("in"), 10);
  EXPECT_EQ(row.at("removed"), 4);
  EXPECT_EQ(row.at("out"), 6);
  EXPECT_EQ(row.at("truth").at("mixed"), (json{{"in", 4}, {"removed", 2}, {"recall", 0.5}, {"precision", 0.5}}));
  EXPECT_EQ(row.at("truth").at("weather"), (json{{"in", 1}, {"removed", 1}, {"recall", 1.0}, {"precision", 0.25}}));
  EXPECT_EQ(row.at("truth").at("mirrored").at("recall"), nullptr) << "there was none to find";
  EXPECT_EQ(row.at("mixed_by_over_1cm"), (json{{"in", 2}, {"removed", 1}, {"share", 0.5}}));
  EXPECT_EQ(row.at("good"), (json{{"in", 5}, {"removed", 1}, {"share", 0.2}}));
  EXPECT_EQ(row.at("classes"), (json{{"IfcWall", {{"in", 5}, {"removed", 1}, {"share", 0.2}}}}));
  EXPECT_THAT(done->text, AllOf(HasSubstr("10 points in, 4 removed (40.00 %), 6 out\n"),
                                HasSubstr("2 of 4 found (50.00 %), 50.00 % of all removed points\n"),
                                HasSubstr("1 of 5 lost (20.00 %)\n"), HasSubstr("1 of 5 (20.00 %)\n")));
  EXPECT_EQ(cloudFormatFor(in())->info(folder_.path() / "out.e57")->scans[0].points, 6U);
}

TEST_F(CleanVerb, WritesTheSameFiguresAsJsonAndAsCsv) {
  const fs::path as_json = folder_.path() / "r.json", as_csv = folder_.path() / "r.csv";
  const auto done = clean({{"filters", kGate}, {"report", as_json.string()}});
  ASSERT_TRUE(done) << describe(done.error());
  json read = json::parse(textOfReport(as_json));
  json answer = done->answer;
  answer.erase("files");
  EXPECT_EQ(read, answer);
  ASSERT_TRUE(clean({{"filters", kGate}, {"report", as_csv.string()}}));
  std::istringstream lines(textOfReport(as_csv));
  std::string line;
  std::vector<std::string> all;
  while (std::getline(lines, line)) all.push_back(line);
  ASSERT_GE(all.size(), 5U);
  EXPECT_EQ(all[0], "filter,counted,in,removed");
  const auto ends = [&](const char* end) {
    return std::count_if(all.begin(), all.end(), [&](const std::string& l) { return l.ends_with(end); });
  };
  EXPECT_TRUE(all[1].starts_with("\"range")) << all[1] << ": a filter's comma stands in quotes";
  EXPECT_EQ(ends(",\"all\",10,4"), 1);
  EXPECT_EQ(ends(",\"mixed\",4,2"), 1);
  EXPECT_EQ(ends(",\"weather\",1,1"), 1);
  EXPECT_EQ(ends(",\"mixed by over 1 cm\",2,1"), 1);
  EXPECT_EQ(ends(",\"good\",5,1"), 1);
  EXPECT_EQ(ends(",\"good IfcWall\",5,1"), 1);
}

TEST_F(CleanVerb, NamesAFolderThatIsNotThereBeforeItBegins) {
  const auto nowhere = folder_.path() / "nowhere";
  for (const char* option : {"output", "report"}) {
    const auto refused = clean({{"filters", kGate}, {option, (nowhere / "x.csv").string()}});
    ASSERT_FALSE(refused);
    EXPECT_THAT(describe(refused.error()),
                AllOf(HasSubstr(nowhere.string() + " does not exist"), HasSubstr(std::string("--") + option)));
    EXPECT_FALSE(fs::exists(folder_.path() / "out.e57"));
  }
  const auto exported = run("export", twoStoreyDocument(), {{"output", (nowhere / "x.glb").string()}});
  ASSERT_FALSE(exported);
  EXPECT_THAT(describe(exported.error()), HasSubstr("folder " + nowhere.string() + " does not exist: create it"));
}

}  // namespace
}  // namespace standpoint
