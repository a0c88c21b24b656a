// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/random.h"
#include "importers/obj/obj_file.h"
#include "importers/obj/obj_writer.h"
#include "importers/soup/obj_polygon.h"
#include "tests/importers/mesh_files.h"

namespace standpoint::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Result<ImportedModel> objModel(const std::string& text, const ImportOptions& options = {}) {
  return import(write(scratch() / "a.obj", text), options);
}

const std::string kCube =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

TEST(Obj, CubeOfQuadsIsClosedAndHasTheVolumeOfACube) {
  const auto model = objModel(kCube, {.metres_per_unit = 0.5});
  ASSERT_TRUE(model) << describe(model.error());
  const auto& mesh = *model->environment.meshes.at(0);
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_TRUE(isClosed(mesh));
  EXPECT_DOUBLE_EQ(volume(mesh), 0.125);
}

TEST(Obj, DefaultUpAxisIsYAndZCanBeAskedFor) {
  const std::string text = "v 1 2 3\nv 0 0 0\nv 1 0 0\nf 1 2 3\n";
  EXPECT_EQ(objModel(text)->environment.meshes.at(0)->positions.at(0), Eigen::Vector3f(1, -3, 2));
  EXPECT_EQ(objModel(text, {.up = UpAxis::z})->environment.meshes.at(0)->positions.at(0), Eigen::Vector3f(1, 2, 3));
}

TEST(Obj, ObjectsAndGroupsBecomeProductsAndANameThatComesBackContinues) {
  const auto model =
      objModel("v 0 0 0\nv 1 0 0\nv 0 1 0\no house\ng wall\nf 1 2 3\ng roof\nf 1 2 3\no house\ng wall\nf -1 -2 -3\n");
  ASSERT_TRUE(model);
  ASSERT_EQ(model->environment.products.size(), 2U);
  EXPECT_EQ(model->environment.products.at(0).id, "o house g wall");
  EXPECT_EQ(model->environment.meshes.at(0)->triangles.size(), 2U);
  EXPECT_EQ(model->environment.meshes.at(1)->triangles.size(), 1U);
}

TEST(Obj, ConcavePolygonKeepsItsArea) {
  // An L of area 3: a fan from the first corner would give 4.
  const auto model =
      objModel("v 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nf 1 2 3 4 5 6\n", {.up = UpAxis::z});
  ASSERT_TRUE(model);
  EXPECT_DOUBLE_EQ(area(*model->environment.meshes.at(0)), 3);
  EXPECT_TRUE(model->report.issues.empty());
}

TEST(Obj, LinesContinueAndEndInAnyWay) {
  const auto model = objModel("\xEF\xBB\xBFv 0 0 0\rv 1 0 \\\r\n0 # x\r\nv 0 1 0\nf 1//1 \\\n 2/4 3/1/1");
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_EQ(triangleCount(model->environment), 1U);
}

TEST(Obj, AGroupNamedRightBeforeAnObjectHoldsItAndOneThatHadFacesEnds) {
  const std::string v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const auto model =
      objModel(v + "g layer\no first\nf 1 2 3\no second\nf 1 3 2\ng Mesh1 Group1 Model\no third\nf 1 2 3\n");
  ASSERT_TRUE(model);
  const auto& p = model->environment.products;
  ASSERT_EQ(p.size(), 3U);
  EXPECT_EQ(p[0].id, "o first g layer");
  EXPECT_EQ(p[1].id, "o second");
  EXPECT_EQ(p[2].name, "third Mesh1");
  EXPECT_THAT(p[2].groups, ElementsAre("Mesh1", "Group1", "Model"));
}

TEST(Obj, CornersOfOnePlaceAreOneVertexUnlessTheirTextureDiffers) {
  const std::string v = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 9 9 9\nvt 0 0\nvt 1 0.25\nvt 0.5 1\n";
  const auto whole = objModel(v + "f 1/1 2/2 3/3\nf 1/1 3/3 4/1\n", {.up = UpAxis::z});
  ASSERT_TRUE(whole);
  const auto& mesh = *whole->environment.meshes.at(0);
  EXPECT_EQ(mesh.positions.size(), 4U);  // the unused one is not there
  EXPECT_EQ(mesh.texture_coordinates.at(1), Eigen::Vector2f(1, 0.75F));
  const auto seam = objModel(v + "f 1/1 2/2 3/3\nf 1/2 3/3 4/1\n");
  EXPECT_EQ(seam->environment.meshes.at(0)->positions.size(), 5U);
}

