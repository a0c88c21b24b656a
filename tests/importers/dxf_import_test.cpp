// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "tests/importers/dxf_files.h"

namespace standpoint::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

double dxfArea(const ImportedModel& model) {
  double sum = 0;
  for (const auto& mesh : model.environment.meshes) sum += area(*mesh);
  return sum;
}
double dxfVolume(const ImportedModel& model) {
  double sum = 0;
  for (const auto& mesh : model.environment.meshes) sum += volume(*mesh);
  return sum;
}

ImportedModel dxfOf(const DxfText& text, const ImportOptions& options = {}) {
  auto model = dxf(text.text(), options);
  EXPECT_TRUE(model) << describe(model.error());
  if (!model) return {};
  EXPECT_EQ(validate(model->environment), "");
  return *std::move(model);
}
ImportedModel dxfEntities(const std::string& entities) { return dxfOf({.entities = entities}); }

// The eight corners of a box of 2 x 3 x 4 and its sides, outward; indices from 0.
constexpr std::array<std::array<int, 4>, 6> kSides{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
Eigen::Vector3d boxCorner(int i) {
  return {i % 4 == 1 || i % 4 == 2 ? 2.0 : 0.0, i % 4 >= 2 ? 3.0 : 0.0, i >= 4 ? 4.0 : 0.0};
}

std::string boxOfFaces(const std::string& head) {
  std::string all;
  for (const auto& side : kSides) {
    all += (all.empty() ? "" : "|") + ("0 3DFACE" + head);
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector3d p = boxCorner(side[static_cast<std::size_t>(k)]);
      all += dxfPoint(10 + k, p.x(), p.y(), p.z());
    }
  }
  return all;
}

std::string boxOfPolyface(const std::string& head) {
  std::string all = "0 POLYLINE" + head + "|66 1|70 64|71 8|72 6";
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d p = boxCorner(i);
    all += "|0 VERTEX|8 0|70 192" + dxfPoint(10, p.x(), p.y(), p.z());
  }
  for (const auto& side : kSides) {
    all += "|0 VERTEX|8 0|70 128|10 0|20 0|30 0";
    for (int k = 0; k < 4; ++k)  // an edge that is not drawn has a negative index
      all +=
          "|" + std::to_string(71 + k) + (k == 2 ? " -" : " ") + std::to_string(side[static_cast<std::size_t>(k)] + 1);
  }
  return all + "|0 SEQEND|8 0";
}

std::string boxOfMesh(const std::string& head) {
  std::string all = "0 MESH" + head + "|100 AcDbSubDMesh|71 2|72 0|91 0|92 8";
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d p = boxCorner(i);
    all += dxfPoint(10, p.x(), p.y(), p.z());
  }
  all += "|93 30";
  for (const auto& side : kSides) {
    all += "|90 4";
    for (const int corner : side) all += "|90 " + std::to_string(corner);
  }
  // Edges and overridden properties have the same codes.
  return all + "|94 1|90 0|90 1|95 1|140 0.5|90 1|91 7|92 1|90 0|63 3|421 5";
}

TEST(Dxf, ReadsABoxWhicheverWayItIsDrawn) {
  for (const auto& [name, entities] :
       {std::pair("3DFACE", boxOfFaces("|8 Walls")), std::pair("POLYLINE", boxOfPolyface("|5 2F|8 Walls")),
        std::pair("MESH", boxOfMesh("|5 2F|8 Walls")),
        std::pair("SOLID", std::string("0 SOLID|8 Walls|39 4|10 0|20 0|30 0|11 2|21 0|31 0|12 0|22 3|32 0|13 2|23 3"
                                       "|33 0"))}) {
    const auto model = dxfEntities(entities);
    ASSERT_EQ(model.environment.products.size(), 1U) << name;
    EXPECT_NEAR(dxfArea(model), 52, 1e-5) << name;
    EXPECT_NEAR(dxfVolume(model), 24, 1e-5) << name;
    EXPECT_EQ(model.environment.meshes.at(0)->triangles.size(), 12U) << name;
    EXPECT_EQ(model.environment.products[0].name, "Walls") << name;
    EXPECT_THAT(model.environment.products[0].groups, ElementsAre("Walls")) << name;
    EXPECT_EQ(toldByDxf(model), "") << name;
  }
}

