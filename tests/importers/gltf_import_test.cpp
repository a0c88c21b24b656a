// SPDX-License-Identifier: GPL-3.0-or-later
#include <meshoptimizer.h>

#include "tests/importers/mesh_files.h"

namespace standpoint::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// One mesh of one primitive under one node; `extra` goes into the accessor of positions, `node` into the node.
std::string oneMesh(const std::string& primitive, const std::string& accessors, const std::string& views,
                    const std::string& binary, const std::string& more = "\"nodes\":[{\"mesh\":0}]") {
  return glb("{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":" + std::to_string(binary.size()) +
                 "}],\"bufferViews\":[" + views + "],\"accessors\":[" + accessors + "],\"meshes\":[{\"primitives\":[{" +
                 primitive + "}]}]," + more + "}",
             binary);
}

std::string view(std::size_t offset, std::size_t length, const std::string& more = "") {
  return "{\"buffer\":0,\"byteOffset\":" + std::to_string(offset) + ",\"byteLength\":" + std::to_string(length) + more +
         "}";
}

std::string accessor(int view_index, int type, const std::string& shape, std::size_t count,
                     const std::string& more = "") {
  return "{\"bufferView\":" + std::to_string(view_index) + ",\"componentType\":" + std::to_string(type) +
         ",\"type\":\"" + shape + "\",\"count\":" + std::to_string(count) + more + "}";
}

const std::vector<float> kFive = {0, 0, 0, 1, 2, 3, 2, 0, 0, 3, 1, 0, 4, 0, 5};

std::vector<Triangle> trianglesOfMode(int mode) {
  const auto file =
      write(scratch() / "mode.glb", oneMesh("\"mode\":" + std::to_string(mode) + ",\"attributes\":{\"POSITION\":0}",
                                            accessor(0, 5126, "VEC3", 5), view(0, 60), bytesOf(kFive)));
  const auto model = import(file);
  EXPECT_TRUE(model) << describe(model.error());
  return model ? model->environment.meshes.at(0)->triangles : std::vector<Triangle>{};
}

TEST(Gltf, StripTurnsEverySecondTriangle) {
  EXPECT_THAT(trianglesOfMode(5), ElementsAre(Triangle{0, 1, 2}, Triangle{1, 3, 2}, Triangle{2, 3, 4}));
}

TEST(Gltf, FanSharesItsFirstVertex) {
  EXPECT_THAT(trianglesOfMode(6), ElementsAre(Triangle{1, 2, 0}, Triangle{2, 3, 0}, Triangle{3, 4, 0}));
}

TEST(Gltf, PointsAndLinesAreListedAsLost) {
  for (const int mode : {0, 1, 2, 3}) {
    const auto model = import(
        write(scratch() / "lines.glb", oneMesh("\"mode\":" + std::to_string(mode) + ",\"attributes\":{\"POSITION\":0}",
                                               accessor(0, 5126, "VEC3", 5), view(0, 60), bytesOf(kFive))));
    ASSERT_TRUE(model);
    EXPECT_EQ(model->report.losses(), 1U);
    EXPECT_EQ(model->report.issues.at(0).source, "/meshes/0/primitives/0");
  }
}

TEST(Gltf, YUpBecomesZUpByAnExchangeOfAxes) {
  const auto file =
      write(scratch() / "up.glb", oneMesh("\"attributes\":{\"POSITION\":0}", accessor(0, 5126, "VEC3", 3), view(0, 36),
                                          bytesOf(std::vector<float>{0.1F, 0.2F, 0.3F, 1, 0, 0, 0, 1, 0})));
  const auto y_up = import(file), z_up = import(file, {.up = UpAxis::z});
  ASSERT_TRUE(y_up && z_up);
  const auto first = [](const ImportedModel& m) -> Eigen::Vector3d {
    return m.environment.instances.at(0).world_from_mesh * m.environment.meshes.at(0)->positions.at(0).cast<double>();
  };
  EXPECT_EQ(first(*y_up), Eigen::Vector3d(0.1F, -0.3F, 0.2F));
  EXPECT_EQ(first(*z_up), Eigen::Vector3d(0.1F, 0.2F, 0.3F));
}

