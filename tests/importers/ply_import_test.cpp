// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "core/random.h"
#include "tests/importers/mesh_files.h"

namespace standpoint::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using Rgba = std::array<std::uint8_t, 4>;

Result<ImportedModel> ply(const std::string& bytes) { return import(write(scratch() / "a.ply", bytes)); }
std::string refusedPly(const std::string& bytes) { return refusal(write(scratch() / "a.ply", bytes)); }

const std::string kHead =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFaces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kSquare = "0 0 0\n1 0 0\n1 2 0\n0 2 0\n";

template <class T>
void put(std::string& to, T value, bool big) {
  std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);  // of a little-endian machine
  if (big) std::reverse(bytes.begin(), bytes.end());
  to += bytes;
}

TEST(Ply, ASquareInTextStandsInMetresZUp) {
  const auto model = ply(kHead + kFaces + kSquare + "4 0 1 2 3\n");
  ASSERT_TRUE(model) << describe(model.error());
  const auto& mesh = *model->environment.meshes.at(0);
  EXPECT_DOUBLE_EQ(area(mesh), 2);
  EXPECT_EQ(mesh.positions.at(2), Eigen::Vector3f(1, 2, 0));
  EXPECT_EQ(model->environment.products.at(0).name, "a");
}

TEST(Ply, BinaryOfEitherOrderHasItsPropertiesInAnyOrderAndType) {
  for (const bool big : {false, true}) {
    std::string file = std::string("ply\r\nformat ") + (big ? "binary_big_endian" : "binary_little_endian") +
                       " 1.0\r\nelement vertex 3\r\nproperty uchar red\r\nproperty double z\r\nproperty short "
                       "x\r\nproperty uchar green\r\n"
                       "property float y\r\nproperty uchar blue\r\nproperty list uchar float weights\r\n"
                       "element face 1\r\nproperty list ushort uint vertex_index\r\nend_header\r\n";
    for (int i = 0; i < 3; ++i) {
      put<std::uint8_t>(file, 10, big);
      put<double>(file, i == 2 ? 0.1 : 7, big);
      put<std::int16_t>(file, static_cast<std::int16_t>(-30 * i), big);
      put<std::uint8_t>(file, 20, big);
      put<float>(file, i == 1 ? 2.5F : 0, big);
      put<std::uint8_t>(file, 30, big);
      put<std::uint8_t>(file, static_cast<std::uint8_t>(i), big);
      for (int k = 0; k < i; ++k) put<float>(file, 1, big);
    }
    put<std::uint16_t>(file, 3, big);
    for (const std::uint32_t i : {0U, 1U, 2U}) put(file, i, big);
    const auto model = ply(file);
    ASSERT_TRUE(model) << describe(model.error());
    const auto& mesh = *model->environment.meshes.at(0);
    EXPECT_THAT(mesh.positions,
                ElementsAre(Eigen::Vector3f(0, 0, 7), Eigen::Vector3f(-30, 2.5F, 7), Eigen::Vector3f(-60, 0, 0.1F)));
    EXPECT_EQ(mesh.colours.at(1), (Rgba{10, 20, 30, 255}));
  }
}

