// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "core/face_normal.h"
#include "project/storage/project_files.h"
#include "project/storage/session.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;

TEST(Layers, AWallOfBrickOutsideAndPlasterInsideHasTwoPhysicalMaterialsWithTheirReasons) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "wall.ifc")
      << "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\nFILE_SCHEMA(('"
         "IFC2X3'));\nENDSEC;\nDATA;\n"
         "#1=IFCCARTESIANPOINT((0.,0.,0.));\n#2=IFCAXIS2PLACEMENT3D(#1,$,$);\n#3=IFCLOCALPLACEMENT($,#2);\n#4="
         "IFCDIRECTION((0.,0.,1.));\n#6=IFCCARTESIANPOINT((0.,0.));\n#7=IFCAXIS2PLACEMENT2D(#6,$);\n"
         "#10=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n#11=IFCUNITASSIGNMENT((#10));\n#12="
         "IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-5,#2,$);\n#20=IFCPROJECT('p',$,'House',$,$,$,$,(#12),#11);"
         "\n"
         "#30=IFCRECTANGLEPROFILEDEF(.AREA.,$,#7,4.,0.3);\n#31=IFCEXTRUDEDAREASOLID(#30,#2,#4,3.);\n#32="
         "IFCSHAPEREPRESENTATION(#12,'Body','SweptSolid',(#31));\n#33=IFCPRODUCTDEFINITIONSHAPE($,$,(#32));\n"
         "#34=IFCWALLSTANDARDCASE('w',$,'W',$,$,#3,#33,$);\n#40=IFCMATERIAL('Brick');\n#41=IFCMATERIAL('Insulation');"
         "\n#42=IFCMATERIAL('Plaster');\n"
         "#43=IFCMATERIALLAYER(#40,0.115,$);\n#44=IFCMATERIALLAYER(#41,0.17,$);\n#45=IFCMATERIALLAYER(#42,0.015,$);\n#"
         "46=IFCMATERIALLAYERSET((#43,#44,#45),$);\n"
         "#47=IFCMATERIALLAYERSETUSAGE(#46,.AXIS2.,.POSITIVE.,-0.15);\n#48=IFCRELASSOCIATESMATERIAL('m',$,$,$,(#34),#"
         "47);\nENDSEC;\nEND-ISO-10303-21;\n";
  Progress progress;
  const auto imported = runOnDisk(
      *findVerb(verbs(), "import"),
      {{"files", {(folder.path() / "wall.ifc").string()}}, {"output", (folder.path() / "p").string()}}, progress);
  ASSERT_TRUE(imported) << describe(imported.error());
  std::map<std::string, double> areas;  // as --json tells them
  for (const auto& row : imported->answer.at("products")[0].at("surfaces")) areas[row.at("name")] = row.at("area");
  EXPECT_NEAR(areas["Brick"], 12 + 2 * 0.115 * (3 + 4), 1e-4);
  EXPECT_NEAR(areas["Plaster"], 12 + 2 * 0.015 * (3 + 4), 1e-4);
  const auto assigned =
      runOnDisk(*findVerb(verbs(), "materials"), {{"project", (folder.path() / "p").string()}}, progress);
  ASSERT_TRUE(assigned) << describe(assigned.error());
  const auto& environment = *assigned->document.imported;
  const auto& assignment = assigned->document.materials->result.assignment;
  std::map<std::string, std::pair<std::string, std::string>> of_surface;
  for (const auto& s : assignment.surfaces)
    if (s.material >= 0)
      of_surface[environment.surfaces[s.surface].name] = {assignment.materials[static_cast<std::size_t>(s.material)].id,
                                                          s.reason};
  ASSERT_EQ(of_surface.size(), 3U);
  EXPECT_EQ(of_surface["Brick"].first.substr(0, 5), "brick");
  EXPECT_NE(of_surface["Brick"].second.find("brick"), std::string::npos) << of_surface["Brick"].second;
  EXPECT_EQ(of_surface["Plaster"].first.substr(0, 7), "plaster");
  EXPECT_NE(of_surface["Plaster"].second.find("plaster"), std::string::npos) << of_surface["Plaster"].second;
}

