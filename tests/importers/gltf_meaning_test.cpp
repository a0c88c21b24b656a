// SPDX-License-Identifier: GPL-3.0-or-later
#include <numbers>

#include "tests/importers/mesh_files.h"

namespace standpoint::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A glTF file in pieces: what it is made of is written where it is used, buffers as one binary chunk.
class Gltf2 {
 public:
  template <class T>
  int view(const std::vector<T>& values) {
    add(views_, "{\"buffer\":0,\"byteOffset\":" + std::to_string(binary_.size()) +
                    ",\"byteLength\":" + std::to_string(values.size() * sizeof(T)) + "}");
    binary_ += bytesOf(values);
    binary_.resize((binary_.size() + 3) / 4 * 4);
    return view_count_++;
  }
  template <class T>
  int accessor(const std::vector<T>& values, int type, const char* shape, std::size_t count,
               const std::string& more = "") {
    add(accessors_, "{\"bufferView\":" + std::to_string(view(values)) + ",\"componentType\":" + std::to_string(type) +
                        ",\"type\":\"" + shape + "\",\"count\":" + std::to_string(count) + more + "}");
    return accessor_count_++;
  }
  Result<ImportedModel> import(const std::string& rest, const ImportOptions& options = {}) const {
    const std::string json =
        "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":" + std::to_string(binary_.size()) +
        "}],\"bufferViews\":[" + views_ + "],\"accessors\":[" + accessors_ + "]," + rest + "}";
    return test::import(write(scratch() / "a.glb", glb(json, binary_)), options);
  }

 private:
  static void add(std::string& list, const std::string& item) { list += (list.empty() ? "" : ",") + item; }
  std::string views_, accessors_, binary_;
  int view_count_ = 0, accessor_count_ = 0;
};

const std::vector<float> kTriangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};
const std::vector<std::uint8_t> kPng = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n', 1, 2, 3};

std::vector<Eigen::Vector3d> placed(const ImportedModel& model) {
  std::vector<Eigen::Vector3d> result;
  for (const auto& i : model.environment.instances)
    for (const auto& p : model.environment.meshes[i.mesh]->positions)
      result.push_back(i.world_from_mesh * p.cast<double>());
  return result;
}

TEST(GltfTextures, ComeEncodedAndTransformedAsInTheExampleOfTheSpecification) {
  // "only the lower left quadrant of the source image, rotated clockwise 90°": the unit square's corners.
  Gltf2 file;
  file.accessor(kTriangle, 5126, "VEC3", 3);
  file.accessor(std::vector<std::uint8_t>{0, 0, 0, 0, 255, 0, 0, 0, 0, 255, 0, 0}, 5121, "VEC2", 3,
                ",\"normalized\":true");
  file.view(kPng);
  auto model =
      file.import(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_1":1},)"
                  R"("material":0}]}],"images":[{"bufferView":2,)"
                  R"("mimeType":"image/png","name":"bricks"}],"textures":[{"source":0}],)"
                  R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":)"
                  R"({"index":0,"extensions":{"KHR_texture_transform":{"texCoord":1,"offset":[0,1],)"
                  R"("rotation":1.57079632679,"scale":[0.5,0.5]}}}}}])");
  ASSERT_TRUE(model) << describe(model.error());
  const auto& e = model->environment;
  ASSERT_EQ(e.images.size(), 1U);
  EXPECT_EQ(e.surfaces.at(0).image, 0);
  EXPECT_EQ(e.images[0]->name, "bricks");
  EXPECT_EQ(e.images[0]->media_type, "image/png");
  EXPECT_EQ(e.images[0]->bytes.size(), kPng.size());
  for (const auto& t : e.meshes.at(0)->texture_coordinates) {
    EXPECT_GE(t.x(), -1e-6);
    EXPECT_LE(t.x(), 0.5 + 1e-6);
    EXPECT_GE(t.y(), 0.5 - 1e-6);
    EXPECT_LE(t.y(), 1 + 1e-6);
  }
}

