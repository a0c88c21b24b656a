// SPDX-License-Identifier: GPL-3.0-or-later
// A model 7 000 km from its origin, scanned: the points leave in the numbers that came in.
#include <fstream>

#include <gtest/gtest.h>

#include "pointclouds/formats.h"
#include "project/storage/session.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

TEST(FarAway, AScanOfARoomAtFiveThousandKilometresHasItsWallsWhereTheFileSays) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "room.ifc")
      << "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\nFILE_SCHEMA(('"
         "IFC4'));\nENDSEC;\nDATA;\n"
         "#1=IFCCARTESIANPOINT((0.,0.,0.));\n#2=IFCAXIS2PLACEMENT3D(#1,$,$);\n#4=IFCDIRECTION((0.,0.,1.));\n#6="
         "IFCCARTESIANPOINT((0.,0.));\n#7=IFCAXIS2PLACEMENT2D(#6,$);\n"
         "#8=IFCCARTESIANPOINT((5012345.6789,5432109.8765,123.4567));\n#9=IFCAXIS2PLACEMENT3D(#8,$,$);\n#3="
         "IFCLOCALPLACEMENT($,#9);\n"
         "#10=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n#11=IFCUNITASSIGNMENT((#10));\n#12="
         "IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-5,#2,$);\n#20=IFCPROJECT('p',$,'House',$,$,$,$,(#12),#11);"
         "\n"
         "#30=IFCRECTANGLEPROFILEDEF(.AREA.,$,#7,6.,4.);\n#31=IFCEXTRUDEDAREASOLID(#30,#2,#4,3.);\n#32="
         "IFCSHAPEREPRESENTATION(#12,'Body','SweptSolid',(#31));\n#33=IFCPRODUCTDEFINITIONSHAPE($,$,(#32));\n"
         "#34=IFCBUILDINGELEMENTPROXY('w',$,'Room',$,$,#3,#33,$,$);\nENDSEC;\nEND-ISO-10303-21;\n";
  Progress progress;
  const std::string project = (folder.path() / "p").string();
  const auto done = [&](const char* verb, const nlohmann::json& options) {
    const auto outcome = runOnDisk(*findVerb(verbs(), verb), options, progress);
    EXPECT_TRUE(outcome) << describe(outcome.error());
  };
  done("import", {{"files", {(folder.path() / "room.ifc").string()}}, {"output", project}});
  done("station", {{"project", project}, {"add", "S1"}, {"at", {5012345.5, 5432110.0, 125.0}}, {"stand", "free"}});
  const auto file = folder.path() / "room.e57";
  done("scan", {{"project", project},
                {"instrument", "leica-rtc360"},
                {"set", {"resolution=12mm"}},
                {"ideal", true},
                {"output", file.string()}});
  const auto extent = measureCloud(file, progress);
  ASSERT_TRUE(extent) << describe(extent.error());
  EXPECT_NEAR(extent->bounds_file_m.min.x(), 5012345.6789 - 3, 1e-4);
  EXPECT_NEAR(extent->bounds_file_m.max.x(), 5012345.6789 + 3, 1e-4);
  EXPECT_NEAR(extent->bounds_file_m.min.y(), 5432109.8765 - 2, 1e-4);
  EXPECT_NEAR(extent->bounds_file_m.max.y(), 5432109.8765 + 2, 1e-4);
  EXPECT_NEAR(extent->bounds_file_m.max.z(), 123.4567 + 3, 1e-4);
}

}  // namespace
}  // namespace standpoint
