// SPDX-License-Identifier: GPL-3.0-or-later
#include <limits>
#include <set>

#include <nlohmann/json.hpp>

#include "core/random.h"
#include "tests/importers/mesh_files.h"

namespace standpoint::test {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

// A triangle with an index buffer, a material and a child node, small enough to break in every place.
std::string sound() {
  const std::string binary =
      bytesOf(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}) + bytesOf(std::vector<std::uint16_t>{0, 1, 2, 0});
  return glb(R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"children":[1]},)"
             R"({"mesh":0,"name":"a"}],)"
             R"("materials":[{"name":"m"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,)"
             R"("material":0}]}],)"
             R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3},{"bufferView":1,)"
             R"("componentType":5123,)"
             R"("type":"SCALAR","count":3}],"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,)"
             R"("byteOffset":36,"byteLength":6}],)"
             R"("buffers":[{"byteLength":44}]})",
             binary);
}

std::string withChange(const char* pointer, const Json& value) {
  const std::string bytes = sound();
  const std::size_t length = static_cast<unsigned char>(bytes[12]) + 256U * static_cast<unsigned char>(bytes[13]);
  auto json = Json::parse(bytes.substr(20, length));
  json[Json::json_pointer(pointer)] = value;
  return refusal(write(scratch() / "wrong.glb", glb(json.dump(), bytes.substr(28 + length))));
}

TEST(GltfRefuses, WhatPointsToNothingAndNamesThePlace) {
  ASSERT_EQ(refusal(write(scratch() / "sound.glb", sound())), "accepted");
  EXPECT_THAT(withChange("/scenes/0/nodes/0", 7), HasSubstr("wrong.glb /scenes/0: refers to /nodes/7"));
  EXPECT_THAT(withChange("/nodes/1/mesh", 3), HasSubstr("/nodes/1/mesh: refers to /meshes/3"));
  EXPECT_THAT(withChange("/meshes/0/primitives/0/material", 5), HasSubstr("/meshes/0/primitives/0/material"));
  EXPECT_THAT(withChange("/meshes/0/primitives/0/attributes/POSITION", 9), HasSubstr("/accessors/9"));
  EXPECT_THAT(withChange("/meshes/0/primitives/0/indices", -1), HasSubstr("/meshes/0/primitives/0/indices"));
  EXPECT_THAT(withChange("/accessors/0/bufferView", 2), HasSubstr("/accessors/0: refers to /bufferViews/2"));
  EXPECT_THAT(withChange("/bufferViews/1/buffer", 4), HasSubstr("/bufferViews/1/buffer"));
}

TEST(GltfRefuses, WhatIsNoneByItsFirstBytes) {
  for (const std::string bytes : {"", " \n ", "\x89PNG\r\n", "[1]", "\xEF\xBB\xBF"})
    EXPECT_THAT(refusal(write(scratch() / "other.glb", bytes)), HasSubstr("neither binary glTF (GLB) nor JSON"))
        << bytes;
  EXPECT_THAT(refusal(write(scratch() / "other.gltf", "\xEF\xBB\xBF {\"asset\":")), HasSubstr("invalid JSON"));
}

TEST(GltfLosses, WhatFollowsTheLengthThatTheHeaderStates) {
  const auto longer = import(write(scratch() / "longer.glb", sound() + "more"));
  ASSERT_TRUE(longer) << describe(longer.error());
  ASSERT_EQ(longer->report.losses(), 1U);
  const auto& issues = longer->report.issues;
  const auto loss =
      std::find_if(issues.begin(), issues.end(), [](const Issue& i) { return i.severity == Severity::loss; });
  EXPECT_EQ(loss->source, "byte 8");
  EXPECT_THAT(loss->message, HasSubstr("4 bytes longer than its header states"));
  std::string shorter = sound();
  const std::size_t stated = shorter.size() - 52;  // without the binary chunk
  for (int i = 0; i < 4; ++i) shorter[8 + static_cast<std::size_t>(i)] = static_cast<char>(stated >> (8 * i));
  EXPECT_THAT(refusal(write(scratch() / "shorter.glb", shorter)), HasSubstr("/buffers/0"));
}

