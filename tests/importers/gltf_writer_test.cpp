// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/gltf_writer.h"

#include <bit>
#include <numbers>

#include "core/random.h"
#include "tests/importers/mesh_files.h"
#include "tests/importers/written_glb.h"

namespace standpoint::test {
namespace {

Mesh randomMesh(std::uint32_t seed, std::size_t vertices, std::size_t triangles, std::uint32_t surfaces) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < vertices; ++i) {
    const auto r = philox({seed, 0}, i, 0, 0);
    mesh.positions.emplace_back(static_cast<float>(uniform(r[0]) - 0.5), static_cast<float>(uniform(r[1]) * 1e-30),
                                static_cast<float>(uniform(r[2]) * 1e6));
  }
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const auto r = philox({seed, 1}, i, 0, 0);
    const auto n = static_cast<std::uint32_t>(vertices);
    mesh.triangles.push_back({r[0] % n, r[1] % n, r[2] % n});
    mesh.surface_of_triangle.push_back(r[3] % surfaces);
  }
  sortBySurface(mesh);
  return mesh;
}

Instance instance(std::uint32_t mesh, std::uint32_t product, const Eigen::Matrix3d& linear,
                  const Eigen::Vector3d& translation) {
  Instance result{mesh, product, Eigen::Affine3d::Identity()};
  result.world_from_mesh.linear() = linear;
  result.world_from_mesh.translation() = translation;
  return result;
}

// Coordinates and every one of the 256 values of a colour's channel.
void paint(Mesh& mesh, std::uint32_t seed) {
  for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) {
    const auto r = philox({seed, 2}, i, 0, 0);
    mesh.texture_coordinates.emplace_back(static_cast<float>(uniform(r[0]) * 7 - 3),
                                          static_cast<float>(uniform(r[1]) / 3));
    mesh.colours.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(255 - i),
                            static_cast<std::uint8_t>(7 * i), static_cast<std::uint8_t>(i ^ 0x55U)});
  }
}

Mesh painted(Mesh mesh, std::uint32_t seed) {
  paint(mesh, seed);
  return mesh;
}

std::shared_ptr<const Image> image(const char* name, const char* media_type, const std::string& bytes) {
  const auto* first = reinterpret_cast<const std::byte*>(bytes.data());
  return std::make_shared<const Image>(Image{name, media_type, {first, first + bytes.size()}});
}

// A red pixel, as any program writes it.
const std::string kTinyPng(
    "\x89PNG\r\n\x1A\n\0\0\0\rIHDR\0\0\0\x01\0\0\0\x01\x08\x02\0\0\0\x90wS\xDE\0\0\0\x0CIDATx\x9C"
    "c\xF8\xCF\xC0\0\0\x03\x01\x01\0\xC9\xFE\x92\xEF\0\0\0\0IEND\xAE"
    "B`\x82",
    69);