TEST(GltfTextures, InOtherFormatsAreNamedAndTheFallbackIsTaken) {
  Gltf2 file;
  file.accessor(kTriangle, 5126, "VEC3", 3);
  file.view(kPng);
  file.view(std::vector<std::uint8_t>{'R', 'I', 'F', 'F', 0, 0, 0, 0, 'W', 'E', 'B', 'P'});
  const auto model = file.import(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
                                 R"("images":[{"bufferView":1},{"bufferView":2}],"textures":)"
                                 R"([{"source":0,"extensions":{"KHR_texture_basisu":{"source":1}}},)"
                                 R"({"extensions":{"KHR_texture_basisu":{"source":1}}},{"source":1}],)"
                                 R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}},)"
                                 R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":1}}},)"
                                 R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":2}}}])");
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_EQ(model->environment.surfaces.at(0).image, 0);
  EXPECT_EQ(model->environment.surfaces.at(1).image, -1);
  EXPECT_EQ(model->environment.surfaces.at(2).image, -1);
  ASSERT_EQ(model->report.losses(), 2U);
  EXPECT_THAT(model->report.issues.at(1).message, HasSubstr("is KTX2, which is not supported and has no PNG or JPEG"));
  EXPECT_THAT(model->report.issues.at(2).message, HasSubstr("is WebP"));
}

TEST(GltfTextures, OutsideTheFolderOfTheModelAreNotRead) {
  const auto folder = scratch();
  std::filesystem::create_directories(folder / "in" / "a b");
  write(folder / "secret.png", std::string(kPng.begin(), kPng.end()));
  write(folder / "in" / "a b" / "c.png", std::string(kPng.begin(), kPng.end()));
  std::filesystem::create_symlink(folder / "secret.png", folder / "in" / "link.png");
  const auto withImage = [&](const std::string& uri) {
    return import(write(folder / "in" / "a.gltf",
                        R"({"asset":{"version":"2.0"},"images":[{"uri":")" + uri +
                            R"("}],"textures":[{"source":0}],)"
                            R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}]})"));
  };
  EXPECT_EQ(withImage("a%20b/c.png")->environment.images.size(), 1U);
  EXPECT_EQ(withImage("a%20b/c.png")->environment.images.at(0)->name, "a b/c.png");
  for (const char* outside : {"../secret.png", "%2e%2e/secret.png", "link.png", "/etc/hostname", "file:///etc/hostname",
                              "a%20b/../../secret.png"}) {
    const auto model = withImage(outside);
    ASSERT_TRUE(model) << outside;
    EXPECT_TRUE(model->environment.images.empty()) << outside;
    EXPECT_EQ(model->report.losses(), 1U) << outside;
    EXPECT_THAT(model->report.issues.at(0).message, HasSubstr("is not in the model's folder")) << outside;
  }
}

