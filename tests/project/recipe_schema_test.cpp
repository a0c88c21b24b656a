// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <memory>

#include <gtest/gtest.h>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "project/dataset/recipe.h"
#include "project/storage/project_files.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using Adapter = valijson::adapters::NlohmannJsonAdapter;

bool schemaAccepts(const json& document) {
  static const auto schema = [] {
    std::ifstream file(SOURCE_DIR "/project/dataset/schema.json");
    static const json text = json::parse(file);
    auto parsed = std::make_unique<valijson::Schema>();
    valijson::SchemaParser().populateSchema(Adapter(text), *parsed);
    return parsed;
  }();
  return valijson::Validator().validate(*schema, Adapter(document), nullptr);
}

// A recipe with an entry of each axis, and what a JSON patch makes of it.
class RecipeSchema : public testing::Test {
 protected:
  void SetUp() override {
    Progress progress;
    ASSERT_TRUE(saveProject(twoStoreyDocument(), folder / "house", progress));
    ASSERT_TRUE(saveProject(twoStoreyDocument(), folder / "tower", progress));
    folder.write("shed.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
    folder.write("plan.pdf", "%PDF-1.4\n");
    folder.write("own.json", R"({"name": "own", "classes": {"a": 0}, "unknown": "a", "noise": "a",
                                 "ifc": {"IfcWall": "a"}})");
    folder.write("nothing.json", R"({"name": "own", "classes": {"a": 0}, "unknown": "a", "noise": "a", "ifc": {}})");
  }

  json recipe(const char* patch) const {
    return json::parse(R"({
      "format": "standpoint-dataset", "recipe_version": 1, "name": "demo", "description": "A demo",
      "license": "https://spdx.org/licenses/CC-BY-4.0.html", "creator": "somebody", "date": "2026-01-31",
      "url": "https://example.org/demo", "version": "1.2.0", "seed": 7, "starved_below": 0.01,
      "environments": [
        {"id": "house", "project": "house", "building": "A", "license": "CC0-1.0"},
        {"id": "tower", "project": "tower", "stations": [
          {"strategy": "project", "names": ["S1"]},
          {"strategy": "places", "places": [[500001, 5600001], [500001, 5600002, 3]], "levelling_error_deg": 1}]},
        {"id": "shed", "model": "shed.obj", "stations": [
          {"strategy": "route", "id": "way", "through": [[0, 0], [9, 0]], "spacing_m": 3, "height_m": 1.6}]}],
      "stations": [{"strategy": "grid", "spacing_m": 2, "count": 2}, {"strategy": "greedy", "count": 3}],
      "instruments": [{"id": "focus", "instrument": "faro-focus-s350", "set": ["resolution=1/32", "quality=4x"]}],
      "weather": [{"id": "clear"}, {"id": "rain", "weather": "rain=20, visibility=5", "interference": 0.1},
                  {"id": "noon", "sun": "180,60,900"}],
      "materials": [{"id": "assigned"}, {"id": "brick", "assign": ["class:IfcWall=brick_red_bare"]}],
      "field_faults": [{"id": "none"}, {"id": "moved", "fault": ["tripod_moved=0.4", "noise=2"]}],
      "effects": [{"id": "noisy"}, {"id": "ideal", "ideal": true}, {"id": "calm", "without": "striping,range-noise"}],
      "seeds": [1, 2],
      "splits": {"train": ["A"], "validation": ["shed"], "test": ["tower"]},
      "classes": ["s3dis", "own.json"],
      "output": {"format": "e57", "as": "scaled", "truth": true, "quality": "preview"}})")
        .patch(json::parse(patch));
  }
  Result<Recipe> read(const json& recipe) const { return readRecipe(folder.write("recipe.json", recipe.dump())); }

  TemporaryFolder folder;
};