Environment everything() {
  Environment e;
  e.surfaces = {{"Brick", {0.1F, 0.7F, 1.0F / 3, 1}, "#12", {}, {}},
                {"", {0, 0, 0, 0.3F}, "", 0.2F, {}},
                {"Gl\xC3\xA4s \"x\"", {0.123456789F, 1, 0.5F, 0.1F}, "#9", 1.0F, 0.0F}};
  e.meshes = {std::make_shared<Mesh>(randomMesh(1, 50, 80, 3)), std::make_shared<Mesh>(),
              std::make_shared<Mesh>(randomMesh(2, 7, 0, 3)), std::make_shared<Mesh>(randomMesh(3, 9, 4, 1))};
  e.images = {image("tiles.png", "image/png", kTinyPng), image("odd", "image/x-tga", "12345"),
              image("none", "image/png", ""), image("liar", "image/jpeg", kTinyPng)};
  e.surfaces.push_back({"Tiles", {1, 1, 1, 1}, "#7", {}, 0.1F, {}, {}, {}, 0.7F, 1.0F / 3, false, 0});
  e.surfaces.push_back({"Pane", {0.2F, 0.9F, 1, 1}, "#8", {}, {}, 0.9F, 1.52F, 0.004F, {}, {}, false, 1});
  e.surfaces.push_back({"Scan", {1, 1, 1, 1}, "#9", {}, {}, {}, {}, {}, {}, {}, true, 0});
  e.meshes.push_back(std::make_shared<Mesh>(painted(randomMesh(4, 300, 90, 6), 4)));
  e.meshes.push_back(
      std::make_shared<Mesh>(randomMesh(5, 20, 30, 6)));  // without coordinates for the image of its surfaces
  e.meshes.push_back(std::make_shared<Mesh>(painted(randomMesh(6, 3, 0, 6), 6)));
  e.products.resize(5);
  e.products[0].name = "wall";
  Eigen::Matrix3d shear, mirror = Eigen::Vector3d(-1, 1, 1).asDiagonal();
  shear << 1, 0.3, 0, 0, 1.7, 0.1, 0, 0, 0.2;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Vector3d t(std::numbers::pi, -1.0 / 3, 1234.5678901234567);
  e.instances = {instance(0, 0, turn, t),
                 instance(0, 0, turn * shear, -t),
                 instance(3, 1, mirror, t / 7),
                 instance(1, 1, turn, t),
                 instance(2, 3, shear, t),
                 instance(0, 3, Eigen::Matrix3d::Identity(), {0, 0, 0}),
                 instance(3, 3, Eigen::Vector3d(1, 1, 0).asDiagonal(), t),
                 instance(4, 4, Eigen::Matrix3d::Identity(), t),
                 instance(5, 4, turn, t),
                 instance(6, 4, turn, t)};
  return e;
}

void expectSame(const Environment& a, const Environment& b) {
  EXPECT_EQ(a.surfaces, b.surfaces);
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (std::size_t i = 0; i < a.meshes.size(); ++i) {
    EXPECT_EQ(bytesOf(a.meshes[i]->positions), bytesOf(b.meshes[i]->positions)) << i;
    EXPECT_EQ(a.meshes[i]->triangles, b.meshes[i]->triangles) << i;
    EXPECT_EQ(a.meshes[i]->surface_of_triangle, b.meshes[i]->surface_of_triangle) << i;
    EXPECT_EQ(bytesOf(a.meshes[i]->texture_coordinates), bytesOf(b.meshes[i]->texture_coordinates)) << i;
    EXPECT_EQ(a.meshes[i]->colours, b.meshes[i]->colours) << i;
  }
  ASSERT_EQ(a.images.size(), b.images.size());
  for (std::size_t i = 0; i < a.images.size(); ++i) {
    EXPECT_EQ(a.images[i]->name, b.images[i]->name);
    EXPECT_EQ(a.images[i]->media_type, b.images[i]->media_type);
    EXPECT_EQ(a.images[i]->bytes, b.images[i]->bytes);
  }
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (std::size_t i = 0; i < a.instances.size(); ++i) {
    EXPECT_EQ(a.instances[i].mesh, b.instances[i].mesh);
    EXPECT_EQ(a.instances[i].product, b.instances[i].product);
    for (int k = 0; k < 16; ++k)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(a.instances[i].world_from_mesh.matrix().data()[k]),
                std::bit_cast<std::uint64_t>(b.instances[i].world_from_mesh.matrix().data()[k]));
  }
  EXPECT_EQ(a.products.size(), b.products.size());
}

Environment throughGlb(const Environment& e, const Georeference& g, const std::filesystem::path& file) {
  Progress progress;
  const auto written = testing::putGlb(e, g, file, progress);
  EXPECT_TRUE(written) << describe(written.error());
  auto back = readEnvironmentGlb(file, progress);
  EXPECT_TRUE(back) << describe(back.error());
  return back.value_or(Environment{});
}

