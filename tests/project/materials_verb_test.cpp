// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/face_normal.h"
#include "core/face_patches.h"
#include "project/materials/materials_json.h"
#include "project/storage/project_files.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using testing::HasSubstr;
namespace fs = std::filesystem;

Document done(const Document& d, const json& options, json* answer = nullptr) {
  auto outcome = run("materials", d, options);
  if (!outcome) ADD_FAILURE() << outcome.error().source << ": " << outcome.error().message;
  if (answer != nullptr) *answer = outcome->answer;
  return std::move(outcome)->document;
}

std::string write(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
  std::ofstream(folder.path() / name, std::ios::binary) << text;
  return (folder.path() / name).string();
}

std::string materialOfProduct(const Document& d, const std::string& id) {
  const auto& assignment = d.materials->result.assignment;
  for (const auto& s : assignment.surfaces)
    if (d.imported->products[s.product].id == id)
      return s.material < 0 ? "" : assignment.materials[static_cast<std::size_t>(s.material)].id;
  return "no such product";
}

// By the triangles of a product in the environment that is shown and scanned.
double areaOf(const Document& d, const std::string& material, std::uint32_t product) {
  const auto& assignment = d.materials->result.assignment;
  const AssignedTriangles triangles(*d.environment(), assignment);
  double area = 0;
  for (std::uint32_t i = 0; i < d.environment()->instances.size(); ++i) {
    const auto& instance = d.environment()->instances[i];
    const Mesh& mesh = *d.environment()->meshes[instance.mesh];
    for (std::uint32_t t = 0; t < mesh.triangles.size() && instance.product == product; ++t)
      if (const auto m = triangles.materialOf(i, t);
          m >= 0 && assignment.materials[static_cast<std::size_t>(m)].id == material)
        area += placedArea(mesh, mesh.triangles[t], instance.world_from_mesh);
  }
  return area;
}

const char* const kOwn = R"({"sources": [{"id": "lab", "text": "Own laboratory", "licence": "own"}], "materials": [
  {"id": "concrete_construction", "label": "Our concrete", "reflectance": [[532, 0.5], [1550, 0.6]],
    "source": {"reflectance": "measured: [lab] no 7"}},
  {"id": "our_panel", "label": "Our panel", "reflectance": [[905, 0.2]],
    "source": {"reflectance": "unsourced: a guess"}}]})";

TEST(MaterialsVerb, KeepsOwnMaterialsInTheProjectAndTellsWhereAChangedOneIsUsed) {
  const TemporaryFolder folder;
  json answer;
  const auto before = done(twoStoreyDocument(), json::object());
  const double dry_concrete = before.materials->result.report.uses.at(0).area_m2;
  auto d =
      done(before, {{"library", {write(folder, "own.json", kOwn)}}, {"assign", {"#none=our_panel", "table=our_panel"}}},
           &answer);
  EXPECT_EQ(answer.at("libraries")[0].at("added"), json({"our_panel"}));
  EXPECT_EQ(answer.at("libraries")[0].at("changed"), json({"concrete_construction"}));
  const auto& used = answer.at("libraries")[0].at("used")[0];
  EXPECT_EQ(used.at("material"), "concrete_construction");
  EXPECT_LT(used.at("area_m2").get<double>(), dry_concrete);  // the table is of something else now
  EXPECT_EQ(used.at("products").size(), 11U);
  fs::remove(folder.path() / "own.json");
  Progress progress;
  ASSERT_TRUE(saveProject(d, folder.path() / "p", progress));
  const auto back = loadProject(folder.path() / "p", progress);
  ASSERT_TRUE(back) << describe(back.error());
  EXPECT_EQ(back->materials->own, d.materials->own);
  d = done(*back, {{"where", "our_panel"}}, &answer);
  EXPECT_EQ(answer.at("where").at("products")[0].at("id"), "table");
  EXPECT_EQ(d.materials->result.assignment.materials.at(0).label, "Our concrete");
  d = done(d, {{"forget", {"concrete_construction"}}});
  EXPECT_EQ(d.materials->result.assignment.materials.at(0).label, "Concrete, cast, slightly soiled");
  const auto wrong = run("materials", d, {{"forget", {"our_panel"}}});
  ASSERT_FALSE(wrong);  // it is assigned
  EXPECT_EQ(wrong.error().source, "#none");
}

