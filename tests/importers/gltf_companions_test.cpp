// SPDX-License-Identifier: GPL-3.0-or-later
// Levels of detail and collision shapes beside an exported model, as engines look for them.
#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "importers/gltf/gltf_writer.h"
#include "tests/importers/mesh_files.h"

namespace standpoint::test {
namespace {

using nlohmann::json;

std::shared_ptr<const Mesh> fan(std::uint32_t triangles) {
  auto mesh = std::make_shared<Mesh>();
  mesh->positions.emplace_back(0, 0, 0);
  for (std::uint32_t i = 0; i <= triangles; ++i) mesh->positions.emplace_back(static_cast<float>(i), 10, 0);
  for (std::uint32_t i = 0; i < triangles; ++i) mesh->triangles.push_back({0, i + 1, i + 2});
  mesh->surface_of_triangle.assign(triangles, 0);
  return mesh;
}

// A roof of six triangles, and two equal walls.
Environment model() {
  Environment e;
  e.surfaces.resize(1);
  e.meshes = {fan(6), fan(2)};
  for (const char* name : {"Roof", "Wall", "Wall"}) e.products.emplace_back().name = name;
  e.products[0].ifc_class = "IfcRoof";
  const Eigen::Affine3d here = Eigen::Affine3d::Identity(), there(Eigen::Translation3d(0, 0, 5));
  e.instances = {{0, 0, here}, {1, 1, here}, {1, 2, there}};
  return e;
}

class GltfCompanion : public ::testing::Test {
 protected:
  json exported(const GltfCompanions& companions) {
    Progress progress;
    const auto done = exportEnvironmentGltf(model_, {}, file_, progress, companions);
    EXPECT_TRUE(done) << describe(done.error());
    return json::parse(std::ifstream(file_));
  }
  ImportedModel read() {
    auto result = import(file_);
    EXPECT_TRUE(result) << describe(result.error());
    return *std::move(result);
  }
  GltfCollision boxes(CollisionNaming naming) {
    shapes_.surfaces.resize(1);
    shapes_.meshes = {fan(1), fan(1), fan(1)};
    for (std::uint32_t i = 0; i < 3; ++i)
      shapes_.instances.push_back({i, i == 0 ? 0U : i, Eigen::Affine3d::Identity()});
    return {&shapes_, {true, true, false}, naming};
  }
  static std::vector<std::string> names(const json& gltf) {
    std::vector<std::string> result;
    for (const auto& node : gltf.at("nodes")) result.push_back(node.value("name", ""));
    return result;
  }
  bool has(const json& gltf, const std::string& name) const {
    const auto all = names(gltf);
    return std::count(all.begin(), all.end(), name) == 1;
  }