TEST(Dxf, ClosesAPolygonMeshWhereItSaysSo) {
  // A tube of four by two vertices, closed around: four sides of 2 x 2.
  std::string all = "0 POLYLINE|8 0|66 1|70 17|71 4|72 2";
  for (const auto& [x, y] : {std::pair(0, 0), std::pair(2, 0), std::pair(2, 2), std::pair(0, 2)})
    for (const int z : {0, 2}) all += "|0 VERTEX|8 0|70 64" + dxfPoint(10, x, y, z);
  EXPECT_NEAR(dxfArea(dxfEntities(all + "|0 SEQEND")), 16, 1e-5);
  const auto open = all.replace(all.find("70 17"), 5, "70 16");
  EXPECT_NEAR(dxfArea(dxfEntities(open + "|0 SEQEND")), 12, 1e-5);
  EXPECT_THAT(refusedDxf(DxfText{.entities = open + "|0 VERTEX|70 64|0 SEQEND"}.text()),
              HasSubstr("is a polygon mesh of 4 by 2 vertices, but has 9"));
}

TEST(Dxf, RaisesWhatHasAThickness) {
  // A closed line of 2 x 3 has sides only; the same with a half circle over one end, and the other way round.
  const std::string rectangle = "0 LWPOLYLINE|8 0|90 4|70 1|38 1|39 4|10 0|20 0|10 2|20 0|10 2|20 3|10 0|20 3";
  EXPECT_NEAR(dxfArea(dxfEntities(rectangle)), 40, 1e-5);
  EXPECT_NEAR(bounds(dxfEntities(rectangle).environment).max.z(), 5, 1e-6);
  const std::string arch = "0 LWPOLYLINE|8 0|90 4|70 1|39 4|10 0|20 0|10 2|20 0|10 2|20 3|42 1|10 0|20 3";
  EXPECT_NEAR(dxfArea(dxfEntities(arch)), 4 * (8 + std::numbers::pi), 0.01);
  EXPECT_NEAR(bounds(dxfEntities(arch).environment).max.y(), 4, 1e-3);
  // As an old polyline, whose vertices follow.
  const std::string old =
      "0 POLYLINE|8 0|66 1|70 0|39 4|10 0|20 0|30 1|0 VERTEX|10 0|20 0|0 VERTEX|10 2|20 0|0 VERTEX|10 2|20 3|0 SEQEND";
  EXPECT_NEAR(dxfArea(dxfEntities(old)), 20, 1e-5);
  const auto circle = dxfEntities("0 CIRCLE|8 0|39 -2|10 5|20 5|30 0|40 1");
  EXPECT_NEAR(dxfArea(circle), 6 * std::numbers::pi, 0.1);
  EXPECT_NEAR(dxfVolume(circle), 2 * std::numbers::pi, 0.05);
  EXPECT_NEAR(bounds(circle.environment).min.z(), -2, 1e-6);
  // From 350° over 0° to 80°: a quarter.
  EXPECT_NEAR(dxfArea(dxfEntities("0 ARC|8 0|39 2|10 0|20 0|30 0|40 1|50 350|51 80")), std::numbers::pi, 0.01);
  const auto line = dxfEntities("0 LINE|8 0|39 2|10 0|20 0|30 0|11 3|21 0|31 0|210 0|220 1|230 0");
  EXPECT_NEAR(dxfArea(line), 6, 1e-6);
  EXPECT_NEAR(bounds(line.environment).max.y(), 2, 1e-6);
}