TEST(GltfColours, OfAllComponentTypesBecomeEightBitsOfSrgb) {
  // 0.2158605 is 128 of 255 in sRGB (IEC 61966-2-1).
  std::string material = R"({"alphaMode":"BLEND"})";
  const auto coloured = [&material](auto values, int type, const char* shape, const std::string& more) {
    Gltf2 file;
    file.accessor(kTriangle, 5126, "VEC3", 3);
    file.accessor(values, type, shape, 3, more);
    const auto model =
        file.import(R"("nodes":[{"mesh":0}],"materials":[)" + material +
                    R"(],"meshes":[{"primitives":[{"material":0,"attributes":{"POSITION":0,"COLOR_0":1}}]}])");
    EXPECT_TRUE(model) << describe(model.error());
    return model ? model->environment.meshes.at(0)->colours.at(0) : std::array<std::uint8_t, 4>{};
  };
  const float half = 0.2158605F;
  EXPECT_THAT(coloured(std::vector<float>{half, 1, 0, 0.5F, 0, 0, 0, 0, 0, 0, 0, 0}, 5126, "VEC4", ""),
              ElementsAre(128, 255, 0, 128));
  EXPECT_THAT(coloured(std::vector<float>{half, 1, 0, 0, 0, 0, 0, 0, 0}, 5126, "VEC3", ""),
              ElementsAre(128, 255, 0, 255));
  EXPECT_THAT(coloured(std::vector<std::uint16_t>{14146, 65535, 0, 32768, 0, 0, 0, 0, 0, 0, 0, 0}, 5123, "VEC4",
                       ",\"normalized\":true"),
              ElementsAre(128, 255, 0, 128));
  EXPECT_THAT(coloured(std::vector<std::uint8_t>{55, 255, 0, 127, 0, 0, 0, 0, 0, 0, 0, 0}, 5121, "VEC4",
                       ",\"normalized\":true"),
              ElementsAre(128, 255, 0, 127));
  material = "{}";  // opaque: alpha is ignored (glTF 2.0 §3.9.4)
  EXPECT_THAT(coloured(std::vector<float>{half, 1, 0, 0.5F, 0, 0, 0, 0, 0, 0, 0, 0}, 5126, "VEC4", ""),
              ElementsAre(128, 255, 0, 255));
}

TEST(GltfMaterials, KeepTheOpticsAndNameTheRest) {
  Gltf2 file;
  file.accessor(kTriangle, 5126, "VEC3", 3);
  const auto model = file.import(
      R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],)"
      R"("extensions":{"KHR_materials_variants":)"
      R"({"variants":[{"name":"summer"},{"name":"winter"}]}},)"
      R"("materials":[{"normalTexture":{"index":0},"extensions":{"KHR_materials_transmission":)"
      R"({"transmissionFactor":0.9},"KHR_materials_ior":{"ior":1.52},)"
      R"("KHR_materials_volume":{"thicknessFactor":0.006},"KHR_materials_clearcoat":)"
      R"({"clearcoatFactor":0.3},"KHR_materials_specular":{},"KHR_materials_sheen":{}}},)"
      R"({"extensions":{"KHR_materials_unlit":{},)"
      R"("KHR_materials_sheen":{}}},)"
      R"({"extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[0,1,0,1],"glossinessFactor":0.75}}}])");
  ASSERT_TRUE(model) << describe(model.error());
  const auto& s = model->environment.surfaces.at(0);
  EXPECT_EQ(s.transmission, 0.9F);
  EXPECT_EQ(s.index_of_refraction, 1.52F);
  EXPECT_EQ(s.thickness_m, 0.006F);
  EXPECT_EQ(s.clearcoat, 0.3F);
  EXPECT_EQ(s.specular, 1.0F);
  EXPECT_FALSE(s.unlit);
  EXPECT_TRUE(model->environment.surfaces.at(1).unlit);
  EXPECT_EQ(model->environment.surfaces.at(2).roughness, 0.25F);
  EXPECT_EQ(model->environment.surfaces.at(2).colour, (Colour{0, 1, 0, 1}));
  std::vector<std::string> messages;
  for (const auto& issue : model->report.issues) messages.push_back(issue.message);
  EXPECT_THAT(messages,
              ElementsAre("2 variants of the materials (summer, winter) were not read; the default variant is used",
                          "KHR_materials_sheen is not supported, here and in 1 more materials",
                          "normalTexture is not supported"));
}