TEST(GltfWriter, RoundTripKeepsEveryBit) {
  const auto e = everything();
  ASSERT_EQ(validate(e), "");
  expectSame(e, throughGlb(e, {}, scratch() / "a.glb"));
}

TEST(GltfWriter, RoundTripOfNothingIsNothing) { expectSame({}, throughGlb({}, {}, scratch() / "empty.glb")); }

TEST(GltfWriter, SameEnvironmentGivesTheSameBytes) {
  const auto folder = scratch();
  throughGlb(everything(), {}, folder / "a.glb");
  throughGlb(everything(), {}, folder / "b.glb");
  EXPECT_EQ(readBytes(folder / "a.glb"), readBytes(folder / "b.glb"));
}

// What another program's reader must see: the same places, Y up, which our importer turns back.
TEST(GltfWriter, ImporterSeesTheSamePlacesAndRestoresTheGeoreference) {
  const auto e = everything();
  Georeference g;
  g.shift_m = {691234, 5336789, 512};
  g.crs = "EPSG:25832";
  g.map_from_file = MapConversion{0.1, 5e6 + 1.0 / 3, 7, 0.3, -0.7, 0.9996};
  g.true_north_rad = 0.1;
  const auto file = scratch() / "a.glb";
  throughGlb(e, g, file);
  const auto model = import(file);
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_EQ(model->georeference.shift_m, g.shift_m);
  EXPECT_EQ(model->georeference.crs, g.crs);
  EXPECT_EQ(model->georeference.map_from_file->northings_m, g.map_from_file->northings_m);
  EXPECT_EQ(model->georeference.true_north_rad, g.true_north_rad);
  EXPECT_EQ(triangleCount(model->environment), triangleCount(e));
  const auto a = bounds(e), b = bounds(model->environment);
  EXPECT_LT((a.min - b.min).norm() + (a.max - b.max).norm(), 1e-6);  // of a box of 1000 km
  EXPECT_EQ(model->environment.products.at(0).name, "wall");
  const auto moved = import(file, {.shift = ShiftMode::none});
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->georeference.shift_m, Eigen::Vector3d::Zero());
  EXPECT_LT((bounds(moved->environment).min - b.min - g.shift_m).norm(), 1e-6);
}

// Every corner of every placed triangle with its product's name, in the world.
std::vector<std::pair<std::string, Eigen::Vector3d>> corners(const Environment& e) {
  std::vector<std::pair<std::string, Eigen::Vector3d>> result;
  for (const auto& i : e.instances)
    for (const auto& t : e.meshes[i.mesh]->triangles)
      for (const auto corner : t)
        result.emplace_back(e.products[i.product].name,
                            i.world_from_mesh * e.meshes[i.mesh]->positions[corner].cast<double>());
  return result;
}