// The volume of a wall that is mitred at its corners is that over its middle line.
TEST(Dxf, RaisesAWallOfAPolylineWithAWidth) {
  const auto wall = dxfEntities("0 LWPOLYLINE|8 0|90 3|70 0|43 0.5|38 1|39 3|10 0|20 0|10 4|20 0|10 4|20 2");
  EXPECT_NEAR(dxfVolume(wall), 6 * 0.5 * 3, 1e-5);
  Bounds box = bounds(wall.environment);
  EXPECT_TRUE(box.min.isApprox(Eigen::Vector3d(0, -0.25, 1), 1e-6)) << box.min.transpose();
  EXPECT_TRUE(box.max.isApprox(Eigen::Vector3d(4.25, 2, 4), 1e-6)) << box.max.transpose();
  // Round a room of 4 by 3 m in the middle of the walls, downward, as an old polyline.
  const auto room = dxfEntities(
      "0 POLYLINE|8 0|66 1|70 1|39 -3|40 0.5|41 0.5|10 0|20 0|30 0|0 VERTEX|10 0|20 0|0 VERTEX|10 4|20 0|0 VERTEX|10 "
      "4|20 3|0 VERTEX|10 0|20 3|0 SEQEND");
  EXPECT_NEAR(dxfVolume(room), 14 * 0.5 * 3, 1e-5);
  EXPECT_NEAR(dxfArea(room), 2 * 14 * 0.5 + 2 * 14 * 3, 1e-4);
  box = bounds(room.environment);
  EXPECT_TRUE(box.min.isApprox(Eigen::Vector3d(-0.25, -0.25, -3), 1e-6)) << box.min.transpose();
  // Half a circle of radius 2.
  const auto bend = dxfEntities("0 LWPOLYLINE|8 0|90 2|39 1|10 -2|20 0|40 1|41 1|42 -1|10 2|20 0|40 7");
  EXPECT_NEAR(dxfVolume(bend), 2 * std::numbers::pi, 0.01);
  EXPECT_NEAR(bounds(bend.environment).max.y(), 2.5, 0.005);
  for (const auto* model : {&wall, &room, &bend}) EXPECT_EQ(toldByDxf(*model), "");
  // A width that the corner has no room for, and one that goes back.
  for (const std::string points :
       {"|43 3|10 0|20 0|10 4|20 0|10 4|20 1|10 0|20 1", "|43 1|10 0|20 0|10 4|20 0|10 0|20 0"}) {
    const auto thin = dxfEntities("0 LWPOLYLINE|8 0|39 2" + points);
    EXPECT_THAT(toldByDxf(thin), HasSubstr("width varies or does not fit their corners, read without it: 1"));
    EXPECT_GT(dxfArea(thin), 15.9);
  }
}

// z×n = y, n×y = z: by the arbitrary axis algorithm a, b, c of the object are b, c along y, z and c along x.
TEST(Dxf, TurnsWhatIsDrawnInAnotherPlane) {
  const auto upright =
      dxfEntities("0 SOLID|8 0|10 1|20 2|30 5|11 4|21 2|31 5|12 1|22 4|32 5|13 4|23 4|33 5|210 1|220 0|230 0");
  const Bounds box = bounds(upright.environment);
  EXPECT_TRUE(box.min.isApprox(Eigen::Vector3d(5, 1, 2), 1e-6)) << box.min.transpose();
  EXPECT_TRUE(box.max.isApprox(Eigen::Vector3d(5, 4, 4), 1e-6)) << box.max.transpose();
  const auto below =
      dxfEntities("0 SOLID|8 0|10 1|20 2|30 5|11 4|21 2|31 5|12 1|22 4|32 5|13 4|23 4|33 5|210 0|220 0|230 -1");
  EXPECT_TRUE(bounds(below.environment).min.isApprox(Eigen::Vector3d(-4, 2, -5), 1e-6));
}

