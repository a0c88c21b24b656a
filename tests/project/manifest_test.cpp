// SPDX-License-Identifier: GPL-3.0-or-later
// The manifest of a set, judged by what is not ours, in the folder that STANDPOINT_MANIFEST_TOOLS names: SHACL by npm's
// jsonld, n3, rdf-ext and shacl-engine, the STAC items by its stac-node-validator and the schemas of STAC; and by
// schemas of our own, without that folder.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "core/sha256.h"
#include "project/dataset/stac_item.h"
#include "project/storage/project_files.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using testing::HasSubstr;
namespace fs = std::filesystem;

std::string wholeTextOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// What a command prints on both streams, and its exit code.
std::pair<std::string, int> saidBy(const std::string& command) {
  std::FILE* const pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return {"cannot be started", -1};
  std::string said;
  std::array<char, 4096> piece;
  while (const std::size_t n = std::fread(piece.data(), 1, piece.size(), pipe)) said.append(piece.data(), n);
  return {said, ::pclose(pipe)};
}

// The folder with the programs of npm, where there is one.
const char* manifestTools() {
  const char* const tools = std::getenv("STANDPOINT_MANIFEST_TOOLS");
  return tools != nullptr && std::system("command -v node > /dev/null 2>&1") == 0 ? tools : nullptr;
}

// A set of two buildings, one of which is somewhere in the world.
class Manifest : public testing::Test {
 protected:
  void SetUp() override {
    Progress progress;
    auto placed = twoStoreyDocument();
    Georeference g = *placed.georeference;
    g.crs = "EPSG:25832";
    placed.georeference = std::make_shared<const Georeference>(g);
    ASSERT_TRUE(saveProject(placed, folder / "house", progress));
    ASSERT_TRUE(saveProject(twoStoreyDocument(), folder / "tower", progress));
    const json recipe = {
        {"format", "standpoint-dataset"},
        {"recipe_version", 1},
        {"name", "demo"},
        {"license", "https://spdx.org/licenses/CC-BY-4.0.html"},
        {"creator", "somebody"},
        {"date", "2026-01-31"},
        {"environments",
         {{{"id", "house"}, {"project", "house"}, {"license", "CC0-1.0"}}, {{"id", "tower"}, {"project", "tower"}}}},
        {"stations", {{{"strategy", "grid"}, {"spacing_m", 2}, {"count", 2}}}},
        {"instruments",
         {{{"id", "focus"},
           {"instrument", "faro-focus-s350"},
           {"set", {"resolution=1/32", "quality=4x", "horizontal_to=90"}}}}},
        {"materials", {{{"id", "assigned"}}, {{"id", "brick"}, {"assign", {"class:IfcWall=brick_red_bare"}}}}},
        {"splits", {{"train", {"house"}}, {"test", {"tower"}}}},
        {"classes", {"s3dis"}}};
    const auto made = run(
        "dataset", {},
        {{"action", "run"}, {"of", folder.write("recipe.json", recipe.dump()).string()}, {"output", set().string()}});
    ASSERT_TRUE(made) << describe(made.error());
    manifest = json::parse(wholeTextOf(set() / "croissant.json"));
  }
  fs::path set() const { return folder / "set"; }
  // Of "isBasedOn", by how its name begins.
  json basis(const std::string& name) const {
    for (const auto& work : manifest["isBasedOn"])
      if (work["name"].get<std::string>().starts_with(name)) return work;
    return {};
  }

  TemporaryFolder folder;
  json manifest;
};

TEST_F(Manifest, HasTheRecipeVersionsLicencesAndChecksums) {
  EXPECT_FALSE(basis("Standpoint")["softwareVersion"].get<std::string>().empty());
  EXPECT_EQ(basis("model house")["license"], "CC0-1.0");
  EXPECT_EQ(basis("model tower")["license"], "not stated");
  EXPECT_THAT(basis("instrument faro-focus-s350")["license"].get<std::string>(), HasSubstr("GPL-3.0-or-later"));
  std::string measured;
  for (const auto& work : manifest["isBasedOn"])
    if (work["license"].get<std::string>().find("free to use, cite") != std::string::npos)
      measured = work["description"];
  EXPECT_THAT(measured, HasSubstr("brick_red_bare")) << "a material of one entry of the axis alone";
  std::set<std::string> files;
  for (const auto& file : manifest["distribution"]) {
    if (file["@type"] != "cr:FileObject" || file["@id"] == "folder") continue;
    files.insert(file["@id"]);
    EXPECT_EQ(file["sha256"], sha256Of(wholeTextOf(set() / file["contentUrl"].get<std::string>()))) << file["@id"];
  }
  EXPECT_EQ(files,
            (std::set<std::string>{"scans.csv", "recipe.json", "classes/s3dis.json", "environments/house.json",
                                   "environments/house.svg", "environments/tower.json", "environments/tower.svg"}));
  const auto csv = wholeTextOf(set() / "scans.csv");
  for (const auto& entry : fs::recursive_directory_iterator(set())) {
    if (!entry.is_regular_file()) continue;
    const auto in_set = fs::relative(entry.path(), set()).generic_string();
    if (in_set.starts_with("scans/") || in_set.starts_with("labels/")) {
      EXPECT_THAT(csv, HasSubstr(sha256Of(wholeTextOf(entry.path())))) << in_set;
    }
    if (in_set != "SHA256SUMS") {
      EXPECT_THAT(wholeTextOf(set() / "SHA256SUMS"), HasSubstr(sha256Of(wholeTextOf(entry.path())) + "  " + in_set));
    }
  }
}

