// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <map>

#include <gtest/gtest.h>

#include "project/project_files.h"
#include "project/session.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

TEST(Layers, AWallOfBrickOutsideAndPlasterInsideHasTwoPhysicalMaterialsWithTheirReasons) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "wall.ifc")
      << "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\nFILE_SCHEMA(('IFC2X3'));\nENDSEC;\nDATA;\n"
         "#1=IFCCARTESIANPOINT((0.,0.,0.));\n#2=IFCAXIS2PLACEMENT3D(#1,$,$);\n#3=IFCLOCALPLACEMENT($,#2);\n#4=IFCDIRECTION((0.,0.,1.));\n#6=IFCCARTESIANPOINT((0.,0.));\n#7=IFCAXIS2PLACEMENT2D(#6,$);\n"
         "#10=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n#11=IFCUNITASSIGNMENT((#10));\n#12=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-5,#2,$);\n#20=IFCPROJECT('p',$,'House',$,$,$,$,(#12),#11);\n"
         "#30=IFCRECTANGLEPROFILEDEF(.AREA.,$,#7,4.,0.3);\n#31=IFCEXTRUDEDAREASOLID(#30,#2,#4,3.);\n#32=IFCSHAPEREPRESENTATION(#12,'Body','SweptSolid',(#31));\n#33=IFCPRODUCTDEFINITIONSHAPE($,$,(#32));\n"
         "#34=IFCWALLSTANDARDCASE('w',$,'W',$,$,#3,#33,$);\n#40=IFCMATERIAL('Brick');\n#41=IFCMATERIAL('Insulation');\n#42=IFCMATERIAL('Plaster');\n"
         "#43=IFCMATERIALLAYER(#40,0.115,$);\n#44=IFCMATERIALLAYER(#41,0.17,$);\n#45=IFCMATERIALLAYER(#42,0.015,$);\n#46=IFCMATERIALLAYERSET((#43,#44,#45),$);\n"
         "#47=IFCMATERIALLAYERSETUSAGE(#46,.AXIS2.,.POSITIVE.,-0.15);\n#48=IFCRELASSOCIATESMATERIAL('m',$,$,$,(#34),#47);\nENDSEC;\nEND-ISO-10303-21;\n";
  Progress progress;
  const auto imported = runOnDisk(*findVerb(verbs(), "import"), {{"files", {(folder.path() / "wall.ifc").string()}}, {"output", (folder.path() / "p").string()}}, progress);
  ASSERT_TRUE(imported) << describe(imported.error());
  std::map<std::string, double> areas;   // as --json tells them
  for (const auto& row : imported->answer.at("products")[0].at("surfaces")) areas[row.at("name")] = row.at("area");
  EXPECT_NEAR(areas["Brick"], 12 + 2 * 0.115 * (3 + 4), 1e-4);
  EXPECT_NEAR(areas["Plaster"], 12 + 2 * 0.015 * (3 + 4), 1e-4);
  const auto assigned = runOnDisk(*findVerb(verbs(), "materials"), {{"project", (folder.path() / "p").string()}}, progress);
  ASSERT_TRUE(assigned) << describe(assigned.error());
  const auto& environment = *assigned->document.imported;
  const auto& assignment = assigned->document.materials->result.assignment;
  std::map<std::string, std::pair<std::string, std::string>> of_surface;
  for (const auto& s : assignment.surfaces)
    if (s.material >= 0) of_surface[environment.surfaces[s.surface].name] = {assignment.materials[static_cast<std::size_t>(s.material)].id, s.reason};
  ASSERT_EQ(of_surface.size(), 3U);
  EXPECT_EQ(of_surface["Brick"].first.substr(0, 5), "brick");
  EXPECT_NE(of_surface["Brick"].second.find("brick"), std::string::npos) << of_surface["Brick"].second;
  EXPECT_EQ(of_surface["Plaster"].first.substr(0, 7), "plaster");
  EXPECT_NE(of_surface["Plaster"].second.find("plaster"), std::string::npos) << of_surface["Plaster"].second;
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
