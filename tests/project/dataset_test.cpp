// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <functional>
#include <set>
#include <tuple>

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
using testing::Contains;
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

TEST_F(Dataset, IsVerifiedInShardsThatLookAtEachFileOnce) {
  const auto set = folder / "set";
  ASSERT_TRUE(dataset("run", write(recipe()), {{"output", set.string()}}));
  const std::string label = "labels/house/grid-1/focus_clear_assigned_none_1_noisy.s3dis.npy",
                    cloud = "scans/tower/grid-2/focus_clear_assigned_none_1_ideal.e57", card = "card.html";
  {
    std::fstream change(set / label, std::ios::in | std::ios::out | std::ios::binary);
    change.seekp(200);
    change.put('\x7F');
  }
  fs::remove(set / cloud);
  fs::remove(set / card);
  std::ofstream(set / "notes.txt") << "mine";
  const auto whole = dataset("verify", set);
  ASSERT_TRUE(whole) << describe(whole.error());
  for (const unsigned count : {1U, 2U, 3U, 7U}) {
    std::size_t files = 0, scans = 0;
    std::multiset<std::string> missing, damaged, unknown;
    for (unsigned i = 1; i <= count; ++i) {
      const auto part = dataset("verify", set, {{"shard", std::to_string(i) + "/" + std::to_string(count)}});
      ASSERT_TRUE(part) << describe(part.error());
      files += part->answer["files"].get<std::size_t>();
      scans += part->answer["scans"].get<std::size_t>();
      for (const auto& [name, found] :
           {std::pair("missing", &missing), std::pair("damaged", &damaged), std::pair("unknown", &unknown)})
        if (part->answer.contains(name))
          for (const auto& path : part->answer[name]) found->insert(path.get<std::string>());
    }
    EXPECT_EQ(files, whole->answer["files"]) << count;
    EXPECT_EQ(scans, whole->answer["scans"]) << count;
    EXPECT_EQ(missing, (std::multiset<std::string>{card, cloud})) << count;
    EXPECT_EQ(damaged, std::multiset<std::string>{label}) << count;
    EXPECT_EQ(unknown, std::multiset<std::string>{"notes.txt"}) << count;
  }
  const auto last = dataset("verify", set, {{"shard", "4/4"}});
  ASSERT_TRUE(last);
  EXPECT_EQ(last->answer["missing"], json({cloud})) << "of its own scans alone";
  EXPECT_THAT(last->description, HasSubstr("demo (4/4) is not whole: 1 files missing, 0 damaged"));
  const auto refused = dataset("verify", set, {{"shard", "5/4"}});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().source, HasSubstr("shard"));
  const auto elsewhere = dataset("manifest", set, {{"shard", "1/4"}});
  ASSERT_FALSE(elsewhere);
  EXPECT_THAT(describe(elsewhere.error()), HasSubstr("--shard: belongs to `dataset run` and `dataset verify`"));
}

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