TEST(Gltf, NormalizedShortsAreDividedByTheirLargest) {
  const std::vector<std::int16_t> quantized = {32767, -32768, 0, 0, 16384, 0, 1, 0, 0, 0, 0, 0};
  const auto model = import(write(scratch() / "q.glb", oneMesh("\"attributes\":{\"POSITION\":0}",
                                                               accessor(0, 5122, "VEC3", 3, ",\"normalized\":true"),
                                                               view(0, 24, ",\"byteStride\":8"), bytesOf(quantized))));
  ASSERT_TRUE(model) << describe(model.error());
  const auto& p = model->environment.meshes.at(0)->positions;
  EXPECT_EQ(p.at(0), Eigen::Vector3f(1, -1, 0));
  EXPECT_EQ(p.at(1).x(), 16384.0F / 32767.0F);  // stride 8: the fourth short is padding
}

TEST(Gltf, SparseValuesReplaceTheDenseOnes) {
  const auto binary =
      bytesOf(kFive) + bytesOf(std::vector<std::uint16_t>{1, 4}) + bytesOf(std::vector<float>{9, 8, 7, 6, 5, 4});
  const auto model =
      import(write(scratch() / "sparse.glb", oneMesh("\"mode\":5,\"attributes\":{\"POSITION\":0}",
                                                     accessor(0, 5126, "VEC3", 5,
                                                              ",\"sparse\":{\"count\":2,\"indices\":{\"bufferView\":1,"
                                                              "\"componentType\":5123},\"values\":{\"bufferView\":2}}"),
                                                     view(0, 60) + "," + view(60, 4) + "," + view(64, 24), binary)));
  ASSERT_TRUE(model) << describe(model.error());
  const auto& p = model->environment.meshes.at(0)->positions;
  EXPECT_EQ(p.at(1), Eigen::Vector3f(9, 8, 7));
  EXPECT_EQ(p.at(4), Eigen::Vector3f(6, 5, 4));
  EXPECT_EQ(p.at(3), Eigen::Vector3f(3, 1, 0));
}

TEST(Gltf, MeshoptBuffersAreDecodedAndTheFallbackIsNotNeeded) {
  std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(5, 12));
  packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), kFive.data(), 5, 12));
  const std::string binary = bytesOf(packed);
  const std::string json =
      R"({"asset":{"version":"2.0"},"extensionsRequired":["EXT_meshopt_compression"],"buffers":[{"byteLength":)" +
      std::to_string(binary.size()) +
      R"(},{"byteLength":60,"extensions":{"EXT_meshopt_compression":{"fallback":true}}}],"bufferViews":[{"buffer":1,
        "byteLength":60,
      "extensions":{"EXT_meshopt_compression":{"buffer":0,"byteLength":)" +
      std::to_string(binary.size()) + R"(,"byteStride":12,"count":5,"mode":"ATTRIBUTES"}}}],"accessors":[)" +
      accessor(0, 5126, "VEC3", 5) +
      R"(],"meshes":[{"primitives":[{"mode":6,"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}]})";
  const auto model = import(write(scratch() / "meshopt.glb", glb(json, binary)));
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_EQ(bytesOf(model->environment.meshes.at(0)->positions), bytesOf(kFive));
}

