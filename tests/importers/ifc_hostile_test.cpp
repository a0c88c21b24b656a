// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>

#include <gtest/gtest.h>

#include "importers/ifc/shapes/mapping.h"
#include "tests/core/own_seconds.h"
#include "tests/importers/ifc_fixture.h"

namespace standpoint::test {
namespace {

// One of each construct, so that a mutation can hit anything.
std::string smallModel() {
  return ifcText(boxSolid(100, "4.", "0.3", "3.") +
                 "#120=IFCCARTESIANPOINT((0.,0.,1.));\n#121=IFCDIRECTION((0.,0.6,0.8));\n#122=IFCAXIS2PLACEMENT3D(#120,"
                 "#121,$);\n#123=IFCPLANE(#122);\n#124=IFCHALFSPACESOLID(#123,.F.);\n"
                 "#125=IFCBOOLEANCLIPPINGRESULT(.DIFFERENCE.,#102,#124);\n" +
                 product(110, "IFCWALL", "#125", "Clipping") + boxSolid(200, "1.", "1.", "0.5") +
                 product(210, "IFCOPENINGELEMENT", "#202") +
                 "#220=IFCRELVOIDSELEMENT('v',$,$,$,#110,#210);\n"
                 "#300=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(2.,0.,0.),(0.,1.,0.),(0.,0.,3.)));\n#301="
                 "IFCTRIANGULATEDFACESET(#300,$,.T.,((1,3,2),(1,2,4),(1,4,3),(2,3,4)),$);\n"
                 "#302=IFCSHAPEREPRESENTATION(#12,'Body','Tessellation',(#301));\n#303=IFCREPRESENTATIONMAP(#2,#302);"
                 "\n#304=IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,#1,2.,$);\n#305=IFCMAPPEDITEM(#303,#304);\n" +
                 product(310, "IFCFURNISHINGELEMENT", "#305", "MappedRepresentation") +
                 "#320=IFCCIRCLE(#7,0.5);\n#321=IFCTRIMMEDCURVE(#320,(IFCPARAMETERVALUE(0.)),(IFCPARAMETERVALUE(3.14)),"
                 ".T.,.PARAMETER.);\n#322=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#321);\n"
                 "#323=IFCCARTESIANPOINT((-0.5,0.));\n#324=IFCCARTESIANPOINT((0.5,0.));\n#325=IFCPOLYLINE((#323,#324));"
                 "\n#326=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#325);\n#327=IFCCOMPOSITECURVE((#322,#326),.F.);\n"
                 "#328=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#327);\n#329=IFCAXIS1PLACEMENT(#330,#5);\n#330="
                 "IFCCARTESIANPOINT((0.,-1.,0.));\n#331=IFCREVOLVEDAREASOLID(#328,$,#329,2.);\n" +
                 product(340, "IFCCOLUMN", "#331") +
                 "#350=IFCMATERIAL('Brick',$,$);\n#351=IFCRELASSOCIATESMATERIAL('m',$,$,$,(#110,#340),#350);\n");
}

TEST(IfcHostile, TheUnharmedModelLosesNothing) {
  const ImportedModel model = importText(smallModel());
  EXPECT_EQ(model.report.losses(), 0U) << issuesOf(model);
  EXPECT_EQ(sceneOf(model.environment).instances.size(), 3U);
}

TEST(IfcHostile, AFileCutAnywhereIsAnErrorOrALossAndNeverACrash) {
  const std::string text = smallModel();
  const std::size_t whole = text.find("END-ISO");
  for (std::size_t size = 0; size < whole - 8; size += 37) {
    const auto model = tryImport(text.substr(0, size));
    EXPECT_TRUE(!model || model->report.losses() > 0) << "cut at " << size;
    if (!model) {
      EXPECT_FALSE(model.error().source.empty()) << "cut at " << size;
    }
  }
}

// A body of that kind made from #100.
std::string bodyOf(const ifc::Mapping& mapping) {
  if (mapping.item) return product(110, "IFCPLATE", "#100", "Brep");
  if (mapping.curve) return "#101=IFCSWEPTDISKSOLID(#100,0.1,$,$,$);\n" + product(110, "IFCPLATE", "#101");
  if (mapping.profile) return "#101=IFCEXTRUDEDAREASOLID(#100,$,#4,1.);\n" + product(110, "IFCPLATE", "#101");
  return "#101=IFCRECTANGULARTRIMMEDSURFACE(#100,0.,0.,1.,1.,.T.,.T.);\n" +
         product(110, "IFCPLATE", "#101", "Surface3D");
}

TEST(IfcHostile, EveryEntityOfTheTableSurvivesAttributesOfAnyKind) {
  for (const ifc::Mapping& mapping : ifc::mappings())
    for (const std::string attribute : {"", "$", "#100", "#1", "#7", "#999", "(#100,#100)", "(#1,#6)", "()",
                                        "((1.,2.))", "1.", "0.", "-1.", "3", ".T.", "'x'", "*"}) {
      std::string all = attribute;
      for (int i = 1; i < 14 && !attribute.empty(); ++i) all += "," + attribute;
      const std::string record = "#100=" + std::string(mapping.entity) + "(" + all + ");\n";
      const double start = test::ownSeconds();
      const ImportedModel model = importText(ifcText(record + bodyOf(mapping)));
      EXPECT_LT(test::ownSeconds() - start, 5) << record;
      EXPECT_EQ(validate(model.environment), "") << record;
      EXPECT_TRUE(!model.environment.instances.empty() || issuesOf(model).find("#110") != std::string::npos) << record;
    }
}

TEST(IfcHostile, ChangedBytesNeverCrashOrHang) {
  const std::string text = smallModel();
  const std::string alphabet = "#$*(),;.'-+0123456789EIFCX\\/\n \xFF";
  std::uint64_t state = 20260101;
  const auto random = [&] { return state = state * 6364136223846793005U + 1442695040888963407U, state >> 33; };
  for (int round = 0; round < 600; ++round) {
    std::string changed = text;
    const std::uint64_t changes = 1 + random() % 4;
    for (std::uint64_t k = 0; k < changes; ++k)
      changed[random() % changed.size()] = alphabet[random() % alphabet.size()];
    const double start = test::ownSeconds();
    const auto model = tryImport(changed);
    EXPECT_LT(test::ownSeconds() - start, 5) << "round " << round;
    if (model) {
      EXPECT_EQ(validate(model->environment), "") << "round " << round;
    }
  }
}

TEST(IfcHostile, PlacementsInACircleAreCut) {
  const ImportedModel model =
      importText(ifcText("#90=IFCLOCALPLACEMENT(#91,#2);\n#91=IFCLOCALPLACEMENT(#90,#2);\n" +
                         boxSolid(100, "4.", "0.3", "3.") + product(110, "IFCWALL", "#102", "SweptSolid", "#90")));
  EXPECT_NEAR(volumeOf(model, "#110"), 3.6, 1e-5);
  EXPECT_FALSE(model.report.issues.empty());
}

TEST(IfcHostile, ABooleanOfItselfIsALossOfThatProductOnly) {
  const ImportedModel model =
      importText(ifcText("#100=IFCBOOLEANRESULT(.UNION.,#100,#100);\n" + product(110, "IFCWALL", "#100") +
                         boxSolid(300, "1.", "1.", "1.") + product(310, "IFCSLAB", "#302")));
  EXPECT_NEAR(volumeOf(model, "#310"), 1, 1e-5);
  EXPECT_GT(model.report.losses(), 0U);
}

TEST(IfcHostile, OperandsNestedTenThousandDeepAreRefused) {
  std::string records = boxSolid(100, "4.", "0.3", "3.");
  for (int i = 1000; i < 11000; ++i)
    records += "#" + std::to_string(i) + "=IFCBOOLEANRESULT(.UNION.,#102,#" + std::to_string(i + 1) + ");\n";
  const ImportedModel model = importText(ifcText(records + product(110, "IFCWALL", "#1000")));
  EXPECT_GT(model.report.losses(), 0U);
}

TEST(IfcHostile, MappedItemsThatMultiplyAreRefusedInTime) {
  // Ten levels of ten: 10^10 boxes.
  std::string records = boxSolid(100, "4.", "0.3", "3.") +
                        "#200=IFCSHAPEREPRESENTATION(#12,'Body','SweptSolid',(#102));\n#90="
                        "IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,#1,$,$);\n";
  for (int level = 0; level < 10; ++level) {
    const int n = 300 + level * 20;
    std::string items;
    records += "#" + std::to_string(n) + "=IFCREPRESENTATIONMAP(#2,#" +
               (level == 0 ? std::string("200") : std::to_string(n - 19)) + ");\n";
    for (int k = 0; k < 10; ++k) {
      records += "#" + std::to_string(n + 2 + k) + "=IFCMAPPEDITEM(#" + std::to_string(n) + ",#90);\n";
      items += (k ? ",#" : "#") + std::to_string(n + 2 + k);
    }
    records +=
        "#" + std::to_string(n + 1) + "=IFCSHAPEREPRESENTATION(#12,'Body','MappedRepresentation',(" + items + "));\n";
  }
  const double start = test::ownSeconds();
  const ImportedModel model = importText(
      ifcText(records + "#700=IFCWALL('g',$,'W',$,$,#3,#701,$,$);\n#701=IFCPRODUCTDEFINITIONSHAPE($,$,(#481));\n"));
  EXPECT_LT(test::ownSeconds() - start, 10);
  EXPECT_GT(model.report.losses(), 0U) << issuesOf(model);
}

TEST(IfcHostile, NumbersThatAreNoneAreNoCoordinates) {
  const ImportedModel model =
      importText(ifcText("#100=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(1.E400,0.,0.),(0.,1.E300,0.),(0.,0.,nan)));\n"
                         "#101=IFCTRIANGULATEDFACESET(#100,$,.T.,((1,3,2),(1,2,4),(1,4,3),(2,3,99)),$);\n" +
                         product(110, "IFCSLAB", "#101", "Tessellation")));
  EXPECT_GT(model.report.losses(), 0U);
  EXPECT_EQ(validate(model.environment), "");
}

TEST(IfcHostile, CancellingStopsTheImport) {
  const TemporaryFile file(smallModel());
  Progress progress;
  progress.cancel();
  const auto model = importFile(file.path(), {}, progress);
  ASSERT_FALSE(model.has_value());
  EXPECT_EQ(model.error().kind, ErrorKind::cancelled);
}

TEST(IfcHostile, AFileThatIsNotThereIsAFileSystemError) {
  Progress progress;
  const auto model = importFile("/nowhere/house.ifc", {}, progress);
  ASSERT_FALSE(model.has_value());
  EXPECT_EQ(model.error().kind, ErrorKind::file_system);
}

}  // namespace
}  // namespace standpoint::test
