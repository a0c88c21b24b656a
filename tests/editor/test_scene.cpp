// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <gtest/gtest.h>

#include "demo_document.h"
#include "editor/viewport/feature_edges.h"
#include "editor/viewport/merged_scene.h"
#include "editor/viewport/model_pieces.h"

namespace standpoint {
namespace {

// A cube whose faces do not share vertices, as glTF has them.
Mesh looseCube() {
  Mesh mesh;
  static constexpr int kCorner[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& face : kCorner) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const int c : face) mesh.positions.emplace_back(c & 1, c >> 1 & 1, c >> 2 & 1);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
    mesh.surface_of_triangle.insert(mesh.surface_of_triangle.end(), 2, 0);
  }
  return mesh;
}

TEST(FeatureEdges, OfACubeAreItsTwelveEdgesWithoutTheDiagonals) {
  EXPECT_EQ(featureEdges(looseCube(), 0.5).size(), 12U);
}

TEST(FeatureEdges, OfASheetAreItsRim) {
  Mesh sheet;
  sheet.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  sheet.surface_of_triangle = {0, 0};
  EXPECT_EQ(featureEdges(sheet, 0.5).size(), 4U);
}

// A corner on the diagonal of a sheet, joined to one half of it by a triangle without area: nothing to draw. Folded
// along the diagonal, that is drawn, in its two parts.
TEST(FeatureEdges, TakeATriangleWithoutAreaForNoFace) {
  for (const bool folded : {false, true}) {
    Mesh sheet;
    sheet.positions = {{0, 0, 0}, {1, 0, folded ? 0.5F : 0}, {1, 1, 0}, {0, 1, 0}, {0.25F, 0.25F, 0}};
    sheet.triangles = {{0, 1, 4}, {1, 2, 4}, {0, 4, 2}, {0, 2, 3}};
    sheet.surface_of_triangle = {0, 0, 0, 0};
    const auto edges = featureEdges(sheet, 0.5);
    EXPECT_EQ(edges.size(), folded ? 6U : 4U);
    EXPECT_EQ(std::count(edges.begin(), edges.end(), EdgeLine{0, 4}), folded ? 1 : 0);
    EXPECT_EQ(std::count(edges.begin(), edges.end(), EdgeLine{2, 4}), folded ? 1 : 0);
    EXPECT_EQ(std::count(edges.begin(), edges.end(), EdgeLine{0, 2}), 0) << "its parts are drawn";
  }
}

TEST(FeatureEdges, OfNothingAreNone) { EXPECT_TRUE(featureEdges(Mesh(), 0.5).empty()); }

ViewState demoState(const Document& document) {
  ViewState state;
  state.environment = document.imported;
  return state;
}

TEST(MergedScene, HasEveryTangibleTriangleOnceAndGlassApart) {
  const auto document = demoHouse();
  const auto merged = mergeVisible(demoState(document));
  std::size_t tangible = 0, glass = 0;
  for (const auto& i : document.imported->instances) {
    const auto& mesh = *document.imported->meshes[i.mesh];
    if (!document.imported->products[i.product].tangible) continue;
    tangible += mesh.triangles.size();
    glass += static_cast<std::size_t>(std::count(mesh.surface_of_triangle.begin(), mesh.surface_of_triangle.end(), 2U));
  }
  EXPECT_EQ(merged.opaque.colours.size() + merged.transparent.colours.size(), tangible);
  EXPECT_EQ(merged.transparent.colours.size(), glass);
  EXPECT_EQ(merged.opaque.corners.size(), 3 * merged.opaque.colours.size());
  const auto points = static_cast<std::int64_t>(merged.opaque.positions.size() / 3);
  EXPECT_TRUE(std::all_of(merged.opaque.corners.begin(), merged.opaque.corners.end(),
                          [&](std::int64_t c) { return c >= 0 && c < points; }));
}

TEST(MergedScene, PutsWhatShowsAnImageApartAndLetsVertexColoursRunFromCornerToCorner) {
  Environment e;
  e.images = {std::make_shared<Image>()};
  e.surfaces = {{"plain", {1, 1, 1, 1}}, {"painted", {1, 1, 1, 1}}};
  e.surfaces[1].image = 0;
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 2}};
  mesh.surface_of_triangle = {0, 1};
  mesh.texture_coordinates = {{0, 0}, {1, 0}, {0, 0.75F}};
  mesh.colours = {{30, 255, 0, 255}, {60, 255, 0, 255}, {90, 127, 0, 255}};
  e.meshes = {std::make_shared<Mesh>(mesh)};
  e.products.resize(1);
  e.instances = {{0, 0, Eigen::Affine3d::Identity()}};
  ViewState state;
  state.environment = std::make_shared<const Environment>(e);
  const auto merged = mergeVisible(state);
  EXPECT_TRUE(merged.graded.graded);
  EXPECT_EQ(merged.graded.colours, (std::vector<Rgba>{{30, 255, 0, 255}, {60, 255, 0, 255}, {90, 127, 0, 255}}));
  EXPECT_EQ(merged.graded.corners.size(), 3U);
  EXPECT_TRUE(merged.opaque.corners.empty());
  ASSERT_EQ(merged.painted.size(), 1U);
  const auto& painted = merged.painted.at({0, true});
  EXPECT_EQ(painted.coordinates, (std::vector<float>{0, 1, 1, 1, 0, 0.25F}));  // upside down
  EXPECT_EQ(painted.triangles.colours.size(), 3U);
  state.colour = ColourMode::reflectance;
  EXPECT_EQ(mergeVisible(state).opaque.colours.size(), 2U);
}

