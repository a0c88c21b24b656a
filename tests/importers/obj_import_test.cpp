// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/random.h"
#include "importers/obj_polygon.h"
#include "tests/importers/mesh_files.h"

namespace standpoint::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Result<ImportedModel> obj(const std::string& text, const ImportOptions& options = {}) {
  return import(write(scratch() / "a.obj", text), options);
}

std::string refused(const std::string& text) { return refusal(write(scratch() / "a.obj", text)); }

const std::string kCube =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

TEST(Obj, CubeOfQuadsIsClosedAndHasTheVolumeOfACube) {
  const auto model = obj(kCube, {.metres_per_unit = 0.5});
  ASSERT_TRUE(model) << describe(model.error());
  const auto& mesh = *model->environment.meshes.at(0);
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_TRUE(isClosed(mesh));
  EXPECT_DOUBLE_EQ(volume(mesh), 0.125);
}

TEST(Obj, DefaultUpAxisIsYAndZCanBeAskedFor) {
  const std::string text = "v 1 2 3\nv 0 0 0\nv 1 0 0\nf 1 2 3\n";
  EXPECT_EQ(obj(text)->environment.meshes.at(0)->positions.at(0), Eigen::Vector3f(1, -3, 2));
  EXPECT_EQ(obj(text, {.up = UpAxis::z})->environment.meshes.at(0)->positions.at(0), Eigen::Vector3f(1, 2, 3));
}

TEST(Obj, ObjectsAndGroupsBecomeProductsAndANameThatComesBackContinues) {
  const auto model = obj("v 0 0 0\nv 1 0 0\nv 0 1 0\no house\ng wall\nf 1 2 3\ng roof\nf 1 2 3\no house\ng wall\nf -3 -2 -1\n");
  ASSERT_TRUE(model);
  ASSERT_EQ(model->environment.products.size(), 2U);
  EXPECT_EQ(model->environment.products.at(0).id, "o house g wall");
  EXPECT_EQ(model->environment.meshes.at(0)->triangles.size(), 2U);
  EXPECT_EQ(model->environment.meshes.at(1)->triangles.size(), 1U);
}

TEST(Obj, ConcavePolygonKeepsItsArea) {
  // An L of area 3: a fan from the first corner would give 4.
  const auto model = obj("v 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nf 1 2 3 4 5 6\n", {.up = UpAxis::z});
  ASSERT_TRUE(model);
  EXPECT_DOUBLE_EQ(area(*model->environment.meshes.at(0)), 3);
  EXPECT_TRUE(model->report.issues.empty());
}

