// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/sha256.h"
#include "pointclouds/datasets/label_array.h"
#include "project/dataset/manifest.h"
#include "project/dataset/recipe.h"
#include "project/dataset/set_scans.h"
#include "project/storage/project_files.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using testing::HasSubstr;
namespace fs = std::filesystem;

// A folder with a project and a recipe on it.
class Dataset : public testing::Test {
 protected:
  void SetUp() override {
    Progress progress;
    ASSERT_TRUE(saveProject(twoStoreyDocument(), folder / "house", progress));
    ASSERT_TRUE(saveProject(twoStoreyDocument(), folder / "tower", progress));
  }
  json recipe() const {
    return {{"format", "standpoint-dataset"},
            {"recipe_version", 1},
            {"name", "demo"},
            {"license", "https://spdx.org/licenses/CC-BY-4.0.html"},
            {"creator", "somebody"},
            {"date", "2026-01-31"},
            {"environments", {{{"id", "house"}, {"project", "house"}}, {{"id", "tower"}, {"project", "tower"}}}},
            {"stations", {{{"strategy", "grid"}, {"spacing_m", 2}, {"count", 2}}}},
            {"instruments",
             {{{"id", "focus"},
               {"instrument", "faro-focus-s350"},
               {"set", {"resolution=1/32", "quality=4x", "horizontal_to=90"}}}}},
            {"effects", {{{"id", "noisy"}}, {{"id", "ideal"}, {"ideal", true}}}},
            {"splits", {{"train", {"house"}}, {"test", {"tower"}}}},
            {"classes", {"s3dis"}}};
  }
  fs::path write(const json& text) const { return folder.write("recipe.json", text.dump(2)); }
  Result<Outcome> dataset(const char* action, const fs::path& of, json more = json::object()) const {
    more["action"] = action;
    more["of"] = of.string();
    return run("dataset", {}, more);
  }
  std::string sums(const fs::path& set) const {
    std::ifstream in(set / "SHA256SUMS");
    return {std::istreambuf_iterator<char>(in), {}};
  }
  TemporaryFolder folder;
};

TEST_F(Dataset, HasTheSameBytesInOneShardAndInThree) {
  const auto file = write(recipe());
  const auto whole = dataset("run", file, {{"output", (folder / "whole").string()}});
  ASSERT_TRUE(whole) << describe(whole.error());
  EXPECT_EQ(whole->answer["scans"], 8);
  for (const char* shard : {"3/3", "1/3", "2/3"}) {
    const auto part = dataset("run", file, {{"output", (folder / "parts").string()}, {"shard", shard}});
    ASSERT_TRUE(part) << describe(part.error());
  }
  ASSERT_TRUE(dataset("manifest", folder / "parts"));
  EXPECT_GT(sums(folder / "whole").size(), 1000U);
  EXPECT_EQ(sums(folder / "whole"), sums(folder / "parts"));
}

TEST_F(Dataset, GoesOnAfterACancelToTheSameBytes) {
  const auto file = write(recipe());
  ASSERT_TRUE(dataset("run", file, {{"output", (folder / "whole").string()}}));
  json options = {{"action", "run"}, {"of", file.string()}, {"output", (folder / "broken").string()}};
  Progress progress;
  progress.onChange([&] {
    if (progress.stageName().find("tower/grid-2") != std::string::npos) progress.cancel();
  });
  const auto cancelled = runVerb(*findVerb(verbs(), "dataset"), {}, options, progress);
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().kind, ErrorKind::cancelled);
  EXPECT_THAT(cancelled.error().message, HasSubstr("resume the run"));
  const auto unasked = run("dataset", {}, options);
  ASSERT_FALSE(unasked) << "finished scans are not thrown away";
  options["resume"] = true;
  const auto resumed = run("dataset", {}, options);
  ASSERT_TRUE(resumed) << describe(resumed.error());
  EXPECT_GE(resumed->answer["resumed"], 6);
  EXPECT_EQ(sums(folder / "whole"), sums(folder / "broken"));
}

TEST_F(Dataset, IsVerifiedFileByFile) {
  const auto set = folder / "set";
  ASSERT_TRUE(dataset("run", write(recipe()), {{"output", set.string()}}));
  const auto good = dataset("verify", set);
  ASSERT_TRUE(good) << describe(good.error());
  EXPECT_EQ(good->report.losses(), 0U);
  const std::string label = "labels/house/grid-1/focus_clear_assigned_none_1_noisy.s3dis.npy";
  const std::string cloud = "scans/tower/grid-2/focus_clear_assigned_none_1_ideal.e57";
  {
    std::fstream change(set / label, std::ios::in | std::ios::out | std::ios::binary);
    change.seekp(200);
    change.put('\x7F');
  }
  fs::remove(set / cloud);
  const auto bad = dataset("verify", set);
  ASSERT_TRUE(bad);
  EXPECT_EQ(bad->answer["damaged"], json({label}));
  EXPECT_EQ(bad->answer["missing"], json({cloud}));
  EXPECT_EQ(bad->report.losses(), 2U);
  EXPECT_FALSE(dataset("manifest", set)) << "what is not whole is not described";
}

