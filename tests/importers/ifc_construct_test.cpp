// SPDX-License-Identifier: GPL-3.0-or-later
// Constructs that few files hold, each against what its definition says.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/importers/ifc_fixture.h"

namespace standpoint::test {
namespace {

TEST(IfcConstruct, ARebarLosesLessThanOnePercentToItsChords) {
  const ImportedModel model =
      importText(ifcText("#100=IFCCIRCLEPROFILEDEF(.AREA.,$,#7,0.006);\n#101=IFCEXTRUDEDAREASOLID(#100,$,#4,2.);\n" +
                         product(110, "IFCREINFORCINGBAR", "#101")));
  const double exact = std::numbers::pi * 0.006 * 0.006 * 2;
  EXPECT_NEAR(volumeOf(model, "#110") / exact, 1, 0.01);
}

TEST(IfcConstruct, AnOutlineThatCrossesItselfIsFilledOnBothSides) {
  const ImportedModel model = importText(
      ifcText("#100=IFCCARTESIANPOINTLIST2D(((0.,0.),(1.,0.),(0.,1.),(1.,1.),(0.,0.)));\n#101=IFCINDEXEDPOLYCURVE(#100,"
              "$,.F.);\n"
              "#102=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#101);\n#103=IFCEXTRUDEDAREASOLID(#102,$,#4,1.);\n" +
              product(110, "IFCSLAB", "#103")));
  EXPECT_NEAR(volumeOf(model, "#110"), 0.5, 1e-6);  // two triangles of base 1 and height 1/2
  EXPECT_TRUE(tells(model, "#102", "intersects itself")) << issuesOf(model);
}

TEST(IfcConstruct, ATaperedRevolutionFollowsPappus) {
  // The side of the square grows from 0.2 to 0.4 while its centre goes a quarter of a circle of radius 2: the mean of
  // its area is 0.28/3.
  const ImportedModel model = importText(ifcText(
      "#100=IFCRECTANGLEPROFILEDEF(.AREA.,$,#7,0.2,0.2);\n#101=IFCRECTANGLEPROFILEDEF(.AREA.,$,#7,0.4,0.4);\n#102="
      "IFCCARTESIANPOINT((2.,0.,0.));\n#103=IFCDIRECTION((0.,1.,0.));\n"
      "#104=IFCAXIS1PLACEMENT(#102,#103);\n#105=IFCREVOLVEDAREASOLIDTAPERED(#100,$,#104,1.5707963267948966,#101);\n" +
      product(110, "IFCBEAM", "#105")));
  EXPECT_NEAR(volumeOf(model, "#110"), 0.28 / 3 * 2 * std::numbers::pi / 2, 0.003);
}

TEST(IfcConstruct, AGeometricSetGivesItsSurfacesAndLeavesItsCurves) {
  const ImportedModel model =
      importText(ifcText("#100=IFCCARTESIANPOINTLIST2D(((0.,0.),(3.,0.),(3.,2.),(0.,2.),(0.,0.)));\n#101="
                         "IFCINDEXEDPOLYCURVE(#100,$,.F.);\n#102=IFCPLANE(#2);\n"
                         "#103=IFCCURVEBOUNDEDPLANE(#102,#101,());\n#104=IFCCARTESIANPOINTLIST2D(((0.,0.),(4.,0.)));\n#"
                         "105=IFCINDEXEDPOLYCURVE(#104,$,.F.);\n"
                         "#106=IFCARBITRARYOPENPROFILEDEF(.CURVE.,$,#105);\n#107=IFCSURFACEOFLINEAREXTRUSION(#106,#2,#"
                         "4,5.);\n#108=IFCGEOMETRICSET((#103,#105,#107));\n" +
                         product(110, "IFCPLATE", "#108", "GeometricSet")));
  EXPECT_NEAR(areaOf(model, "#110"), 3 * 2 + 4 * 5, 1e-5);
  EXPECT_EQ(model.report.losses(), 0U) << issuesOf(model);
}

TEST(IfcConstruct, AnOffsetCurveKeepsItsDistanceAtTheCorners) {
  const ImportedModel model = importText(
      ifcText("#100=IFCCARTESIANPOINTLIST2D(((-1.,-1.),(1.,-1.),(1.,1.),(-1.,1.),(-1.,-1.)));\n#101="
              "IFCINDEXEDPOLYCURVE(#100,$,.F.);\n#102=IFCOFFSETCURVE2D(#101,0.25,.F.);\n"
              "#103=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#102);\n#104=IFCEXTRUDEDAREASOLID(#103,$,#4,2.);\n" +
              product(110, "IFCSLAB", "#104")));
  EXPECT_NEAR(volumeOf(model, "#110"), 1.5 * 1.5 * 2, 1e-6);  // positive is to the left, here inward
}

TEST(IfcConstruct, ASweptDiskEndsAcrossItsArc) {
  const ImportedModel model =
      importText(ifcText("#100=IFCCIRCLE(#2,1.);\n#101=IFCTRIMMEDCURVE(#100,(IFCPARAMETERVALUE(0.)),(IFCPARAMETERVALUE("
                         "1.5707963267948966)),.T.,.PARAMETER.);\n"
                         "#102=IFCSWEPTDISKSOLID(#101,0.2,$,$,$);\n" +
                         product(110, "IFCPIPEFITTING", "#102")));
  EXPECT_NEAR(boundsOf(model, "#110").min.x(), 0, 1e-6);  // the end faces lie in the planes x = 0 and y = 0
  EXPECT_NEAR(boundsOf(model, "#110").min.y(), 0, 1e-6);
}

TEST(IfcConstruct, ACosineSpiralLeadsFromALineIntoItsCircle) {
  // Curvature (1 − cos(πs/L)) / 2R; its end by adding up small steps.
  constexpr double kLength = 80, kRadius = 200;
  double x = 0, y = 0;
  constexpr int kSteps = 20000;
  for (int i = 0; i < kSteps; ++i) {
    const double s = kLength * (i + 0.5) / kSteps;
    const double heading =
        s / (2 * kRadius) - kLength / (2 * kRadius * std::numbers::pi) * std::sin(std::numbers::pi * s / kLength);
    x += std::cos(heading) * kLength / kSteps;
    y += std::sin(heading) * kLength / kSteps;
  }
  const ImportedModel model = importText(
      ifcText("#100=IFCCOSINESPIRAL(#7,-400.,400.);\n#101=IFCCURVESEGMENT(.CONTINUOUS.,#7,IFCLENGTHMEASURE(0.),"
              "IFCLENGTHMEASURE(80.),#100);\n#102=IFCCOMPOSITECURVE((#101),.F.);\n"
              "#103=IFCPOINTBYDISTANCEEXPRESSION(IFCLENGTHMEASURE(80.),$,$,$,#102);\n#104=IFCAXIS2PLACEMENTLINEAR(#103,"
              "$,$);\n#105=IFCLINEARPLACEMENT($,#104,$);\n" +
                  boxSolid(106, "0.2", "0.2", "0.2") + product(110, "IFCSIGNAL", "#108", "SweptSolid", "#105"),
              "IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)", "IFC4X3_ADD2"));
  const Bounds b = boundsOf(model, "#110");
  expectNear((b.min + b.max) / 2, {x, y, 0.1}, 0.005);
}

TEST(IfcConstruct, WhatWasMendedIsSaidForTheProduct) {
  // A tetrahedron inside out, with one of its faces twice.
  const ImportedModel model =
      importText(ifcText("#100=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(1.,0.,0.),(0.,1.,0.),(0.,0.,1.)));\n#101="
                         "IFCTRIANGULATEDFACESET(#100,$,.T.,((1,2,3),(1,4,2),(1,3,4),(2,4,3),(2,4,3)),$);\n" +
                         product(110, "IFCFURNISHINGELEMENT", "#101", "Tessellation")));
  EXPECT_NEAR(volumeOf(model, "#110"), 1.0 / 6, 1e-6);
  EXPECT_TRUE(tells(model, "#110", "inverted shells")) << issuesOf(model);
  EXPECT_TRUE(tells(model, "#110", "duplicate faces removed: 1")) << issuesOf(model);
}

TEST(IfcConstruct, AHollowShellKeepsItsCavity) {
  // A cube of 2 with a cube of 1 inside that is turned inward: 8 − 1, whichever way the file turns the whole.
  const std::string points =
      "#100=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(2.,0.,0.),(2.,2.,0.),(0.,2.,0.),(0.,0.,2.),(2.,0.,2.),(2.,2.,2.),(0.,"
      "2.,2.),"
      "(0.5,0.5,0.5),(1.5,0.5,0.5),(1.5,1.5,0.5),(0.5,1.5,0.5),(0.5,0.5,1.5),(1.5,0.5,1.5),(1.5,1.5,1.5),(0.5,1.5,1.5))"
      ");\n";
  const int cube[6][4] = {{1, 4, 3, 2}, {5, 6, 7, 8}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 4, 8, 7}, {4, 1, 5, 8}};
  for (const bool inverted : {false, true}) {
    std::string faces, list;
    for (int k = 0; k < 12; ++k) {
      const auto& f = cube[k % 6];
      const bool backward = (k >= 6) != inverted;
      faces += "#" + std::to_string(120 + k) + "=IFCINDEXEDPOLYGONALFACE((";
      for (int i = 0; i < 4; ++i)
        faces += std::to_string(f[backward ? 3 - i : i] + (k >= 6 ? 8 : 0)) + (i < 3 ? "," : "));\n");
      list += (k ? ",#" : "#") + std::to_string(120 + k);
    }
    const ImportedModel model =
        importText(ifcText(points + faces + "#101=IFCPOLYGONALFACESET(#100,.T.,(" + list + "),$);\n" +
                           product(110, "IFCFURNISHINGELEMENT", "#101", "Tessellation")));
    EXPECT_NEAR(volumeOf(model, "#110"), 7, 1e-5);
  }
}

TEST(IfcConstruct, AShellThatIsSaidToBeClosedAndIsNotIsPointedOut) {
  const ImportedModel model =
      importText(ifcText("#100=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(1.,0.,0.),(0.,1.,0.),(0.,0.,1.)));\n#101="
                         "IFCTRIANGULATEDFACESET(#100,$,.T.,((1,3,2),(1,2,4),(1,4,3)),$);\n" +
                         product(110, "IFCFURNISHINGELEMENT", "#101", "Tessellation")));
  EXPECT_TRUE(tells(model, "#110", "declared closed")) << issuesOf(model);
}

TEST(IfcConstruct, ATurnThatRoundingCarriedBeyondItselfIsAWholeOne) {
  const ImportedModel model = importText(
      ifcText("#100=IFCCIRCLE(#7,0.5);\n#101=IFCTRIMMEDCURVE(#100,(IFCPARAMETERVALUE(0.)),(IFCPARAMETERVALUE(6."
              "28318977355957)),.T.,.PARAMETER.);\n#102=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#101);\n"
              "#103=IFCCOMPOSITECURVE((#102),.F.);\n#104=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#103);\n#105="
              "IFCEXTRUDEDAREASOLID(#104,$,#4,1.);\n" +
              product(110, "IFCPLATE", "#105")));
  EXPECT_NEAR(volumeOf(model, "#110") / (std::numbers::pi * 0.25), 1, 0.01);
}

TEST(IfcConstruct, AnElbowWhoseReferenceSurfaceLiesElsewhereIsStillAnElbow) {
  // As old exports of Revit write it: a pipe of radius 51.5875 around a bend of 57.9375, whose directrix is the inner
  // edge (6.35) and whose profile is shifted along its y. Pappus: the area times a quarter turn of the middle.
  const ImportedModel model = importText(
      ifcText("#90=IFCCARTESIANPOINT((0.,51.5875));\n#91=IFCAXIS2PLACEMENT2D(#90,$);\n#92=IFCCIRCLEPROFILEDEF(.AREA.,$,"
              "#91,51.5875);\n#93=IFCCARTESIANPOINT((-6.35,0.));\n#94=IFCDIRECTION((0.,1.));\n"
              "#95=IFCAXIS2PLACEMENT2D(#93,#94);\n#96=IFCCIRCLE(#95,6.35);\n#97=IFCTRIMMEDCURVE(#96,(IFCPARAMETERVALUE("
              "4.71238898038469)),(IFCPARAMETERVALUE(0.)),.T.,.PARAMETER.);\n"
              "#98=IFCARBITRARYOPENPROFILEDEF(.CURVE.,$,#97);\n#99=IFCCARTESIANPOINT((0.,0.,-304.8));\n#100="
              "IFCAXIS2PLACEMENT3D(#99,$,$);\n#101=IFCDIRECTION((0.,0.,-1.));\n"
              "#102=IFCSURFACEOFLINEAREXTRUSION(#98,#100,#101,1.);\n#103=IFCSURFACECURVESWEPTAREASOLID(#92,#2,#97,0.,"
              "360.,#102);\n" +
                  product(110, "IFCPIPEFITTING", "#103"),
              "IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.)"));
  const double r = 0.0515875;
  EXPECT_NEAR(volumeOf(model, "#110") / (std::numbers::pi * r * r * std::numbers::pi / 2 * 0.0579375), 1, 0.01);
  EXPECT_TRUE(tells(model, "#103", "reference surface")) << issuesOf(model);
}

TEST(IfcConstruct, ArcsBeyondATurnOfRadiansAreInDegreesWhereNoUnitIsStated) {
  // A quarter disk of radius 2, its arc from 90 to 180.
  std::string text = ifcText(
      "#100=IFCCIRCLE(#7,2.);\n#101=IFCTRIMMEDCURVE(#100,(IFCPARAMETERVALUE(90.)),(IFCPARAMETERVALUE(180.)),.T.,."
      "PARAMETER.);\n#102=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#101);\n"
      "#103=IFCCARTESIANPOINT((-2.,0.));\n#104=IFCCARTESIANPOINT((0.,2.));\n#105=IFCPOLYLINE((#103,#6,#104));\n#106="
      "IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#105);\n"
      "#107=IFCCOMPOSITECURVE((#102,#106),.F.);\n#108=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#107);\n#109="
      "IFCEXTRUDEDAREASOLID(#108,$,#4,1.);\n" +
      product(110, "IFCPLATE", "#109"));
  text.replace(text.find("(#10,#13)"), 9, "(#10)");
  const ImportedModel model = importText(text);
  EXPECT_NEAR(volumeOf(model, "#110"), std::numbers::pi, 0.01);
  EXPECT_TRUE(tells(model, "#11", "degrees assumed")) << issuesOf(model);
}

}  // namespace
}  // namespace standpoint::test