TEST(Obj, OnePositionWithThousandsOfTextureCoordinatesIsAsManyVertices) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 3000; ++i) text += "vt " + std::to_string(i) + " 0\nv " + std::to_string(i) + " 1 1\n";
  for (int i = 1; i <= 3000; ++i) text += "f 1/" + std::to_string(i) + " 2/1 " + std::to_string(i + 3) + "/1\n";
  const auto model = objModel(text + text.substr(text.find('f')));
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_EQ(model->environment.meshes.at(0)->positions.size(), 3000U + 1 + 3000);
}

TEST(Obj, ColoursOfVerticesAreReadInBothPlacesAndBothScales) {
  const std::string rest = "v 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const auto fractions = objModel("v 0 0 0 1 0.5 0\n" + rest), weighted = objModel("v 0 0 0 1 1 0.5 0\n" + rest),
             bytes = objModel("v 0 0 0 255 128 0\n" + rest);
  using Rgba = std::array<std::uint8_t, 4>;
  for (const auto* model : {&fractions, &weighted, &bytes}) {
    ASSERT_TRUE(*model);
    EXPECT_THAT((*model)->environment.meshes.at(0)->colours,
                ElementsAre(Rgba{255, 128, 0, 255}, Rgba{255, 255, 255, 255}, Rgba{255, 255, 255, 255}));
  }
  EXPECT_EQ(fractions->environment.surfaces.at(0).colour, (Colour{1, 1, 1, 1}));
  EXPECT_EQ(bytes->report.issues.at(0).severity, Severity::warning);
}

TEST(Obj, WhatStandsThereTwiceOrHasCollapsedIsLeftOutAndSaid) {
  const auto model = objModel("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nf 1 2 3\nf 2 3 1\nf 1 3 2\nf 1 2 2\nf 1 2 4\n");
  ASSERT_TRUE(model);
  EXPECT_EQ(model->environment.meshes.at(0)->triangles.size(), 2U);  // one from each side
  EXPECT_EQ(model->environment.meshes.at(0)->positions.size(), 3U);
  ASSERT_EQ(model->report.issues.size(), 2U);
  EXPECT_EQ(model->report.issues[0].source, "line 8");
  EXPECT_THAT(model->report.issues[0].message, HasSubstr("degenerate triangles skipped: 2"));
  EXPECT_EQ(model->report.issues[1].source, "line 6");
}

TEST(Obj, AHouseInMillimetresIsPointedOut) {
  std::string text;
  for (const char c : kCube) text += c == '1' && text.find('f') == std::string::npos ? "9000" : std::string(1, c);
  const auto model = objModel(text);
  ASSERT_TRUE(model);
  ASSERT_FALSE(model->report.issues.empty());
  EXPECT_THAT(model->report.issues.back().message, HasSubstr("coordinates are in mm"));
}

TEST(Obj, PiecesOfAnySizeGiveTheSameModel) {
  std::string text = "# a path \\\n" + kCube;
  for (const char* end : {"\n", "\r\n", "\r"}) {
    std::string ended;
    for (const char c : text + "o b\ng c\nusemtl d\nv 0 0 \\\n 0 1 0 0\nvt 0 1\nf -1/-1 \\\n-2/1 -3/1\n\n\nf 1 2 3")
      ended += c == '\n' ? end : std::string(1, c);
    Progress progress;
    const auto bytes = FileBytes::of(ended, "a.obj");
    const auto whole = readObjFile(bytes, "a.obj", ended.size(), progress);
    ASSERT_TRUE(whole) << describe(whole.error());
    ASSERT_EQ(whole->faceCount(), 8U);
    ASSERT_EQ(whole->lineOf(7), 26U);
    for (std::size_t piece = 1; piece < 60; ++piece) {
      const auto parts = readObjFile(bytes, "a.obj", piece, progress);
      ASSERT_TRUE(parts) << describe(parts.error()) << piece;
      EXPECT_EQ(parts->positions, whole->positions);
      EXPECT_EQ(parts->corners, whole->corners);
      EXPECT_EQ(parts->texture_corners, whole->texture_corners);
      EXPECT_EQ(parts->face_begins, whole->face_begins);
      EXPECT_EQ(parts->colours, whole->colours);
      EXPECT_EQ(parts->events.size(), whole->events.size());
      for (std::size_t f = 0; f < 8; ++f) EXPECT_EQ(parts->lineOf(f), whole->lineOf(f)) << piece;
    }
  }
}

TEST(Obj, Utf16IsReadAsItsText) {
  std::string text = "\xFF\xFE";
  for (const char c : std::string("o B\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"))
    text += c == 'B' ? std::string("\xDF\x00", 2) : std::string{c, '\0'};
  const auto model = objModel(text);
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_EQ(model->environment.products.at(0).name, "ß");
}