TEST_F(RecipeSchema, AcceptsWhatTheReaderAccepts) {
  for (const char* patch :
       {"[]", R"([{"op": "remove", "path": "/description"}, {"op": "remove", "path": "/url"}])",
        R"([{"op": "remove", "path": "/weather"}, {"op": "remove", "path": "/materials"},
            {"op": "remove", "path": "/field_faults"}, {"op": "remove", "path": "/effects"},
            {"op": "remove", "path": "/seeds"}, {"op": "remove", "path": "/output"}])",
        R"([{"op": "replace", "path": "/weather", "value": []}, {"op": "replace", "path": "/effects", "value": []}])",
        R"([{"op": "remove", "path": "/stations"}, {"op": "add", "path": "/environments/0/stations",
            "value": [{"strategy": "greedy", "count": 1}]}])",
        R"([{"op": "replace", "path": "/output", "value": {"format": "las", "as": "pdrf8"}}])",
        R"([{"op": "replace", "path": "/output", "value": {"as": "spherical"}}])",
        R"([{"op": "replace", "path": "/output", "value": {"format": "xyz"}}])",
        R"([{"op": "add", "path": "/environments/1/stations/0/levelling_error_deg", "value": 0}])",
        R"([{"op": "replace", "path": "/splits", "value": {"train": ["A", "tower", "shed"], "test": []}}])"}) {
    const auto document = recipe(patch);
    EXPECT_TRUE(schemaAccepts(document)) << patch;
    const auto made = read(document);
    EXPECT_TRUE(made) << patch << ": " << describe(made.error());
  }
}