  std::filesystem::path file_ = scratch() / "house.gltf";
  Environment model_ = model(), shapes_;
};

TEST_F(GltfCompanion, ALevelIsNamedByItsProductAndStandsOutsideOfTheScene) {
  Environment light = model_, bare = model_;
  light.meshes[0] = fan(1);
  bare.meshes[0] = light.meshes[0];
  bare.instances.erase(bare.instances.begin() + 2);  // the second wall is gone
  const json gltf =
      exported({{{"LOD1", &light, {0.25, 0, 0}, {0.1, 0, 0}}, {"LOD2", &bare, {0.25, 0, 3}, {0.1, 0, 2}}}, {}});
  const auto& nodes = gltf.at("nodes");
  const auto all = names(gltf);
  const auto roof = static_cast<std::size_t>(std::find(all.begin(), all.end(), "Roof") - all.begin());
  const auto ids = nodes[roof].at("extensions").at("MSFT_lod").at("ids");
  ASSERT_EQ(ids.size(), 1U);  // the second level has the same roof
  EXPECT_EQ(nodes[ids[0].get<std::size_t>()].at("name"), "Roof LOD1");
  EXPECT_EQ(nodes[ids[0].get<std::size_t>()].at("extras").at("standpoint").at("max_deviation_m"), 0.25);
  const auto& in_scene = nodes[0].at("children");
  EXPECT_EQ(in_scene.size(), 3U);
  EXPECT_EQ(std::count(in_scene.begin(), in_scene.end(), ids[0]), 0);
  // A deviation of 0.25 m on a roof of 11.66 m (10 by 6) is a thousandth of the screen where the roof is 4.7 % of its
  // height.
  const auto coverage = nodes[roof].at("extras").at("MSFT_screencoverage");
  ASSERT_EQ(coverage.size(), 2U);
  EXPECT_NEAR(coverage[0].get<double>(), std::pow(std::hypot(10, 6) / 250, 2), 1e-9);
  EXPECT_EQ(coverage[1], 0);
  EXPECT_FALSE(nodes[in_scene[1].get<std::size_t>()].contains("extensions"));
  const auto& gone = nodes[in_scene[2].get<std::size_t>()].at("extensions").at("MSFT_lod").at("ids")[0];
  EXPECT_FALSE(nodes[gone.get<std::size_t>()].contains("mesh"));
  EXPECT_EQ(gltf.at("asset").at("extras").at("standpoint").at("levels")[0].at("triangles"), 1 + 2 + 2);
  EXPECT_EQ(
      gltf.at("asset").at("extras").at("standpoint").at("levels")[0].at("classes").at("IfcRoof").at("max_deviation_m"),
      0.25);
}

TEST_F(GltfCompanion, WhatIsReadBackIsTheFinestLevelWithoutShapesAndNothingIsLost) {
  Environment light = model_;
  light.meshes[0] = fan(1);
  for (const auto naming : {CollisionNaming::unreal, CollisionNaming::godot, CollisionNaming::physics}) {
    shapes_ = {};
    exported({{{"LOD1", &light, {0.25, 0, 0}, {0.1, 0, 0}}}, boxes(naming)});
    const auto back = read();
    EXPECT_EQ(triangleCount(back.environment), 10U);
    EXPECT_EQ(back.environment.products.size(), 3U);
    EXPECT_EQ(back.report.losses(), 0U);
  }
}

TEST_F(GltfCompanion, UnrealFindsShapesByTheNameOfTheMesh) {
  const json gltf = exported({{}, boxes(CollisionNaming::unreal)});
  EXPECT_TRUE(has(gltf, "UCX_Roof_0_01"));
  EXPECT_TRUE(has(gltf, "UCX_Wall_1_01"));
  EXPECT_TRUE(has(gltf, "Roof_0"));
  EXPECT_FALSE(has(gltf, "UCX_Wall_2_01"));  // the second wall is the same mesh, which has its shape already
  EXPECT_EQ(gltf.at("meshes")[0].at("name"), "Roof_0");
}

TEST_F(GltfCompanion, UnrealGetsNoShapeThatIsNotConvexForItWouldMakeAHullOfIt) {
  auto collision = boxes(CollisionNaming::unreal);
  collision.convex = {false, true, true};
  const json gltf = exported({{}, collision});
  EXPECT_FALSE(has(gltf, "UCX_Roof_0_01"));
  EXPECT_TRUE(has(gltf, "Roof")) << "keeps its name: nothing looks for it";
  EXPECT_TRUE(has(gltf, "UCX_Wall_1_01"));
}

TEST_F(GltfCompanion, GodotReadsConvexShapesAndMeshesByTheirSuffix) {
  const json gltf = exported({{}, boxes(CollisionNaming::godot)});
  EXPECT_TRUE(has(gltf, "Roof-convcolonly"));
  EXPECT_TRUE(has(gltf, "Wall-convcolonly"));
  EXPECT_TRUE(has(gltf, "Wall-colonly"));
}

TEST_F(GltfCompanion, ACollidersMeshIsDrawnByNobody) {
  const json gltf = exported({{}, boxes(CollisionNaming::physics)});
  const auto& nodes = gltf.at("nodes");
  std::size_t colliders = 0;
  for (const auto& index : nodes[0].at("children")) {
    const auto& node = nodes[index.get<std::size_t>()];
    if (!node.contains("extensions")) continue;
    ++colliders;
    const auto& geometry = node.at("extensions").at("KHR_physics_rigid_bodies").at("collider").at("geometry");
    EXPECT_FALSE(node.contains("mesh"));
    EXPECT_TRUE(nodes[geometry.at("node").get<std::size_t>()].contains("mesh"));
    EXPECT_EQ(std::count(nodes[0].at("children").begin(), nodes[0].at("children").end(), geometry.at("node")), 0);
    EXPECT_EQ(geometry.at("convexHull"), node.at("name") == "Roof collider" || colliders == 2);
  }
  EXPECT_EQ(colliders, 3U);
  EXPECT_EQ(gltf.at("extensionsUsed"), json::array({"KHR_physics_rigid_bodies"}));
}

TEST_F(GltfCompanion, CollisionShapesOfOtherProgramsAreLeftOutAndSaid) {
  model_.products[1].name = "UCX_Roof_01";
  model_.products[2].name = "Wall-ColOnly";
  exported({});
  const auto back = read();
  EXPECT_EQ(triangleCount(back.environment), 6U);
  EXPECT_TRUE(std::any_of(back.report.issues.begin(), back.report.issues.end(),
                          [](const Issue& i) { return i.message.starts_with("2 collision shapes"); }));
}

}  // namespace
}  // namespace standpoint::test