TEST(Obj, LargeCoordinatesKeepTheirTenthOfAMillimetre) {
  const auto model = objModel(
      "v 4512345.1234 5300000.5 100.25\nv 4512346.1234 5300000.5 100.25\nv 4512345.1234 5300001.5 100.25\nf 1 2 3\n",
      {.up = UpAxis::z});
  ASSERT_TRUE(model);
  const auto& e = model->environment;
  const Eigen::Vector3d file =
      e.instances.at(0).world_from_mesh * e.meshes.at(0)->positions.at(0).cast<double>() + model->georeference.shift_m;
  EXPECT_NEAR(file.x(), 4512345.1234, 1e-7);
  EXPECT_EQ(model->georeference.shift_m, model->georeference.shift_m.array().round().matrix());
}

TEST(Obj, WriterAndImporterAgreeInTheFileFrame) {
  Progress progress;
  const auto folder = scratch();
  auto model =
      import(write(folder / "a.obj", "o left #1\n" + kCube + "o right\nusemtl Glass\nf 1 2 3\n"), {.up = UpAxis::z});
  ASSERT_TRUE(model);
  model->environment.instances[1].world_from_mesh.linear() = Eigen::Vector3d(-1, 1, 1).asDiagonal();
  model->georeference.shift_m = {600000, 5000000, 300};
  ASSERT_TRUE(writeEnvironmentObj(model->environment, model->georeference, folder / "b.obj", progress));
  const auto back = import(folder / "b.obj", {.up = UpAxis::z});
  ASSERT_TRUE(back) << describe(back.error());
  const auto a = bounds(model->environment), b = bounds(back->environment);
  EXPECT_LT((a.min + model->georeference.shift_m - b.min - back->georeference.shift_m).norm(), 1e-6);
  EXPECT_LT((a.max + model->georeference.shift_m - b.max - back->georeference.shift_m).norm(), 1e-6);
  ASSERT_EQ(back->environment.products.size(), 2U);
  EXPECT_NEAR(volume(*back->environment.meshes.at(0)), 1, 1e-6);
  EXPECT_TRUE(isClosed(*back->environment.meshes.at(0)));
  EXPECT_EQ(back->environment.surfaces.at(1).name, "Glass");
  // A mirrored instance turns its triangles so that they still face outward.
  const auto& t = *back->environment.meshes.at(1);
  const auto corner = [&](int k) { return t.positions[t.triangles[0][static_cast<std::size_t>(k)]]; };
  EXPECT_GT((corner(1) - corner(0)).cross(corner(2) - corner(0)).z(), 0);
}

TEST(Polygon, TriangulationOfAnyStarShapedPolygonKeepsItsArea) {
  for (std::uint32_t n = 4; n < 60; ++n) {
    std::vector<Eigen::Vector3d> corners;
    double shoelace = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      const double radius = 0.2 + uniform(philox({n, 0}, i, 0, 0)[0]), angle = 6.283185307179586 * i / n;
      corners.emplace_back(radius * std::cos(angle), 3, radius * std::sin(angle));
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      const auto &p = corners[i], &q = corners[(i + 1) % n];
      shoelace += 0.5 * (p.x() * q.z() - p.z() * q.x());
    }
    const auto cut = triangulatePolygon(corners);
    ASSERT_EQ(cut.triangles.size(), n - 2);  // what a polygon of n corners has
    EXPECT_TRUE(cut.clean);
    double sum = 0;
    for (const auto& t : cut.triangles)
      sum += 0.5 * (corners[t[1]] - corners[t[0]]).cross(corners[t[2]] - corners[t[0]]).norm();
    EXPECT_NEAR(sum, shoelace, 1e-12) << n;
  }
}

TEST(Polygon, AHoleThatABridgeJoinsToTheOutlineStaysOpen) {
  // A square of 4 by 4 around a square of 2 by 2: out along the bridge from (0, 0) to (1, 1), round, and back.
  const std::vector<Eigen::Vector3d> corners = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                                                {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
  const auto cut = triangulatePolygon(corners);
  EXPECT_TRUE(cut.clean);
  double sum = 0;
  for (const auto& t : cut.triangles)
    sum += 0.5 * (corners[t[1]] - corners[t[0]]).cross(corners[t[2]] - corners[t[0]]).z();
  EXPECT_DOUBLE_EQ(sum, 12);
}

TEST(Polygon, CrossingItselfIsSaidAndBounded) {
  std::vector<Eigen::Vector3d> corners;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const auto r = philox({5, 0}, i, 0, 0);
    corners.emplace_back(uniform(r[0]), uniform(r[1]), 0);
  }
  const auto cut = triangulatePolygon(corners);
  EXPECT_FALSE(cut.clean);
  EXPECT_EQ(cut.triangles.size(), 19998U);
}

}  // namespace
}  // namespace standpoint::test