TEST(Gltf, NodesShareTheirMeshAndKeepNamesAndExtras) {
  const auto model = import(write(
      scratch() / "nodes.glb",
      oneMesh("\"mode\":5,\"attributes\":{\"POSITION\":0}", accessor(0, 5126, "VEC3", 5), view(0, 60), bytesOf(kFive),
              R"("nodes":[{"children":[1,2],"translation":[10,0,0]},{"mesh":0,"name":"left",)"
              R"("extras":{"fire":"F90","n":2}},)"
              R"({"mesh":0,"name":"right","scale":[2,2,2]}],"scenes":[{"nodes":[0]}],"scene":0)")));
  ASSERT_TRUE(model) << describe(model.error());
  const auto& e = model->environment;
  ASSERT_EQ(e.meshes.size(), 1U);
  ASSERT_EQ(e.instances.size(), 2U);
  EXPECT_EQ(e.products.at(0).name, "left");
  EXPECT_EQ(e.products.at(0).id, "/nodes/1");
  ASSERT_EQ(e.products.at(0).properties.size(), 2U);
  EXPECT_EQ(e.products.at(0).properties.at(0).value, "F90");
  EXPECT_EQ(e.products.at(0).properties.at(1).value, "2");
  const Eigen::Vector3d placed = e.instances.at(1).world_from_mesh * Eigen::Vector3d(1, 2, 3);
  EXPECT_EQ(placed, Eigen::Vector3d(12, -6, 4));
}

TEST(Gltf, GpuInstancesBelongToOneProduct) {
  const auto binary = bytesOf(kFive) + bytesOf(std::vector<float>{0, 0, 0, 5, 0, 0, 10, 0, 0});
  const auto model = import(write(
      scratch() / "instances.glb",
      oneMesh("\"mode\":5,\"attributes\":{\"POSITION\":0}",
              accessor(0, 5126, "VEC3", 5) + "," + accessor(1, 5126, "VEC3", 3), view(0, 60) + "," + view(60, 36),
              binary,
              R"("nodes":[{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":1}}}}])")));
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_EQ(model->environment.products.size(), 1U);
  EXPECT_EQ(triangleCount(model->environment), 9U);
  EXPECT_EQ(bounds(model->environment).max.x(), 14);
}

TEST(Gltf, MaterialsBecomeSurfacesInSrgbAndAMissingTextureOnlyCostsTheTexture) {
  const auto model = import(write(
      scratch() / "material.glb",
      oneMesh(
          "\"mode\":5,\"attributes\":{\"POSITION\":0},\"material\":0", accessor(0, 5126, "VEC3", 5), view(0, 60),
          bytesOf(kFive),
          R"("nodes":[{"mesh":0}],"images":[{"uri":"nowhere.png"}],"textures":[{"source":0}],)"
          R"("materials":[{"name":"Glass",)"
          R"("alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[0.21404114,1,0,0.25],"metallicFactor":0,)"
          R"("roughnessFactor":0.5,"baseColorTexture":{"index":0}}}])")));
  ASSERT_TRUE(model) << describe(model.error());
  const auto& s = model->environment.surfaces.at(0);
  EXPECT_EQ(s.name, "Glass");
  EXPECT_NEAR(s.colour.r, 0.5, 1e-6);  // 0.21404114 is sRGB 0.5 in IEC 61966-2-1
  EXPECT_EQ(s.colour.a, 0.25F);
  EXPECT_EQ(s.metallic, 0.0F);
  EXPECT_EQ(s.roughness, 0.5F);
  ASSERT_EQ(model->report.losses(), 1U);
  EXPECT_EQ(model->report.issues.at(0).source, "/materials/0");
}

TEST(Gltf, FarCoordinatesKeepTheirMillimetres) {
  std::vector<float> far = {500000, 0, 0, 500001, 0, 0, 500000, 1, 0.5F};
  const auto model =
      import(write(scratch() / "far.glb", oneMesh("\"attributes\":{\"POSITION\":0}", accessor(0, 5126, "VEC3", 3),
                                                  view(0, 36), bytesOf(far))));
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_EQ(model->georeference.shift_m, Eigen::Vector3d(500001, 0, 1));
  const auto box = bounds(model->environment);
  EXPECT_EQ(box.min, Eigen::Vector3d(-1, -0.5, -1));
  EXPECT_EQ(box.max, Eigen::Vector3d(0, 0, 0));
  for (const auto& p : model->environment.meshes.at(0)->positions) EXPECT_LT(p.norm(), 2);
}

}  // namespace
}  // namespace standpoint::test