TEST(Obj, MaterialsComeFromTheMtlAndAMissingOneIsAWarning) {
  const auto folder = scratch();
  write(folder / "two words.mtl", "newmtl Red brick\nKd 0.5 0.25 0.125\nd 0.5\nPr 0.75\n");
  const auto model = import(write(folder / "a.obj", "mtllib two words.mtl\nmtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                                                    "usemtl Red brick\nf 1 2 3\nusemtl other\nf 1 2 3\n"));
  ASSERT_TRUE(model) << describe(model.error());
  const auto& s = model->environment.surfaces;
  ASSERT_EQ(s.size(), 2U);
  EXPECT_EQ(s[0].colour, (Colour{0.5F, 0.25F, 0.125F, 0.5F}));
  EXPECT_EQ(s[0].roughness, 0.75F);
  EXPECT_EQ(s[0].source, "newmtl Red brick");
  EXPECT_THAT(model->environment.products.at(0).materials, ElementsAre("Red brick", "other"));
  ASSERT_EQ(model->report.issues.size(), 2U);
  EXPECT_EQ(model->report.issues[0].severity, Severity::warning);
  EXPECT_EQ(model->report.issues[0].source, "line 2");
  EXPECT_EQ(model->report.issues[1].source, "line 8");
}

TEST(Obj, RefusesWrongNumbersAndIndicesWithTheirLine) {
  EXPECT_THAT(refused("v 0 0 0\nv nan 0 0\n"), HasSubstr("a.obj line 2"));
  EXPECT_THAT(refused("v 0 0 0\nv 1 inf 0\n"), HasSubstr("line 2"));
  EXPECT_THAT(refused("v 0 0 1e999\n"), HasSubstr("line 1: a coordinate is not a finite number"));
  EXPECT_THAT(refused("v 0 0\n"), HasSubstr("line 1: a vertex needs three numbers"));
  EXPECT_THAT(refused("v 0 0 0\n\n# note\nf 1 1 4\n"), HasSubstr("line 4: refers to vertex 4, there are 1"));
  EXPECT_THAT(refused("v 0 0 0\nf 1 0 1\n"), HasSubstr("line 2: corner 2"));
  EXPECT_THAT(refused("v 0 0 0\nf 1 1 -2\n"), HasSubstr("line 2: refers to vertex -2"));
  EXPECT_THAT(refused("v 0 0 0\nf 1 1 4294967297\n"), HasSubstr("line 2: an index of more than nine digits"));
  EXPECT_THAT(refused("v 0 0 0\nf a b c\n"), HasSubstr("line 2"));
}

TEST(Obj, LinesContinueAndEndInAnyWay) {
  const auto model = obj("\xEF\xBB\xBFv 0 0 0\rv 1 0 \\\r\n0 # x\r\nv 0 1 0\nf 1//1 \\\n 2/4 3/1/1");
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_EQ(triangleCount(model->environment), 1U);
}

TEST(Obj, ListsOnceWhatIsNotASurface) {
  const auto model = obj("v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\np 1\nl 1 2\nl 2 3\ncurv 0 1 1 2\nf 1 2\nf 1 2 3\n");
  ASSERT_TRUE(model);
  EXPECT_EQ(model->report.losses(), 5U);
  EXPECT_EQ(model->report.issues.at(1).source, "line 5");
  EXPECT_THAT(model->report.issues.at(1).message, HasSubstr("2 line statement"));
}

TEST(Obj, LargeCoordinatesKeepTheirTenthOfAMillimetre) {
  const auto model = obj("v 4512345.1234 5300000.5 100.25\nv 4512346.1234 5300000.5 100.25\nv 4512345.1234 5300001.5 100.25\nf 1 2 3\n",
                         {.up = UpAxis::z});
  ASSERT_TRUE(model);
  const auto& e = model->environment;
  const Eigen::Vector3d file = e.instances.at(0).world_from_mesh * e.meshes.at(0)->positions.at(0).cast<double>() + model->georeference.shift_m;
  EXPECT_NEAR(file.x(), 4512345.1234, 1e-7);
  EXPECT_EQ(model->georeference.shift_m, model->georeference.shift_m.array().round().matrix());
}

TEST(Obj, WriterAndImporterAgreeInTheFileFrame) {
  Progress progress;
  const auto folder = scratch();
  auto model = import(write(folder / "a.obj", "o left #1\n" + kCube + "o right\nusemtl Glass\nf 1 2 3\n"), {.up = UpAxis::z});
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
    ASSERT_EQ(cut.triangles.size(), n - 2);
    EXPECT_TRUE(cut.clean);
    double sum = 0;
    for (const auto& t : cut.triangles) sum += 0.5 * (corners[t[1]] - corners[t[0]]).cross(corners[t[2]] - corners[t[0]]).norm();
    EXPECT_NEAR(sum, shoelace, 1e-12) << n;
  }
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

TEST(ObjSurvives, RandomBytes) {
  const std::string text = "mtllib a.mtl\no a\ng b\nusemtl c\n" + kCube + "l 1 2\ncurv 1 2\nf 1/1/1 2//2 -1\n";
  const auto file = scratch() / "mutated.obj";
  for (std::uint32_t round = 0; round < 400; ++round) {
    auto mutated = text;
    const auto r = philox({9, 0}, round, 0, 0);
    for (int k = 0; k < 3; ++k) mutated[r[static_cast<std::size_t>(k)] % mutated.size()] = static_cast<char>(r[3] >> (8 * k));
    const auto model = import(write(file, mutated));
    EXPECT_EQ(model ? validate(model->environment) : "", "");
  }
}

}  // namespace
}  // namespace standpoint::test