TEST_F(Manifest, IsFoundGoodByShaclAndWithoutItsLicenceAddressesOrChecksumsBad) {
  const char* const tools = manifestTools();
  if (tools == nullptr) GTEST_SKIP() << "STANDPOINT_MANIFEST_TOOLS or node is not here";
  const auto without = [&](const char* name, const std::function<void(json&)>& spoil) {
    auto spoilt = manifest;
    spoil(spoilt);
    return folder.write(name, spoilt.dump()).string();
  };
  const auto files = (set() / "croissant.json").string() + " " +
                     without("license.json", [](json& m) { m.erase("license"); }) + " " +
                     without("url.json", [](json& m) { m["distribution"][1].erase("contentUrl"); }) + " " +
                     without("sum.json", [](json& m) { m["distribution"][2].erase("sha256"); }) + " " +
                     without("short.json", [](json& m) { m["distribution"][2]["sha256"] = "0123"; }) + " " +
                     without("basis.json", [](json& m) { m["isBasedOn"][1].erase("license"); }) + " " +
                     without("version.json", [](json& m) { m["isBasedOn"][0].erase("softwareVersion"); }) + " " +
                     without("conforms.json", [](json& m) { m["conformsTo"] = "http://mlcommons.org/croissant/0.8"; });
  const auto command = std::string("node " SOURCE_DIR "/tests/project/manifest/check.mjs ") + tools +
                       " " SOURCE_DIR "/tests/project/manifest/shapes.ttl " + files;
  const auto said = saidBy(command).first;
  std::istringstream lines(said);
  std::vector<json> reports;
  for (std::string line; std::getline(lines, line);) reports.push_back(json::parse(line, nullptr, false));
  const char* const kWhere[] = {"license", "contentUrl",      "sha256",    "sha256",
                                "license", "softwareVersion", "conformsTo"};
  ASSERT_EQ(reports.size(), 1 + std::size(kWhere)) << said;
  EXPECT_EQ(reports[0]["conforms"], true) << said;
  EXPECT_GT(reports[0]["quads"], 200);
  for (std::size_t k = 0; k < std::size(kWhere); ++k) {
    EXPECT_EQ(reports[k + 1]["conforms"], false) << kWhere[k];
    ASSERT_EQ(reports[k + 1]["where"].size(), 1U) << reports[k + 1];
    EXPECT_THAT(reports[k + 1]["where"][0].get<std::string>(), HasSubstr(kWhere[k]));
  }
}

TEST_F(Manifest, HasAStacItemOfAnEnvironmentThatIsOnAMap) {
  EXPECT_FALSE(fs::exists(set() / "stac/tower.json")) << "it is nowhere";
  const auto item = json::parse(wholeTextOf(set() / "stac/house.json"));
  const auto schema_text = json::parse(wholeTextOf(SOURCE_DIR "/tests/project/manifest/stac_item.json"));
  using Adapter = valijson::adapters::NlohmannJsonAdapter;
  valijson::Schema schema;
  valijson::SchemaParser().populateSchema(Adapter(schema_text), schema);
  const auto accepts = [&](const json& document) {
    return valijson::Validator().validate(schema, Adapter(document), nullptr);
  };
  EXPECT_TRUE(accepts(item)) << item;
  for (const char* key : {"datetime", "license", "pc:count", "pc:type"}) {
    auto less = item;
    less["properties"].erase(key);
    EXPECT_FALSE(accepts(less)) << key;
  }
  // 500 km east in zone 32 is its meridian, 9° E; north by the meridian's arc of GRS 80 over 0.9996, integrated apart.
  const auto& corner = item["geometry"]["coordinates"][0][0];
  EXPECT_NEAR(corner[0].get<double>(), 9, 1e-5);
  EXPECT_NEAR(corner[1].get<double>(), 50.5519306, 1e-6);
  EXPECT_EQ(item["properties"]["datetime"], "2026-01-31T00:00:00Z");
  EXPECT_EQ(item["properties"]["license"], "CC-BY-4.0");
  EXPECT_EQ(item["links"].back(), (json{{"rel", "license"}, {"href", manifest["license"]}}));
  Progress progress;
  auto recipe = readRecipeOfSet(set()).value();
  const auto check = checkSet(set(), recipe, Shard(), progress).value();
  for (const auto& [license, id, links] :
       {std::tuple("CC0-1.0", "CC0-1.0", 1U), std::tuple("ask the owner", "proprietary", 1U),
        std::tuple("https://creativecommons.org/licenses/by/4.0/", "proprietary", 2U)}) {
    recipe.license = license;
    const auto other = json::parse(stacItem(recipe, check, 0).value().value());
    EXPECT_EQ(other["properties"]["license"], id) << license;
    EXPECT_EQ(other["links"].size(), links) << license;
  }
  std::uint64_t points = 0;
  for (const auto& [name, asset] : item["assets"].items()) {
    const auto file = set() / "stac" / asset["href"].get<std::string>();
    ASSERT_TRUE(fs::exists(file)) << name;
    if (name == "plan") continue;
    EXPECT_EQ(asset["file:checksum"], "1220" + sha256Of(wholeTextOf(file)));
    points += json::parse(wholeTextOf(set() / "records" / (name + ".json")))["points"].get<std::uint64_t>();
  }
  EXPECT_EQ(item["properties"]["pc:count"], points);
}