const std::string kTriangleBlock = "0 BLOCK|8 0|2 Part|70 0|10 1|20 0|30 0|" + kDxfTriangle + "|0 ENDBLK";

TEST(Dxf, PlacesBlocksByTheirBasePointScaleAndAngle) {
  const auto model = dxfOf(
      {.blocks = kTriangleBlock, .entities = "0 INSERT|5 A1|8 Doors|2 PART|10 10|20 0|30 2|41 2|42 3|43 1|50 90"});
  ASSERT_EQ(model.environment.products.size(), 1U);
  const Product& p = model.environment.products[0];
  EXPECT_EQ(p.name, "Part");
  EXPECT_EQ(p.id, "#A1");
  EXPECT_THAT(p.groups, ElementsAre("Doors"));
  EXPECT_NEAR(dxfArea(model), 3, 1e-6);
  const Bounds box = bounds(model.environment);
  EXPECT_TRUE(box.min.isApprox(Eigen::Vector3d(7, -2, 2), 1e-6)) << box.min.transpose();
  EXPECT_TRUE(box.max.isApprox(Eigen::Vector3d(10, 0, 2), 1e-6)) << box.max.transpose();
}

TEST(Dxf, PlacesRowsAndColumnsOfNestedBlocks) {
  const auto model =
      dxfOf({.blocks = kTriangleBlock + "|0 BLOCK|2 Row|10 0|20 0|30 0|0 INSERT|5 B1|2 Part|10 1|20 0|30 0"
                                        "|70 3|44 5|71 2|45 7|0 ENDBLK",
             .entities = "0 INSERT|5 C1|2 Row|10 0|20 0|30 0|41 1|42 1|43 1|50 90|0 INSERT|5 C2|2 Row|10 "
                         "100|20 0|30 0"});
  EXPECT_NEAR(dxfArea(model), 6, 1e-6);
  const auto& products = model.environment.products;
  ASSERT_EQ(products.size(), 4U);
  EXPECT_EQ(products[0].name, "Row");
  EXPECT_EQ(products[1].id, "#C1/#B1");
  EXPECT_EQ(products[1].whole, 0);
  // Columns of 5, rows of 7, turned by 90°.
  const Bounds first = bounds(*model.environment.meshes.at(0), model.environment.instances.at(0).world_from_mesh);
  EXPECT_TRUE(first.min.isApprox(Eigen::Vector3d(-8, 0, 0), 1e-6)) << first.min.transpose();
  EXPECT_TRUE(first.max.isApprox(Eigen::Vector3d(0, 11, 0), 1e-6)) << first.max.transpose();
}

TEST(Dxf, TellsThePartsOfRowsAndColumnsApart) {
  const auto model = dxfOf({.blocks = kTriangleBlock + "|0 BLOCK|2 Row|0 INSERT|5 B1|2 Part|10 1|20 0|30 0|0 ENDBLK",
                            .entities = "0 INSERT|5 C1|2 Row|70 2|44 9|10 0|20 0|30 0"});
  std::string ids;
  for (const Product& p : model.environment.products) ids += p.id + " ";
  EXPECT_EQ(ids, "#C1 #C1[0]/#B1 #C1[1]/#B1 ");
}

TEST(Dxf, KeepsAMirroredBlockFacingOutward) {
  const auto model =
      dxfOf({.blocks = "0 BLOCK|2 Box|10 0|20 0|30 0|" + boxOfMesh("|8 0") + "|0 ENDBLK",
             .entities = "0 INSERT|2 Box|10 0|20 0|30 0|41 -1|0 INSERT|2 Box|10 20|20 0|30 0|210 0|220 0|230 -1"});
  EXPECT_NEAR(dxfVolume(model), 48, 1e-4);
  EXPECT_NEAR(bounds(model.environment).min.x(), -22, 1e-5);
  EXPECT_NEAR(bounds(model.environment).min.z(), -4, 1e-5);
}