TEST(MaterialsVerb, KeepsOwnRulesWhenTheirFileIsGone) {
  const TemporaryFolder folder;
  const auto file = write(folder, "mine.json",
                          R"({"rules": [{"ifc_class": "IfcFurniture", "assign": "carpet"}], "then": "default"})");
  auto d = done(twoStoreyDocument(), {{"rules", file}});
  EXPECT_EQ(materialOfProduct(d, "table"), "carpet");
  fs::remove(file);
  Progress progress;
  ASSERT_TRUE(saveProject(d, folder.path() / "p", progress));
  d = done(*loadProject(folder.path() / "p", progress), {{"assign", {"south0=bark"}}});
  EXPECT_EQ(materialOfProduct(d, "table"), "carpet");
  EXPECT_EQ(materialOfProduct(d, "south0"), "bark");
  d = done(d, {{"rules", "default"}});
  EXPECT_EQ(materialOfProduct(d, "table"), "concrete_construction");
}

TEST(MaterialsVerb, TakesBackWhatWasAssigned) {
  auto d = done(twoStoreyDocument(), {{"assign", {"south0=bark"}}});
  d = done(d, {{"assign", {"south0=rules"}}});
  EXPECT_EQ(materialOfProduct(d, "south0"), "concrete_construction");
  EXPECT_TRUE(d.materials->overrides.empty());
  EXPECT_FALSE(run("materials", d, {{"assign", {"south0=rules"}}}));
}

TEST(MaterialsVerb, AcceptsAFindingBecauseOfSomethingUntilItsCauseChanges) {
  json answer;
  auto d = done(twoStoreyDocument(), {{"assign", {"slab0=mirror_household"}}}, &answer);
  ASSERT_EQ(answer.at("findings").size(), 2U) << answer.at("findings");  // implausible, and one name two ways
  const std::string id = answer.at("findings")[0].at("id");
  EXPECT_THAT(id, HasSubstr("implausible-"));
  EXPECT_FALSE(run("materials", d, {{"accept", {id}}}));  // because of what?
  EXPECT_FALSE(run("materials", d, {{"accept", {"implausible-00000000"}}, {"because", "x"}}));
  d = done(d, {{"accept", {id}}, {"because", "an art gallery"}}, &answer);
  EXPECT_EQ(answer.at("open"), 1);
  EXPECT_EQ(answer.at("findings")[1].at("accepted"), "an art gallery");  // what is open stands first
  const TemporaryFolder folder;
  Progress progress;
  ASSERT_TRUE(saveProject(d, folder.path() / "p", progress));
  d = done(*loadProject(folder.path() / "p", progress), json::object(), &answer);
  EXPECT_EQ(answer.at("open"), 1);
  done(d, {{"assign", {"slab1=mirror_household"}}}, &answer);
  EXPECT_EQ(answer.at("open"), 2);  // a second such floor
  done(d, {{"reopen", {id}}}, &answer);
  EXPECT_EQ(answer.at("open"), 2);
}

TEST(MaterialsVerb, OffersRemediesThatTheVerbTakesAsTheyAre) {
  json answer;
  auto d = done(twoStoreyDocument(), {{"assign", {"slab0=mirror_household"}}}, &answer);
  const json findings = answer.at("findings");
  for (const auto& f : findings)
    if (f.at("kind") == "two-ways") d = done(d, f.at("remedies")[0].at("options"), &answer);
  for (const auto& f : answer.at("findings")) EXPECT_NE(f.at("kind"), "two-ways");
}

TEST(MaterialsVerb, TellsReasonsCoverageAndTheInstrumentsWavelength) {
  json answer;
  const TemporaryFolder folder;
  auto d = done(
      twoStoreyDocument(),
      {{"instrument", "leica-rtc360"}, {"library", {write(folder, "own.json", kOwn)}}, {"assign", {"table=our_panel"}}},
      &answer);
  EXPECT_THAT(answer.at("reasons")[0].at("reason").get<std::string>(),
              testing::MatchesRegex("material 'Concrete' \\(concrete\\), rule [0-9]+ of default.json"));
  EXPECT_EQ(answer.at("reasons")[0].at("surfaces").size(), 11U);
  EXPECT_EQ(answer.at("reasons")[1].at("confidence"), 1);
  EXPECT_EQ(answer.at("by_class")[0].at("class"), "IfcWall");
  EXPECT_EQ(answer.at("by_class")[0].at("coverage"), 1);
  bool found = false;
  for (const auto& f : answer.at("findings")) found = found || f.at("kind") == "no-data";
  EXPECT_TRUE(found);  // our panel has a figure at 905 nm only
  EXPECT_FALSE(run("materials", d, {{"instrument", "leica-rtc999"}}));
}