TEST(GltfPose, MorphTargetsAreAddedByTheWeightsOfTheNodeElseOfTheMesh) {
  Gltf2 file;
  file.accessor(kTriangle, 5126, "VEC3", 3);
  file.accessor(std::vector<float>{0, 0, 4, 0, 0, 4, 0, 0, 4}, 5126, "VEC3", 3);
  file.accessor(std::vector<float>{0, 8, 0, 0, 8, 0, 0, 8, 0}, 5126, "VEC3", 3);
  const auto model =
      file.import(R"("nodes":[{"mesh":0},{"mesh":0,"weights":[1,0.5]},{"mesh":0}],"meshes":[{"weights":[0.25,0],)"
                  R"("primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":1},{"POSITION":2}]}]}])",
                  {.up = UpAxis::z});
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_EQ(model->report.losses(), 0U);
  EXPECT_EQ(model->environment.meshes.size(), 2U);  // the first and the third node share theirs
  const auto p = placed(*model);
  EXPECT_EQ(p.at(0), Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(p.at(3), Eigen::Vector3d(0, 4, 4));
  EXPECT_EQ(p.at(6), p.at(0));
}

TEST(GltfPose, ASkinStandsWhereItsJointsAreAndNotWhereItsNodeIs) {
  Gltf2 file;
  file.accessor(kTriangle, 5126, "VEC3", 3);
  file.accessor(std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, 5121, "VEC4", 3);
  file.accessor(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 0.5F, 0.5F, 0, 0}, 5126, "VEC4", 3);
  std::vector<float> bind(32, 0);
  for (const std::size_t k : {0, 5, 10, 15}) bind[k] = bind[16 + k] = 1;
  bind[16 + 12] = -1;  // the second joint was bound at x = 1
  file.accessor(bind, 5126, "MAT4", 2);
  const auto model = file.import(
      R"("scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0,"skin":0,"translation":[100,0,0]},{"children":[2],)"
      R"("translation":[0,0,10]},{"translation":[1,7,0]}],"skins":[{"joints":[1,2],"inverseBindMatrices":3}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}]}])",
      {.up = UpAxis::z});
  ASSERT_TRUE(model) << describe(model.error());
  const auto p = placed(*model);
  EXPECT_EQ(p.at(0), Eigen::Vector3d(0, 0, 10));        // joint 1 moves it by (0, 0, 10)
  EXPECT_EQ(p.at(1), Eigen::Vector3d(1, 7, 10));        // joint 2: (1, 0, 0) − (1, 0, 0) + (1, 7, 10)
  EXPECT_EQ(p.at(2), Eigen::Vector3d(0, 1 + 3.5, 10));  // half of each
}

TEST(GltfScenes, OnlyTheDefaultOneIsReadAndTheOthersAreCounted) {
  Gltf2 file;
  file.accessor(kTriangle, 5126, "VEC3", 3);
  const auto model = file.import(
      R"("scene":1,"scenes":[{"nodes":[0]},{"nodes":[1]}],"nodes":[{"mesh":0},{"mesh":0,"scale":[-1,1,1]}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}},{"mode":0,"attributes":{"POSITION":0}}]}])");
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_EQ(model->environment.products.at(0).id, "/nodes/1");
  EXPECT_LT(model->environment.instances.at(0).world_from_mesh.linear().determinant(), 0);
  ASSERT_EQ(model->report.losses(), 2U);
  EXPECT_EQ(model->report.issues.at(0).message, "holds 3 points, which are not surfaces");
  EXPECT_EQ(model->report.issues.at(1).message, "1 nodes with meshes are not in the default scene");
}

TEST(GltfScenes, CesiumRtcMovesTheModelInAFrameThatIsZUp) {
  Gltf2 file;
  file.accessor(kTriangle, 5126, "VEC3", 3);
  const auto model =
      file.import(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
                  R"("extensionsRequired":["CESIUM_RTC"],"extensions":{"CESIUM_RTC":{"center":[4000000.25,20,30]}})");
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_EQ(model->georeference.shift_m.x(), 4000001);
  EXPECT_EQ(bounds(model->environment).min,
            Eigen::Vector3d(-0.75, 20 - model->georeference.shift_m.y(), 30 - model->georeference.shift_m.z()));
}