std::string dxfColourOf(const ImportedModel& model, std::size_t surface) {
  const Colour c = model.environment.surfaces.at(surface).colour;
  char text[32];
  std::snprintf(text, sizeof text, "%.0f %.0f %.0f %.2f", c.r * 255, c.g * 255, c.b * 255, c.a);
  return text;
}

TEST(Dxf, KnowsColoursByNumberByLayerAndByBlock) {
  const std::string layers = "0 LAYER|2 Glass|70 0|62 4|0 LAYER|2 Roof|70 0|62 1|420 8388736";
  const auto coloured = [&](const std::string& look) {
    auto face = kDxfTriangle;
    return face.replace(face.find("|8 0"), 4, look);
  };
  const auto colourOf = [&](const std::string& look) {
    return dxfColourOf(dxfOf({.layers = layers, .entities = coloured(look)}), 0);
  };
  EXPECT_EQ(colourOf("|8 Glass"), "0 255 255 1.00");
  EXPECT_EQ(colourOf("|8 glass|62 256"), "0 255 255 1.00");
  EXPECT_EQ(colourOf("|8 Roof"), "128 0 128 1.00");
  EXPECT_EQ(colourOf("|8 Roof|62 3"), "0 255 0 1.00");
  EXPECT_EQ(colourOf("|8 Roof|62 3|420 255|440 33554559"), "0 0 255 0.50");
  // From the table in dxflib: 12 is 0.65 of red, 37 and 251 are (0.3, 0.225, 0.15) and a grey of 0.464.
  EXPECT_EQ(colourOf("|8 Roof|62 12"), "165 0 0 1.00");
  EXPECT_EQ(colourOf("|8 Roof|62 37"), "76 57 38 1.00");
  EXPECT_EQ(colourOf("|8 Roof|62 251"), "119 119 119 1.00");
  // What is on layer 0 of a block, or has its colour, is as the insert is.
  const auto in_block = [&](const std::string& look, const std::string& insert) {
    const auto model = dxfOf({.layers = layers,
                              .blocks = "0 BLOCK|2 B|10 0|20 0|30 0|" + coloured(look) + "|0 ENDBLK",
                              .entities = "0 INSERT|2 B|10 0|20 0|30 0" + insert});
    return model.environment.surfaces.at(0).name + " " + dxfColourOf(model, 0);
  };
  EXPECT_EQ(in_block("|8 0", "|8 Glass|62 1"), "Glass 0 255 255 1.00");
  EXPECT_EQ(in_block("|8 0|62 0", "|8 Glass|62 1"), "Glass 255 0 0 1.00");
  EXPECT_EQ(in_block("|8 Roof", "|8 Glass|62 1"), "Roof 128 0 128 1.00");
  EXPECT_EQ(in_block("|8 Roof|62 0", "|8 Glass"), "Roof 0 255 255 1.00");
}

TEST(Dxf, LeavesOutWhatIsNotToBeSeen) {
  const auto on = [&](const std::string& layer) {
    auto face = kDxfTriangle;
    return face.replace(face.find("|8 0"), 4, layer) + "|";
  };
  const auto model = dxfOf({.layers = "0 LAYER|2 Off|70 0|62 -4|0 LAYER|2 Cold|70 1|62 4",
                            .blocks = kTriangleBlock,
                            .entities = on("|8 Off") + on("|8 Cold") + on("|8 0|60 1") + on("|8 0|67 1") +
                                        on("|8 Walls") + "0 INSERT|8 Cold|2 Part|10 0|20 0|30 0"});
  EXPECT_NEAR(dxfArea(model), 0.5, 1e-6);
  const std::string told = toldByDxf(model);
  EXPECT_THAT(told, HasSubstr("faces and blocks on layers that are off or frozen, left out: 3"));
  EXPECT_THAT(told, HasSubstr("invisible entities left out: 1"));
  EXPECT_THAT(told, HasSubstr("entities in paper space left out: 1"));
  EXPECT_EQ(model.report.losses(), 0U);
}