TEST(MaterialsVerb, WritesAReportToPrintAndATable) {
  const TemporaryFolder folder;
  auto d = done(twoStoreyDocument(),
                {{"assign", {"table=retroreflective_foil"}}, {"report", (folder.path() / "r.html").string()}});
  done(d, {{"report", (folder.path() / "r.csv").string()}});
  const auto text = [&](const char* name) {
    std::ifstream in(folder.path() / name);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_THAT(text("r.html"), HasSubstr("Concrete, cast, slightly soiled"));
  EXPECT_THAT(text("r.html"), HasSubstr("ECOSTRESS"));
  EXPECT_THAT(text("r.html"), HasSubstr("Retroreflective foil"));  // as a finding
  EXPECT_THAT(text("r.csv"), HasSubstr("\nconcrete_construction,\"Concrete, cast, slightly soiled\","));
  EXPECT_FALSE(run("materials", d, {{"report", (folder.path() / "r.pdf").string()}}));
}

TEST(MaterialsVerb, TellsPeopleWhatIsThereAndHowToGoOn) {
  const auto d = twoStoreyDocument();  // slabs of 28 m² each side and rim: 3 · 52 m², walls, a table of 5 m²
  const auto outcome = run("materials", d, {{"assign", {"table=retroreflective_foil", "slab0=mirror_household"}}});
  ASSERT_TRUE(outcome) << describe(outcome.error());
  const auto& text = outcome->text;
  EXPECT_THAT(text, HasSubstr("\n  mirror_household"));
  EXPECT_THAT(text, HasSubstr("52.0 m²"));  // 2 · 6 · 4 + 2 · 0.2 · (6 + 4)
  EXPECT_THAT(text, HasSubstr("\n  (none)"));
  EXPECT_THAT(text, HasSubstr("5.0 m²"));  // 2 · 1 · 1 + 4 · 0.75
  EXPECT_THAT(text, HasSubstr("  5.0 m² of 5.0 m² of IfcFurniture\n"));
  EXPECT_THAT(text, HasSubstr("    1 implausible"));
  EXPECT_THAT(text, HasSubstr("--because"));
  const auto& first = d.imported->products.back();
  EXPECT_EQ(first.name, "table");
  for (const auto& f : outcome->answer.at("findings")) {  // each kind's first can be named
    if (f.at("kind") == "gap") {
      EXPECT_THAT(text, HasSubstr(f.at("id").get<std::string>()));
    }
  }
}

TEST(MaterialsVerb, QuotesSelectorsForTheShell) {
  Document d = twoStoreyDocument();
  auto e = std::make_shared<Environment>(*d.imported);
  e->surfaces[0].name = "Joe's stuff";
  d.imported = e;
  const auto outcome = run("materials", d, json::object());
  ASSERT_TRUE(outcome);
  EXPECT_THAT(outcome->text, HasSubstr("'\\''s stuff"));
}

TEST(MaterialsVerb, OpensProjectsOfBeforeFindingsAndSourcesHadParts) {
  const json old = {{"rules_file", ""},
                    {"overrides", json::array()},
                    {"materials",
                     {{{"id", "a"},
                       {"label", "A"},
                       {"reflectance", {{532, 0.3}}},
                       {"roughness_rad", 0},
                       {"gloss_slope", 0},
                       {"index_of_refraction", 0},
                       {"thickness_m", 0},
                       {"transmittance", json::array()},
                       {"source", {"reflectance: measured: me"}}}}},
                    {"surfaces", {{0, 0, 0, "rule /3"}}},
                    {"report",
                     {{"coverage", 1},
                      {"area_m2", 2},
                      {"uses", {{{"material", "a"}, {"area_m2", 2}, {"products", {0}}}}},
                      {"findings", {{"note", "#1", "look"}}}}}};
  const auto choice = materialsFrom(old);
  EXPECT_EQ(choice.result.assignment.surfaces.at(0).reason, "rule /3");
  EXPECT_EQ(choice.result.assignment.materials.at(0).sources.at(0).text, "measured: me");
  EXPECT_EQ(choice.result.report.findings.at(0).message, "look");
  EXPECT_EQ(materialsToJson(materialsFrom(materialsToJson(choice))), materialsToJson(choice));
}

TEST(MaterialsVerb, KeepsFacesThroughTheDiskAndTheOptimizer) {
  const TemporaryFolder folder;
  Progress progress;
  auto d = done(twoStoreyDocument(), {{"assign", {"slab0@0,0,1=carpet"}}});
  ASSERT_TRUE(saveProject(d, folder.path() / "p", progress));
  d = *loadProject(folder.path() / "p", progress);
  ASSERT_EQ(d.materials->result.assignment.faces.size(), 1U);
  const auto lighter = run("optimize", d, json::object());
  ASSERT_TRUE(lighter) << describe(lighter.error());
  d = done(lighter->document, json::object());
  EXPECT_NEAR(areaOf(d, "carpet", 0), 24, 1e-4);
  EXPECT_NEAR(areaOf(d, "concrete_construction", 0), 24 + 2 * 0.2 * (6 + 4), 1e-4);
}

// A floor of 6 by 4 m that is two meshes' worth of triangles: itself, and a table top of 1 m² that looks up as it does.
Document withTableInTheSlab() {
  Document d = twoStoreyDocument();
  auto e = std::make_shared<Environment>(*d.imported);
  auto mesh = std::make_shared<Mesh>(*e->meshes[0]);
  const Mesh& table = *e->meshes[e->instances.back().mesh];
  for (const auto& t : table.triangles) mesh->triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  for (const auto& p : table.positions) mesh->positions.emplace_back(p + Eigen::Vector3f(2, 2, 0.2F));
  mesh->surface_of_triangle.assign(mesh->triangles.size(), 0);
  e->meshes[0] = mesh;
  d.imported = e;
  return d;
}

TEST(MaterialsVerb, KeepsAFaceAtAPointThroughTheDiskAndTheOptimizer) {
  const TemporaryFolder folder;
  Progress progress;
  auto d = done(withTableInTheSlab(), {{"assign", {"slab0@0,0,1@500002.5,5600002.5,0.75=carpet"}}});  // the table's top
  EXPECT_NEAR(areaOf(d, "carpet", 0), 1, 1e-4);
  ASSERT_TRUE(saveProject(d, folder.path() / "p", progress));
  d = *loadProject(folder.path() / "p", progress);
  EXPECT_NEAR(areaOf(d, "carpet", 0), 1, 1e-4);
  const auto lighter = run("optimize", d, {{"max-deviation", 0.05}});
  ASSERT_TRUE(lighter) << describe(lighter.error());
  EXPECT_NE(lighter->document.environment(), d.imported);
  EXPECT_NEAR(areaOf(lighter->document, "carpet", 0), 1, 1e-4);  // by what was assigned before
  EXPECT_NEAR(areaOf(done(lighter->document, json::object()), "carpet", 0), 1, 1e-4);
}

TEST(MaterialsVerb, WritesAFaceAtAPointIntoWhatItExports) {
  const TemporaryFolder folder;
  const auto d = done(withTableInTheSlab(), {{"assign", {"slab0@0,0,1@500002.5,5600002.5,0.75=carpet"}}});
  const auto file = (folder.path() / "m.glb").string();
  ASSERT_TRUE(run("export", d, {{"output", file}}));
  auto back = run("import", Document(), {{"files", {file}}});
  ASSERT_TRUE(back) << describe(back.error());
  back->document = done(back->document, json::object());
  const auto& uses = back->document.materials->result.report.uses;
  const auto carpet =
      std::find_if(uses.begin(), uses.end(), [](const MaterialUse& u) { return u.material == "carpet"; });
  ASSERT_NE(carpet, uses.end());
  EXPECT_NEAR(carpet->area_m2, 1, 1e-4);
}

}  // namespace
}  // namespace standpoint