TEST(GltfRefuses, SizesThatDoNotFit) {
  EXPECT_THAT(withChange("/accessors/0/count", 4),
              HasSubstr("/accessors/0: needs 48 bytes of /bufferViews/0, which has 36"));
  EXPECT_THAT(withChange("/accessors/0/count", 4294967295), HasSubstr("/accessors/0"));
  EXPECT_THAT(withChange("/accessors/0/byteOffset", 1e300), HasSubstr("/accessors/0/byteOffset"));
  EXPECT_THAT(withChange("/bufferViews/0/byteLength", 400), HasSubstr("/bufferViews/0: extends to byte 400"));
  EXPECT_THAT(withChange("/bufferViews/0/byteStride", 4), HasSubstr("smaller than an element"));
  EXPECT_THAT(withChange("/buffers/0/byteLength", 4000), HasSubstr("/buffers/0: states 4000 bytes but has 44"));
  EXPECT_THAT(withChange("/accessors/1/componentType", 5126), HasSubstr("/accessors/1"));
  EXPECT_THAT(withChange("/accessors/0/type", "MAT4"), HasSubstr("/accessors/0"));
}

TEST(GltfRefuses, CyclesAndForeignFormats) {
  EXPECT_THAT(withChange("/nodes/1/children", Json::array({0})), HasSubstr("/nodes/0: has two parents"));
  EXPECT_THAT(withChange("/asset/version", "1.0"), HasSubstr("/asset/version"));
  EXPECT_THAT(withChange("/extensionsRequired", Json::array({"NEW_geometry"})), HasSubstr("/extensionsRequired/0"));
  EXPECT_THAT(withChange("/nodes/0/matrix", Json::array({1, 2})), HasSubstr("/nodes/0/matrix"));
  EXPECT_THAT(withChange("/buffers/0/uri", "/etc/hostname"), HasSubstr("/buffers/0/uri"));
  EXPECT_THAT(withChange("/buffers/0/uri", "https://example.org/a.bin"), HasSubstr("/buffers/0/uri"));
}

TEST(GltfRefuses, AccessorsThatUnpackToFarMoreThanTheFile) {
  Json accessor = {{"componentType", 5126}, {"type", "VEC3"}, {"count", 4000000000U}};
  EXPECT_THAT(withChange("/accessors/0", accessor), HasSubstr("decompresses to more than 64 times"));
}

