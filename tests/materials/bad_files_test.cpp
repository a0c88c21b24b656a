// SPDX-License-Identifier: GPL-3.0-or-later
#include <random>

#include <gmock/gmock.h>

#include "tests/materials/bad_entries.h"
#include "tests/materials/fixtures.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

using testing::HasSubstr;

class BadEntries : public testing::TestWithParam<BadEntry> {};

TEST_P(BadEntries, AreRefusedWithTheirPlace) {
  const auto& bad = GetParam();
  const TemporaryFolder folder;
  folder.write("stone.json", libraryWith(bad));
  const auto library = readMaterialLibrary(folder.path());
  ASSERT_FALSE(library.has_value());
  EXPECT_EQ(library.error().kind, ErrorKind::unusable);
  EXPECT_EQ(library.error().source, bad.source);
  EXPECT_THAT(library.error().message, HasSubstr(bad.message));
}

INSTANTIATE_TEST_SUITE_P(Library, BadEntries, testing::ValuesIn(badEntries()),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(BadLibraries, WithoutAFolderOrFilesSaySo) {
  const TemporaryFolder folder;
  EXPECT_EQ(readMaterialLibrary(folder.path() / "none").error().kind, ErrorKind::file_system);
  EXPECT_THAT(readMaterialLibrary(folder.path()).error().message, HasSubstr("no material library"));
  folder.write("list.json", "[]");
  EXPECT_THAT(readMaterialLibrary(folder.path()).error().message, HasSubstr("must be an object"));
}

TEST(BadLibraries, OfSourcesThatAreWrongAreRefusedWithTheirPlace) {
  const TemporaryFolder folder;
  for (const auto& [text, source, message] :
       {std::tuple{
            R"({"sources": [{"id": "a", "text": "A", "licence": "own"}, {"id": "a", "text": "B", "licence": "own"}]})",
            "s.json /sources/1/id", "already exists"},
        {R"({"sources": [{"id": "a", "text": "A"}]})", "s.json /sources/0/licence", "missing"},
        {R"({"sources": {}})", "s.json /sources", "list"},
        {R"({"material": []})", "s.json /material", "unknown key"}}) {
    folder.write("s.json", text);
    const auto library = readMaterialLibrary(folder.path());
    ASSERT_FALSE(library.has_value()) << text;
    EXPECT_EQ(library.error().source, source);
    EXPECT_THAT(library.error().message, HasSubstr(message));
  }
}

TEST(BadLibraries, EmptyOrBinaryAreNamed) {
  const TemporaryFolder folder;
  folder.write("e.json", "");
  EXPECT_EQ(readMaterialLibrary(folder.path()).error().source, "e.json line 1");
  folder.write("e.json", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16));
  EXPECT_THAT(readMaterialLibrary(folder.path()).error().message, HasSubstr("not JSON"));
  folder.write("e.json", "{}");
  EXPECT_THAT(readOwnMaterials(folder.path() / "e.json", SOURCE_DIR "/materials/library").error().message,
              HasSubstr("no material"));
}

TEST(OwnMaterials, MayReferToShippedSourcesAndStandInForShippedMaterials) {
  const TemporaryFolder folder;
  const auto file = folder.write("own.json", R"({"materials": [
    {"id": "bark", "label": "My bark", "reflectance": [[905, 0.4]],
      "source": {"reflectance": "measured: [usgs] my bark"}},
    {"id": "brick_new_wet", "label": "Wet", "wet_of": "brick_red_bare", "source": {"wet_of": "unsourced"}}]})");
  const auto own = orThrow(readOwnMaterials(file, SOURCE_DIR "/materials/library"));
  ASSERT_EQ(own.size(), 2U);
  EXPECT_EQ(own[0].sources[0].licence, "US public domain");
  const auto library = withOwn(shippedLibrary(), own);
  EXPECT_EQ(library.size(), shippedLibrary().size() + 1);
  for (const auto& m : library) EXPECT_TRUE(m.id != "bark" || m.label == "My bark");
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
        BadRule{R"({"assign": "bark"})", "r.json /rules/1", "match everything"},
        BadRule{R"({"material": "a||b", "assign": "bark"})", "r.json /rules/1/material", "empty pattern"},
        BadRule{R"({"material": "", "assign": "bark"})", "r.json /rules/1/material", "empty"},
        BadRule{R"({"material": 3, "assign": "bark"})", "r.json /rules/1/material", "text"},
        BadRule{R"({"colour": "red|mauve", "assign": "bark"})", "r.json /rules/1/colour", "'mauve' is not a colour"},
        BadRule{R"({"material": "x", "assign": "bark", "hidden": 1})", "r.json /rules/1/hidden", "true or false"},
        BadRule{R"({"ifc_class": "x", "assign": "bark", "hidden": true})", "r.json /rules/1/hidden",
                "requires a pattern"},
        BadRule{R"({"material": "{stone}", "assign": "bark"})", "r.json /rules/1/material",
                "{stone}, which does not exist"},
        BadRule{R"({"material": "{stone", "assign": "bark"})", "r.json /rules/1/material", "brace"},
        BadRule{R"({"material": "a&&b", "assign": "bark"})", "r.json /rules/1/material", "empty pattern"},
        BadRule{R"({"material": "!", "assign": "bark"})", "r.json /rules/1/material", "empty pattern"},
        BadRule{R"({"metallic": [0.5, 0.2], "assign": "bark"})", "r.json /rules/1/metallic/1", "0.2"},
        BadRule{R"({"metallic": 1, "assign": "bark"})", "r.json /rules/1/metallic", "[from, to]"},
        BadRule{R"({"material": "x", "assign": "bark", "confidence": 2})", "r.json /rules/1/confidence",
                "a number from 0 to 1"},
        BadRule{R"({"class": "IfcWall", "assign": "bark"})", "r.json /rules/1/class", "unknown key"}}) {
    const auto rules = readAssignmentRules(folder.write("r.json", good + text + "]}"), shippedLibrary());
    ASSERT_FALSE(rules.has_value()) << text;
    EXPECT_EQ(rules.error().kind, ErrorKind::unusable);
    EXPECT_EQ(rules.error().source, source);
    EXPECT_THAT(rules.error().message, HasSubstr(message));
  }
  EXPECT_EQ(readAssignmentRules(folder.path() / "none.json", shippedLibrary()).error().kind, ErrorKind::file_system);
}