TEST(Dxf, KnowsTheUnit) {
  const auto with = [](const std::string& unit) { return DxfText{.header = unit, .entities = kDxfTriangle}; };
  EXPECT_NEAR(dxfArea(dxfOf(with("9 $INSUNITS|70 4"))), 0.5e-6, 1e-12);
  EXPECT_NEAR(dxfArea(dxfOf(with("9 $INSUNITS|70 2"))), 0.5 * 0.3048 * 0.3048, 1e-7);
  EXPECT_DOUBLE_EQ(dxfOf(with("9 $INSUNITS|70 21")).metres_per_unit, 1200.0 / 3937);
  ImportOptions centimetres;
  centimetres.metres_per_unit = 0.01;
  EXPECT_NEAR(dxfArea(dxfOf(with("9 $INSUNITS|70 4"), centimetres)), 0.5e-4, 1e-10);
  const auto none = dxfOf(with("9 $INSUNITS|70 0"));
  EXPECT_NEAR(dxfArea(none), 0.5, 1e-6);
  EXPECT_THAT(toldByDxf(none), HasSubstr("states no unit ($INSUNITS), metres assumed; specify it on import"));
  EXPECT_THAT(toldByDxf(dxfOf(with("9 $INSUNITS|70 99"))), HasSubstr("the unit ($INSUNITS) is unknown"));
}

TEST(Dxf, KeepsLargeCoordinates) {
  const auto model = dxfEntities(
      "0 3DFACE|8 0|10 500000.125|20 5400000.25|30 100|11 500001.125|21 5400000.25|31 100"
      "|12 500000.125|22 5400001.25|32 100.5|13 500000.125|23 5400001.25|33 100.5");
  const Bounds box = bounds(model.environment);
  EXPECT_EQ(box.min + model.georeference.shift_m, Eigen::Vector3d(500000.125, 5400000.25, 100));
  EXPECT_EQ(box.max + model.georeference.shift_m, Eigen::Vector3d(500001.125, 5400001.25, 100.5));
}

TEST(Dxf, ReadsNamesInTheCodePageOfTheFile) {
  const auto nameOf = [&](const std::string& page, const std::string& layer) {
    auto face = kDxfTriangle;
    const DxfText text{.header = "9 $INSUNITS|70 6|9 $DWGCODEPAGE|3 " + page,
                       .entities = face.replace(face.find("|8 0"), 4, "|8 " + layer)};
    return dxfOf(text).environment.products.at(0).name;
  };
  EXPECT_EQ(nameOf("ANSI_1252", "W\xE4nde"), "Wände");
  EXPECT_EQ(nameOf("ANSI_1251", "\xD1\xF2\xB3\xED\xE0"), "Стіна");
  EXPECT_EQ(nameOf("dos850", "W\x84nde"), "Wände");
  EXPECT_EQ(nameOf("ANSI_1252", "Wände"), "Wände");
  EXPECT_EQ(nameOf("ANSI_1252", "W\\U+00E4nde"), "Wände");
  EXPECT_EQ(nameOf("ANSI_932", "\x95\xC7"), "壁");
  EXPECT_EQ(nameOf("nothing", "W\xE4nde"), "Wände");
}

TEST(Dxf, KeepsTheAttributesOfABlock) {
  const auto model =
      dxfOf({.blocks = kTriangleBlock,
             .entities = "0 INSERT|8 0|66 1|2 Part|10 0|20 0|30 0|0 ATTRIB|8 0|2 FIRE|1 T90|101 Embedded "
                         "Object|1 other|0 ATTRIB|2 ROOM|1 1.04|0 SEQEND|" +
                         kDxfTriangle});
  ASSERT_EQ(model.environment.products.size(), 2U);
  std::string properties;
  for (const Property& p : model.environment.products[1].properties)
    properties += p.set + "." + p.name + "=" + p.value + " ";
  EXPECT_EQ(properties, "attributes.FIRE=T90 attributes.ROOM=1.04 ");
}