// A wall of 4 by 3 m: 115 mm of brick at y = -0.15, 165 mm of core, 20 mm of plaster; with a window's opening of 1 by 1
// m.
std::string wallWithOpening(const std::string& core, const std::string& core_thickness = "0.165") {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\nFILE_SCHEMA(('"
         "IFC2X3'));\nENDSEC;\nDATA;\n"
         "#1=IFCCARTESIANPOINT((0.,0.,0.));\n#2=IFCAXIS2PLACEMENT3D(#1,$,$);\n#3=IFCLOCALPLACEMENT($,#2);\n#4="
         "IFCDIRECTION((0.,0.,1.));\n#6=IFCCARTESIANPOINT((0.,0.));\n#7=IFCAXIS2PLACEMENT2D(#6,$);\n"
         "#10=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n#11=IFCUNITASSIGNMENT((#10));\n#12="
         "IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-5,#2,$);\n#20=IFCPROJECT('p',$,'House',$,$,$,$,(#12),#11);"
         "\n"
         "#30=IFCRECTANGLEPROFILEDEF(.AREA.,$,#7,4.,0.3);\n#31=IFCEXTRUDEDAREASOLID(#30,#2,#4,3.);\n#32="
         "IFCSHAPEREPRESENTATION(#12,'Body','SweptSolid',(#31));\n#33=IFCPRODUCTDEFINITIONSHAPE($,$,(#32));\n"
         "#34=IFCWALLSTANDARDCASE('w',$,'W',$,$,#3,#33,$);\n#40=IFCMATERIAL('Brick');\n#41=IFCMATERIAL('" +
         core +
         "');\n#42=IFCMATERIAL('Plaster');\n"
         "#43=IFCMATERIALLAYER(#40,0.115,$);\n#44=IFCMATERIALLAYER(#41," +
         core_thickness +
         ",$);\n#45=IFCMATERIALLAYER(#42,0.02,$);\n#46=IFCMATERIALLAYERSET((#43,#44,#45),$);\n"
         "#47=IFCMATERIALLAYERSETUSAGE(#46,.AXIS2.,.POSITIVE.,-0.15);\n#48=IFCRELASSOCIATESMATERIAL('m',$,$,$,(#34),#"
         "47);\n"
         "#50=IFCRECTANGLEPROFILEDEF(.AREA.,$,#7,1.,1.);\n#51=IFCCARTESIANPOINT((0.,0.,1.));\n#52=IFCAXIS2PLACEMENT3D(#"
         "51,$,$);\n#53=IFCEXTRUDEDAREASOLID(#50,#52,#4,1.);\n"
         "#54=IFCSHAPEREPRESENTATION(#12,'Body','SweptSolid',(#53));\n#55=IFCPRODUCTDEFINITIONSHAPE($,$,(#54));\n#56="
         "IFCOPENINGELEMENT('o',$,'O',$,$,#3,#55,$);\n#57=IFCRELVOIDSELEMENT('v',$,$,$,#34,#56);\n"
         "ENDSEC;\nEND-ISO-10303-21;\n";
}

struct WallAreas {
  std::map<std::string, double> outside, inside, reveal;  // by the physical material's first word
};

WallAreas wallAreas(const std::string& ifc) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "wall.ifc") << ifc;
  Progress progress;
  const auto imported = runOnDisk(
      *findVerb(verbs(), "import"),
      {{"files", {(folder.path() / "wall.ifc").string()}}, {"output", (folder.path() / "p").string()}}, progress);
  const auto assigned =
      runOnDisk(*findVerb(verbs(), "materials"), {{"project", (folder.path() / "p").string()}}, progress);
  EXPECT_TRUE(imported && assigned);
  const auto& environment = *assigned->document.imported;
  const auto& assignment = assigned->document.materials->result.assignment;
  WallAreas areas;
  for (const auto& instance : environment.instances) {
    if (environment.products[instance.product].ifc_class != "IfcWallStandardCase") continue;
    const Mesh& mesh = *environment.meshes[instance.mesh];
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto material = materialOf(assignment, instance.product, mesh.surface_of_triangle[t]);
      const std::string id = material < 0 ? "" : assignment.materials[static_cast<std::size_t>(material)].id;
      const auto normal = placedNormal(mesh, mesh.triangles[t], instance.world_from_mesh);
      const Eigen::Vector3d corner = instance.world_from_mesh * mesh.positions[mesh.triangles[t][0]].cast<double>();
      const bool in_opening = std::abs(corner.x()) < 0.6 && corner.z() > 0.9 && corner.z() < 2.1;
      if (std::abs(normal.y()) < 0.5 && !in_opening) continue;  // the wall's ends, top and foot
      auto& side = std::abs(normal.y()) < 0.5 ? areas.reveal : normal.y() < 0 ? areas.outside : areas.inside;
      side[id.substr(0, id.find('_'))] += placedArea(mesh, mesh.triangles[t], instance.world_from_mesh);
    }
  }
  return areas;
}

TEST(Layers, TheRevealOfAWindowShowsWhatTheWallIsMadeOfInside) {
  const auto areas = wallAreas(wallWithOpening("Concrete"));
  ASSERT_EQ(areas.outside.size(), 1U);
  EXPECT_NEAR(areas.outside.at("brick"), 4 * 3 - 1, 1e-4);
  ASSERT_EQ(areas.inside.size(), 1U);
  EXPECT_NEAR(areas.inside.at("plaster"), 4 * 3 - 1, 1e-4);
  ASSERT_EQ(areas.reveal.size(), 3U);  // four sides of 1 m, cut through all layers
  EXPECT_NEAR(areas.reveal.at("concrete"), 4 * 0.165, 1e-4);
  EXPECT_NEAR(areas.reveal.at("brick"), 4 * 0.115, 1e-4);
  EXPECT_NEAR(areas.reveal.at("plaster"), 4 * 0.02, 1e-4);
}

