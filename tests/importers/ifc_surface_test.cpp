// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies on curved and bounded surfaces, and curves that are known by a surface's parameters, each against its formula.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/importers/ifc_fixture.h"

namespace standpoint::test {
namespace {

// A quarter of a cylinder's side, radius 2, height 3, around the z axis from +x to +y; a face bounded by `edges`.
std::string quarterCylinder(const std::string& surface, const std::string& arcs) {
  return surface +
         "#200=IFCCARTESIANPOINT((2.,0.,0.));\n#201=IFCCARTESIANPOINT((0.,2.,0.));\n#202=IFCCARTESIANPOINT((0.,2.,3.));"
         "\n#203=IFCCARTESIANPOINT((2.,0.,3.));\n"
         "#204=IFCVERTEXPOINT(#200);\n#205=IFCVERTEXPOINT(#201);\n#206=IFCVERTEXPOINT(#202);\n#207=IFCVERTEXPOINT(#203)"
         ";\n#208=IFCDIRECTION((0.,0.,1.));\n#209=IFCVECTOR(#208,1.);\n"
         "#210=IFCLINE(#201,#209);\n#211=IFCLINE(#200,#209);\n" +
         arcs +
         "#220=IFCEDGECURVE(#204,#205,#212,.T.);\n#221=IFCEDGECURVE(#205,#206,#210,.T.);\n#222=IFCEDGECURVE(#207,#206,#"
         "213,.T.);\n#223=IFCEDGECURVE(#204,#207,#211,.T.);\n"
         "#224=IFCORIENTEDEDGE(*,*,#220,.T.);\n#225=IFCORIENTEDEDGE(*,*,#221,.T.);\n#226=IFCORIENTEDEDGE(*,*,#222,.F.);"
         "\n#227=IFCORIENTEDEDGE(*,*,#223,.F.);\n"
         "#228=IFCEDGELOOP((#224,#225,#226,#227));\n#229=IFCFACEOUTERBOUND(#228,.T.);\n#230=IFCADVANCEDFACE((#229),#"
         "101,.T.);\n#231=IFCOPENSHELL((#230));\n#232=IFCSHELLBASEDSURFACEMODEL((#231));\n" +
         product(110, "IFCPLATE", "#232", "SurfaceModel");
}

const std::string kCylinder = "#100=IFCCYLINDRICALSURFACE(#2,2.);\n";
const std::string kCircles =
    "#214=IFCAXIS2PLACEMENT3D(#203,$,$);\n#215=IFCCARTESIANPOINT((0.,0.,3.));\n#216=IFCAXIS2PLACEMENT3D(#215,$,$);\n#"
    "212=IFCCIRCLE(#2,2.);\n#213=IFCCIRCLE(#216,2.);\n";
// The same arcs as straight lines in the cylinder's parameters: angle across, height up.
const std::string kPcurves =
    "#240=IFCCARTESIANPOINT((0.,0.));\n#241=IFCCARTESIANPOINT((1.5707963267948966,0.));\n#242=IFCPOLYLINE((#240,#241));"
    "\n#212=IFCPCURVE(#100,#242);\n"
    "#243=IFCCARTESIANPOINT((0.,3.));\n#244=IFCCARTESIANPOINT((1.5707963267948966,3.));\n#245=IFCPOLYLINE((#243,#244));"
    "\n#246=IFCPCURVE(#100,#245);\n#213=IFCINTERSECTIONCURVE($,(#246,#246),.PCURVE_S1.);\n";

void expectQuarterCylinder(const std::string& records) {
  const ImportedModel model = importText(ifcText(records));
  EXPECT_EQ(model.report.losses(), 0U) << issuesOf(model);
  EXPECT_NEAR(areaOf(model, "#110"), std::numbers::pi / 2 * 2 * 3, 0.01);
  expectNear(boundsOf(model, "#110").max, {2, 2, 3}, 1e-5);
  expectNear(boundsOf(model, "#110").min, {0, 0, 0}, 1e-5);
}

TEST(IfcSurface, AFaceMayLieOnATrimmedSurface) {
  expectQuarterCylinder(
      quarterCylinder(kCylinder + "#101=IFCRECTANGULARTRIMMEDSURFACE(#100,0.,0.,3.2,3.,.T.,.T.);\n", kCircles));
}

TEST(IfcSurface, AnEdgeMayBeACurveInTheParametersOfItsSurface) {
  expectQuarterCylinder(
      quarterCylinder("#100=IFCCYLINDRICALSURFACE(#2,2.);\n#101=IFCCURVEBOUNDEDSURFACE(#100,(),.F.);\n", kPcurves));
}

TEST(IfcSurface, ATrimmedCylinderIsABodyOfItsOwn) {
  // From 3π/2 forward to π/2: half of it, over the angle zero.
  const ImportedModel model =
      importText(ifcText("#100=IFCCYLINDRICALSURFACE(#2,2.);\n#101=IFCRECTANGULARTRIMMEDSURFACE(#100,4.71238898038469,"
                         "1.,1.5707963267948966,4.,.T.,.T.);\n" +
                         product(110, "IFCPLATE", "#101", "Surface3D")));
  EXPECT_NEAR(areaOf(model, "#110"), std::numbers::pi * 2 * 3, 0.02);
  expectNear(boundsOf(model, "#110").min, {0, -2, 1}, 1e-5);
  expectNear(boundsOf(model, "#110").max, {2, 2, 4}, 1e-5);
}

TEST(IfcSurface, AnglesInDegreesTrimASphere) {
  // A half turn of the upper hemisphere of radius 3: 2πr²/2.
  std::string text = ifcText(
      "#90=IFCDIMENSIONALEXPONENTS(0,0,0,0,0,0,0);\n#91=IFCSIUNIT(*,.PLANEANGLEUNIT.,$,.RADIAN.);\n#92="
      "IFCMEASUREWITHUNIT(IFCPLANEANGLEMEASURE(0.017453292519943295),#91);\n"
      "#100=IFCSPHERICALSURFACE(#2,3.);\n#101=IFCRECTANGULARTRIMMEDSURFACE(#100,0.,0.,180.,90.,.T.,.T.);\n" +
      product(110, "IFCPLATE", "#101", "Surface3D"));
  const std::string radian = "#13=IFCSIUNIT(*,.PLANEANGLEUNIT.,$,.RADIAN.);";
  text.replace(text.find(radian), radian.size(), "#13=IFCCONVERSIONBASEDUNIT(#90,.PLANEANGLEUNIT.,'DEGREE',#92);");
  const ImportedModel model = importText(text);
  EXPECT_NEAR(areaOf(model, "#110"), std::numbers::pi * 9, 0.03);
}

TEST(IfcSurface, ACurveBoundedSurfaceIsWhatItsBoundaryEncloses) {
  const ImportedModel model =
      importText(ifcText(kCylinder +
                         "#240=IFCCARTESIANPOINT((0.,0.));\n#241=IFCCARTESIANPOINT((1.,0.));\n#242=IFCCARTESIANPOINT(("
                         "1.,3.));\n#243=IFCCARTESIANPOINT((0.,3.));\n"
                         "#244=IFCPOLYLINE((#240,#241,#242,#243,#240));\n#245=IFCPCURVE(#100,#244);\n#246="
                         "IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#245);\n#247=IFCOUTERBOUNDARYCURVE((#246),.F.);\n"
                         "#101=IFCCURVEBOUNDEDSURFACE(#100,(#247),.F.);\n" +
                         product(110, "IFCPLATE", "#101", "Surface3D")));
  EXPECT_NEAR(areaOf(model, "#110"), 1 * 2 * 3, 0.005);  // an angle of 1 at radius 2, 3 high
  EXPECT_EQ(model.report.losses(), 0U) << issuesOf(model);
}

TEST(IfcSurface, AnImplicitOuterBoundaryIsNamedAsLost) {
  const ImportedModel model = importText(ifcText(kCylinder + "#101=IFCCURVEBOUNDEDSURFACE(#100,(),.T.);\n" +
                                                 product(110, "IFCPLATE", "#101", "Surface3D")));
  EXPECT_TRUE(tells(model, "#101", "implicit outer boundary")) << issuesOf(model);
}

TEST(IfcSurface, ASweepAlongACurveInTheParametersOfItsPlane) {
  // A disk of 0.1 around a square corner of 2 + 2, drawn in the plane x = 5; mitred, so that its volume is area times
  // length.
  const ImportedModel model = importText(
      ifcText("#90=IFCCARTESIANPOINT((5.,0.,0.));\n#91=IFCAXIS2PLACEMENT3D(#90,#5,#4);\n#92=IFCPLANE(#91);\n#240="
              "IFCCARTESIANPOINT((0.,0.));\n#241=IFCCARTESIANPOINT((2.,0.));\n#242=IFCCARTESIANPOINT((2.,2.));\n"
              "#243=IFCPOLYLINE((#240,#241,#242));\n#244=IFCPCURVE(#92,#243);\n#245=IFCSURFACECURVE($,(#244),.PCURVE_"
              "S1.);\n#101=IFCSWEPTDISKSOLID(#245,0.1,$,$,$);\n" +
              product(110, "IFCPIPESEGMENT", "#101")));
  EXPECT_NEAR(volumeOf(model, "#110") / (std::numbers::pi * 0.01 * 4), 1, 0.01);
  EXPECT_NEAR(boundsOf(model, "#110").max.z(), 2.1, 1e-4);  // the plane's x is the model's z
}

// A curve in the XY plane, turned around the y axis through `axis`.
std::string turned(const std::string& curve, const std::string& position = "#2", const std::string& axis = "#1") {
  return curve + "#240=IFCARBITRARYOPENPROFILEDEF(.CURVE.,$,#230);\n#241=IFCDIRECTION((0.,1.,0.));\n" +
         "#242=IFCAXIS1PLACEMENT(" + axis + ",#241);\n#243=IFCSURFACEOFREVOLUTION(#240," + position + ",#242);\n" +
         product(110, "IFCPLATE", "#243", "Surface3D");
}
const std::string kSlant =
    "#228=IFCCARTESIANPOINT((1.,0.));\n#229=IFCCARTESIANPOINT((2.,3.));\n#230=IFCPOLYLINE((#228,#229));\n";

TEST(IfcSurface, ARevolvedLineIsTheSideOfACone) {
  const ImportedModel model = importText(ifcText(turned(kSlant)));
  EXPECT_EQ(model.report.losses(), 0U) << issuesOf(model);
  EXPECT_NEAR(areaOf(model, "#110") / (std::numbers::pi * (1 + 2) * std::sqrt(1 + 9)), 1, 0.002);
  expectNear(boundsOf(model, "#110").max, {2, 3, 2}, 1e-5);
  expectNear(boundsOf(model, "#110").min, {-2, 0, -2}, 1e-5);
}

TEST(IfcSurface, ARevolvedArcThatEndsOnItsAxisIsAClosedBall) {
  const ImportedModel model = importText(
      ifcText(turned("#226=IFCCARTESIANPOINTLIST2D(((0.,-1.),(1.,0.),(0.,1.)));\n#230=IFCINDEXEDPOLYCURVE(#226,("
                     "IFCARCINDEX((1,2,3))),.F.);\n")));
  EXPECT_EQ(model.report.losses(), 0U) << issuesOf(model);
  EXPECT_NEAR(areaOf(model, "#110") / (4 * std::numbers::pi), 1, 0.005);
  EXPECT_NEAR(volumeOf(model, "#110") / (4 * std::numbers::pi / 3), 1, 0.005);
}

TEST(IfcSurface, TheAxisOfARevolutionMayBeStatedInTheFrameOfTheShape) {
  const std::string raised = "#220=IFCCARTESIANPOINT((10.,0.,5.));\n#221=IFCAXIS2PLACEMENT3D(#220,$,$);\n";
  const ImportedModel model = importText(ifcText(raised + turned(kSlant, "#221", "#220")));
  expectNear(boundsOf(model, "#110").max, {12, 3, 7}, 1e-5);
}

TEST(IfcSurface, ACurveOnItsAxisOfRevolutionIsNamedAsLost) {
  const ImportedModel model = importText(
      ifcText(turned("#228=IFCCARTESIANPOINT((0.,0.));\n#229=IFCCARTESIANPOINT((0.,3.));\n#230=IFCPOLYLINE((#228,#229))"
                     ";\n")));
  EXPECT_TRUE(tells(model, "#243", "no area")) << issuesOf(model);
}

// Half of the upper hemisphere, from +x over +y to −x: two meridians and half of the equator, in any order.
ImportedModel quarterBall(const std::string& radius, const std::string& edges) {
  return importText(ifcText(
      "#100=IFCSPHERICALSURFACE(#2," + radius + ");\n#200=IFCCARTESIANPOINT((" + radius +
      ",0.,0.));\n#201=IFCCARTESIANPOINT((-" + radius + ",0.,0.));\n#202=IFCCARTESIANPOINT((0.,0.," + radius +
      "));\n"
      "#204=IFCVERTEXPOINT(#200);\n#205=IFCVERTEXPOINT(#201);\n#206=IFCVERTEXPOINT(#202);\n#207=IFCDIRECTION((0.,-1.,0."
      "));\n#208=IFCAXIS2PLACEMENT3D(#1,#207,#5);\n#209=IFCCIRCLE(#2," +
      radius + ");\n#210=IFCCIRCLE(#208," + radius +
      ");\n"
      "#220=IFCEDGECURVE(#204,#205,#209,.T.);\n#221=IFCEDGECURVE(#206,#205,#210,.T.);\n#222=IFCEDGECURVE(#204,#206,#"
      "210,.T.);\n"
      "#224=IFCORIENTEDEDGE(*,*,#220,.T.);\n#225=IFCORIENTEDEDGE(*,*,#221,.F.);\n#226=IFCORIENTEDEDGE(*,*,#222,.F.);\n"
      "#228=IFCEDGELOOP((" +
      edges +
      "));\n#229=IFCFACEOUTERBOUND(#228,.T.);\n#230=IFCADVANCEDFACE((#229),#100,.T.);\n#231=IFCOPENSHELL((#230));\n#"
      "232=IFCSHELLBASEDSURFACEMODEL((#231));\n" +
      product(110, "IFCPLATE", "#232", "SurfaceModel")));
}

TEST(IfcSurface, AFaceMayHaveACornerAtThePole) {
  for (const char* edges : {"#224,#225,#226", "#225,#226,#224", "#226,#224,#225"}) {
    const ImportedModel model = quarterBall("0.2", edges);
    EXPECT_EQ(model.report.losses(), 0U) << issuesOf(model);
    EXPECT_NEAR(areaOf(model, "#110") / (std::numbers::pi * 0.04), 1, 0.01);
  }
}

TEST(IfcSurface, ALargeBallKeepsToTheChordErrorAwayFromItsBounds) {
  for (const char* edges : {"#224,#225,#226", "#225,#226,#224", "#226,#224,#225"}) {
    const ImportedModel model = quarterBall("2.", edges);
    EXPECT_EQ(issuesOf(model).find("coarser"), std::string::npos);
    EXPECT_NEAR(areaOf(model, "#110") / (std::numbers::pi * 4), 1, 0.005);
    double inner = 0, outer = 0;
    const auto& e = model.environment;
    for (const auto& i : e.instances)
      for (const auto& t : e.meshes[i.mesh]->triangles) {
        Eigen::Vector3d middle = Eigen::Vector3d::Zero();
        for (const auto v : t) middle += i.world_from_mesh * e.meshes[i.mesh]->positions[v].cast<double>() / 3;
        const bool at_bound = middle.y() < 0.2 || middle.z() < 0.2;
        (at_bound ? outer : inner) = std::max(at_bound ? outer : inner, std::abs(middle.norm() - 2));
      }
    EXPECT_LE(inner, 0.001);
    EXPECT_LE(outer, 2 * (1 - std::cos(std::numbers::pi / 32)) + 0.001);  // circles have 32 chords
  }
}

}  // namespace
}  // namespace standpoint::test
