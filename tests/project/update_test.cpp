// SPDX-License-Identifier: GPL-3.0-or-later
// A changed model in place of the old one: what the user made stays, what changed is told.
#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>

#include "project/storage/project_files.h"
#include "project/storage/session.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

struct Wall {
  std::string global_id, name;
  double length = 4, y = 0;
  std::string fire = "F30", material = "Brick";
};

// An IFC of walls of `length` × 0.3 × 3 m; `first` shifts all numbers, as another export of the same model does.
std::string model(const std::vector<Wall>& walls, int first = 100) {
  std::string text =
      "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\nFILE_SCHEMA(('IFC4'"
      "));\nENDSEC;\nDATA;\n"
      "#1=IFCCARTESIANPOINT((0.,0.,0.));\n#2=IFCAXIS2PLACEMENT3D(#1,$,$);\n#4=IFCDIRECTION((0.,0.,1.));\n#6="
      "IFCCARTESIANPOINT((0.,0.));\n#7=IFCAXIS2PLACEMENT2D(#6,$);\n"
      "#10=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n#11=IFCUNITASSIGNMENT((#10));\n#12=IFCGEOMETRICREPRESENTATIONCONTEXT($"
      ",'Model',3,1.E-5,#2,$);\n"
      "#20=IFCPROJECT('p',$,'House',$,$,$,$,(#12),#11);\n";
  int n = first;
  for (const Wall& w : walls) {
    const auto id = [&](int k) { return "#" + std::to_string(n + k); };
    text += id(0) + "=IFCWALL('" + w.global_id + "',$,'" + w.name + "',$,$," + id(6) + "," + id(1) + ",$,$);\n" +
            id(1) + "=IFCPRODUCTDEFINITIONSHAPE($,$,(" + id(2) + "));\n" + id(2) +
            "=IFCSHAPEREPRESENTATION(#12,'Body','SweptSolid',(" + id(4) + "));\n" + id(3) +
            "=IFCRECTANGLEPROFILEDEF(.AREA.,$,#7," + std::to_string(w.length) + ",0.3);\n" + id(4) +
            "=IFCEXTRUDEDAREASOLID(" + id(3) + ",$,#4,3.);\n" + id(6) + "=IFCLOCALPLACEMENT($," + id(7) + ");\n" +
            id(7) + "=IFCAXIS2PLACEMENT3D(" + id(8) + ",$,$);\n" + id(8) + "=IFCCARTESIANPOINT((0.," +
            std::to_string(w.y) + ",0.));\n" + id(9) + "=IFCPROPERTYSINGLEVALUE('FireRating',$,IFCLABEL('" + w.fire +
            "'),$);\n" + id(10) + "=IFCPROPERTYSET('s',$,'Pset_WallCommon',$,(" + id(9) + "));\n" + id(11) +
            "=IFCRELDEFINESBYPROPERTIES('r',$,$,$,(" + id(0) + ")," + id(10) + ");\n" + id(12) + "=IFCMATERIAL('" +
            w.material + "',$,$);\n" + id(13) + "=IFCRELASSOCIATESMATERIAL('m',$,$,$,(" + id(0) + ")," + id(12) +
            ");\n";
    n += 20;
  }
  return text + "ENDSEC;\nEND-ISO-10303-21;\n";
}

const std::vector<Wall> kBefore = {{"a", "A"}, {"b", "B", 4, 2}, {"c", "C", 4, 4}, {"d", "D", 4, 6}};

json updated(const char* verb, const json& options) {
  Progress progress;
  const auto outcome = runOnDisk(*findVerb(verbs(), verb), options, progress);
  EXPECT_TRUE(outcome) << describe(outcome.error());
  return outcome ? outcome->answer : json();
}

class Update : public ::testing::Test {
 protected:
  json import(const std::vector<Wall>& walls, int first = 100, const json& more = {}) {
    std::ofstream(folder_.path() / "house.ifc") << model(walls, first);
    json options = {{"files", {(folder_.path() / "house.ifc").string()}}, {"output", project()}};
    if (!more.is_null()) options.update(more);
    return updated("import", options);
  }
  json update(const std::vector<Wall>& walls, int first = 1000) {
    return import(walls, first, {{"update", true}}).at("changes");
  }
  std::string project() const { return (folder_.path() / "p").string(); }
  Document document() const {
    Progress progress;
    return *loadProject(project(), progress);
  }
  std::string materialOf(const std::string& global_id) const {
    const Document d = document();
    const auto& assignment = d.materials->result.assignment;
    for (const auto& s : assignment.surfaces)
      if (d.imported->products[s.product].global_id == global_id)
        return s.material < 0 ? "" : assignment.materials[static_cast<std::size_t>(s.material)].id;
    return "no such product";
  }
  TemporaryFolder folder_;
};