TEST(BadRules, InTheRestOfTheFileAreRefusedWithTheirPlace) {
  const TemporaryFolder folder;
  for (const auto& [text, source, message] :
       {BadRule{"", "r.json line 1", "not JSON"}, BadRule{"\x01\x02\xff", "r.json line 1", "not JSON"},
        BadRule{"[]", "r.json", "object"}, BadRule{"{}", "r.json /rules", "missing"},
        BadRule{R"({"rules": 1})", "r.json /rules", "list"},
        BadRule{R"({"rules": [], "then": "others"})", "r.json /then", "default"},
        BadRule{R"({"rules": [], "words": []})", "r.json /words", "object"},
        BadRule{R"({"rules": [], "words": {"a": []}})", "r.json /words/a", "list of texts"},
        BadRule{R"({"rules": [], "words": {"a": ["x|y"]}})", "r.json /words/a/0", "a single word"},
        BadRule{R"({"rules": [], "implausible": [{"assigned": "bark"}]})", "r.json /implausible/0/why", "missing"},
        BadRule{R"({"rules": [], "words": {"glass": ["tumbler"]}, "then": "default"})", "r.json /words/glass",
                "another name"}}) {
    const auto rules =
        readAssignmentRules(folder.write("r.json", text), shippedLibrary(), SOURCE_DIR "/materials/rules/default.json");
    ASSERT_FALSE(rules.has_value()) << text;
    EXPECT_EQ(rules.error().source, source);
    EXPECT_THAT(rules.error().message, HasSubstr(message));
  }
}

TEST(BadRules, ByTheMillionOrNestedDeeplyEndInAnErrorNotInAWait) {
  const TemporaryFolder folder;
  std::string many = R"({"rules": [)";
  for (int i = 0; i < 1'000'000; ++i) many += R"({"name":"a","assign":"bark"},)";
  EXPECT_THAT(readAssignmentRules(folder.write("r.json", many), shippedLibrary()).error().message, HasSubstr("1 MB"));
  std::string some = R"({"rules": [{"name":"a","assign":"bark"})";
  for (int i = 0; i < 20'000; ++i) some += R"(,{"name":"a","assign":"bark"})";
  EXPECT_THAT(readAssignmentRules(folder.write("r.json", some + "]}"), shippedLibrary()).error().message,
              HasSubstr("more than 10000 rules"));
  EXPECT_FALSE(readAssignmentRules(folder.write("r.json", std::string(900'000, '[')), shippedLibrary()).has_value());
}

TEST(OwnRules, ComeBeforeTheDefaultOnesAndMayUseTheirWords) {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "mine.json", R"({"rules": [{"material": "{brick}", "assign": "marble_white_weathered"}], "then": "default"})");
  const auto rules = orThrow(readAssignmentRules(file, shippedLibrary(), SOURCE_DIR "/materials/rules/default.json"));
  EXPECT_EQ(rules.own, 1U);
  Builder b;
  b.product("IfcWall", "", {b.surface("Backstein"), b.surface("Beton")});
  const auto result = b.assignBy(rules);
  EXPECT_EQ(materialId(result, 0, 0), "marble_white_weathered");
  EXPECT_EQ(materialId(result, 0, 1), "concrete_construction");
  EXPECT_EQ(result.assignment.surfaces[0].reason, "material 'Backstein' (backstein), rule 0 of mine.json");
}

TEST(OwnRules, ThatDecideNothingAreAFinding) {
  const TemporaryFolder folder;
  const auto file =
      folder.write("idle.json", R"({"rules": [{"material": "unobtainium", "assign": "bark"}], "then": "default"})");
  const auto rules = orThrow(readAssignmentRules(file, shippedLibrary(), SOURCE_DIR "/materials/rules/default.json"));
  Builder b;
  b.product("IfcWall", "", {b.surface("Beton")});
  const auto findings = b.assignBy(rules).report.findings;
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].kind, "idle-rules");
  EXPECT_EQ(findings[0].source, "rule 0 of idle.json");
}

}  // namespace
}  // namespace standpoint