TEST(Dxf, TellsWhatHasNoFaces) {
  const auto model =
      dxfOf({.blocks = "0 BLOCK|2 Unused|10 0|20 0|30 0|0 HATCH|0 ENDBLK|0 BLOCK|2 Xref|70 4|1 c.dwg|0 ENDBLK|"
                       "0 BLOCK|2 Xref|0 ENDBLK",
             .entities = "0 3DSOLID|8 0|1 acis|0 LINE|10 0|20 0|30 0|11 1|21 0|31 0|0 LINE|10 0|20 0|11 1|21 1|0 "
                         "AEC_WALL|8 0|0 VIEWPORT|0 INSERT|2 Xref|0 INSERT|2 Nowhere|0 MESH|91 2|92 3|10 0|20 "
                         "0|30 0|10 1|20 0|30 0|10 0|20 1|30 0|93 7|90 3|90 0|90 1|90 2|90 2|90 0|90 1|0 "
                         "LWPOLYLINE|39 1|10 0|20 0|10 1|20 0|40 0|41 0.5|10 2|20 0"});
  const std::string told = toldByDxf(model);
  EXPECT_THAT(told, HasSubstr("'3DSOLID' entities skipped (a body without faces; convert it to a mesh): 1"));
  EXPECT_THAT(told, HasSubstr("'LINE' entities skipped (not a surface): 2"));
  EXPECT_THAT(told,
              HasSubstr("'AEC_WALL' entities skipped (not supported; explode them or convert them to meshes): 1"));
  EXPECT_THAT(told, HasSubstr("external references, not read; bind them: 1"));
  EXPECT_THAT(told, HasSubstr("inserted blocks that are not in the file: 1"));
  EXPECT_THAT(told, HasSubstr("meshes with smoothness, read as their base mesh: 1"));
  EXPECT_THAT(told, HasSubstr("faces with fewer than three corners: 1"));
  EXPECT_THAT(told, HasSubstr("polylines whose width varies or does not fit their corners, read without it: 1"));
  EXPECT_THAT(told, HasSubstr("blocks defined twice, of which the first was kept: 1"));
  EXPECT_THAT(told, Not(HasSubstr("HATCH")));
  EXPECT_THAT(told, Not(HasSubstr("VIEWPORT")));
}

// The drawing with these objects after its entities.
ImportedModel dxfWithObjects(const DxfText& drawing, const std::string& objects) {
  std::string text = drawing.text();
  text.insert(text.rfind("  0\nEOF"), dxfSection("OBJECTS", objects));
  auto model = dxf(text);
  EXPECT_TRUE(model) << describe(model.error());
  if (!model) return {};
  EXPECT_EQ(validate(model->environment), "");
  return *std::move(model);
}

// At this height.
std::string dxfTriangle(int z, const std::string& layer_and_more) {
  auto face = kDxfTriangle;
  for (const char* group : {"|30 ", "|31 ", "|32 ", "|33 "}) face.replace(face.find(group) + 4, 1, std::to_string(z));
  return face.replace(face.find("|8 0"), 4, layer_and_more);
}

// "Name RRGGBBAA source" of each surface.
std::vector<std::string> dxfSurfaces(const ImportedModel& model) {
  std::vector<std::string> all;
  for (const Surface& s : model.environment.surfaces) {
    const auto part = [](float value) { return std::lround(255 * value); };
    all.push_back(fmt::format("{} {:02x}{:02x}{:02x}{:02x} {}", s.name, part(s.colour.r), part(s.colour.g),
                              part(s.colour.b), part(s.colour.a), s.source));
  }
  return all;
}

