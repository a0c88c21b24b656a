// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tests/core/own_seconds.h"
#include "tests/importers/ifc_fixture.h"

namespace standpoint::test {
namespace {

bool loses(const ImportedModel& model, const std::string& source, const std::string& words = "") {
  const auto& issues = model.report.issues;
  return std::any_of(issues.begin(), issues.end(), [&](const Issue& i) {
    return i.severity == Severity::loss && i.source == source && i.message.find(words) != std::string::npos;
  });
}

bool warns(const ImportedModel& model, const std::string& source, const std::string& words) {
  const auto& issues = model.report.issues;
  return std::any_of(issues.begin(), issues.end(), [&](const Issue& i) {
    return i.severity == Severity::warning && i.source == source && i.message.find(words) != std::string::npos;
  });
}

const std::string kWallBox = boxSolid(100, "4.", "0.3", "3.");

ImportedModel wallAt(const std::string& placement_records) {
  return importText(ifcText(placement_records + kWallBox + product(110, "IFCWALL", "#102", "SweptSolid", "#90")));
}

TEST(IfcLosses, APlacementThatIsNoFiniteNumberIsALossThatNamesItsProduct) {
  for (const std::string x :
       {"nan", "NAN", "inf", "1.#QNAN", "-1.#IND", "1.E400", "1.E300", "-3.E15", "((1.))", "'1'"}) {
    const ImportedModel model =
        wallAt("#92=IFCCARTESIANPOINT((" + x + ",0.,0.));\n#91=IFCAXIS2PLACEMENT3D(#92,$,$);\n" +
               "#90=IFCLOCALPLACEMENT(#3,#91);\n");
    EXPECT_TRUE(loses(model, "#110", "IfcWall guid110 is not where it belongs: see placement #90")) << x << "\n"
                                                                                                    << issuesOf(model);
    EXPECT_EQ(validate(model.environment), "") << x;
    EXPECT_NEAR(volumeOf(model, "#110"), 3.6, 1e-5) << x;
  }
}

TEST(IfcLosses, ADirectionOrAReferenceThatCannotBeReadIsALossThatNamesItsProduct) {
  for (const std::string placement :
       {"#92=IFCDIRECTION((0.,nan,1.));\n#91=IFCAXIS2PLACEMENT3D(#1,#92,$);\n#90=IFCLOCALPLACEMENT(#3,#91);\n",
        "#91=IFCAXIS2PLACEMENT3D(#999,$,$);\n#90=IFCLOCALPLACEMENT(#3,#91);\n", "#90=IFCLOCALPLACEMENT(#3,#999);\n",
        "#90=IFCLOCALPLACEMENT(#999,#2);\n", ""}) {
    const ImportedModel model = wallAt(placement);
    EXPECT_TRUE(loses(model, "#110", "IfcWall guid110 is not where it belongs")) << placement << issuesOf(model);
    EXPECT_NEAR(volumeOf(model, "#110"), 3.6, 1e-5) << placement;
  }
}

TEST(IfcLosses, AMapPositionThatIsNoFiniteNumberIsALoss) {
  const ImportedModel model = importText(ifcText(
      "#80=IFCPROJECTEDCRS('EPSG:25832',$,$,$,$,$,$);\n#81=IFCMAPCONVERSION(#12,#80,500000.,nan,0.,1.,0.,1.);\n"));
  EXPECT_TRUE(loses(model, "#81", "nan is not a finite number")) << issuesOf(model);
}

TEST(IfcLosses, AHugeDirectionIsADirection) {
  const ImportedModel model = wallAt(
      "#92=IFCDIRECTION((1.E300,1.E300,0.));\n#91=IFCAXIS2PLACEMENT3D(#1,#4,#92);\n#90=IFCLOCALPLACEMENT(#3,#91);\n");
  EXPECT_EQ(model.report.losses(), 0U) << issuesOf(model);
  EXPECT_NEAR(boundsOf(model, "#110").max.y(), 2.15 / std::sqrt(2), 1e-5);
}

TEST(IfcLosses, ACoordinateOfAShapeThatIsNoNumberIsALossThatNamesItsProduct) {
  for (const std::string shape :
       {"#101=IFCCARTESIANPOINT((nan,0.,0.));\n#102=IFCAXIS2PLACEMENT3D(#101,$,$);\n#103=IFCRECTANGLEPROFILEDEF(.AREA.,"
        "$,#7,1.,1.);\n#100=IFCEXTRUDEDAREASOLID(#103,#102,#4,1.);\n",
        "#101=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(2.,0.,1.E999),(0.,1.,0.),(0.,0.,3.)));\n#100="
        "IFCTRIANGULATEDFACESET(#101,$,.T.,((1,3,2),(1,2,4),(1,4,3),(2,3,4)),$);\n",
        "#101=IFCCARTESIANPOINT((0.,0.));\n#102=IFCCARTESIANPOINT((2.,0.));\n#103=IFCCARTESIANPOINT((2.,2.));\n#104="
        "IFCPOLYLINE((#101,#102,#103,#998,#101));\n#105=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#104);\n#100="
        "IFCEXTRUDEDAREASOLID(#105,$,#4,1.);\n"}) {
    const ImportedModel model = importText(ifcText(shape + product(110, "IFCWALL", "#100")));
    EXPECT_TRUE(loses(model, "#110", "IfcWall guid110 is incomplete: see #")) << shape << issuesOf(model);
  }
}

TEST(IfcLosses, AShapeThatIsScaledBeyondAllBoundsIsLeftOutAndTheRestStays) {
  const ImportedModel model = importText(
      ifcText(kWallBox +
              "#120=IFCSHAPEREPRESENTATION(#12,'Body','SweptSolid',(#102));\n#121=IFCREPRESENTATIONMAP(#2,#120);\n"
              "#122=IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,#124,1.,$);\n#124=IFCCARTESIANPOINT((1.E308,1.E308,"
              "0.));\n#123=IFCMAPPEDITEM(#121,#122);\n" +
              product(110, "IFCWALL", "#123", "MappedRepresentation") + product(130, "IFCSLAB", "#102")));
  EXPECT_TRUE(loses(model, "#110", "IfcWall guid110")) << issuesOf(model);
  EXPECT_NEAR(volumeOf(model, "#130"), 3.6, 1e-5);
}

TEST(IfcLosses, APlacementCutOutOfACircleIsALossOfEachProductInIt) {
  const ImportedModel model = importText(
      ifcText("#90=IFCLOCALPLACEMENT(#91,#2);\n#91=IFCLOCALPLACEMENT(#90,#2);\n#92=IFCLOCALPLACEMENT(#91,#2);\n" +
              kWallBox + product(110, "IFCWALL", "#102", "SweptSolid", "#90") +
              product(120, "IFCSLAB", "#102", "SweptSolid", "#92") + product(130, "IFCSLAB", "#102")));
  EXPECT_TRUE(loses(model, "#90", "circular reference between placements")) << issuesOf(model);
  EXPECT_TRUE(loses(model, "#110", "IfcWall guid110 is not where it belongs"));
  EXPECT_TRUE(loses(model, "#120", "IfcSlab guid120 is not where it belongs"));
  EXPECT_FALSE(loses(model, "#130"));
}

TEST(IfcLosses, ADeepChainOfPlacementsIsNoCircle) {
  constexpr int kDepth = 20000;
  std::string chain = "#98=IFCCARTESIANPOINT((0.,0.,0.5));\n#97=IFCAXIS2PLACEMENT3D(#98,$,$);\n";
  for (int i = 0; i < kDepth; ++i)
    chain += "#" + std::to_string(1000 + i) + "=IFCLOCALPLACEMENT(" +
             (i == 0 ? std::string("$") : "#" + std::to_string(999 + i)) + ",#97);\n";
  const ImportedModel model = importText(
      ifcText(chain + kWallBox + product(110, "IFCWALL", "#102", "SweptSolid", "#" + std::to_string(999 + kDepth))));
  EXPECT_EQ(model.report.losses(), 0U) << issuesOf(model);
  EXPECT_NEAR(boundsOf(model, "#110").min.z(), 0.5 * kDepth, 1e-3);
}

std::string aggregate(int n, const std::string& whole, const std::string& parts) {
  return "#" + std::to_string(n) + "=IFCRELAGGREGATES('r" + std::to_string(n) + "',$,$,$," + whole + ",(" + parts +
         "));\n";
}

TEST(IfcLosses, AggregatesInACircleAreALossOfEachProductInIt) {
  const ImportedModel model = importText(ifcText(kWallBox + product(110, "IFCELEMENTASSEMBLY", "#102") +
                                                 product(120, "IFCBEAM", "#102") + product(130, "IFCPLATE", "#102") +
                                                 aggregate(140, "#110", "#120") + aggregate(141, "#120", "#110,#130")));
  EXPECT_TRUE(loses(model, "#110", "IfcElementAssembly guid110 is a part of itself")) << issuesOf(model);
  EXPECT_TRUE(loses(model, "#120", "IfcBeam guid120 is a part of itself"));
  EXPECT_FALSE(loses(model, "#130"));
  EXPECT_EQ(productOf(model, "#110").whole, -1);
  EXPECT_EQ(productOf(model, "#120").whole, -1);
  EXPECT_EQ(productOf(model, "#130").whole, static_cast<int>(indexOf(model, "#120")));
}

TEST(IfcLosses, APlaceInACircleIsALossEvenIfItHasAnotherWhole) {
  const ImportedModel model =
      importText(ifcText(kWallBox + product(110, "IFCWALL", "#102") + aggregate(140, "#22", "#21")));
  EXPECT_TRUE(loses(model, "#21", "IfcBuilding 0000000000000000000002 is a part of itself")) << issuesOf(model);
  EXPECT_TRUE(loses(model, "#22", "IfcBuildingStorey"));
  EXPECT_FALSE(loses(model, "#20"));
  EXPECT_EQ(model.environment.spatial.size(), 3U);
}

TEST(IfcLosses, ARepresentationThatPointsAtNothingIsALossThatNamesItsProduct) {
  const std::string wall = "#110=IFCWALL('guid110',$,'Wall',$,$,#3,#111,$,$);\n";
  for (const std::string shape :
       {"", "#111=IFCPRODUCTDEFINITIONSHAPE($,$,(#999));\n",
        "#111=IFCPRODUCTDEFINITIONSHAPE($,$,(#112));\n#112=IFCSHAPEREPRESENTATION(#12,'Body','SweptSolid',(#999));\n",
        "#111=IFCPRODUCTDEFINITIONSHAPE($,$,(#112));\n#112=IFCSHAPEREPRESENTATION(#12,'Body','MappedRepresentation',(#"
        "113));\n#113=IFCMAPPEDITEM(#999,$);\n",
        "#111=IFCPRODUCTDEFINITIONSHAPE($,$,(#112));\n#112=IFCSHAPEREPRESENTATION(#12,'Body','SweptSolid',());\n"}) {
    const ImportedModel model = importText(ifcText(wall + shape));
    EXPECT_TRUE(loses(model, "#110", "IfcWall guid110")) << shape << issuesOf(model);
  }
}

TEST(IfcLosses, AnItemThatIsNotThereBesideOneThatIsMakesItsProductIncomplete) {
  const ImportedModel model = importText(ifcText(kWallBox + product(110, "IFCWALL", "#102,#999")));
  EXPECT_TRUE(loses(model, "#110", "IfcWall guid110 is incomplete or misplaced: #112: refers to #999"))
      << issuesOf(model);
  EXPECT_NEAR(volumeOf(model, "#110"), 3.6, 1e-5);
}

TEST(IfcLosses, ABodyOfAKindThatIsNotReadIsALossThatNamesItsProduct) {
  for (const std::string surface : {"IFCSPHERICALSURFACE(#2,1.)", "IFCPLANE(#2)",
                                    "IFCBSPLINESURFACEWITHKNOTS(1,1,((#1,#1),(#1,#1)),.U.,.F.,.F.,.F.,"
                                    "(2,2),(2,2),(0.,1.),(0.,1.),.U.)",
                                    "IFCSOMENEWSOLID(#2)", "IFCHALFSPACESOLID(#98,.T.)"}) {
    const std::string record = "#98=IFCPLANE(#2);\n#100=" + surface + ";\n";
    const std::string name = surface.substr(0, surface.find('('));
    const ImportedModel alone = importText(ifcText(record + product(110, "IFCWALL", "#100", "Surface3D")));
    EXPECT_TRUE(loses(alone, "#110", name + " is not supported")) << issuesOf(alone);
    const ImportedModel beside =
        importText(ifcText(record + boxSolid(200, "1.", "1.", "1.") + product(110, "IFCWALL", "#202,#100")));
    EXPECT_TRUE(loses(beside, "#110", "IfcWall guid110 is incomplete: see #100")) << name << issuesOf(beside);
  }
}

TEST(IfcLosses, ACurveBesideABodyIsDrawingAndNoLoss) {
  const ImportedModel model = importText(ifcText("#98=IFCPOLYLINE((#1,#97));\n#97=IFCCARTESIANPOINT((1.,0.,0.));\n" +
                                                 kWallBox + product(110, "IFCWALL", "#102,#98")));
  EXPECT_EQ(model.report.losses(), 0U) << issuesOf(model);
}

TEST(IfcLosses, AWallWhoseBodyIsThatOfItsPartsLosesNothing) {
  const ImportedModel model = importText(ifcText("#98=IFCPOLYLINE((#1,#97));\n#97=IFCCARTESIANPOINT((1.,0.,0.));\n" +
                                                 kWallBox + product(110, "IFCWALL", "#98", "Curve2D") +
                                                 product(120, "IFCPLATE", "#102") + aggregate(140, "#110", "#120")));
  EXPECT_EQ(model.report.losses(), 0U) << issuesOf(model);
}

TEST(IfcLosses, ParenthesesNestedBeyondTheLimitAreALossThatNamesTheRecord) {
  const std::string deep = std::string(3000, '(') + "0.,0.,0." + std::string(3000, ')');
  const ImportedModel model = wallAt("#92=IFCCARTESIANPOINT(" + deep +
                                     ");\n#91=IFCAXIS2PLACEMENT3D(#92,$,$);\n#90=IFCLOCALPLACEMENT(#3,#91);\n");
  EXPECT_TRUE(std::any_of(model.report.issues.begin(), model.report.issues.end(), [](const Issue& i) {
    return i.severity == Severity::loss && i.message.find("record #92 (IFCCARTESIANPOINT) nests") == 0;
  })) << issuesOf(model);
  EXPECT_TRUE(loses(model, "#110", "IfcWall guid110")) << issuesOf(model);
}

TEST(IfcLosses, ASphereBeyondAllBoundsIsRefusedInTime) {
  for (const std::string radius : {"1.E300", "1.E9", "1.E14"}) {
    const double start = test::ownSeconds();
    const ImportedModel model =
        importText(ifcText("#100=IFCSPHERE(#2," + radius + ");\n" + product(110, "IFCTANK", "#100", "CSG")));
    EXPECT_TRUE(loses(model, "#110", "IfcTank guid110 produced no geometry")) << issuesOf(model);
    EXPECT_LT(test::ownSeconds() - start, 2);
  }
}

TEST(IfcLosses, AnOpeningThatTakesTheWholeWallIsNoLoss) {
  const ImportedModel model = importText(
      ifcText(kWallBox + product(110, "IFCWALL", "#102") + boxSolid(200, "5.", "1.", "4.") +
              product(210, "IFCOPENINGELEMENT", "#202") + "#220=IFCRELVOIDSELEMENT('v',$,$,$,#110,#210);\n"));
  EXPECT_EQ(model.report.losses(), 0U) << issuesOf(model);
  EXPECT_TRUE(warns(model, "#110", "IfcWall guid110 is removed entirely by its openings"));
}

TEST(IfcLosses, AnOpeningWithoutABodyIsALoss) {
  const ImportedModel model =
      importText(ifcText(kWallBox + product(110, "IFCWALL", "#102") + product(210, "IFCOPENINGELEMENT", "#999") +
                         "#220=IFCRELVOIDSELEMENT('v',$,$,$,#110,#210);\n"));
  EXPECT_TRUE(loses(model, "#210", "IfcOpeningElement guid210 has a representation but none with a body"))
      << issuesOf(model);
}

// A table's type with a map, and what stands for it.
std::string furnitureType(const std::string& rest = "") {
  return kWallBox +
         "#120=IFCSHAPEREPRESENTATION(#12,'Body','SweptSolid',(#102));\n#121=IFCREPRESENTATIONMAP(#2,#120);\n"
         "#130=IFCFURNITURETYPE('type130',$,'Table',$,'Desk',(#140),(#121),'T1','For four',.NOTDEFINED.,"
         ".USERDEFINED.);\n#140=IFCPROPERTYSET('p',$,'Pset_Table',$,(#141));\n#141=IFCPROPERTYSINGLEVALUE("
         "'Seats',$,IFCINTEGER(4),$);\n" +
         rest;
}

TEST(IfcLosses, GeometryThatHangsOnlyOnTypesIsALossThatOffersToTakeThem) {
  const ImportedModel model = importText(ifcText(furnitureType()));
  EXPECT_TRUE(loses(model, "#130", "IfcFurnitureType type130")) << issuesOf(model);
  EXPECT_TRUE(loses(model, "#130", "import types as products"));
  EXPECT_TRUE(model.environment.products.empty());
}

TEST(IfcLosses, TypesThatNoProductShowsAreProductsWhereThatIsAskedFor) {
  ImportOptions options;
  options.types = true;
  const ImportedModel model = importText(ifcText(furnitureType()), options);
  EXPECT_EQ(model.report.losses(), 0U) << issuesOf(model);
  EXPECT_NEAR(volumeOf(model, "#130"), 3.6, 1e-5);
  const Product& table = productOf(model, "#130");
  EXPECT_EQ(table.ifc_class, "IfcFurnitureType");
  EXPECT_EQ(table.global_id, "type130");
  EXPECT_TRUE(table.tangible);
  EXPECT_TRUE(std::any_of(table.properties.begin(), table.properties.end(), [](const Property& p) {
    return p.set == "Pset_Table" && p.name == "Seats" && p.value == "4";
  }));
  const ImportedModel shown = importText(ifcText(furnitureType(product(150, "IFCFURNITURE", "#102") +
                                                               "#160=IFCRELDEFINESBYTYPE('d',$,$,$,(#150),#130);\n")),
                                         options);
  EXPECT_EQ(shown.environment.products.size(), 1U) << "the type is shown by its product";
}

TEST(IfcLosses, SolidsThatBelongToNoProductAreALoss) {
  const ImportedModel model = importText(ifcText(kWallBox));
  EXPECT_TRUE(loses(model, "#102", "IfcExtrudedAreaSolid belongs to no product and was not imported"))
      << issuesOf(model);
  EXPECT_EQ(importText(ifcText("")).report.losses(), 0U);
}

TEST(IfcLosses, ATriangulatedFaceSetOfTheFirstReleaseOfIfc4IsReadWhole) {
  const std::string points = "#101=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(2.,0.,0.),(0.,1.,0.),(0.,0.,3.)));\n";
  const std::string triangles = "((1,3,2),(1,2,4),(1,4,3),(2,3,4))";
  for (const std::string last : {"((1,1,1),(2,2,2),(3,3,3),(4,4,4))", "(1,2,3,4)", "$"}) {
    const ImportedModel model =
        importText(ifcText(points +
                           "#100=IFCTRIANGULATEDFACESET(#101,((0.,0.,-1.),(0.,-1.,0.),"
                           "(-1.,0.,0.),(0.7,0.7,0.2)),.T.," +
                           triangles + "," + last + ");\n" + product(110, "IFCWALL", "#100", "Tessellation")));
    EXPECT_EQ(model.report.losses(), 0U) << last << issuesOf(model);
    EXPECT_NEAR(volumeOf(model, "#110"), 1, 1e-5) << last;
  }
}

ImportedModel signalAt(const std::string& stated) {
  return importText(
      ifcText("#80=IFCCARTESIANPOINT((0.,0.,0.));\n#81=IFCCARTESIANPOINT((100.,0.,0.));\n#82=IFCPOLYLINE(("
              "#80,#81));\n#83=IFCPOINTBYDISTANCEEXPRESSION(IFCLENGTHMEASURE(40.),$,$,$,#82);\n#84="
              "IFCAXIS2PLACEMENTLINEAR(#83,$,$);\n#85=IFCCARTESIANPOINT((" +
              stated + ",0.,0.));\n#86=IFCAXIS2PLACEMENT3D(#85,$,$);\n#90=IFCLINEARPLACEMENT(#3,#84,#86);\n" +
              kWallBox + product(110, "IFCSIGNAL", "#102", "SweptSolid", "#90")));
}

TEST(IfcLosses, AStatedPositionThatDisagreesWithTheCurveIsUsedWithAWarning) {
  const ImportedModel same = signalAt("40.004"), other = signalAt("43.5");
  EXPECT_NEAR(boundsOf(same, "#110").min.x(), 38, 1e-4) << issuesOf(same);
  EXPECT_FALSE(tells(same, "#90", "CartesianPosition"));
  EXPECT_NEAR(boundsOf(other, "#110").min.x(), 41.5, 1e-4);
  EXPECT_TRUE(warns(other, "#90", "CartesianPosition is 3.500 m from")) << issuesOf(other);
  EXPECT_EQ(other.report.losses(), 0U);
}

TEST(IfcLosses, RepresentationsThatMultiplyWithoutABodyAreLookedThroughInTime) {
  std::string records =
      "#97=IFCCARTESIANPOINT((1.,0.,0.));\n#98=IFCPOLYLINE((#1,#97));\n#200=IFCSHAPEREPRESENTATION("
      "#12,'Body','Curve3D',(#98));\n";
  for (int level = 0; level < 12; ++level) {
    const int n = 300 + level * 20;
    std::string items;
    records += "#" + std::to_string(n) + "=IFCREPRESENTATIONMAP(#2,#" +
               (level == 0 ? std::string("200") : std::to_string(n - 19)) + ");\n";
    for (int k = 0; k < 10; ++k) {
      records += "#" + std::to_string(n + 2 + k) + "=IFCMAPPEDITEM(#" + std::to_string(n) + ",$);\n";
      items += (k ? ",#" : "#") + std::to_string(n + 2 + k);
    }
    records +=
        "#" + std::to_string(n + 1) + "=IFCSHAPEREPRESENTATION(#12,'Body','MappedRepresentation',(" + items + "));\n";
  }
  const double start = test::ownSeconds();
  const ImportedModel model = importText(ifcText(
      records + "#700=IFCWALL('guid700',$,'W',$,$,#3,#701,$,$);\n#701=IFCPRODUCTDEFINITIONSHAPE($,$,(#521));\n"));
  EXPECT_LT(test::ownSeconds() - start, 2);
  EXPECT_TRUE(loses(model, "#700", "none with a body")) << issuesOf(model);
}

}  // namespace
}  // namespace standpoint::test