struct Damage {
  const char* place;  // that the reader names
  const char* patch;
  bool beyond_schema = false;  // it takes more than a look at one file
};
constexpr Damage kDamages[] = {
    {"/format", R"([{"op": "replace", "path": "/format", "value": "standpoint"}])"},
    {"/format", R"([{"op": "remove", "path": "/format"}])"},
    {"/recipe_version", R"([{"op": "replace", "path": "/recipe_version", "value": 2}])"},
    {"/name", R"([{"op": "replace", "path": "/name", "value": "my set"}])"},
    {"/name", R"([{"op": "remove", "path": "/name"}])"},
    {"/license", R"([{"op": "replace", "path": "/license", "value": " "}])"},
    {"/creator", R"([{"op": "replace", "path": "/creator", "value": 7}])"},
    {"/date", R"([{"op": "replace", "path": "/date", "value": "31.1.2026"}])"},
    {"/date", R"([{"op": "replace", "path": "/date", "value": "2026-02-30"}])", true},
    {"/date", R"([{"op": "replace", "path": "/date", "value": "2026-13-01"}])", true},
    {"/creator", R"([{"op": "replace", "path": "/creator", "value": "two\nlines"}])"},
    {"/environments/0/building", R"([{"op": "replace", "path": "/environments/0/building", "value": "A\u0000"}])"},
    {"/environments/2/model", R"([{"op": "replace", "path": "/environments/2/model", "value": "."}])", true},
    {"/environments/2/model", R"([{"op": "replace", "path": "/environments/2/model", "value": "plan.pdf"}])", true},
    {"/description", R"([{"op": "replace", "path": "/description", "value": ""}])"},
    {"/url", R"([{"op": "replace", "path": "/url", "value": ["a"]}])"},
    {"/seed", R"([{"op": "replace", "path": "/seed", "value": -1}])"},
    {"/seed", R"([{"op": "replace", "path": "/seed", "value": 1.5}])"},
    {"/seed", R"([{"op": "replace", "path": "/seed", "value": 9007199254740992}])"},
    {"/starved_below", R"([{"op": "replace", "path": "/starved_below", "value": 2}])"},
    {"/instrumens", R"([{"op": "add", "path": "/instrumens", "value": []}])"},
    {"/environments", R"([{"op": "remove", "path": "/environments"}])"},
    {"/environments", R"([{"op": "replace", "path": "/environments", "value": []}])"},
    {"/environments", R"([{"op": "replace", "path": "/environments", "value": {"id": "house"}}])"},
    {"/environments/0", R"([{"op": "remove", "path": "/environments/0/project"}])"},
    {"/environments/0", R"([{"op": "add", "path": "/environments/0/model", "value": "shed.obj"}])"},
    {"/environments/0/id", R"([{"op": "replace", "path": "/environments/0/id", "value": "../house"}])"},
    {"/environments/0/id", R"([{"op": "replace", "path": "/environments/0/id", "value": "-house"}])"},
    {"/environments/0/id",
     R"([{"op": "replace", "path": "/environments/0/id", "value": "a2345678901234567890123456789012345678901"}])"},
    {"/environments/0/licence", R"([{"op": "add", "path": "/environments/0/licence", "value": "CC0"}])"},
    {"/environments/0/project", R"([{"op": "replace", "path": "/environments/0/project", "value": "nowhere"}])", true},
    {"/environments/2/model", R"([{"op": "replace", "path": "/environments/2/model", "value": "no.ifc"}])", true},
    {"/environments/1/id", R"([{"op": "replace", "path": "/environments/1/id", "value": "house"}])", true},
    {"/environments/0", R"([{"op": "remove", "path": "/stations"}])"},
    {"/environments/0", R"([{"op": "replace", "path": "/stations", "value": []}])"},
    {"/environments/1", R"([{"op": "replace", "path": "/environments/1/stations", "value": []}])"},
    {"/environments/2/stations", R"([{"op": "replace", "path": "/environments/2/stations",
                                      "value": [{"strategy": "project", "names": ["S1"]}]}])"},
    {"/environments/2/stations", R"([{"op": "remove", "path": "/environments/2/stations"},
        {"op": "add", "path": "/stations/-", "value": {"strategy": "project", "names": ["S1"]}}])"},
    {"/stations/0/strategy", R"([{"op": "replace", "path": "/stations/0/strategy", "value": "random"}])"},
    {"/stations/0/strategy", R"([{"op": "remove", "path": "/stations/0/strategy"}])"},
    {"/stations/0/spacing_m", R"([{"op": "replace", "path": "/stations/0/spacing_m", "value": 0.4}])"},
    {"/stations/0/spacing_m", R"([{"op": "remove", "path": "/stations/0/spacing_m"}])"},
    {"/stations/0/count", R"([{"op": "remove", "path": "/stations/0/count"}])"},
    {"/stations/0/count", R"([{"op": "replace", "path": "/stations/0/count", "value": 0}])"},
    {"/stations/1/count", R"([{"op": "replace", "path": "/stations/1/count", "value": 2.5}])"},
    {"/stations/1/count", R"([{"op": "replace", "path": "/stations/1/count", "value": 10001}])"},
    {"/stations/1/spacing_m", R"([{"op": "add", "path": "/stations/1/spacing_m", "value": 2}])"},
    {"/stations/0/height_m", R"([{"op": "add", "path": "/stations/0/height_m", "value": 20}])"},
    {"/stations/0/levelling_error_deg", R"([{"op": "add", "path": "/stations/0/levelling_error_deg", "value": 61}])"},
    {"/stations/1/id", R"([{"op": "add", "path": "/stations/1/id", "value": "grid"}])", true},
    {"/environments/1/stations/0/names",
     R"([{"op": "replace", "path": "/environments/1/stations/0/names", "value": []}])"},
    {"/environments/1/stations/0",
     R"([{"op": "add", "path": "/environments/1/stations/0/levelling_error_deg", "value": 1}])"},
    {"/environments/1/stations/0", R"([{"op": "add", "path": "/environments/1/stations/0/height_m", "value": 1.5}])"},
    {"/environments/1/stations/1/places",
     R"([{"op": "replace", "path": "/environments/1/stations/1/places", "value": []}])"},
    {"/environments/1/stations/1/places/0",
     R"([{"op": "replace", "path": "/environments/1/stations/1/places/0", "value": [1]}])"},
    {"/environments/1/stations/1/places/0/1",
     R"([{"op": "replace", "path": "/environments/1/stations/1/places/0", "value": [1, "2"]}])"},
    {"/environments/1/stations/1/places/0/0",
     R"([{"op": "replace", "path": "/environments/1/stations/1/places/0", "value": [1e10, 2]}])"},
    {"/environments/2/stations/0/through",
     R"([{"op": "replace", "path": "/environments/2/stations/0/through", "value": [[0, 0]]}])"},
    {"/environments/2/stations/0/spacing_m",
     R"([{"op": "replace", "path": "/environments/2/stations/0/through", "value": [[0, 0], [99999, 0]]}])", true},
    {"/instruments", R"([{"op": "remove", "path": "/instruments"}])"},
    {"/instruments", R"([{"op": "replace", "path": "/instruments", "value": []}])"},
    {"/instruments/0/instrument", R"([{"op": "remove", "path": "/instruments/0/instrument"}])"},
    {"/instruments/0/instrument", R"([{"op": "replace", "path": "/instruments/0/instrument", "value": "no"}])", true},
    {"/instruments/0/instrument",
     R"([{"op": "replace", "path": "/instruments/0/instrument", "value": "hesai-xt32"},
         {"op": "remove", "path": "/instruments/0/set"}])",
     true},
    {"/instruments/0/set", R"([{"op": "replace", "path": "/instruments/0/set", "value": ["fast"]}])"},
    {"/instruments/0/set", R"([{"op": "replace", "path": "/instruments/0/set", "value": "quality=4x"}])"},
    {"/instruments/0/set", R"([{"op": "replace", "path": "/instruments/0/set", "value": ["resolution=7"]}])", true},
    {"/weather/1/weather", R"([{"op": "replace", "path": "/weather/1/weather", "value": "hail=3"}])"},
    {"/weather/1/weather", R"([{"op": "replace", "path": "/weather/1/weather", "value": "rain=3000"}])", true},
    {"/weather/1/interference", R"([{"op": "replace", "path": "/weather/1/interference", "value": 2}])"},
    {"/weather/2/sun", R"([{"op": "replace", "path": "/weather/2/sun", "value": "180"}])"},
    {"/weather/2/sun", R"([{"op": "replace", "path": "/weather/2/sun", "value": "180,-5"}])", true},
    {"/materials/1/assign", R"([{"op": "replace", "path": "/materials/1/assign", "value": ["brick"]}])"},
    {"/materials/1/rules", R"([{"op": "add", "path": "/materials/1/rules", "value": "no.json"}])", true},
    {"/materials/1/id", R"([{"op": "remove", "path": "/materials/1/id"}])"},
    {"/field_faults/1/fault", R"([{"op": "replace", "path": "/field_faults/1/fault", "value": ["dog=1"]}])"},
    {"/field_faults/1/fault", R"([{"op": "replace", "path": "/field_faults/1/fault", "value": ["until=2"]}])", true},
    {"/effects/1/ideal", R"([{"op": "replace", "path": "/effects/1/ideal", "value": "yes"}])"},
    {"/effects/1/without", R"([{"op": "add", "path": "/effects/1/without", "value": "striping"}])"},
    {"/effects/2/without", R"([{"op": "replace", "path": "/effects/2/without", "value": "Striping!"}])"},
    {"/effects/2/without", R"([{"op": "replace", "path": "/effects/2/without", "value": "gravity"}])", true},
    {"/seeds", R"([{"op": "replace", "path": "/seeds", "value": []}])"},
    {"/seeds", R"([{"op": "replace", "path": "/seeds", "value": 3}])"},
    {"/seeds/1", R"([{"op": "replace", "path": "/seeds", "value": [1, 1]}])"},
    {"/splits", R"([{"op": "remove", "path": "/splits"}])"},
    {"/splits", R"([{"op": "replace", "path": "/splits", "value": {}}])"},
    {"/splits/holdout", R"([{"op": "add", "path": "/splits/holdout", "value": []}])"},
    {"/splits/train", R"([{"op": "replace", "path": "/splits/train", "value": ["A", "A"]}])"},
    {"/splits/train", R"([{"op": "replace", "path": "/splits/train", "value": [1]}])"},
    {"/splits/test", R"([{"op": "replace", "path": "/splits/test", "value": ["tower", "A"]}])", true},
    {"/splits", R"([{"op": "replace", "path": "/splits/test", "value": []}])", true},
    {"/splits/train", R"([{"op": "replace", "path": "/splits/train", "value": ["A", "castle"]}])", true},
    {"/classes", R"([{"op": "remove", "path": "/classes"}])"},
    {"/classes", R"([{"op": "replace", "path": "/classes", "value": []}])"},
    {"/classes/0", R"([{"op": "replace", "path": "/classes", "value": ["s4dis"]}])"},
    {"/classes/1", R"([{"op": "replace", "path": "/classes", "value": ["ifc", "ifc"]}])"},
    {"/classes/0", R"([{"op": "replace", "path": "/classes", "value": ["my map.json"]}])"},
    {"/classes/0", R"([{"op": "replace", "path": "/classes", "value": ["absent.json"]}])", true},
    {"/classes/0", R"([{"op": "replace", "path": "/classes", "value": ["nothing.json"]}])", true},
    {"/output/format", R"([{"op": "replace", "path": "/output", "value": {"format": "laz"}}])"},
    {"/output/as", R"([{"op": "replace", "path": "/output", "value": {"as": "pdrf8"}}])"},
    {"/output/as", R"([{"op": "replace", "path": "/output", "value": {"format": "ply", "as": "scaled"}}])"},
    {"/output/truth", R"([{"op": "replace", "path": "/output/truth", "value": 1}])"},
    {"/output/quality", R"([{"op": "replace", "path": "/output/quality", "value": "best"}])"},
    {"/output/compress", R"([{"op": "add", "path": "/output/compress", "value": true}])"}};