TEST_F(Update, TheSameModelUnderOtherNumbersHasNotChanged) {
  import(kBefore);
  const json changes = update(kBefore);
  EXPECT_EQ(changes.at("counts"), json({{"added", 0},
                                        {"removed", 0},
                                        {"changed", 0},
                                        {"unchanged", 4},
                                        {"geometry", 0},
                                        {"material", 0},
                                        {"properties", 0}}));
}

TEST_F(Update, TellsWhatChangedByGlobalId) {
  import(kBefore);
  const json changes =
      update({{"a", "A", 4.001}, {"b", "B", 4, 2, "F90"}, {"c", "C", 4, 4, "F30", "Concrete"}, {"e", "E", 4, 8}});
  EXPECT_EQ(changes.at("counts"), json({{"added", 1},
                                        {"removed", 1},
                                        {"changed", 3},
                                        {"unchanged", 0},
                                        {"geometry", 1},
                                        {"material", 1},
                                        {"properties", 1}}));
  EXPECT_EQ(changes.at("added")[0].at("global_id"), "e");
  EXPECT_EQ(changes.at("removed")[0].at("global_id"), "d");
  const auto& changed = changes.at("changed");
  EXPECT_TRUE(changed[0].at("geometry"));
  EXPECT_EQ(changed[0].at("global_id"), "a");
  EXPECT_EQ(changed[1].at("properties"), json({"Pset_WallCommon.FireRating"}));
  EXPECT_TRUE(changed[2].at("material"));
}

TEST_F(Update, MaterialsFollowTheirProductsToOtherNumbers) {
  import(kBefore);
  updated("materials",
          {{"project", project()}, {"assign", {"#120=wood_hardwood", "c=carpet"}}});  // by number, and by GlobalId
  update({kBefore[2], kBefore[1], kBefore[0]}, 100);  // now #100 is c, #120 is b, #140 is a
  EXPECT_EQ(materialOf("b"), "wood_hardwood");
  EXPECT_EQ(materialOf("c"), "carpet");
  EXPECT_NE(materialOf("a"), "wood_hardwood");
  update({kBefore[1]}, 500);
  EXPECT_EQ(materialOf("b"), "wood_hardwood");
}

TEST_F(Update, MaterialsOfSingleFacesFollowTheirProducts) {
  import(kBefore);
  updated("materials",
          {{"project", project()}, {"assign", {"#120@0,0,1=carpet", "#100&material:Brick=bark"}}});  // of b, and of a
  update({kBefore[2], kBefore[1], kBefore[0]}, 100);  // now #120 is b again, and #140 is a
  const Document d = document();
  EXPECT_EQ(d.materials->overrides.at(1).selector, "#140&material:Brick");
  EXPECT_EQ(materialOf("a"), "bark");
  ASSERT_EQ(d.materials->result.assignment.faces.size(), 1U);
  EXPECT_EQ(d.imported->products[d.materials->result.assignment.faces[0].product].global_id, "b");
}

TEST_F(Update, AFaceAtAPointStaysWhereTheModelStillHasIt) {
  import(kBefore, 100, {{ "shift", "100,200,0" }});
  updated("materials", {{"project", project()}, {"assign", {"#120@0,1,0@0.5,2.15,1=carpet"}}});  // the north side of b
  update({kBefore[2], {"b", "B", 4, 2.05}, kBefore[0]});                                         // 5 cm further north
  const auto material = document().materials;
  EXPECT_EQ(material->overrides.at(0).selector, "#1020@0,1,0@0.5,2.15,1");
  const auto carpet = [](const MaterialChoice& choice) {
    for (const auto& use : choice.result.report.uses)
      if (use.material == "carpet") return use.area_m2;
    return 0.0;
  };
  EXPECT_NEAR(carpet(*material), 12, 1e-4);
  update({kBefore[2], {"b", "B", 4, 2.3}, kBefore[0]}, 3000);  // too far: it is kept, and a finding tells
  const auto lost = document().materials;
  EXPECT_EQ(lost->overrides.size(), 1U);
  EXPECT_EQ(carpet(*lost), 0);
  EXPECT_EQ(std::count_if(lost->result.report.findings.begin(), lost->result.report.findings.end(),
                          [](const MaterialFinding& f) { return f.kind == "selector"; }),
            1);
}

TEST_F(Update, WhatHasNoProductAnyMoreIsKeptAndListedAndComesBack) {
  import(kBefore);
  updated("materials", {{"project", project()}, {"assign", {"#160=carpet"}}});  // d
  const json changes = update({kBefore[0], kBefore[1]});
  ASSERT_EQ(changes.at("kept").size(), 1U);
  EXPECT_EQ(changes.at("kept")[0].at("product").at("global_id"), "d");
  EXPECT_EQ(changes.at("kept")[0].at("material"), "carpet");
  update(kBefore, 3000);
  EXPECT_EQ(materialOf("d"), "carpet");
}

