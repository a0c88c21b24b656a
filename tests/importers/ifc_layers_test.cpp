// SPDX-License-Identifier: GPL-3.0-or-later
// The layers of walls and slabs on their faces. Truth: the areas of a box, and where the schema says that the layers
// lie.
#include <map>

#include <gtest/gtest.h>

#include "tests/importers/ifc_fixture.h"

namespace standpoint::test {
namespace {

// A wall of 4 × 0.3 × 3 m, y from −0.15 to 0.15, of 115 mm brick, 135 mm wool and 50 mm plaster from `offset` on.
std::string wall(const std::string& sense, const std::string& offset, const std::string& more = {}) {
  return boxSolid(100, "4.", "0.3", "3.") + product(110, "IFCWALLSTANDARDCASE", "#102") +
         "#120=IFCMATERIAL('Brick');\n#121=IFCMATERIAL('Wool');\n#122=IFCMATERIAL('Plaster');\n"
         "#123=IFCMATERIALLAYER(#120,0.115,$);\n#124=IFCMATERIALLAYER(#121,0.135,$);\n#125=IFCMATERIALLAYER(#122,0.05,$"
         ");\n"
         "#126=IFCMATERIALLAYERSET((#123,#124,#125),'outer wall');\n#127=IFCMATERIALLAYERSETUSAGE(#126,.AXIS2.,." +
         sense + ".," + offset +
         ");\n"
         "#128=IFCRELASSOCIATESMATERIAL('m',$,$,$,(#110),#127);\n" +
         more;
}

struct Side {
  double area = 0;
  Bounds bounds;
};
// By the surface's name: the area that looks along ±`axis` (or, with axis 3, in every other direction than y).
std::map<std::string, Side> sides(const ImportedModel& model, const std::string& id, int axis, double sign) {
  std::map<std::string, Side> found;
  const std::size_t product = indexOf(model, id);
  for (const Instance& i : model.environment.instances) {
    if (i.product != product) continue;
    const Mesh& mesh = *model.environment.meshes[i.mesh];
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
      const auto at = [&](int c) {
        return Eigen::Vector3d(i.world_from_mesh *
                               mesh.positions[mesh.triangles[k][static_cast<std::size_t>(c)]].cast<double>());
      };
      const Eigen::Vector3d n = (at(1) - at(0)).cross(at(2) - at(0));
      if (n.normalized()[axis] * sign < 0.99) continue;
      Side& side = found[model.environment.surfaces[mesh.surface_of_triangle[k]].name];
      side.area += n.norm() / 2;
      for (int c = 0; c < 3; ++c) side.bounds.extend(at(c));
    }
  }
  return found;
}

bool closed(const ImportedModel& model) {
  for (const auto& mesh : model.environment.meshes)
    if (!isClosed(*mesh)) return false;
  return true;
}

TEST(IfcLayers, EachSideOfAWallShowsItsOuterLayerAndTheEndsShowAll) {
  const ImportedModel model =
      importText(ifcText(wall("POSITIVE", "-0.15"), "IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)", "IFC2X3"));
  const auto out = sides(model, "#110", 1, -1), in = sides(model, "#110", 1, 1), end = sides(model, "#110", 0, 1);
  ASSERT_EQ(out.size(), 1U);
  EXPECT_NEAR(out.at("Brick").area, 12, 1e-5);
  ASSERT_EQ(in.size(), 1U);
  EXPECT_NEAR(in.at("Plaster").area, 12, 1e-5);
  ASSERT_EQ(end.size(), 3U);
  EXPECT_NEAR(end.at("Brick").area, 0.115 * 3, 1e-5);
  EXPECT_NEAR(end.at("Wool").area, 0.135 * 3, 1e-5);
  EXPECT_NEAR(end.at("Plaster").area, 0.05 * 3, 1e-5);
  EXPECT_NEAR(end.at("Wool").bounds.min.y(), -0.035, 1e-6);
  EXPECT_NEAR(end.at("Wool").bounds.max.y(), 0.1, 1e-6);
  EXPECT_NEAR(volumeOf(model, "#110"), 3.6, 1e-5);
  EXPECT_TRUE(closed(model));
  expectNear(boundsOf(model, "#110").min, {-2, -0.15, 0}, 1e-6);
  expectNear(boundsOf(model, "#110").max, {2, 0.15, 3}, 1e-6);
}

TEST(IfcLayers, ANegativeSenseTurnsTheOrder) {
  const ImportedModel model = importText(ifcText(wall("NEGATIVE", "0.15")));
  EXPECT_NEAR(sides(model, "#110", 1, 1).at("Brick").area, 12, 1e-5);
  EXPECT_NEAR(sides(model, "#110", 1, -1).at("Plaster").area, 12, 1e-5);
}

TEST(IfcLayers, AnOffsetIsMeasuredFromTheReferenceLineWhereverItLies) {
  // The axis runs along the outer face, backwards: y = −0.15 from x = 2 to −2. Offset 0, and +y of the placement still
  // leads inwards.
  const std::string axis =
      "#140=IFCCARTESIANPOINT((2.,-0.15));\n#141=IFCCARTESIANPOINT((-2.,-0.15));\n#142=IFCPOLYLINE((#140,#141));\n"
      "#143=IFCSHAPEREPRESENTATION(#12,'Axis','Curve2D',(#142));\n#144=IFCPRODUCTDEFINITIONSHAPE($,$,(#143,#112));\n";
  std::string text = ifcText(wall("POSITIVE", "0.", axis));
  text.replace(text.find("#3,#111,"), 8, "#3,#144,");
  const ImportedModel model = importText(text);
  EXPECT_NEAR(sides(model, "#110", 1, -1).at("Brick").area, 12, 1e-5);
  EXPECT_NEAR(sides(model, "#110", 1, 1).at("Plaster").area, 12, 1e-5);
}

TEST(IfcLayers, ARevealShowsTheLayersThatTheOpeningGoesThrough) {
  const std::string opening =
      "#130=IFCRECTANGLEPROFILEDEF(.AREA.,$,#7,1.,1.);\n#131=IFCCARTESIANPOINT((0.,0.,1.));\n#132=IFCAXIS2PLACEMENT3D(#"
      "131,$,$);\n"
      "#133=IFCEXTRUDEDAREASOLID(#130,#132,#4,1.);\n" +
      product(150, "IFCOPENINGELEMENT", "#133") + "#160=IFCRELVOIDSELEMENT('v',$,$,$,#110,#150);\n";
  const ImportedModel model = importText(ifcText(wall("POSITIVE", "-0.15", opening)));
  const auto sill = sides(model, "#110", 2, 1);  // the sill, 1 m², and the wall's top, 4 m
  EXPECT_NEAR(sill.at("Wool").area, 0.135 * (1 + 4), 1e-5);
  EXPECT_NEAR(sides(model, "#110", 1, -1).at("Brick").area, 12 - 1, 1e-5);
  EXPECT_NEAR(volumeOf(model, "#110"), 3.6 - 0.3, 1e-5);
  EXPECT_TRUE(closed(model));
}

TEST(IfcLayers, ANicheShowsTheLayerThatItsBackLiesIn) {
  const std::string opening =
      "#130=IFCRECTANGLEPROFILEDEF(.AREA.,$,#7,1.,0.4);\n#131=IFCCARTESIANPOINT((0.,0.2,1.));\n#132="
      "IFCAXIS2PLACEMENT3D(#131,$,$);\n"
      "#133=IFCEXTRUDEDAREASOLID(#130,#132,#4,1.);\n" +
      product(150, "IFCOPENINGELEMENT", "#133") +
      "#160=IFCRELVOIDSELEMENT('v',$,$,$,#110,#150);\n";  // its back at y = 0, in the wool
  const ImportedModel model = importText(ifcText(wall("POSITIVE", "-0.15", opening)));
  const auto in = sides(model, "#110", 1, 1);
  EXPECT_NEAR(in.at("Wool").area, 1, 1e-5);
  EXPECT_NEAR(in.at("Plaster").area, 11, 1e-5);
}

TEST(IfcLayers, ASlabsLayersLieAboveEachOther) {
  const ImportedModel model =
      importText(ifcText(boxSolid(100, "4.", "5.", "0.25") + product(110, "IFCSLAB", "#102") +
                         "#120=IFCMATERIAL('Concrete',$,$);\n#121=IFCMATERIAL('Parquet',$,$);\n#123=IFCMATERIALLAYER(#"
                         "120,0.23,$,$,$,$,$);\n#124=IFCMATERIALLAYER(#121,0.02,$,$,$,$,$);\n"
                         "#126=IFCMATERIALLAYERSET((#123,#124),$,$);\n#127=IFCMATERIALLAYERSETUSAGE(#126,.AXIS3.,."
                         "POSITIVE.,0.,$);\n#128=IFCRELASSOCIATESMATERIAL('m',$,$,$,(#110),#127);\n"));
  EXPECT_NEAR(sides(model, "#110", 2, 1).at("Parquet").area, 20, 1e-4);
  EXPECT_NEAR(sides(model, "#110", 2, -1).at("Concrete").area, 20, 1e-4);
  EXPECT_TRUE(closed(model));
}

TEST(IfcLayers, EqualWallsOfOtherLayersHaveMeshesOfTheirOwnAndOfTheSameLayersShareOne) {
  const std::string second =
      "#170=IFCLOCALPLACEMENT($,#171);\n#171=IFCAXIS2PLACEMENT3D(#172,$,$);\n#172=IFCCARTESIANPOINT((0.,9.,0.));\n"
      "#180=IFCWALL('w2',$,'W2',$,$,#170,#111,$,$);\n#181=IFCWALL('w3',$,'W3',$,$,#170,#111,$,$);\n"
      "#190=IFCMATERIALLAYERSETUSAGE(#126,.AXIS2.,.NEGATIVE.,0.15);\n#191=IFCRELASSOCIATESMATERIAL('m2',$,$,$,(#180),#"
      "190);\n#192=IFCRELASSOCIATESMATERIAL('m3',$,$,$,(#181),#127);\n";
  const ImportedModel model = importText(ifcText(wall("POSITIVE", "-0.15", second)));
  EXPECT_EQ(model.environment.meshes.size(), 2U);
  EXPECT_NEAR(sides(model, "#180", 1, 1).at("Brick").area, 12, 1e-5);
  EXPECT_NEAR(sides(model, "#181", 1, 1).at("Plaster").area, 12, 1e-5);
}

TEST(IfcLayers, TheFilesOwnStyleWinsForTheColourAndTheLayerForTheName) {
  const ImportedModel model = importText(
      ifcText(wall("POSITIVE", "-0.15",
                   "#150=IFCCOLOURRGB($,0.2,0.4,0.6);\n#151=IFCSURFACESTYLERENDERING(#150,0.,$,$,$,$,$,$,.FLAT.);\n#"
                   "152=IFCSURFACESTYLE('Paint',.BOTH.,(#151));\n#153=IFCSTYLEDITEM(#102,(#152),$);\n")));
  ASSERT_EQ(model.environment.surfaces.size(), 3U);
  for (const Surface& s : model.environment.surfaces) EXPECT_FLOAT_EQ(s.colour.g, 0.4F);
  EXPECT_NEAR(sides(model, "#110", 1, 1).at("Plaster").area, 12, 1e-5);
}

TEST(IfcLayers, WhereTheirSumIsNotTheWallsThicknessOnlyTheSidesAreTold) {
  std::string text = wall("POSITIVE", "-0.15");
  text.replace(text.find("#121,0.135"), 10, "#121,0.400");
  const ImportedModel model = importText(ifcText(text));
  EXPECT_NEAR(sides(model, "#110", 1, -1).at("Brick").area, 12, 1e-5);
  EXPECT_NEAR(sides(model, "#110", 1, 1).at("Plaster").area, 12, 1e-5);
  EXPECT_NEAR(sides(model, "#110", 0, 1).at("Wool").area, 0.9, 1e-5);  // the thickest
}

TEST(IfcLayers, ACurvedWallShowsItsOuterLayerOutside) {
  // A quarter ring around the origin, 5 to 5.3 m, 3 m high; the reference line is its inner arc, drawn
  // counter-clockwise, so that its left is the inside: layers in the negative sense follow each other outwards.
  const ImportedModel model = importText(ifcText(
      "#90=IFCCIRCLE(#7,5.);\n#91=IFCTRIMMEDCURVE(#90,(IFCPARAMETERVALUE(0.)),(IFCPARAMETERVALUE(1.5707963267948966)),."
      "T.,.PARAMETER.);\n#92=IFCSHAPEREPRESENTATION(#12,'Axis','Curve2D',(#91));\n"
      "#93=IFCCARTESIANPOINTLIST2D(((5.3,0.),(3.7476659402887,3.7476659402887),(0.,5.3),(0.,5.),(3.5355339059327,3."
      "5355339059327),(5.,0.)));\n"
      "#94=IFCINDEXEDPOLYCURVE(#93,(IFCARCINDEX((1,2,3)),IFCLINEINDEX((3,4)),IFCARCINDEX((4,5,6)),IFCLINEINDEX((6,1))),"
      ".F.);\n"
      "#95=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#94);\n#102=IFCEXTRUDEDAREASOLID(#95,$,#4,3.);\n"
      "#110=IFCWALL('guid110',$,'Arc',$,$,#3,#111,$,$);\n#111=IFCPRODUCTDEFINITIONSHAPE($,$,(#92,#112));\n#112="
      "IFCSHAPEREPRESENTATION(#12,'Body','SweptSolid',(#102));\n"
      "#120=IFCMATERIAL('Plaster');\n#121=IFCMATERIAL('Wool');\n#122=IFCMATERIAL('Brick');\n#123=IFCMATERIALLAYER(#120,"
      "0.05,$);\n#124=IFCMATERIALLAYER(#121,0.135,$);\n#125=IFCMATERIALLAYER(#122,0.115,$);\n"
      "#126=IFCMATERIALLAYERSET((#123,#124,#125),'outer "
      "wall');\n#127=IFCMATERIALLAYERSETUSAGE(#126,.AXIS2.,.NEGATIVE.,0.);\n#128=IFCRELASSOCIATESMATERIAL('m',$,$,$,(#"
      "110),#127);\n"));
  std::map<std::string, double> outward, inward;  // areas that look away from the centre, and towards it
  const Mesh& mesh = *model.environment.meshes.at(0);
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const auto at = [&](std::size_t c) { return Eigen::Vector3d(mesh.positions[mesh.triangles[k][c]].cast<double>()); };
    const Eigen::Vector3d n = (at(1) - at(0)).cross(at(2) - at(0)),
                          away = Eigen::Vector3d(at(0).x(), at(0).y(), 0).normalized();
    const double facing = n.normalized().dot(away);
    if (std::abs(facing) > 0.9)
      (facing > 0 ? outward : inward)[model.environment.surfaces[mesh.surface_of_triangle[k]].name] += n.norm() / 2;
  }
  ASSERT_EQ(outward.size(), 1U);
  EXPECT_NEAR(outward.at("Brick"), 3.14159265 / 2 * 5.3 * 3, 0.05);
  ASSERT_EQ(inward.size(), 1U);
  EXPECT_NEAR(inward.at("Plaster"), 3.14159265 / 2 * 5.0 * 3, 0.05);
}

}  // namespace
}  // namespace standpoint::test
