// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <random>

#include "tests/materials/fixtures.h"

namespace standpoint {
namespace {

using testing::HasSubstr;

const std::string kGood = R"({"id": "stone", "label": "Stone", "reflectance": [[532, 0.3], [905, 0.4]],
  "roughness_rad": 0.2, "source": {"reflectance": "measured: [lab] no 7", "roughness_rad": "unsourced"}})";
const std::string kSources = R"({"sources": [{"id": "lab", "text": "Own laboratory", "licence": "own"}], "materials": [)";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

struct BadEntry {
  const char* name;
  const char* what;
  const char* by;
  const char* source;   // where the error points to
  const char* message;  // a part of it
};

class BadEntries : public testing::TestWithParam<BadEntry> {};

TEST_P(BadEntries, AreRefusedWithTheirPlace) {
  const auto& bad = GetParam();
  const TemporaryFolder folder;
  folder.write("stone.json", kSources + replaced(kGood, "stone", "rock") + ",\n" + replaced(kGood, bad.what, bad.by) + "]}");
  const auto library = readMaterialLibrary(folder.path());
  ASSERT_FALSE(library.has_value());
  EXPECT_EQ(library.error().kind, ErrorKind::unusable);
  EXPECT_EQ(library.error().source, bad.source);
  EXPECT_THAT(library.error().message, HasSubstr(bad.message));
}