// Every file of a set, one after the other.
TEST_F(Dataset, IsFoundDamagedAndIncompleteByTheNameOfEachFile) {
  auto text = recipe();
  text["environments"].erase(1);
  text["splits"] = {{"train", {"house"}}};
  text["stations"][0]["count"] = 1;
  text["effects"].erase(1);
  const auto set = folder / "set";
  ASSERT_TRUE(dataset("run", write(text), {{"output", set.string()}}));
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(set))
    if (entry.is_regular_file()) files.insert(fs::relative(entry.path(), set).generic_string());
  EXPECT_GE(files.size(), 13U);
  files.erase("SHA256SUMS");
  for (const char* needed : {"recipe.json", "classes/s3dis.json"}) {  // what is not read says so itself
    fs::rename(set / needed, folder / "kept");
    const auto without = dataset("verify", set);
    ASSERT_FALSE(without);
    EXPECT_THAT(describe(without.error()), HasSubstr(fs::path(needed).filename().string()));
    fs::rename(folder / "kept", set / needed);
    files.erase(needed);
  }
  for (const auto& file : files) {
    fs::copy_file(set / file, folder / "kept", fs::copy_options::overwrite_existing);
    const auto middle = static_cast<std::streamoff>(fs::file_size(set / file) / 2);
    {
      std::fstream change(set / file, std::ios::in | std::ios::out | std::ios::binary);
      change.seekg(middle);
      const char was = static_cast<char>(change.get());
      change.seekp(middle);
      change.put(static_cast<char>(was ^ 0x10));
    }
    const auto damaged = dataset("verify", set);
    ASSERT_TRUE(damaged) << file;
    EXPECT_THAT(damaged->answer["damaged"].get<std::vector<std::string>>(), Contains(file));
    EXPECT_FALSE(damaged->answer.contains("unknown")) << file;
    fs::remove(set / file);
    const auto missing = dataset("verify", set);
    ASSERT_TRUE(missing) << file;
    EXPECT_EQ(missing->answer["missing"], json({file}));
    fs::rename(folder / "kept", set / file);
  }
  const auto whole = dataset("verify", set);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->report.losses(), 0U);
}