// Nobody leaves wool bare in a reveal: the masonry is led round it.
TEST(Layers, ARevealNeverShowsTheInsulation) {
  const auto areas = wallAreas(wallWithOpening("Mineral wool insulation"));
  ASSERT_EQ(areas.reveal.size(), 2U);
  EXPECT_NEAR(areas.reveal.at("brick"), 4 * (0.115 + 0.165), 1e-4);
  EXPECT_NEAR(areas.reveal.at("plaster"), 4 * 0.02, 1e-4);
}

TEST(Layers, WhereTheLayersDoNotFitTheWallTheRevealShowsTheThickest) {
  const auto areas = wallAreas(wallWithOpening("Concrete", "0.365"));  // 0.5 m of layers in a wall of 0.3 m
  EXPECT_NEAR(areas.outside.at("brick"), 11, 1e-4);
  EXPECT_NEAR(areas.inside.at("plaster"), 11, 1e-4);
  ASSERT_EQ(areas.reveal.size(), 1U);
  EXPECT_NEAR(areas.reveal.at("concrete"), 4 * 0.3, 1e-4);
}

TEST(Layers, OfADrawingAreSelectedThroughTheProjectOnDisk) {
  const TemporaryFolder folder;
  auto text = wallWithOpening("Concrete");
  text.replace(text.find("ENDSEC;\nEND-ISO"), 8,
               "#60=IFCPRESENTATIONLAYERASSIGNMENT('A-WALL-EXTR',$,(#32),$);\nENDSEC;\n");
  std::ofstream(folder.path() / "wall.ifc") << text;
  std::ofstream(folder.path() / "rules.json")
      << R"({"rules": [{"layer": "a-wall*", "assign": "bark"}], "then": "default"})";
  Progress progress;
  ASSERT_TRUE(runOnDisk(
      *findVerb(verbs(), "import"),
      {{"files", {(folder.path() / "wall.ifc").string()}}, {"output", (folder.path() / "p").string()}}, progress));
  const auto materialsOf = [&](json options) {
    options["project"] = (folder.path() / "p").string();
    const auto assigned = runOnDisk(*findVerb(verbs(), "materials"), options, progress);
    EXPECT_TRUE(assigned) << describe(assigned.error());
    std::set<std::string> ids;
    for (const auto& use : assigned->document.materials->result.report.uses) ids.insert(use.material);
    return ids;
  };
  EXPECT_EQ(materialsOf({{"assign", {"layer:A-WALL*=carpet"}}}), (std::set<std::string>{"carpet"}));
  EXPECT_EQ(materialsOf({{"assign", {"layer:A-WALL*=rules"}}, {"rules", (folder.path() / "rules.json").string()}}),
            (std::set<std::string>{"bark"}));
}

// Counted by hand in the file: which products' representations or items its three IfcPresentationLayerAssignments name.
TEST(Layers, OfARealDrawingMeanTheProductsThatTheFilePutsOnThem) {
  const char* shared = std::getenv("STANDPOINT_SHARED");
  const auto file = std::filesystem::path(shared != nullptr ? shared : SOURCE_DIR "/../shared") /
                    "corpus/ifc/xbimess__4walls1floorSite.ifc";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no corpus at " << file;
  const auto imported = run("import", Document(), {{"files", {file.string()}}});
  ASSERT_TRUE(imported) << describe(imported.error());
  const auto classes = [&](const char* selector) {
    std::string text;
    for (const auto p : select(*imported->document.imported, selector))
      text += imported->document.imported->products[p].ifc_class + " ";
    return text;
  };
  EXPECT_EQ(classes("layer:A-200-M_WALL_EXT"),
            "IfcWallStandardCase IfcWallStandardCase IfcWallStandardCase IfcWallStandardCase ");
  EXPECT_EQ(classes("layer:a-230*"), "IfcSlab ");
  EXPECT_EQ(classes("layer:C-9?0-M_TOPO"), "IfcSite ");
}

TEST(Layers, WhatAnImportTellsOfAProductComesBackFromTheProject) {
  const TemporaryFolder folder;
  Progress progress;
  Document d = twoStoreyDocument();
  auto e = std::make_shared<Environment>(*d.imported);
  e->products[1].type_name = "Basic wall 300";
  e->products[1].groups = {"IfcSystem Shell", "IfcZone Flat 3"};
  e->spatial[0].properties = {{"Pset_ProjectCommon", "Phase", "as built"}};
  d.imported = e;
  ASSERT_TRUE(saveProject(d, folder.path() / "p", progress));
  const auto back = loadProject(folder.path() / "p", progress);
  ASSERT_TRUE(back) << describe(back.error());
  EXPECT_EQ(back->imported->products[1].type_name, "Basic wall 300");
  EXPECT_EQ(back->imported->products[1].groups, e->products[1].groups);
  ASSERT_EQ(back->imported->spatial[0].properties.size(), 1U);
  EXPECT_EQ(back->imported->spatial[0].properties[0].value, "as built");
}

}  // namespace
}  // namespace standpoint