INSTANTIATE_TEST_SUITE_P(
    Library, BadEntries,
    testing::Values(
        BadEntry{"unknownKey", "\"label\"", "\"colour\": 1, \"label\"", "stone.json /materials/1/colour", "not a known key"},
        BadEntry{"noId", "\"id\": \"stone\",", "", "stone.json /materials/1/id", "missing"},
        BadEntry{"idOfOtherLetters", "\"stone\"", "\"Stone 1\"", "stone.json /materials/1/id", "a-z"},
        BadEntry{"sameId", "\"stone\"", "\"rock\"", "stone.json /materials/1/id", "already in stone.json /materials/0"},
        BadEntry{"emptyLabel", "\"Stone\"", "\" \"", "stone.json /materials/1/label", "empty"},
        BadEntry{"tooBright", "0.4", "1.4", "stone.json /materials/1/reflectance/1/1", "1.4"},
        BadEntry{"negative", "0.3", "-0.3", "stone.json /materials/1/reflectance/0/1", "-0.3"},
        BadEntry{"text", "0.3", "\"0.3\"", "stone.json /materials/1/reflectance/0/1", "number"},
        BadEntry{"nothing", "0.3", "null", "stone.json /materials/1/reflectance/0/1", "number"},
        BadEntry{"micrometres", "532", "0.532", "stone.json /materials/1/reflectance/0/0", "0.532"},
        BadEntry{"unsorted", "905", "532", "stone.json /materials/1/reflectance/1/0", "rise"},
        BadEntry{"noPair", "[532, 0.3]", "[532]", "stone.json /materials/1/reflectance/0", "[wavelength_nm, share]"},
        BadEntry{"emptySpectrum", "[[532, 0.3], [905, 0.4]]", "[]", "stone.json /materials/1/reflectance", "list"},
        BadEntry{"roughnessInDegrees", "0.2", "20", "stone.json /materials/1/roughness_rad", "20"},
        BadEntry{"noSource", "\"roughness_rad\": \"unsourced\"", "\"reflectance2\": \"x\"",
                 "stone.json /materials/1/source/reflectance2", "figure"},
        BadEntry{"missingSource", ", \"roughness_rad\": \"unsourced\"", "", "stone.json /materials/1/source/roughness_rad",
                 "missing"},
        BadEntry{"sourceOfNothing", "\"roughness_rad\": 0.2,", "", "stone.json /materials/1/source/roughness_rad",
                 "does not have"},
        BadEntry{"noSources", ", \"roughness_rad\": \"unsourced\"}}", "}, \"source2\": 1}", "stone.json /materials/1/source2",
                 "not a known key"},
        BadEntry{"moreThanAll", "\"roughness_rad\": 0.2, \"source\": {",
                 "\"roughness_rad\": 0.2, \"index_of_refraction\": 30, \"source\": {\"index_of_refraction\": \"unsourced\", ",
                 "stone.json /materials/1/reflectance/0", "exceed"},
        BadEntry{"glossWithoutIndex", "\"roughness_rad\": 0.2, \"source\": {",
                 "\"roughness_rad\": 0.2, \"gloss_slope\": 0.1, \"source\": {\"gloss_slope\": \"x\", ",
                 "stone.json /materials/1/gloss_slope", "needs index_of_refraction"},
        BadEntry{"thickWithoutTransmittance", "\"roughness_rad\": 0.2, \"source\": {",
                 "\"roughness_rad\": 0.2, \"thickness_m\": 0.01, \"source\": {\"thickness_m\": \"x\", ",
                 "stone.json /materials/1/thickness_m", "needs transmittance"},
        BadEntry{"keyTwice", "\"label\": \"Stone\"", "\"label\": \"Stone\", \"label\": \"Rock\"", "stone.json",
                 "'label' twice"},
        BadEntry{"noObject", kGood.c_str(), "7", "stone.json /materials/1", "object"},
        BadEntry{"cutShort", "\"source\"", "\"sou", "stone.json line 4", "not JSON"}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(BadLibraries, WithoutAFolderOrFilesSaySo) {
  const TemporaryFolder folder;
  EXPECT_EQ(readMaterialLibrary(folder.path() / "none").error().kind, ErrorKind::file_system);
  EXPECT_THAT(readMaterialLibrary(folder.path()).error().message, HasSubstr("no material library"));
  folder.write("list.json", "[]");
  EXPECT_THAT(readMaterialLibrary(folder.path()).error().message, HasSubstr("must be an object"));
}

TEST(BadLibraries, NestedDeeplyOrHugeEndInAnErrorNotACrash) {
  const TemporaryFolder folder;
  folder.write("deep.json", std::string(3'000'000, '['));
  EXPECT_FALSE(readMaterialLibrary(folder.path()).has_value());
  folder.write("deep.json", std::string(17U << 20U, ' '));
  EXPECT_THAT(readMaterialLibrary(folder.path()).error().message, HasSubstr("16 MB"));
}

// Whatever a byte is changed to, the reader answers with a library or an error that names the file.
TEST(BadLibraries, MutatedAnywhereAreReadOrRefused) {
  const TemporaryFolder folder;
  std::ifstream stream(SOURCE_DIR "/materials/library/glass.json", std::ios::binary);
  const std::string good{std::istreambuf_iterator<char>(stream), {}};
  std::mt19937 random(7);
  std::size_t refused = 0;
  for (int round = 0; round < 300; ++round) {
    auto text = good;
    for (int change = 0; change < 3; ++change) text[random() % text.size()] = static_cast<char>(random() % 256);
    if (round % 3 == 0) text.resize(random() % text.size());
    folder.write("glass.json", text);
    const auto library = readMaterialLibrary(folder.path());
    if (library) continue;
    ++refused;
    EXPECT_THAT(library.error().source, HasSubstr("glass.json"));
  }
  EXPECT_GE(refused, 100U);
}

struct BadRule {
  const char* text;
  const char* source;
  const char* message;
};

TEST(BadRules, AreRefusedWithTheirPlace) {
  const TemporaryFolder folder;
  const std::string good = R"({"rules": [{"material": "*beton*", "assign": "concrete_construction"}, )";
  for (const auto& [text, source, message] :
       {BadRule{R"({"material": "x", "assign": "adamantium"})", "r.json /rules/1/assign", "not in the library"},
        BadRule{R"({"material": "x"})", "r.json /rules/1/assign", "missing"},
        BadRule{R"({"assign": "bark"})", "r.json /rules/1", "fit everything"},
        BadRule{R"({"material": "a||b", "assign": "bark"})", "r.json /rules/1/material", "empty pattern"},
        BadRule{R"({"material": "", "assign": "bark"})", "r.json /rules/1/material", "empty"},
        BadRule{R"({"material": 3, "assign": "bark"})", "r.json /rules/1/material", "text"},
        BadRule{R"({"colour": "red|mauve", "assign": "bark"})", "r.json /rules/1/colour", "'mauve' is no colour"},
        BadRule{R"({"material": "x", "assign": "bark", "hidden": 1})", "r.json /rules/1/hidden", "true or false"},
        BadRule{R"({"ifc_class": "x", "assign": "bark", "hidden": true})", "r.json /rules/1/hidden", "needs a pattern"},
        BadRule{R"({"class": "IfcWall", "assign": "bark"})", "r.json /rules/1/class", "not a known key"}}) {
    const auto rules = readAssignmentRules(folder.write("r.json", good + text + "]}"), shippedLibrary());
    ASSERT_FALSE(rules.has_value()) << text;
    EXPECT_EQ(rules.error().kind, ErrorKind::unusable);
    EXPECT_EQ(rules.error().source, source);
    EXPECT_THAT(rules.error().message, HasSubstr(message));
  }
  EXPECT_EQ(readAssignmentRules(folder.path() / "none.json", shippedLibrary()).error().kind, ErrorKind::file_system);
}

}  // namespace
}  // namespace standpoint