TEST(MergedScene, ShowsDeviationsFromGreyToDarkRedAtTheFullScale) {
  const auto document = demoHouse();
  auto state = demoState(document);
  state.colour = ColourMode::deviation;
  const auto waiting = mergeVisible(state);
  ASSERT_FALSE(waiting.opaque.colours.empty());
  EXPECT_EQ(waiting.opaque.colours.front(), deviationColour(0, 1));
  DeviationField field{document.imported, {}, 0.01};
  for (const auto& i : document.imported->instances) {
    InstanceDeviation d;
    d.distance_m.assign(document.imported->meshes[i.mesh]->positions.size(), i.product == 0 ? 0.02F : 0.0F);
    d.area_m2.assign(d.distance_m.size(), 1);
    field.of_instance.push_back(std::make_shared<const InstanceDeviation>(std::move(d)));
  }
  state.deviation = std::make_shared<const DeviationField>(std::move(field));
  const auto merged = mergeVisible(state);
  EXPECT_TRUE(merged.opaque.corners.empty());
  EXPECT_TRUE(merged.transparent.corners.empty());  // glass, too, shows how far it moved
  ASSERT_EQ(merged.graded.colours.size(), merged.graded.positions.size() / 3);
  EXPECT_EQ(merged.graded.colours.front(), (Rgba{118, 8, 40, 255}));
  EXPECT_EQ(merged.graded.colours.back(), (Rgba{178, 186, 196, 255}));
}

TEST(MergedScene, LeavesOutWhatIsHidden) {
  const auto document = demoHouse();
  auto state = demoState(document);
  state.hidden = std::make_shared<const HiddenProducts>(document.imported->products.size(), std::uint8_t{1});
  const auto merged = mergeVisible(state);
  EXPECT_TRUE(merged.opaque.colours.empty());
  EXPECT_TRUE(merged.transparent.colours.empty());
}

TEST(MergedScene, PaintsWhatHasNoMaterialInAColourThatNoMaterialHas) {
  const auto document = demoHouse();
  auto state = demoState(document);
  state.colour = ColourMode::material;
  const auto merged = mergeVisible(state);
  ASSERT_FALSE(merged.opaque.colours.empty());
  EXPECT_EQ(merged.opaque.colours.front(), merged.opaque.colours.back());
  const auto pink = materialColour(nullptr);
  for (const double red : {0.02, 0.2, 0.6, 0.95})
    for (const double green : {0.02, 0.2, 0.6, 0.95}) {
      PhysicalMaterial m;
      m.id = "some";
      m.reflectance = {{532, green}, {660, red}};
      const auto c = materialColour(&m);
      EXPECT_GT(std::abs(c.r - pink.r) + std::abs(c.g - pink.g) + std::abs(c.b - pink.b), 0.3F) << red << " " << green;
    }
}