TEST(GltfMetadata, AFeatureOfAMeshIsAProductWithTheRowOfItsTable) {
  Gltf2 file;
  file.accessor(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0}, 5126, "VEC3", 6);
  file.accessor(std::vector<float>{1, 1, 1, 0, 0, 0}, 5126, "SCALAR", 6);
  const int names = file.view(std::vector<char>{'d', 'o', 'o', 'r', 'w', 'a', 'l', 'l', '7'});
  const int ends = file.view(std::vector<std::uint32_t>{0, 4, 9});
  const int heights = file.view(std::vector<float>{2.5F, 3, 1, 4});
  const int kinds = file.view(std::vector<std::uint16_t>{1, 0});
  const auto model =
      file.import(R"("nodes":[{"mesh":0,"name":"house"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,)"
                  R"("_FEATURE_ID_0":1},"extensions":)"
                  R"({"EXT_mesh_features":{"featureIds":[{"featureCount":2,"attribute":0,)"
                  R"("propertyTable":0}]}}}]}],"extensions":{"EXT_structural_metadata":)"
                  R"({"schema":{"enums":{"kind":{"values":[{"name":"LOAD","value":0},{"name":"FREE","value":1}]}},)"
                  R"("classes":{"part":{"properties":{"name":)"
                  R"({"type":"STRING"},"size":{"type":"VEC2","componentType":"FLOAT32"},"kind":{"type":"ENUM",)"
                  R"("enumType":"kind"}}}}},"propertyTables":)"
                  R"([{"class":"part","count":2,"properties":{"name":{"values":)" +
                  std::to_string(names) + R"(,"stringOffsets":)" + std::to_string(ends) + R"(},"size":{"values":)" +
                  std::to_string(heights) + R"(},"kind":{"values":)" + std::to_string(kinds) + R"(}}}]}})");
  ASSERT_TRUE(model) << describe(model.error());
  const auto& products = model->environment.products;
  ASSERT_EQ(products.size(), 2U);
  EXPECT_EQ(products[0].name, "wall7");
  EXPECT_EQ(products[0].id, "/nodes/0/features/1");
  EXPECT_EQ(products[1].name, "door");
  std::vector<std::string> values;
  for (const auto& p : products[1].properties) values.push_back(p.set + "." + p.name + "=" + p.value);
  EXPECT_THAT(values, ElementsAre("part.kind=FREE", "part.name=door", "part.size=2.5, 3.0"));
  EXPECT_EQ(productBounds(model->environment)[1].min.x(), 5);
  EXPECT_EQ(model->environment.meshes.at(0)->positions.size(), 3U);
}

TEST(GltfMetadata, XmpPacketsAndExtrasAreProperties) {
  Gltf2 file;
  file.accessor(kTriangle, 5126, "VEC3", 3);
  const auto model = file.import(
      R"("nodes":[{"mesh":0,"extras":{"fire":"F90"},"extensions":{"KHR_xmp_json_ld":{"packet":0}}}],)"
      R"("meshes":[{"primitives":)"
      R"([{"attributes":{"POSITION":0}}]}],"extensions":{"KHR_xmp_json_ld":{"packets":[{"@context":{},"dc:title":)"
      R"({"@list":["Door","Tür"]}}]}})");
  ASSERT_TRUE(model) << describe(model.error());
  const auto& p = model->environment.products.at(0).properties;
  ASSERT_EQ(p.size(), 2U);
  EXPECT_EQ(p[0].name + "=" + p[0].value, "fire=F90");
  EXPECT_EQ(p[1].set + " " + p[1].name + "=" + p[1].value, "KHR_xmp_json_ld dc:title=[\"Door\",\"Tür\"]");
}

TEST(GltfRefusesWithARemedy, WhatItDoesNotUnderstand) {
  Gltf2 file;
  file.accessor(kTriangle, 5126, "VEC3", 3);
  const auto model = file.import(R"("extensionsRequired":["NEW_geometry"])");
  ASSERT_FALSE(model);
  EXPECT_THAT(
      describe(model.error()),
      HasSubstr("/extensionsRequired/0: 'NEW_geometry' is required but not supported; export the model without it"));
}

}  // namespace
}  // namespace standpoint::test