TEST_F(Dataset, KeepsTheWorkOfOtherRunsAndNamesIt) {
  const auto set = folder / "set";
  ASSERT_TRUE(dataset("run", write(recipe()), {{"output", set.string()}}));
  EXPECT_FALSE(fs::exists(set / ".work"));
  const auto work = set / ".work/8_3.1.rack7.4026531836.77";
  fs::create_directories(work);
  std::ofstream(work / "x.e57") << "half";
  std::ofstream(set / "scans/.x.e57.part") << "half";
  const auto verified = dataset("verify", set);
  ASSERT_TRUE(verified);
  EXPECT_EQ(verified->answer["working"], json({".work/8_3.1.rack7.4026531836.77"}));
  EXPECT_EQ(verified->answer["unknown"], json({"scans/.x.e57.part"}));
  ASSERT_TRUE(dataset("manifest", set));
  EXPECT_TRUE(fs::exists(work / "x.e57")) << "a run on another machine goes on";
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

TEST_F(Dataset, HasItsBytesForecastInEachFormat) {
  auto text = recipe();
  text["environments"].erase(1);
  text["splits"] = {{"train", {"house"}}};
  text["stations"][0]["count"] = 1;
  text["effects"].erase(1);
  text["instruments"][0]["set"] = {"resolution=1/32", "quality=4x"};
  for (const auto& [format, as, truth] :
       {std::tuple("e57", "", true), std::tuple("e57", "scaled", false), std::tuple("las", "", true),
        std::tuple("ply", "", true), std::tuple("pcd", "", false), std::tuple("pcd", "points", true),
        std::tuple("ptx", "", true), std::tuple("pts", "", false), std::tuple("xyz", "", false),
        std::tuple("csv", "", true)}) {
    text["output"] = {{"format", format}, {"truth", truth}};
    if (*as != 0) text["output"]["as"] = as;
    const auto file = write(text);
    const auto forecast = dataset("check", file);
    ASSERT_TRUE(forecast) << describe(forecast.error());
    const auto set = folder / (std::string(format) + as);
    const auto made = dataset("run", file, {{"output", set.string()}});
    ASSERT_TRUE(made) << format << as << describe(made.error());
    const double points = forecast->answer["points"].get<double>() / made->answer["points"].get<double>();
    const double bytes = forecast->answer["bytes"].get<double>() / made->answer["bytes"].get<double>();
    EXPECT_NEAR(points, 1, 0.05) << format << as;
    EXPECT_NEAR(bytes, 1, 0.05) << format << as << ": " << made->answer["bytes"];
    RecordProperty(std::string(format) + as, std::to_string(bytes));
    fs::remove_all(set);
  }
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
  for (const char* shard : {"4/3", "0/3", "1/0", "-1/3", "a/b", "2"}) {
    const auto refused = dataset("run", write(recipe()), {{"output", (folder / "x").string()}, {"shard", shard}});
    ASSERT_FALSE(refused) << shard;
    EXPECT_THAT(refused.error().source, HasSubstr("shard")) << shard;
    EXPECT_FALSE(fs::exists(folder / "x")) << shard;
  }
}

// What a model alone shows: a run finds it when it opens the first environment.
TEST_F(Dataset, LetsARecipeBeCorrectedThatMadeNothingYet) {
  const auto set = folder / "set";
  folder.write("broken.ifc", "not a model");
  auto no_model = recipe();
  no_model["environments"][0] = {{"id", "house"}, {"model", "broken.ifc"}};
  auto no_material = recipe();
  no_material["materials"] = {{{"id", "painted"}, {"assign", {"class:IfcWall=nothing-like-it"}}}};
  for (const auto& wrong : {no_model, no_material}) {
    ASSERT_FALSE(dataset("run", write(wrong), {{"output", set.string()}}));
    EXPECT_FALSE(fs::exists(set / "recipe.json"));
    EXPECT_FALSE(fs::exists(set / "classes"));
  }
  const auto corrected = dataset("run", write(recipe()), {{"output", set.string()}});
  ASSERT_TRUE(corrected) << describe(corrected.error());
  auto other = recipe();
  other["seed"] = 2;
  const auto refused = dataset("run", write(other), {{"output", set.string()}, {"resume", true}});
  ASSERT_FALSE(refused) << "scans of another recipe are in it";
  EXPECT_THAT(refused.error().message, HasSubstr("begun with another recipe"));
}

TEST_F(Dataset, NamesMaterialsThatMatchNothingOfAModel) {
  auto text = recipe();
  folder.write("own.json", R"({"rules": [{"name": "*marzipan*", "assign": "bark"}]})");
  text["effects"].erase(1);
  text["stations"][0]["count"] = 1;
  text["materials"] = {{{"id", "painted"}, {"assign", {"class:IfcWall=bark", "name:*marzipan*=bark"}}},
                       {{"id", "ruled"}, {"rules", "own.json"}},
                       {{"id", "plain"}}};
  const auto set = folder / "set";
  const auto made = dataset("run", write(text), {{"output", set.string()}});
  ASSERT_TRUE(made) << describe(made.error());
  std::vector<std::string> warnings;
  for (const auto& issue : made->report.issues)
    if (issue.severity == Severity::warning) warnings.push_back(issue.source + ": " + issue.message);
  std::vector<std::string> expected;
  for (const std::string environment : {"house", "tower"}) {
    expected.push_back(environment +
                       ": materials 'painted': the selector name:*marzipan* matches no surface and has no effect");
    expected.push_back(environment + ": materials 'ruled': none of the rules in own.json match");
  }
  EXPECT_EQ(warnings, expected);
  std::ifstream in(set / "environments/tower.json");
  EXPECT_EQ(json::parse(in)["without_effect"], json({{{"materials", "painted"}, {"assign", "name:*marzipan*"}},
                                                     {{"materials", "ruled"}, {"rules", "own.json"}}}));
  std::ifstream card(set / "README.md");
  EXPECT_THAT(std::string(std::istreambuf_iterator<char>(card), {}),
              HasSubstr("| house | painted | `name:*marzipan*` |\n| house | ruled | `own.json` |\n"));
  const auto checked = dataset("check", write(text));
  ASSERT_TRUE(checked);
  EXPECT_EQ(checked->report.issues.front().message, made->report.issues.front().message);
}

TEST_F(Dataset, NeverReplacesARecipeThatSomebodyPutIntoTheFolder) {
  auto own = recipe();
  own["seed"] = 2;
  fs::create_directories(folder / "set");
  std::ofstream(folder / "set/recipe.json") << own.dump();
  ASSERT_FALSE(dataset("run", write(recipe()), {{"output", (folder / "set").string()}}));
  std::ifstream in(folder / "set/recipe.json");
  EXPECT_EQ(json::parse(in), own);
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