TEST_F(RecipeSchema, RefusesWhatTheReaderRefusesByItsPlace) {
  for (const auto& damage : kDamages) {
    const auto document = recipe(damage.patch);
    EXPECT_EQ(schemaAccepts(document), damage.beyond_schema) << damage.patch;
    const auto made = read(document);
    ASSERT_FALSE(made) << damage.patch;
    EXPECT_EQ(made.error().source, std::string("recipe.json ") + damage.place)
        << damage.patch << ": " << made.error().message;
  }
  auto wordy = recipe("[]");
  wordy["creator"] = std::string(1001, 'x');
  EXPECT_FALSE(schemaAccepts(wordy));
  EXPECT_EQ(read(wordy).error().source, "recipe.json /creator");
  EXPECT_FALSE(schemaAccepts(json::array()));
  EXPECT_FALSE(read(json::array()));
}

// A project may have materials of its own, so this is asked of models only.
TEST_F(RecipeSchema, RefusesMaterialsThatTheLibraryDoesNotHave) {
  auto document = recipe(R"([{"op": "remove", "path": "/environments/0"}, {"op": "remove", "path": "/environments/0"},
                             {"op": "replace", "path": "/splits", "value": {"train": ["shed"]}}])");
  ASSERT_TRUE(read(document)) << describe(read(document).error());
  document["materials"][1]["assign"] = {"class:IfcWall=adamant"};
  const auto assigned = read(document);
  ASSERT_FALSE(assigned);
  EXPECT_EQ(describe(assigned.error()),
            "recipe.json /materials/1/assign: 'adamant' is not in the library of materials");
  document["materials"][1] = {{"id", "own"}, {"rules", "rules.json"}};
  folder.write("rules.json", R"({"rules": 7})");
  const auto ruled = read(document);
  ASSERT_FALSE(ruled);
  EXPECT_EQ(ruled.error().source, "recipe.json /materials/1/rules");
}

TEST_F(RecipeSchema, RefusesMoreThanAMillionScans) {
  auto document = recipe("[]");  // at 12 places, with 3 weathers, 2 materials, 2 faults and 3 effects
  document["seeds"] = json::array();
  for (int seed = 0; seed < 2314; ++seed) document["seeds"].push_back(seed);
  EXPECT_TRUE(read(document)) << describe(read(document).error());
  document["seeds"].push_back(2314);
  const auto refused = read(document);
  ASSERT_FALSE(refused);
  EXPECT_EQ(describe(refused.error()),
            "recipe.json: makes 1000080 scans, more than 1000000: split it into several recipes");
}

// A megabyte of a wrong word is not printed.
TEST_F(RecipeSchema, NamesAWrongKeyOrIdInShort) {
  auto document = recipe("[]");
  document["environments"][0]["id"] = std::string(1'000'000, 'x');
  EXPECT_LT(describe(read(document).error()).size(), 3000U);
  document = recipe("[]");
  document[std::string(1'000'000, 'x')] = 1;
  EXPECT_LT(describe(read(document).error()).size(), 3000U);
}

}  // namespace
}  // namespace standpoint