TEST(Ply, TextureCoordinatesOfVerticesAndOfCornersAreRead) {
  const auto folder = scratch();
  write(folder / "brick wall.jpg", "\xFF\xD8\xFFrest");
  const std::string texture = "ply\nformat ascii 1.0\ncomment TextureFile brick wall.jpg\n";
  const auto vertices = import(write(folder / "v.ply", texture +
                                                           "element vertex 3\nproperty float x\nproperty float "
                                                           "y\nproperty float z\nproperty float s\nproperty float t\n" +
                                                           kFaces + "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 0.25\n3 0 1 2\n"));
  ASSERT_TRUE(vertices) << describe(vertices.error());
  EXPECT_THAT(vertices->environment.meshes.at(0)->texture_coordinates,
              ElementsAre(Eigen::Vector2f(0, 1), Eigen::Vector2f(1, 1), Eigen::Vector2f(0, 0.75F)));
  const auto corners =
      import(write(folder / "c.ply", texture +
                                         "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                                         "element face 2\nproperty list uchar int vertex_indices\nproperty list uchar "
                                         "float texcoord\nproperty int texnumber\nend_header\n" +
                                         kSquare + "3 0 1 2 6 0 0 1 0 1 1 0\n3 0 2 3 6 0 0 1 1 0.5 1 0\n"));
  ASSERT_TRUE(corners) << describe(corners.error());
  const auto& e = corners->environment;
  EXPECT_THAT(e.meshes.at(0)->positions, SizeIs(4));  // the corners of both faces meet again
  EXPECT_EQ(e.meshes.at(0)->texture_coordinates.at(2), Eigen::Vector2f(1, 0));
  ASSERT_THAT(e.images, SizeIs(1));
  EXPECT_EQ(e.surfaces.at(e.meshes.at(0)->surface_of_triangle.at(0)).image, 0);
  EXPECT_EQ(e.surfaces.at(e.meshes.at(0)->surface_of_triangle.at(0)).name, "brick wall");
}

TEST(Ply, ColoursOfFacesBecomeSurfaces) {
  const auto model = ply(kHead +
                         "element face 2\nproperty list uchar int vertex_indices\nproperty uchar red\nproperty uchar "
                         "green\nproperty uchar blue\nend_header\n" +
                         kSquare + "3 0 1 2 255 0 0\n3 0 2 3 0 0 255\n");
  ASSERT_TRUE(model);
  EXPECT_THAT(model->environment.products.at(0).materials, ElementsAre("#ff0000", "#0000ff"));
}

TEST(Ply, StripsTurnEveryOtherTriangleAndBeginAnew) {
  const auto model = ply(kHead + "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" +
                         "0 0 0\n1 0 0\n0 2 0\n1 2 0\n" + "8 0 1 2 3 -1 2 1 0\n");
  ASSERT_TRUE(model) << describe(model.error());
  const auto& mesh = *model->environment.meshes.at(0);
  ASSERT_THAT(mesh.triangles, SizeIs(3));
  const auto up = [&](std::size_t i) {
    const auto& t = mesh.triangles[i];
    return (mesh.positions[t[1]] - mesh.positions[t[0]]).cross(mesh.positions[t[2]] - mesh.positions[t[0]]).z();
  };
  EXPECT_FLOAT_EQ(up(0), 2);
  EXPECT_FLOAT_EQ(up(1), 2);
  EXPECT_FLOAT_EQ(up(2), -2);
}

TEST(Ply, ACloudIsRefusedWithWhatToDoInstead) {
  EXPECT_THAT(refusedPly(kHead + "end_header\n" + kSquare),
              HasSubstr("a point cloud, not a model; add it as an underlay"));
  EXPECT_THAT(refusedPly(kHead + "element face 0\nproperty list uchar int vertex_indices\nend_header\n" + kSquare),
              HasSubstr("point cloud"));
}

TEST(Ply, OtherElementsAreReadOverAndListed) {
  const auto model =
      ply(kHead + "element edge 2\nproperty int a\nproperty list uchar double b\nelement nothing 1000000000000\n" +
          kFaces + kSquare + "7 2 0.5 0.5\n8 0\n4 0 1 2 3\n");
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_EQ(model->report.losses(), 2U);
  EXPECT_THAT(model->report.issues, Contains(Field(&Issue::message, HasSubstr("2 of the element edge"))));
}

TEST(Ply, LargeCoordinatesKeepTheirDigits) {
  const auto model =
      ply(kHead + kFaces + "4512345.123 5300000 100\n4512346 5300000 100\n4512345 5300001 100\n0 0 0\n3 0 1 2\n");
  ASSERT_TRUE(model);
  const auto& e = model->environment;
  const Eigen::Vector3d file =
      e.instances.at(0).world_from_mesh * e.meshes.at(0)->positions.at(0).cast<double>() + model->georeference.shift_m;
  EXPECT_NEAR(file.x(), 4512345.123, 1e-4);
}