TEST_F(Update, StationsAndTargetsStayWhereTheyWere) {
  import(kBefore, 100, {{ "shift", "100,200,0" }});
  updated("station", {{"project", project()}, {"add", "S1"}, {"at", {1, 1, 1.6}}});
  updated("target", {{"project", project()}, {"add", "T1"}, {"at", {2, 1, 1}}});
  const Document before = document();
  update({kBefore[0], {"e", "E", 4, 5000}});
  const Document after = document();
  EXPECT_EQ(after.georeference->shift_m, before.georeference->shift_m);
  ASSERT_EQ(after.job->stations.size(), 1U);
  EXPECT_EQ(after.job->stations[0].true_pose.translation, before.job->stations[0].true_pose.translation);
  ASSERT_EQ(after.job->targets.size(), 1U);
  EXPECT_EQ(after.job->targets[0].centre, before.job->targets[0].centre);
}

TEST_F(Update, AMapPositionThatTheUserGaveStays) {
  import(kBefore);
  updated("georeference", {{"project", project()}, {"crs", "EPSG:25832"}, {"origin", {500000, 5400000, 10}}});
  update(kBefore);
  EXPECT_EQ(document().georeference->crs, "EPSG:25832");
  EXPECT_EQ(document().georeference->map_from_file->eastings_m, 500000);
}

TEST_F(Update, WithoutAProjectOrWithReplaceItIsRefused) {
  std::ofstream(folder_.path() / "house.ifc") << model(kBefore);
  Progress progress;
  const auto& verb = *findVerb(verbs(), "import");
  const json files = {(folder_.path() / "house.ifc").string()};
  EXPECT_FALSE(runOnDisk(verb, {{"files", files}, {"output", project()}, {"update", true}}, progress));
  import(kBefore);
  EXPECT_FALSE(
      runOnDisk(verb, {{"files", files}, {"output", project()}, {"update", true}, {"replace", true}}, progress));
}

TEST_F(Update, ProductsWithoutGlobalIdsAreKnownByTheirNames) {
  const auto obj = [&](const std::string& text) {
    std::ofstream(folder_.path() / "m.obj") << text;
    return json{(folder_.path() / "m.obj").string()};
  };
  const std::string a = "o A\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n",
                    b = "o B\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf -3 -2 -1\n",
                    c = "o C\nv 9 0 0\nv 9 1 0\nv 9 0 1\nf -3 -2 -1\n";
  updated("import", {{"files", obj(a + b)}, {"output", project()}});
  const json changes =
      updated("import", {{"files", obj(c + b)}, {"output", project()}, {"update", true}}).at("changes");
  EXPECT_EQ(changes.at("counts").at("unchanged"), 1);
  EXPECT_EQ(changes.at("added")[0].at("name"), "C");
  EXPECT_EQ(changes.at("removed")[0].at("name"), "A");
}

TEST_F(Update, WhatWasExcludedStaysSoByItsGlobalId) {
  import(kBefore);
  updated("treat", {{"project", project()}, {"products", {"#120"}}, {"as", "excluded"}});
  updated("treat", {{"project", project()}, {"products", {"c"}}, {"as", "excluded"}});
  update({{"a", "A"}, {"b", "B", 4, 2}, {"d", "D", 4, 6}}, 5000);
  std::vector<std::string> excluded;
  const Document fewer = document();
  for (const auto& p : fewer.imported->products)
    if (p.excluded) excluded.push_back(p.global_id);
  EXPECT_EQ(excluded, std::vector<std::string>{"b"});
  update(kBefore, 9000);  // what was gone comes back as it was treated
  const Document all = document();
  for (const auto& p : all.imported->products)
    EXPECT_EQ(p.excluded, p.global_id == "b" || p.global_id == "c") << p.global_id;
}

TEST_F(Update, LightensByTheSameRulesAgain) {
  import(kBefore);
  updated("optimize", {{"project", project()}, {"lod", "default"}, {"surroundings", {"name:D"}}});
  update({{"a", "A"}, {"d", "D", 4, 6}, {"e", "E", 4, 8}}, 5000);
  const Document d = document();
  ASSERT_TRUE(d.simplified);
  ASSERT_EQ(d.simplified->levels.size(), d.imported->products.size());
  for (std::size_t i = 0; i < d.simplified->levels.size(); ++i)
    EXPECT_EQ(d.simplified->levels[i], d.imported->products[i].name == "D" ? "LoD 200" : "LoD 300");
}

}  // namespace
}  // namespace standpoint