const std::string kDxfMaterials =
    "0 MATERIAL|5 9|1 Global|71 1|91 -16777216|0 MATERIAL|5 7|1 ByLayer|0 MATERIAL|5 8|1 ByBlock"
    // 0xC2804020, with 0.5 of its light, and its later groups of the same code, of other maps
    "|0 MATERIAL|5 a1|1 Masonry|70 1|90 -1|71 1|41 0.5|91 -1031782368|72 1|3 |73 1|43 1|44 0.5|73 0|49 1|140 0.8"
    "|0 MATERIAL|5 B2|1 Paint|71 0|91 255|140 1";

TEST(Dxf, ReadsMaterialsOfEntitiesLayersAndBlocks) {
  const DxfText drawing{
      .layers = "0 LAYER|2 Brick|70 0|62 1|347 A1|0 LAYER|2 Plain|70 0|62 5",
      .blocks = "0 BLOCK|2 B|70 0|" + dxfTriangle(0, "|8 0|347 8") + "|" + dxfTriangle(1, "|8 0") + "|0 ENDBLK",
      .entities = dxfTriangle(0, "|8 Brick") + "|" + dxfTriangle(1, "|8 Brick|347 7") + "|" +
                  dxfTriangle(2, "|8 Plain|347 a1") + "|" + dxfTriangle(3, "|8 Brick|347 b2") + "|" +
                  dxfTriangle(4, "|8 Brick|347 9") + "|" + dxfTriangle(5, "|8 Plain|347 FF") +
                  "|0 INSERT|5 10|8 Plain|2 B|347 B2|10 5|20 0|30 0"};
  const auto model = dxfWithObjects(drawing, kDxfMaterials);
  EXPECT_THAT(dxfSurfaces(model),
              ElementsAre("Masonry 402010cc #a1", "Paint ff0000ff #B2", "Brick ff0000ff layer Brick",
                          "Plain 0000ffff layer Plain", "Paint 0000ffff #B2"));
  EXPECT_EQ(toldByDxf(model), "");
}

TEST(Dxf, TellsOfPaintedMaterialsClippingAndPlacesOnTheMap) {
  const DxfText drawing{.layers = "0 LAYER|2 Brick|70 0|62 1|347 A1|0 LAYER|2 Plain|70 0|62 4|347 B2",
                        .entities = dxfTriangle(0, "|8 Brick|347 A1") + "|" + dxfTriangle(1, "|8 Plain|347 C3")};
  const auto model = dxfWithObjects(drawing,
                                    "0 MATERIAL|5 a1|1 Masonry|72 1|3 bricks.jpg|0 MATERIAL|5 B2|1 Plain|3 "
                                    "|0 MATERIAL|5 c3|1 Marble|72 2|0 SPATIAL_FILTER|70 2|0 GEODATA");
  const std::string told = toldByDxf(model);
  EXPECT_THAT(told,
              HasSubstr("loss line 24: entities and layers whose MATERIAL has an image or a pattern, read with its "
                        "colour alone: 3"));
  EXPECT_THAT(told, HasSubstr("clipped blocks, read whole: 1"));
  EXPECT_THAT(told, HasSubstr("geographic locations (GEODATA), not read; specify the CRS on import: 1"));
  EXPECT_EQ(model.report.losses(), 3U);
}

TEST(Dxf, ReadsAllLineEndsAndComments) {
  const std::string text = dxfGroups("999 made by hand") + DxfText{.entities = kDxfTriangle}.text();
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string changed;
    for (const char c : text) changed += c == '\n' ? end : std::string(1, c);
    const auto model = dxf(changed);
    ASSERT_TRUE(model) << describe(model.error());
    EXPECT_NEAR(dxfArea(*model), 0.5, 1e-6);
  }
  EXPECT_TRUE(import(write(scratch() / "plan", DxfText{.entities = kDxfTriangle}.text())));
}

}  // namespace
}  // namespace standpoint::test