TEST(PlyHostile, CountsThatTheFileCannotHoldAreRefused) {
  const std::string vertices = "property float x\nproperty float y\nproperty float z\n";
  EXPECT_THAT(refusedPly("ply\nformat ascii 1.0\nelement vertex 1000000000\n" + vertices + kFaces),
              HasSubstr("a.ply line 3: says 1000000000 of vertex"));
  EXPECT_THAT(
      refusedPly("ply\nformat binary_little_endian 1.0\nelement vertex 18446744073709551615\n" + vertices + kFaces),
      HasSubstr("line 3"));
  EXPECT_THAT(refusedPly("ply\nformat binary_little_endian 1.0\nelement vertex 0\n" + vertices +
                         "element face 1\nproperty list uint int vertex_indices\nend_header\n" +
                         std::string("\xFF\xFF\xFF\xFF", 4)),
              HasSubstr("a.ply face 0: the file is truncated here"));
  EXPECT_THAT(refusedPly(kHead + kFaces + kSquare + "1000000000 0 1 2\n"), HasSubstr("the file is truncated here"));
}

TEST(PlyHostile, WrongIndicesAndNumbersAreRefusedWithTheirPlace) {
  EXPECT_THAT(refusedPly(kHead + kFaces + kSquare + "3 0 1 4\n"),
              HasSubstr("a.ply line 14: refers to a missing vertex; vertex count is 4"));
  EXPECT_THAT(refusedPly(kHead + kFaces + kSquare + "3 0 1 -1\n"), HasSubstr("line 14"));
  EXPECT_THAT(refusedPly(kHead + kFaces + "0 0 nan\n1 0 0\n1 2 0\n0 2 0\n3 0 1 2\n"),
              HasSubstr("line 10: a coordinate is not a finite number"));
  EXPECT_TRUE(ply(kHead + kFaces + "0 0 nan\n1 0 0\n1 2 0\n0 2 0\n3 1 2 3\n"));
  EXPECT_THAT(refusedPly(kHead + kFaces + "0 0 x\n1 0 0\n1 2 0\n0 2 0\n3 0 1 2\n"),
              HasSubstr("line 10: 'x' is not a number (vertex 0 of 4)"));
  EXPECT_THAT(refusedPly("ply\nformat ascii 1.0\nelement vertex four\n"), HasSubstr("line 3"));
  EXPECT_THAT(refusedPly("ply\nproperty float x\n"), HasSubstr("line 2"));
  EXPECT_THAT(refusedPly("ply\nformat ascii 1.0\n"), HasSubstr("no end_header"));
}

TEST(PlyHostile, CutOffOrMutatedItIsAModelOrAnErrorWithItsPlace) {
  std::string binary =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  for (const float v : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) put(binary, v, false);
  binary += '\3';
  for (const std::int32_t i : {0, 1, 2}) put(binary, i, false);
  const auto file = scratch() / "cut.ply";
  for (const std::string& whole : {binary, kHead + kFaces + kSquare + "4 0 1 2 3\n"}) {
    for (std::size_t length = 0; length + 3 < whole.size(); ++length)
      EXPECT_THAT(refusal(write(file, whole.substr(0, length))), HasSubstr("cut.ply")) << length;
    for (std::uint32_t round = 0; round < 100; ++round) {
      auto mutated = whole;
      const auto r = philox({10, 0}, round, 0, 0);
      mutated[r[0] % mutated.size()] = static_cast<char>(r[1]);
      const auto model = import(write(file, mutated));
      EXPECT_EQ(model ? validate(model->environment) : "", "");
    }
  }
}

}  // namespace
}  // namespace standpoint::test
