// SPDX-License-Identifier: GPL-3.0-or-later
#include <numbers>

#include <gtest/gtest.h>

#include "tests/importers/ifc_fixture.h"

namespace standpoint::test {
namespace {

const std::string kWall = boxSolid(100, "4.", "0.3", "3.") + product(110, "IFCWALL", "#102");

TEST(IfcGeometry, AnExtrudedRectangleHasItsBoundsAndVolume) {
  const ImportedModel model = importText(ifcText(kWall));
  expectNear(boundsOf(model, "#110").min, {-2, -0.15, 0});
  expectNear(boundsOf(model, "#110").max, {2, 0.15, 3});
  EXPECT_NEAR(volumeOf(model, "#110"), 3.6, 1e-5);
  EXPECT_TRUE(model.report.issues.empty()) << issuesOf(model);
}

TEST(IfcGeometry, MillimetresAndFeetBecomeMetres) {
  const ImportedModel mm = importText(ifcText(kWall, "IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.)"));
  EXPECT_NEAR(boundsOf(mm, "#110").max.z(), 0.003, 1e-9);
  // A foot by way of an inch by way of a millimetre.
  const ImportedModel feet = importText(ifcText(
      "#60=IFCMEASUREWITHUNIT(IFCLENGTHMEASURE(12.),#61);\n#61=IFCCONVERSIONBASEDUNIT(#64,.LENGTHUNIT.,'INCH',#62);\n"
      "#62=IFCMEASUREWITHUNIT(IFCLENGTHMEASURE(25.4),#63);\n#63=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);\n#64="
      "IFCDIMENSIONALEXPONENTS(1,0,0,0,0,0,0);\n" +
          kWall,
      "IFCCONVERSIONBASEDUNIT(#64,.LENGTHUNIT.,'FOOT',#60)"));
  EXPECT_NEAR(boundsOf(feet, "#110").max.z(), 3 * 0.3048, 1e-6);
}

const std::string kOpening = boxSolid(200, "1.", "1.", "2.") + product(210, "IFCOPENINGELEMENT", "#202") +
                             "#220=IFCRELVOIDSELEMENT('v',$,$,$,#110,#210);\n";

TEST(IfcGeometry, AnOpeningIsCutFromItsWallAndIsABodyThatNoBeamMeets) {
  const ImportedModel model = importText(ifcText(kWall + kOpening));
  EXPECT_NEAR(volumeOf(model, "#110"), 3.6 - 0.3 * 2, 1e-5);
  EXPECT_FALSE(productOf(model, "#210").tangible);
  EXPECT_NEAR(volumeOf(model, "#210"), 1 * 1 * 2, 1e-6);
  EXPECT_EQ(sceneOf(model.environment).instances.size(), 1U);
  EXPECT_TRUE(model.report.issues.empty()) << issuesOf(model);
}

TEST(IfcGeometry, AnOpeningOfTheWholeIsCutFromItsParts) {
  const ImportedModel model = importText(ifcText(
      boxSolid(100, "4.", "0.3", "3.") + "#110=IFCWALL('w',$,'W',$,$,#3,$,$,$);\n" +
      product(120, "IFCBUILDINGELEMENTPART", "#102") + "#130=IFCRELAGGREGATES('a',$,$,$,#110,(#120));\n" + kOpening));
  EXPECT_NEAR(volumeOf(model, "#120"), 3.6 - 0.3 * 2, 1e-5);
  EXPECT_EQ(productOf(model, "#120").whole, static_cast<std::int32_t>(indexOf(model, "#110")));
}

TEST(IfcGeometry, AMappedItemIsStoredOnceAndMayMirror) {
  const std::string records =
      "#100=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(2.,0.,0.),(0.,1.,0.),(0.,0.,3.)));\n"
      "#101=IFCTRIANGULATEDFACESET(#100,$,.T.,((1,3,2),(1,2,4),(1,4,3),(2,3,4)),$);\n"
      "#102=IFCSHAPEREPRESENTATION(#12,'Body','Tessellation',(#101));\n#103=IFCREPRESENTATIONMAP(#2,#102);\n"
      "#104=IFCDIRECTION((-1.,0.,0.));\n#105=IFCDIRECTION((0.,1.,0.));\n#106=IFCCARTESIANPOINT((10.,0.,0.));\n"
      "#107=IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,#1,$,$);\n#108=IFCCARTESIANTRANSFORMATIONOPERATOR3DNONUNIFORM(#5,#"
      "109,#106,1.,#4,2.,1.);\n#109=IFCDIRECTION((0.,-1.,0.));\n"
      "#110=IFCMAPPEDITEM(#103,#107);\n#111=IFCMAPPEDITEM(#103,#108);\n" +
      product(120, "IFCFURNISHINGELEMENT", "#110", "MappedRepresentation") +
      product(130, "IFCFURNISHINGELEMENT", "#111", "MappedRepresentation");
  const ImportedModel model = importText(ifcText(records));
  EXPECT_EQ(model.environment.meshes.size(), 1U);
  ASSERT_EQ(model.environment.instances.size(), 2U);
  EXPECT_NEAR(std::abs(volumeOf(model, "#120")), 1, 1e-6);
  EXPECT_LT(model.environment.instances[1].world_from_mesh.linear().determinant(), 0);
  expectNear(boundsOf(model, "#130").min, {10, -2, 0});
  expectNear(boundsOf(model, "#130").max, {12, 0, 3});
}

TEST(IfcGeometry, AHalfSpaceTakesTheSideThatItsFlagNames) {
  // The plane z = 1: T says that the material is below it, so a difference keeps what is above.
  const auto clipped = [&](const std::string& flag) {
    return importText(ifcText(boxSolid(100, "4.", "0.3", "3.") +
                              "#120=IFCCARTESIANPOINT((0.,0.,1.));\n#121=IFCAXIS2PLACEMENT3D(#120,$,$);\n#122=IFCPLANE("
                              "#121);\n#123=IFCHALFSPACESOLID(#122,." +
                              flag + ".);\n#124=IFCBOOLEANCLIPPINGRESULT(.DIFFERENCE.,#102,#123);\n" +
                              product(110, "IFCWALL", "#124", "Clipping")));
  };
  EXPECT_NEAR(volumeOf(clipped("T"), "#110"), 2 * 1.2, 1e-5);
  EXPECT_NEAR(boundsOf(clipped("T"), "#110").min.z(), 1, 1e-6);
  EXPECT_NEAR(volumeOf(clipped("F"), "#110"), 1 * 1.2, 1e-5);
  EXPECT_NEAR(boundsOf(clipped("F"), "#110").max.z(), 1, 1e-6);
}

TEST(IfcGeometry, ABoundedHalfSpaceCutsOnlyWithinItsPolygon) {
  const ImportedModel model = importText(ifcText(
      boxSolid(100, "4.", "0.3", "3.") +
      "#120=IFCCARTESIANPOINT((0.,0.,1.));\n#121=IFCAXIS2PLACEMENT3D(#120,$,$);\n#122=IFCPLANE(#121);\n"
      "#130=IFCCARTESIANPOINT((0.,-1.));\n#131=IFCCARTESIANPOINT((5.,-1.));\n#132=IFCCARTESIANPOINT((5.,1.));\n#133="
      "IFCCARTESIANPOINT((0.,1.));\n#134=IFCPOLYLINE((#130,#131,#132,#133,#130));\n"
      "#135=IFCPOLYGONALBOUNDEDHALFSPACE(#122,.F.,#2,#134);\n#136=IFCBOOLEANCLIPPINGRESULT(.DIFFERENCE.,#102,#135);\n" +
      product(110, "IFCWALL", "#136", "Clipping")));
  EXPECT_NEAR(volumeOf(model, "#110"), 3.6 - 2 * 0.3 * 2, 1e-5);  // x > 0 loses what is above 1 m
  EXPECT_TRUE(model.report.issues.empty()) << issuesOf(model);
}

TEST(IfcGeometry, ABooleanThatCannotBeDoneKeepsTheBodyAndSaysSo) {
  const ImportedModel model = importText(ifcText(
      boxSolid(100, "4.", "0.3", "3.") + "#120=IFCBOOLEANRESULT(.DIFFERENCE.,#102,#999);\n" +
      product(110, "IFCWALL", "#120", "CSG") + boxSolid(300, "1.", "1.", "1.") + product(310, "IFCSLAB", "#302")));
  EXPECT_NEAR(volumeOf(model, "#110"), 3.6, 1e-5);
  EXPECT_NEAR(volumeOf(model, "#310"), 1, 1e-5);
  ASSERT_EQ(model.report.losses(), 2U) << issuesOf(model);
  EXPECT_EQ(model.report.issues[0].source, "#120");
  EXPECT_TRUE(tells(model, "#110", "IfcWall guid110 is incomplete: see #120"));
}

TEST(IfcGeometry, AFacetedBrepTurnedInsideOutIsTurnedOutward) {
  const ImportedModel model =
      importText(ifcText("#100=IFCCARTESIANPOINT((0.,0.,0.));\n#101=IFCCARTESIANPOINT((1.,0.,0.));\n#102="
                         "IFCCARTESIANPOINT((0.,1.,0.));\n#103=IFCCARTESIANPOINT((0.,0.,1.));\n"
                         "#104=IFCPOLYLOOP((#100,#101,#102));\n#105=IFCPOLYLOOP((#100,#103,#101));\n#106=IFCPOLYLOOP((#"
                         "100,#102,#103));\n#107=IFCPOLYLOOP((#101,#103,#102));\n"
                         "#108=IFCFACEOUTERBOUND(#104,.T.);\n#109=IFCFACEOUTERBOUND(#105,.T.);\n#110=IFCFACEOUTERBOUND("
                         "#106,.T.);\n#111=IFCFACEOUTERBOUND(#107,.T.);\n"
                         "#112=IFCFACE((#108));\n#113=IFCFACE((#109));\n#114=IFCFACE((#110));\n#115=IFCFACE((#111));\n#"
                         "116=IFCCLOSEDSHELL((#112,#113,#114,#115));\n#117=IFCFACETEDBREP(#116);\n" +
                         product(120, "IFCFURNISHINGELEMENT", "#117", "Brep")));
  EXPECT_NEAR(volumeOf(model, "#120"), 1.0 / 6, 1e-6);
}

TEST(IfcGeometry, ARolledSteelProfileHasTheAreaOfItsTable) {
  // HEB 220: h 220, b 220, tw 9.5, tf 16, r 18: 91.04 cm² (EN 10365). Chords cut the fillets by less than 1 %.
  const ImportedModel model =
      importText(ifcText("#100=IFCISHAPEPROFILEDEF(.AREA.,'HE220B',#7,220.,220.,9.5,16.,18.);\n#101="
                         "IFCEXTRUDEDAREASOLID(#100,$,#4,1000.);\n" +
                             product(110, "IFCBEAM", "#101"),
                         "IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.)"));
  EXPECT_NEAR(volumeOf(model, "#110") * 1e4, 91.04, 0.91);
}

TEST(IfcGeometry, AColumnsCircleKeepsTheChordErrorAndItsFullWidth) {
  ImportOptions options;
  options.chord_error_m = 0.0005;
  const ImportedModel model =
      importText(ifcText("#100=IFCCIRCLEPROFILEDEF(.AREA.,$,#7,0.5);\n#101=IFCEXTRUDEDAREASOLID(#100,$,#4,1.);\n" +
                         product(110, "IFCCOLUMN", "#101")),
                 options);
  expectNear(boundsOf(model, "#110").max, {0.5, 0.5, 1}, 1e-6);
  const double exact = std::numbers::pi * 0.25, sliver = std::numbers::pi * 0.0005;  // circumference × chord error
  EXPECT_LT(volumeOf(model, "#110"), exact);
  EXPECT_GT(volumeOf(model, "#110"), exact - sliver);
}

TEST(IfcGeometry, AnArcOfAnIndexedCurveRoundsTheOutline) {
  const ImportedModel model = importText(
      ifcText("#100=IFCCARTESIANPOINTLIST2D(((-1.,0.),(1.,0.),(0.,1.)));\n#101=IFCINDEXEDPOLYCURVE(#100,(IFCLINEINDEX(("
              "1,2)),IFCARCINDEX((2,3,1))),.F.);\n"
              "#102=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#101);\n#103=IFCEXTRUDEDAREASOLID(#102,$,#4,2.);\n" +
              product(110, "IFCSLAB", "#103")));
  EXPECT_NEAR(volumeOf(model, "#110"), std::numbers::pi, 0.01);
  EXPECT_NEAR(boundsOf(model, "#110").max.y(), 1, 1e-3);
}

TEST(IfcGeometry, AClothoidLeadsFromALineIntoItsCircle) {
  // Clothoid A = 100 over 50 m ends at radius 200: turned by L²/2A² = 0.125 rad; Fresnel: x = L(1 − θ²/10 + θ⁴/216), y
  // = L(θ/3 − θ³/42).
  const ImportedModel model = importText(
      ifcText("#100=IFCCLOTHOID(#7,100.);\n#101=IFCCURVESEGMENT(.CONTINUOUS.,#7,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE("
              "50.),#100);\n#102=IFCCOMPOSITECURVE((#101),.F.);\n"
              "#110=IFCLINE(#6,#111);\n#111=IFCVECTOR(#112,1.);\n#112=IFCDIRECTION((1.,0.));\n#113=IFCCARTESIANPOINT(("
              "0.,7.));\n#114=IFCAXIS2PLACEMENT2D(#113,#112);\n"
              "#115=IFCCURVESEGMENT(.CONTINUOUS.,#114,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(50.),#110);\n#116="
              "IFCGRADIENTCURVE((#115),.F.,#102,$);\n"
              "#120=IFCPOINTBYDISTANCEEXPRESSION(IFCLENGTHMEASURE(50.),$,$,$,#116);\n#121=IFCAXIS2PLACEMENTLINEAR(#120,"
              "$,$);\n#122=IFCLINEARPLACEMENT($,#121,$);\n" +
                  boxSolid(130, "0.002", "0.002", "1.") + product(140, "IFCSIGNAL", "#132", "SweptSolid", "#122"),
              "IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)", "IFC4X3_ADD2"));
  const Bounds b = boundsOf(model, "#140");
  expectNear((b.min + b.max) / 2, {49.92193, 2.08101, 7.5}, 2e-3);
}

TEST(IfcGeometry, CoordinatesOfMillionsOfMetresKeepTheirMillimetres) {
  const std::string far =
      "#100=IFCCARTESIANPOINTLIST3D(((5000000.001,4000000.,100.),(5000001.001,4000000.,100.),(5000000.001,4000002.,100."
      "),(5000000.001,4000000.,103.)));\n"
      "#101=IFCTRIANGULATEDFACESET(#100,$,.T.,((1,3,2),(1,2,4),(1,4,3),(2,3,4)),$);\n" +
      product(110, "IFCSLAB", "#101", "Tessellation");
  const ImportedModel model = importText(ifcText(far));
  EXPECT_EQ(model.georeference.shift_m, model.georeference.shift_m.array().round().matrix());
  EXPECT_GT(model.georeference.shift_m.x(), 4.9e6);
  expectNear(boundsOf(model, "#110").min, {5000000.001, 4000000, 100}, 1e-6);
  EXPECT_NEAR(volumeOf(model, "#110"), 1, 1e-5);
  const std::string placed =
      "#90=IFCCARTESIANPOINT((5000000.001,4000000.,100.));\n#91=IFCAXIS2PLACEMENT3D(#90,$,$);\n#92=IFCLOCALPLACEMENT($,"
      "#91);\n" +
      boxSolid(100, "4.", "0.3", "3.") + product(110, "IFCWALL", "#102", "SweptSolid", "#92");
  expectNear(boundsOf(importText(ifcText(placed)), "#110").min, {4999998.001, 3999999.85, 100}, 1e-6);
}

TEST(IfcGeometry, AGridPlacementStandsWhereItsAxesCross) {
  const ImportedModel model = importText(
      ifcText("#100=IFCCARTESIANPOINT((0.,4.));\n#101=IFCCARTESIANPOINT((9.,4.));\n#102=IFCPOLYLINE((#100,#101));\n#"
              "103=IFCGRIDAXIS('A',#102,.T.);\n"
              "#104=IFCCARTESIANPOINT((6.,0.));\n#105=IFCCARTESIANPOINT((6.,9.));\n#106=IFCPOLYLINE((#104,#105));\n#"
              "107=IFCGRIDAXIS('1',#106,.T.);\n"
              "#108=IFCVIRTUALGRIDINTERSECTION((#103,#107),(0.5,0.,0.));\n#109=IFCGRIDPLACEMENT($,#108,$);\n" +
                  boxSolid(120, "0.4", "0.4", "3.") + product(130, "IFCCOLUMN", "#122", "SweptSolid", "#109"),
              "IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)", "IFC4X3_ADD2"));
  expectNear(boundsOf(model, "#130").min, {5.8, 4.3, 0});
}

}  // namespace
}  // namespace standpoint::test