// A node that places its mesh `count` times, with an accessor of zeros that costs the file nothing.
TEST(GltfRefuses, BombsOfInstancing) {
  const auto bomb = [](std::uint64_t count) {
    const std::string bytes = sound();
    const std::size_t length = static_cast<unsigned char>(bytes[12]) + 256U * static_cast<unsigned char>(bytes[13]);
    auto json = Json::parse(bytes.substr(20, length));
    json["accessors"].push_back({{"componentType", 5126}, {"type", "VEC3"}, {"count", count}});
    json["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 2;
    return refusal(write(scratch() / "bomb.glb", glb(json.dump(), bytes.substr(28 + length))));
  };
  EXPECT_EQ(bomb(1000), "accepted");
  EXPECT_THAT(bomb(1'000'000'000), HasSubstr("/accessors/2: decompresses to more than 64 times the file size"));
  EXPECT_THAT(bomb(10'000'000), HasSubstr("decompresses to more than 64 times the file size"));
}

// Each of 1000 nodes places a mesh of a million vertices that the file spells out once, as zeros.
TEST(GltfRefuses, MoreThanABillionPlacedVertices) {
  Json json = {{"asset", {{"version", "2.0"}}},
               {"accessors", {{{"componentType", 5126}, {"type", "VEC3"}, {"count", 1'000'000}}}},
               {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}}};
  for (int i = 0; i < 1001; ++i) json["nodes"].push_back({{"mesh", 0}});
  EXPECT_THAT(refusal(write(scratch() / "placed.gltf", json.dump())),
              HasSubstr("/nodes/999: exceeds the limit of 1 000 000 000 placed vertices"));
}

TEST(GltfRefuses, DeepNestingOfJsonAndReadsDeepNestingOfNodes) {
  EXPECT_THAT(refusal(write(scratch() / "deep.gltf",
                            "{\"asset\":{\"version\":\"2.0\"},\"extras\":" + std::string(5'000'000, '['))),
              HasSubstr("deep.gltf byte 235: the JSON is nested more than 200 levels deep"));
  Json json = {{"asset", {{"version", "2.0"}}}, {"scenes", {{{"nodes", {0}}}}}};
  constexpr int kNodes = 20'000;
  for (int i = 0; i < kNodes; ++i)
    json["nodes"].push_back(i + 1 < kNodes ? Json{{"children", {i + 1}}} : Json{{"name", "last"}});
  EXPECT_EQ(refusal(write(scratch() / "nodes.gltf", json.dump())), "accepted");
  for (auto& node : json["nodes"]) node["scale"] = {1e10, 1e10, 1e10};
  EXPECT_THAT(refusal(write(scratch() / "nodes.gltf", json.dump())),
              HasSubstr("/nodes/30: its placement is not finite"));
}

TEST(GltfRefuses, DataUrisOfTheWrongLengthAndReadsOverlappingViews) {
  const auto uri = [](const std::string& data, int states) {
    return refusal(write(scratch() / "uri.gltf",
                         R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":)" + std::to_string(states) +
                             R"(,"uri":"data:application/octet-stream;base64,)" + data + "\"}]}"));
  };
  EXPECT_EQ(uri("AAECAw==", 4), "accepted");
  EXPECT_EQ(uri("AAECAw==", 3), "accepted");  // a longer one is what padding makes
  EXPECT_THAT(uri("AAECAw==", 5), HasSubstr("/buffers/0: states 5 bytes but has 4"));
  EXPECT_THAT(uri("AAE*Aw==", 4), HasSubstr("/buffers/0/uri: is a data URI that is not base64"));
  EXPECT_EQ(withChange("/bufferViews/1/byteOffset", 4), "accepted");  // indices from the bytes of positions: all 0
}

TEST(GltfRefuses, NumbersThatAreNotFinite) {
  EXPECT_THAT(withChange("/nodes/1/scale", Json::array({1e308, 1e308, 1e308})), HasSubstr("accepted"));
  std::string nan = sound();
  const float not_a_number = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(&nan[nan.size() - 44 + 4], &not_a_number, 4);
  EXPECT_THAT(refusal(write(scratch() / "nan.glb", nan)), HasSubstr("/accessors/0: element 0 is not a finite number"));
}

TEST(GltfRefuses, NumbersBeyondDoubleWithTheirPlace) {
  EXPECT_THAT(refusal(write(scratch() / "large.gltf", R"({"asset":{"version":"2.0"},"x":-2.8e937278})")),
              HasSubstr("large.gltf byte 31: the number -2.8e937278 is too large"));
}

TEST(GltfRefuses, EveryCutOfAFile) {
  const auto bytes = sound();
  const auto file = scratch() / "cut.glb";
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_NE(refusal(write(file, bytes.substr(0, length))), "accepted") << length;
}

// Any answer is fine as long as there is one, and what is accepted is a valid environment.
void survivesMutations(const std::filesystem::path& original, int rounds) {
  const auto bytes = readBytes(original);
  const auto file = scratch() / ("mutated" + original.extension().string());
  for (const auto& entry : std::filesystem::directory_iterator(original.parent_path()))
    if (entry.path().extension() == ".bin")
      std::filesystem::copy(entry.path(), file.parent_path() / entry.path().filename());
  for (int round = 0; round < rounds; ++round) {
    auto mutated = bytes;
    const auto draw = philox({7, 0}, static_cast<std::uint32_t>(round), 0, 0);
    const std::size_t reach = round % 2 == 0 ? std::min<std::size_t>(mutated.size(), 3000) : mutated.size();
    for (int k = 0; k < 3; ++k)
      mutated[draw[static_cast<std::size_t>(k)] % reach] = static_cast<char>(draw[3] >> (8 * k));
    const auto model = import(write(file, mutated));
    EXPECT_EQ(model ? validate(model->environment) : "", "");
  }
}

TEST(GltfSurvives, RandomBytesInEveryKindOfFile) { survivesMutations(write(scratch() / "sound.glb", sound()), 500); }

TEST(GltfSurvives, RandomBytesInDracoFiles) {
  const auto file = corpus() / "gltf/assimp/draco/2CylinderEngine.gltf";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no corpus beside the project";
  survivesMutations(file, 60);
}

TEST(GltfCorpus, LoadsAllPositivesAndRefusesAllNegatives) {
  const auto folder = corpus() / "gltf";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no corpus beside the project";
  // The generator's manifest says of these two that they must not load: a later version, an unknown required extension.
  const std::set<std::string> not_loadable = {"Compatibility_04.gltf", "Compatibility_05.gltf"};
  int loaded = 0, refused = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "asset-generator-positive")) {
    if (entry.path().extension() != ".gltf") continue;
    const auto model = import(entry.path());
    EXPECT_EQ(model.has_value(), !not_loadable.contains(entry.path().filename().string())) << entry.path();
    loaded += model.has_value() ? 1 : 0;
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "asset-generator-negative")) {
    if (entry.path().extension() != ".gltf") continue;
    EXPECT_THAT(refusal(entry.path()), HasSubstr("/meshes/0/primitives/0/attributes: has no POSITION"));
    ++refused;
  }
  EXPECT_EQ(loaded, 161);
  EXPECT_EQ(refused, 2);
}

}  // namespace
}  // namespace standpoint::test
