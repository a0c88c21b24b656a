// SPDX-License-Identifier: GPL-3.0-or-later
// Sections along alignments, cant, open and rail profiles, and parts of directrices, each against its formula.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/importers/ifc_fixture.h"

namespace standpoint::test {
namespace {

const std::string kInMetres = "IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)";

// 100 m straight along x. Cant: the left rail rises by 0.15 m from 20 m to 60 m with a clothoid, gauge 1.5 m, its
// middle by half of that; then it stays. #150 is the curve.
const double kRoll = std::asin(0.1);
std::string cantedTrack() {
  const std::string y = std::to_string(-0.1), z = std::to_string(std::sqrt(1 - 0.01));
  return "#120=IFCVECTOR(#121,1.);\n#121=IFCDIRECTION((1.,0.));\n#122=IFCLINE(#6,#120);\n#123=IFCCURVESEGMENT(."
         "CONTINUOUS.,#7,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(100.),#122);\n"
         "#124=IFCCOMPOSITECURVE((#123),.F.);\n#125=IFCGRADIENTCURVE((#123),.F.,#124,$);\n"
         "#130=IFCCURVESEGMENT(.CONTINUOUS.,#2,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(20.),#122);\n"
         "#131=IFCCARTESIANPOINT((20.,0.,0.));\n#132=IFCAXIS2PLACEMENT3D(#131,#4,#5);\n#133=IFCCLOTHOID(#7,146."
         "05934866804428);\n"
         "#134=IFCCURVESEGMENT(.CONTINUOUS.,#132,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(40.),#133);\n"
         "#135=IFCCARTESIANPOINT((60.,0.075,0.));\n#136=IFCDIRECTION((0.," +
         y + "," + z +
         "));\n#137=IFCAXIS2PLACEMENT3D(#135,#136,#5);\n"
         "#138=IFCCURVESEGMENT(.CONTINUOUS.,#137,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(40.),#122);\n"
         "#139=IFCCARTESIANPOINT((100.,0.075,0.));\n#140=IFCAXIS2PLACEMENT3D(#139,#136,#5);\n#150="
         "IFCSEGMENTEDREFERENCECURVE((#130,#134,#138),.F.,#125,#140);\n";
}

// A box of 0.02 × 3 × 0.02 across the track at a distance along it.
Bounds sleeperAt(const std::string& distance, const std::string& axis = "$") {
  const ImportedModel model = importText(
      ifcText(cantedTrack() + "#151=IFCPOINTBYDISTANCEEXPRESSION(IFCLENGTHMEASURE(" + distance +
                  "),$,$,$,#150);\n#152=IFCAXIS2PLACEMENTLINEAR(#151," + axis +
                  ",$);\n"
                  "#153=IFCLINEARPLACEMENT($,#152,$);\n" +
                  boxSolid(106, "0.02", "3.", "0.02") + product(110, "IFCTRACKELEMENT", "#108", "SweptSolid", "#153"),
              kInMetres, "IFC4X3_ADD2"));
  EXPECT_EQ(model.report.losses(), 0U) << issuesOf(model);
  return boundsOf(model, "#110");
}

TEST(IfcSection, WhatStandsAlongATrackLeansWithItsCant) {
  const double half = 1.5;
  const Bounds before = sleeperAt("10."), after = sleeperAt("80."), midway = sleeperAt("40.");
  EXPECT_NEAR(before.max.z() - before.min.z(), 0.02, 1e-5);
  EXPECT_NEAR(after.min.z(), 0.075 - half * std::sin(kRoll), 1e-5);
  EXPECT_NEAR(after.max.z(), 0.075 + half * std::sin(kRoll) + 0.02 * std::cos(kRoll), 1e-5);
  // A clothoid's curvature, and so the lift and the angle, are at their half in the middle.
  EXPECT_NEAR(midway.min.z(), 0.0375 - half * std::sin(kRoll / 2), 1e-4);
}

TEST(IfcSection, AStatedAxisIsNotLeanedOnceMore) {
  const Bounds b = sleeperAt("80.", "#136");
  EXPECT_NEAR(b.min.z(), 0.075 - 1.5 * std::sin(kRoll), 1e-5);
}

TEST(IfcSection, ASolidAlongATrackLeansWithItsCant) {
  const ImportedModel model = importText(
      ifcText(cantedTrack() +
                  "#151=IFCPOINTBYDISTANCEEXPRESSION(IFCLENGTHMEASURE(0.),$,$,$,#150);\n#152=IFCAXIS2PLACEMENTLINEAR(#"
                  "151,$,$);\n#153=IFCPOINTBYDISTANCEEXPRESSION(IFCLENGTHMEASURE(100.),$,$,$,#150);\n"
                  "#154=IFCAXIS2PLACEMENTLINEAR(#153,$,$);\n#155=IFCRECTANGLEPROFILEDEF(.AREA.,$,#7,3.,0.2);\n#156="
                  "IFCSECTIONEDSOLIDHORIZONTAL(#150,(#155,#155),(#152,#154));\n" +
                  product(110, "IFCCOURSE", "#156"),
              kInMetres, "IFC4X3_ADD2"));
  const Bounds b = boundsOf(model, "#110");
  EXPECT_NEAR(b.max.z(), 0.075 + 1.5 * std::sin(kRoll) + 0.1 * std::cos(kRoll), 1e-5);
  EXPECT_NEAR(b.min.z(), 0.075 - 1.5 * std::sin(kRoll) - 0.1 * std::cos(kRoll), 1e-5);
  EXPECT_NEAR(volumeOf(model, "#110") / (3 * 0.2 * 100), 1,
              0.002);  // sections stand upright: the area times the way in the plan
}

TEST(IfcSection, ACantedDirectrixTurnsASweepAlongWithIt) {
  // A beam of 0.1 × 0.1, 1 m to the left of the track; the reference direction is "up".
  const ImportedModel model = importText(ifcText(cantedTrack() +
                                                     "#151=IFCCARTESIANPOINT((0.,-1.));\n#152=IFCAXIS2PLACEMENT2D(#151,"
                                                     "$);\n#153=IFCRECTANGLEPROFILEDEF(.AREA.,$,#152,0.1,0.1);\n"
                                                     "#154=IFCDIRECTRIXDERIVEDREFERENCESWEPTAREASOLID(#153,$,#150,"
                                                     "IFCLENGTHMEASURE(60.),IFCLENGTHMEASURE(100.),#4);\n" +
                                                     product(110, "IFCRAIL", "#154"),
                                                 kInMetres, "IFC4X3_ADD2"));
  const Bounds b = boundsOf(model, "#110");
  // x of the profile points up, its y to the right of the way.
  const double to_side = std::abs(b.min.y()) < std::abs(b.max.y()) ? 1 : -1;
  EXPECT_NEAR((b.min.z() + b.max.z()) / 2, 0.075 + to_side * std::sin(kRoll), 0.001);
  EXPECT_NEAR(volumeOf(model, "#110"), 0.01 * 40, 1e-4);
}

// Along 20 m of x; `sections` are two open profiles #160 and #161.
ImportedModel road(const std::string& sections,
                   const std::string& solid = "IFCSECTIONEDSURFACE(#123,(#152,#154),(#160,#161))") {
  return importText(ifcText(
      "#121=IFCCARTESIANPOINT((0.,0.,0.));\n#122=IFCCARTESIANPOINT((20.,0.,0.));\n#123=IFCPOLYLINE((#121,#122));\n"
      "#151=IFCPOINTBYDISTANCEEXPRESSION(IFCLENGTHMEASURE(0.),$,$,$,#123);\n#152=IFCAXIS2PLACEMENTLINEAR(#151,$,$);\n#"
      "153=IFCPOINTBYDISTANCEEXPRESSION(IFCLENGTHMEASURE(20.),$,$,$,#123);\n"
      "#154=IFCAXIS2PLACEMENTLINEAR(#153,$,$);\n" +
          sections + "#170=" + solid + ";\n" + product(110, "IFCCOURSE", "#170", "SectionedSurface"),
      kInMetres, "IFC4X3_ADD2"));
}

TEST(IfcSection, AnOpenCrossProfileSlopesByItsWidthsAndAngles) {
  // From 3 m to the right: 3 m up at 45° measured horizontally, 3 m level along its slope.
  const std::string section = "=IFCOPENCROSSPROFILEDEF(.CURVE.,$,.T.,(3.,3.),(0.7853981633974483,0.),$,#162);\n";
  const ImportedModel model = road("#162=IFCCARTESIANPOINT((-3.,0.));\n#160" + section + "#161" + section);
  EXPECT_NEAR(areaOf(model, "#110"), 20 * (3 * std::sqrt(2.0) + 3), 1e-3);
  expectNear(boundsOf(model, "#110").min, {0, -3, 0}, 1e-5);  // x of a profile is to the left of the way, here +y
  expectNear(boundsOf(model, "#110").max, {20, 3, 3}, 1e-5);
}

TEST(IfcSection, ABreaklineMayBeginBetweenTwoSections) {
  // Level and 6 m wide at first, then with a ridge of 1 m in the middle: a tag of its own. Two halves that twist, each
  // a ruled patch of one triangle and one that rises: over the plan of 120 m² lie areas that the ends bound.
  const ImportedModel model = road(
      "#162=IFCCARTESIANPOINT((-3.,0.));\n#160=IFCOPENCROSSPROFILEDEF(.CURVE.,$,.T.,(6.),(0.),('R','L'),#162);\n"
      "#161=IFCOPENCROSSPROFILEDEF(.CURVE.,$,.T.,(3.,3.),(0.3217505543966422,-0.3217505543966422),('R','M','L'),#162);"
      "\n");  // atan(1/3)
  EXPECT_NEAR(boundsOf(model, "#110").max.z(), 1, 1e-5);
  EXPECT_GT(areaOf(model, "#110"), 120);
  EXPECT_LT(areaOf(model, "#110"), 20 * 2 * std::sqrt(10.0));
}

TEST(IfcSection, AnExtrudedSurfaceMayStartFromAnOpenCrossProfile) {
  const ImportedModel model =
      importText(ifcText("#100=IFCOPENCROSSPROFILEDEF(.CURVE.,$,.F.,(3.,4.),(0.,1.5707963267948966),$,$);\n#101="
                         "IFCSURFACEOFLINEAREXTRUSION(#100,#2,#4,2.);\n" +
                             product(110, "IFCPLATE", "#101", "Surface3D"),
                         kInMetres, "IFC4X3_ADD2"));
  EXPECT_NEAR(areaOf(model, "#110"), (3 + 4) * 2, 1e-5);
  expectNear(boundsOf(model, "#110").max, {3, 4, 2}, 1e-5);
}

TEST(IfcSection, OpenSectionsOfASolidAreASurface) {
  const std::string section = "=IFCOPENCROSSPROFILEDEF(.CURVE.,$,.T.,(3.,3.),(0.,0.),$,$);\n";
  const ImportedModel model =
      road("#160" + section + "#161" + section, "IFCSECTIONEDSOLIDHORIZONTAL(#123,(#160,#161),(#152,#154))");
  EXPECT_NEAR(areaOf(model, "#110"), 6 * 20, 1e-4);
  EXPECT_TRUE(tells(model, "#170", "open")) << issuesOf(model);
}

// Area of a profile, extruded by 1 m; lengths in millimetres.
double areaOfProfile(const std::string& profile) {
  const ImportedModel model = importText(
      ifcText("#100=" + profile + ";\n#101=IFCEXTRUDEDAREASOLID(#100,$,#4,1000.);\n" + product(110, "IFCBEAM", "#101"),
              "IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.)", "IFC2X3"));
  EXPECT_EQ(model.report.losses(), 0U) << issuesOf(model);
  return volumeOf(model, "#110") * 1e6;
}

TEST(IfcSection, ACraneRailHasTheMassOfItsTable) {
  // DIN 536-1: A 45 has 22.1 kg/m, A 75 has 56.2 kg/m; steel of 7850 kg/m³. The fillets, which the entity does not
  // state, are less than 1 %.
  const double a45 =
      areaOfProfile("IFCCRANERAILASHAPEPROFILEDEF(.AREA.,$,#7,55.,125.,4.,45.,24.,20.,24.,54.,14.5,11.,8.,$)");
  const double a75 =
      areaOfProfile("IFCCRANERAILASHAPEPROFILEDEF(.AREA.,$,#7,85.,200.,8.,75.,39.5,35.,45.,90.,22.,15.4,11.,$)");
  EXPECT_NEAR(a45 * 7850e-6 / 22.1, 1, 0.01);
  EXPECT_NEAR(a75 * 7850e-6 / 56.2, 1, 0.01);
}

TEST(IfcSection, AFlatCraneRailIsTheSumOfItsTrapezia) {
  // Head 100 wide: 25 deep, then 5 more to the web of 60; foot 15 thick at its edge, 20 at the web; 80 high.
  const double exact = 100 * 25 + (100 + 60) / 2.0 * 5 + 60 * (80 - 30 - 20) + (100 + 60) / 2.0 * 5 + 100 * 15;
  EXPECT_NEAR(areaOfProfile("IFCCRANERAILFSHAPEPROFILEDEF(.AREA.,$,#7,80.,100.,$,30.,25.,60.,20.,15.,$)"), exact, 0.01);
}

TEST(IfcSection, ParametersOfACompositeCurveAreTheSumOfItsSegments) {
  // A line of 10 m (10 of its vectors of 1 m), a quarter circle (π/2), a line of 5 m: from 4 to 10 + π/4 leaves 6 m and
  // half of the arc of radius 2.
  const std::string records =
      "#100=IFCDIRECTION((1.,0.,0.));\n#101=IFCVECTOR(#100,1.);\n#102=IFCLINE(#1,#101);\n#103=IFCTRIMMEDCURVE(#102,("
      "IFCPARAMETERVALUE(0.)),(IFCPARAMETERVALUE(10.)),.T.,.PARAMETER.);\n"
      "#104=IFCCARTESIANPOINT((10.,2.,0.));\n#105=IFCAXIS2PLACEMENT3D(#104,$,$);\n#106=IFCCIRCLE(#105,2.);\n#107="
      "IFCTRIMMEDCURVE(#106,(IFCPARAMETERVALUE(4.71238898038469)),(IFCPARAMETERVALUE(6.283185307179586)),.T.,."
      "PARAMETER.);\n"
      "#108=IFCCARTESIANPOINT((12.,2.,0.));\n#120=IFCCARTESIANPOINT((12.,7.,0.));\n#121=IFCPOLYLINE((#108,#120));\n"
      "#122=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#103);\n#123=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#107);\n#"
      "124=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#121);\n"
      "#125=IFCCOMPOSITECURVE((#122,#123,#124),.F.);\n#126=IFCRECTANGLEPROFILEDEF(.AREA.,$,#7,0.2,0.1);\n"
      "#127=IFCFIXEDREFERENCESWEPTAREASOLID(#126,$,#125,4.,10.785398163397448,#4);\n";
  const ImportedModel model = importText(ifcText(records + product(110, "IFCBEAM", "#127")));
  EXPECT_NEAR(volumeOf(model, "#110") / (0.02 * (6 + std::numbers::pi / 4 * 2)), 1, 0.002);
  EXPECT_NEAR(boundsOf(model, "#110").min.x(), 4, 1e-6);
}

}  // namespace
}  // namespace standpoint::test
