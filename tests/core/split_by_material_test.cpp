// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/split_by_material.h"

#include <array>

#include <gtest/gtest.h>

namespace standpoint {
namespace {

// Two products that show one mesh of two looks (a frame and a pane), the second look first where the materials say so.
struct Model {
  Environment environment;
  MaterialAssignment assignment;
  Model() {
    auto mesh = std::make_shared<Mesh>();
    mesh->positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    mesh->triangles = {{0, 1, 2}, {1, 3, 2}};
    mesh->surface_of_triangle = {0, 1};
    environment.surfaces = {{"frame"}, {"pane"}};
    environment.meshes = {mesh};
    environment.products.resize(2);
    environment.instances = {{0, 0, Eigen::Affine3d::Identity()}, {0, 1, Eigen::Affine3d::Identity()}};
    assignment.materials.resize(2);
    assignment.surfaces = {{0, 0, 0, ""}, {0, 1, 1, ""}, {1, 0, 0, ""}, {1, 1, 1, ""}};
  }
};

TEST(SplitByMaterial, SharesTheMeshOfProductsThatAreMadeOfTheSame) {
  Model model;
  const std::array all = {&model.environment};
  EXPECT_EQ(splitByMaterial(all, model.assignment, LooksOfSplit::kept), (std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(model.environment.meshes.size(), 1U);
  EXPECT_EQ(model.environment.surfaces[1].name, "pane");
  EXPECT_EQ(validate(model.environment), "");
}

TEST(SplitByMaterial, PartsAMeshWhoseProductsAreMadeOfOtherThings) {
  Model model;
  model.assignment.surfaces[2].material = 1;  // the frame of the second product
  const std::array all = {&model.environment};
  EXPECT_EQ(splitByMaterial(all, model.assignment, LooksOfSplit::kept), (std::vector<std::int32_t>{0, 1, 1}));
  ASSERT_EQ(model.environment.meshes.size(), 2U);
  EXPECT_EQ(model.environment.surfaces[2].name, "frame");
  EXPECT_EQ(model.environment.meshes[1]->surface_of_triangle, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(model.environment.meshes[1]->triangles[0],
            (Triangle{1, 3, 2}));  // the pane's came first in the list of surfaces
  EXPECT_EQ(validate(model.environment), "");
}

TEST(SplitByMaterial, WithoutLooksHasOneSurfaceForEachMaterialAndKeepsTheLooksOfTheRest) {
  Model model;
  model.assignment.surfaces = {{0, 0, 1, ""}, {0, 1, 1, ""}, {1, 0, 1, ""}};  // the second pane has none
  const std::array all = {&model.environment};
  EXPECT_EQ(splitByMaterial(all, model.assignment, LooksOfSplit::left_out), (std::vector<std::int32_t>{1, -1}));
  EXPECT_EQ(model.environment.surfaces[1].name, "pane");
}

TEST(SplitByMaterial, GivesAllEnvironmentsOneListOfSurfaces) {
  Model model;
  Environment simpler = model.environment;
  simpler.instances.pop_back();
  model.assignment.surfaces[2].material = 1;
  const std::array all = {&model.environment, &simpler};
  splitByMaterial(all, model.assignment, LooksOfSplit::kept);
  EXPECT_EQ(model.environment.surfaces, simpler.surfaces);
  EXPECT_EQ(validate(simpler), "");
}

}  // namespace
}  // namespace standpoint