TEST_F(Manifest, HasAStacItemThatTheSchemasOfStacFindGoodAndWithAWrongDateLicenceCountOrSizeBad) {
  const char* const tools = manifestTools();
  const auto schemas = fs::path(tools == nullptr ? "" : tools) / "schemas";
  if (tools == nullptr || !fs::exists(schemas))
    GTEST_SKIP() << "STANDPOINT_MANIFEST_TOOLS, its schemas or node is not here";
  const auto item = json::parse(wholeTextOf(set() / "stac/house.json"));
  json map = json::array();
  for (const auto& extension : item["stac_extensions"]) {
    const auto url = extension.get<std::string>();
    map.push_back(url + "=" + (schemas / url.substr(url.find("//") + 2)).string());
  }
  for (const char* name : {"Feature", "Geometry"})
    map.push_back(
        fmt::format("https://geojson.org/schema/{0}.json={1}/node_modules/geojson-schema/{0}.json", name, tools));
  const auto judged = [&](const char* name, const std::function<void(json&)>& spoil) {
    auto spoilt = item;
    spoil(spoilt);
    const json config = {{"files", {folder.write(fmt::format("{}.json", name), spoilt.dump()).string()}},
                         {"schemas", (schemas / "schemas.stacspec.org/v1.0.0").string()},
                         {"schemaMap", map},
                         {"verbose", true}};
    const auto file = folder.write(fmt::format("{}-config.json", name), config.dump());
    return saidBy(fmt::format("node {}/node_modules/stac-node-validator/bin/cli.js --config {}", tools, file.string()));
  };
  const auto [said, status] = judged("good", [](json&) {});
  EXPECT_EQ(status, 0) << said;
  EXPECT_THAT(said, HasSubstr("Item: valid"));
  EXPECT_THAT(said, HasSubstr("pointcloud/v2.0.0/schema.json: valid"));
  EXPECT_THAT(said, HasSubstr("file/v2.1.0/schema.json: valid"));
  const auto isBad = [&](const char* name, const char* where, const std::function<void(json&)>& spoil) {
    const auto [bad_said, bad_status] = judged(name, spoil);
    EXPECT_NE(bad_status, 0) << name;
    EXPECT_THAT(bad_said, HasSubstr(fmt::format("{}: invalid", where))) << name;
  };
  isBad("date", "Item", [](json& m) { m["properties"].erase("datetime"); });
  isBad("license", "Item", [&](json& m) { m["properties"]["license"] = manifest["license"]; });
  isBad("count", "pointcloud/v2.0.0/schema.json", [](json& m) { m["properties"]["pc:count"] = -1; });
  isBad("size", "file/v2.1.0/schema.json", [](json& m) { m["assets"].front()["file:size"] = -1; });
}

TEST_F(Manifest, HasACardWhosePicturesAreThere) {
  const auto html = wholeTextOf(set() / "card.html"), markdown = wholeTextOf(set() / "README.md");
  for (const char* picture : {"environments/house.svg", "environments/tower.svg", "balance/s3dis.svg"}) {
    EXPECT_THAT(html, HasSubstr("src=\"" + std::string(picture) + "\""));
    EXPECT_THAT(markdown, HasSubstr("](" + std::string(picture) + ")"));
    const auto svg = wholeTextOf(set() / picture);
    EXPECT_TRUE(svg.starts_with("<svg xmlns=")) << picture;
    EXPECT_TRUE(svg.ends_with("</svg>\n")) << picture;
  }
  const auto plan = wholeTextOf(set() / "environments/house.svg");
  EXPECT_THAT(plan, HasSubstr(">grid-1</text>"));
  EXPECT_THAT(wholeTextOf(set() / "balance/s3dis.svg"), HasSubstr(">sofa</text>"));
}

}  // namespace
}  // namespace standpoint