TEST_F(Dataset, HasALabelForEachPointAndCountsThem) {
  const auto set = folder / "set";
  ASSERT_TRUE(dataset("run", write(recipe()), {{"output", set.string()}}));
  Progress progress;
  const auto labels =
      readPointLabels(set / "labels/house/grid-1/focus_clear_assigned_none_1_noisy.s3dis.npy", progress);
  ASSERT_TRUE(labels) << describe(labels.error());
  std::ifstream in(set / "records/house/grid-1/focus_clear_assigned_none_1_noisy.json");
  const auto record = json::parse(in);
  EXPECT_EQ(labels->ids.size(), record["points"]);
  EXPECT_GT(record["classes"]["s3dis"]["wall"], 1000);
  EXPECT_EQ(std::count(labels->ids.begin(), labels->ids.end(), 2U), record["classes"]["s3dis"]["wall"]);
}

TEST_F(Dataset, IsForecastByItsRecipe) {
  const auto file = write(recipe());
  const auto forecast = dataset("check", file);
  ASSERT_TRUE(forecast) << describe(forecast.error());
  const auto made = dataset("run", file, {{"output", (folder / "set").string()}});
  ASSERT_TRUE(made);
  EXPECT_EQ(forecast->answer["scans"], made->answer["scans"]);
  EXPECT_NEAR(forecast->answer["points"].get<double>() / made->answer["points"].get<double>(), 1, 0.05);
  bool sofa = false;
  for (const auto& c : forecast->answer["classes"]) sofa |= c["class"] == "sofa" && c["starved"] == true;
  EXPECT_TRUE(sofa) << "a class without points is starved";
}

TEST_F(Dataset, RefusesWhatIsWrongWithARecipeByItsPlace) {
  const std::pair<const char*, std::function<void(json&)>> wrongs[] = {
      {"/instrumens", [](json& r) { r["instrumens"] = 1; }},
      {"/environments/0/project", [](json& r) { r["environments"][0]["project"] = "nowhere"; }},
      {"/instruments/0/instrument", [](json& r) { r["instruments"][0]["instrument"] = "nobody"; }},
      {"/instruments/0/set", [](json& r) { r["instruments"][0]["set"] = {"resolution=7"}; }},
      {"/splits", [](json& r) { r["splits"].erase("test"); }},
      {"/splits/test",
       [](json& r) {
         r["splits"]["test"] = {"house", "tower"};
       }},
      {"/classes/0", [](json& r) { r["classes"] = {"s4dis"}; }},
      {"/environments/1/id", [](json& r) { r["environments"][1]["id"] = "house"; }},
      {"/effects/1/without", [](json& r) { r["effects"][1]["without"] = "striping"; }},
      {"/stations/0/spacing_m", [](json& r) { r["stations"][0]["spacing_m"] = 0; }},
      {"/environments/0/id", [](json& r) { r["environments"][0]["id"] = "../house"; }}};
  for (const auto& [place, spoil] : wrongs) {
    auto text = recipe();
    spoil(text);
    const auto read = readRecipe(write(text));
    ASSERT_FALSE(read) << place;
    EXPECT_EQ(read.error().source, std::string("recipe.json ") + place) << read.error().message;
  }
}

TEST_F(Dataset, RefusesClassesThatMapNothingAndShardsOutOfRange) {
  auto text = recipe();
  folder.write("own.json",
               R"({"name": "own", "classes": {"a": 0}, "unknown": "a", "noise": "a", "ifc": {"IfcBridge": "a"}})");
  text["classes"] = {"own.json"};
  const auto none = dataset("run", write(text), {{"output", (folder / "set").string()}});
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message, HasSubstr("map nothing"));
  EXPECT_FALSE(dataset("run", write(recipe()), {{"output", (folder / "x").string()}, {"shard", "4/3"}}));
}

TEST_F(Dataset, SplitsPlacesIntoShardsThatFollowEachOther) {
  const auto read = readRecipe(write(recipe()));
  ASSERT_TRUE(read) << describe(read.error());
  for (const unsigned count : {1U, 2U, 3U, 4U, 7U}) {
    std::vector<std::string> together;
    for (unsigned i = 1; i <= count; ++i)
      for (const auto& place : placesOf(*read, {i, count}))
        together.push_back(std::to_string(place.environment) + place.station);
    EXPECT_EQ(together, (std::vector<std::string>{"0grid-1", "0grid-2", "1grid-1", "1grid-2"})) << count;
  }
}

}  // namespace
}  // namespace standpoint