TEST(GltfExport, ComesBackByImportWithProductsPropertiesAndImages) {
  auto e = everything();
  Product& p = e.products[0];
  p = {"#12",
       "2O2Fr$t4X7Zf8NOew3FLOH",
       "IfcWall",
       "SOLIDWALL",
       "Wand \"1\"",
       "WT",
       "EG",
       -1,
       -1,
       true,
       {"Brick", "Plaster"},
       {{"Plaster", 0.015}},
       {"IfcZone A"},
       {{"Pset_WallCommon", "FireRating", "F90"}, {"Pset_WallCommon", "FireRating", "twice"}, {"", "x", "1"}}};
  Georeference g;
  g.shift_m = {4e6, 5e6, 100};
  g.crs = "EPSG:25832";
  for (const char* name : {"a b\xC3\xA4.gltf", "a.glb"}) {
    const auto file = scratch() / name;
    Progress progress;
    ASSERT_TRUE(exportEnvironmentGltf(e, g, file, progress));
    const auto model = import(file);
    ASSERT_TRUE(model) << describe(model.error());
    const auto& back = model->environment;
    EXPECT_EQ(back.surfaces, e.surfaces);
    ASSERT_EQ(back.images.size(), e.images.size());
    for (std::size_t i = 0; i < e.images.size(); ++i) EXPECT_EQ(back.images[i]->bytes, e.images[i]->bytes);
    const auto a = corners(e), b = corners(back);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].first, b[i].first);
      EXPECT_LT((a[i].second - b[i].second).norm(), 1e-9 * (1 + a[i].second.norm()));
    }
    EXPECT_EQ(back.instances.size(), e.instances.size() - 1);  // the empty mesh is nowhere
    EXPECT_EQ(back.meshes.size(), e.meshes.size() - 1);
    const auto& wall = back.products.at(0);
    EXPECT_EQ(wall.global_id, p.global_id);
    EXPECT_EQ(wall.ifc_class, "IfcWall");
    EXPECT_EQ(wall.predefined_type + wall.type_name + wall.storey, "SOLIDWALLWTEG");
    EXPECT_EQ(wall.materials, p.materials);
    EXPECT_EQ(wall.groups, p.groups);
    EXPECT_EQ(wall.layers.at(0).thickness_m, 0.015);
    ASSERT_EQ(wall.properties.size(), 3U);
    EXPECT_EQ(wall.properties[1].set + wall.properties[1].name + wall.properties[1].value,
              "Pset_WallCommonFireRatingtwice");
    EXPECT_EQ(model->georeference.shift_m, g.shift_m);
    EXPECT_EQ(model->georeference.crs, g.crs);
  }
}

// BLAINDER takes the property categoryID of an object for the class of its points.
TEST(GltfExport, NodesHaveTheirClassAsCategoryIdWhichComesBackOnce) {
  auto e = everything();
  e.products[0].ifc_class = "IfcWall";
  const auto classOf = [](const std::filesystem::path& file) {
    const auto gltf = nlohmann::json::parse(readBytes(file));
    for (const auto& node : gltf.at("nodes"))
      if (node.contains("extras") && node.at("extras").contains("categoryID"))
        return node.at("extras").at("categoryID").get<std::string>();
    return std::string();
  };
  Progress progress;
  const auto first = scratch() / "first.gltf", second = scratch() / "second.gltf";
  ASSERT_TRUE(exportEnvironmentGltf(e, {}, first, progress));
  EXPECT_EQ(classOf(first), "IfcWall");
  const auto back = import(first);
  ASSERT_TRUE(back) << describe(back.error());
  EXPECT_EQ(back->environment.products.at(0).ifc_class, "IfcWall");
  EXPECT_EQ(back->environment.products.at(0).properties.size(), e.products[0].properties.size());
  ASSERT_TRUE(exportEnvironmentGltf(back->environment, {}, second, progress));
  EXPECT_EQ(classOf(second), "IfcWall");
  e.products[0].ifc_class.clear();
  ASSERT_TRUE(exportEnvironmentGltf(e, {}, first, progress));
  EXPECT_EQ(classOf(first), "") << "BLAINDER falls back on the object's name";
}

TEST(GltfWriter, ProgressCancelStopsTheWriting) {
  Progress progress;
  progress.cancel();
  const auto written = testing::putGlb(everything(), {}, scratch() / "a.glb", progress);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().kind, ErrorKind::cancelled);
}

TEST(GltfWriter, FolderThatDoesNotExistIsAFileSystemError) {
  Progress progress;
  const auto written = testing::putGlb(everything(), {}, scratch() / "no/such/a.glb", progress);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().kind, ErrorKind::file_system);
}

TEST(GltfReader, ForeignGlbIsNotAnEnvironmentOfOurs) {
  Progress progress;
  const auto file = write(scratch() / "a.glb", glb(R"({"asset":{"version":"2.0"}})", ""));
  const auto back = readEnvironmentGlb(file, progress);
  ASSERT_FALSE(back);
  EXPECT_THAT(describe(back.error()), ::testing::HasSubstr("/asset/extras/standpoint/meshes"));
}

}  // namespace
}  // namespace standpoint::test