// Two squares in one plane, of one surface: one has a material of its own.
TEST(MergedScene, ShowsAFaceAtAPointAndNotItsCoplanarNeighbour) {
  Environment e;
  e.surfaces = {{"panel"}};
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {3, 0, 0}, {3, 1, 0}, {2, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  mesh.surface_of_triangle.assign(4, 0);
  e.meshes = {std::make_shared<Mesh>(mesh)};
  e.products.resize(1);
  e.instances = {{0, 0, Eigen::Affine3d::Identity()}};
  MaterialChoice choice;
  auto& assignment = choice.result.assignment;
  assignment.materials.resize(2);
  assignment.materials[0].reflectance = {{905, 0.2}};
  assignment.materials[1].reflectance = {{905, 0.8}};
  assignment.surfaces = {{0, 0, 0, "", 1}};
  assignment.faces = {{0, 0, Eigen::Vector3d::UnitZ(), 1, "", Eigen::Vector3d(2.5, 0.5, 0)}};
  ViewState state;
  state.environment = std::make_shared<const Environment>(e);
  state.materials = std::make_shared<const MaterialChoice>(choice);
  state.colour = ColourMode::reflectance;
  const Rgba dark = {51, 51, 51, 255}, bright = {204, 204, 204, 255};  // 0.2 and 0.8 of 255
  EXPECT_EQ(mergeVisible(state).opaque.colours, (std::vector<Rgba>{dark, dark, bright, bright}));
}

TEST(MergedColours, AreThoseOfTheMergedSceneAndTellWhetherATriangleMoved) {
  const auto document = demoHouse();  // with glass, which is transparent by the model's colours
  auto state = demoState(document);
  std::vector<MergedColours> of_mode;
  for (const auto mode : {ColourMode::model, ColourMode::material, ColourMode::reflectance, ColourMode::confidence,
                          ColourMode::expected_noise}) {
    state.colour = mode;
    const auto merged = mergeVisible(state);
    const auto colours = mergeColours(state);
    ASSERT_TRUE(colours);
    EXPECT_EQ(colours->opaque, merged.opaque.colours);
    EXPECT_EQ(colours->transparent, merged.transparent.colours);
    of_mode.push_back(*colours);
  }
  EXPECT_NE(of_mode[0].runs, of_mode[1].runs);  // without materials, nothing is transparent
  EXPECT_EQ(of_mode[1].runs, of_mode[3].runs);
  EXPECT_NE(of_mode[1].opaque, of_mode[4].opaque);
}

TEST(MergedColours, AreNotToldWhereTheGeometryDependsOnThem) {
  Environment e;
  e.surfaces.resize(1);
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.surface_of_triangle = {0};
  mesh.colours.resize(3);
  e.meshes = {std::make_shared<Mesh>(mesh)};
  e.products.resize(1);
  e.instances = {{0, 0, Eigen::Affine3d::Identity()}};
  ViewState state;
  state.environment = std::make_shared<const Environment>(e);
  EXPECT_FALSE(mergeColours(state));
  state.colour = ColourMode::material;
  EXPECT_TRUE(mergeColours(state));
}

// Three cells in a row: the second is a little higher, as on a slope; the third is a stair's next step.
TEST(MergedScene, DrawsTheCellsOfASlopeWithoutGapsAndTheStepsOfAStairAsTheyAre) {
  Mesh mesh;
  for (const auto& [x, z] : {std::pair{0.0F, 1.0F}, {1.0F, 1.05F}, {2.0F, 1.23F}}) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {{x, 0, z}, {x + 1, 0, z}, {x + 1, 1, z}, {x, 1, z}});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  const auto drawn = mergeWalkable(mesh, {72, 200, 130, 120});
  const auto height = [&](std::size_t cell, std::size_t corner) {
    return drawn.positions[(4 * cell + corner) * 3 + 2];
  };
  EXPECT_FLOAT_EQ(height(0, 0), 1.03F);
  EXPECT_FLOAT_EQ(height(0, 1), 1.08F) << "meets the second";
  EXPECT_FLOAT_EQ(height(1, 0), 1.08F);
  EXPECT_FLOAT_EQ(height(1, 1), 1.08F) << "below the step";
  EXPECT_FLOAT_EQ(height(2, 0), 1.26F);
  EXPECT_EQ(drawn.colours.size(), 6U);
}

TEST(ModelPieces, CoverEveryInstanceOnceAndKeepRanksOfFacesApart) {
  const Document document = demoHouse();
  const auto& environment = *document.imported;
  const auto ranges = rangesOf(environment, 20);
  ASSERT_GT(ranges.size(), 2U);
  std::vector<int> times(environment.instances.size());
  int rank = 0;
  for (const auto& range : ranges) {
    EXPECT_GE(range.rank, rank) << "the first in front";
    rank = range.rank;
    std::size_t triangles = 0, instances = 0;
    for (auto i = range.first; i < range.end; ++i) {
      if (!range.holds(environment, i)) continue;
      ++times[i];
      ++instances;
      triangles += environment.meshes[environment.instances[i].mesh]->triangles.size();
      EXPECT_EQ(faceRank(environment.products[environment.instances[i].product]), range.rank);
    }
    EXPECT_TRUE(triangles <= 20 || instances == 1) << triangles;
  }
  EXPECT_EQ(times, std::vector<int>(environment.instances.size(), 1));
  EXPECT_TRUE(rangesOf(Environment(), 20).empty());
}

TEST(FaceRank, HasFinishesBeforeWallsBeforeSlabsBeforeTheirFrameBeforeTheGround) {
  const auto rank = [](const char* ifc_class) {
    Product product;
    product.ifc_class = ifc_class;
    return faceRank(product);
  };
  EXPECT_EQ(rank(""), 0);
  EXPECT_EQ(rank("IfcDoor"), 0);
  EXPECT_LT(rank("IfcCovering"), rank("IfcWallStandardCase"));
  EXPECT_EQ(rank("IfcWall"), rank("IfcWallStandardCase"));
  EXPECT_LT(rank("IfcWall"), rank("IfcSlab"));
  EXPECT_LT(rank("IfcSlab"), rank("IfcMember"));
  EXPECT_LT(rank("IfcMember"), rank("IfcSite"));
  EXPECT_EQ(rank("IfcSite"), kFaceRanks - 1);
}

TEST(EdgeCache, PlacesTheEdgesOfEveryInstance) {
  Document document = demoHouse();
  EdgeCache cache;
  const std::vector<std::uint32_t> column = {10};
  const auto lines = cache.edges(demoState(document), &column);
  EXPECT_EQ(document.imported->products[10].ifc_class, "IfcColumn");
  EXPECT_EQ(lines.ends.size(), 24U);
}

}  // namespace
}  // namespace standpoint
