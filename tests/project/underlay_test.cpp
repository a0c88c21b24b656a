// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include <gmock/gmock.h>

#include "project/storage/project_files.h"
#include "project/survey/underlays.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

// Two points, one metre apart in each axis from `at`.
fs::path cloudFile(const fs::path& file, const Eigen::Vector3d& at) {
  std::ofstream out(file);
  out.precision(17);
  out << at.x() << ' ' << at.y() << ' ' << at.z() << '\n'
      << at.x() + 1 << ' ' << at.y() + 1 << ' ' << at.z() + 1 << '\n';
  return file;
}

// A model whose X axis points to the map's north, 50 m above the map's zero.
Document turnedDocument() {
  Document d = twoStoreyDocument();
  Georeference g = *d.georeference;
  g.map_from_file = MapConversion{0, 0, 50, 0, 1, 1};
  g.crs = "EPSG:25832";
  d.georeference = std::make_shared<const Georeference>(g);
  return d;
}

TEST(Underlay, InTheModelsOwnCoordinatesStaysWhereItIs) {
  const TemporaryFolder folder;
  const auto file = cloudFile(folder.path() / "a.xyz", {500001, 5600002, 1});
  const auto done = run("underlay", twoStoreyDocument(), {{"add", file.string()}});
  ASSERT_TRUE(done) << describe(done.error());
  ASSERT_EQ(done->document.underlays.size(), 1u);
  const Underlay& u = *done->document.underlays[0];
  EXPECT_EQ(u.name, "a");
  EXPECT_EQ(u.points, 2u);
  EXPECT_EQ(u.bounds_cloud_m.min, Eigen::Vector3d(500001, 5600002, 1));
  EXPECT_EQ(u.bounds_cloud_m.max, Eigen::Vector3d(500002, 5600003, 2));
  EXPECT_TRUE(u.file_from_cloud.translation.isZero());
  EXPECT_THAT(said(done->report), HasSubstr("by its coordinates"));
}

TEST(Underlay, InMapCoordinatesIsPlacedByTheModelsMapConversion) {
  const TemporaryFolder folder;
  // x east, y north of the model's (500001, 5600002, 1) and (500002, 5600001, 2).
  const auto file = cloudFile(folder.path() / "utm.xyz", {-5600002, 500001, 51});
  const auto done = run("underlay", turnedDocument(), {{"add", file.string()}});
  ASSERT_TRUE(done) << describe(done.error());
  const Bounds b = boundsInFile(*done->document.underlays[0]);
  EXPECT_LT((b.min - Eigen::Vector3d(500001, 5600001, 1)).norm(), 1e-6);
  EXPECT_LT((b.max - Eigen::Vector3d(500002, 5600002, 2)).norm(), 1e-6);
  EXPECT_THAT(said(done->report), HasSubstr("placed using the model's map conversion"));
}

TEST(Underlay, FarFromTheModelIsAFindingWithARemedy) {
  const TemporaryFolder folder;
  const auto file = cloudFile(folder.path() / "far.xyz", {0, 0, 0});
  const auto done = run("underlay", twoStoreyDocument(), {{"add", file.string()}});
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_THAT(said(done->report), HasSubstr("km from the model: specify its origin"));
  const auto placed = run("underlay", twoStoreyDocument(), {{"add", file.string()}, {"at", {500000, 5600000, 0}}});
  ASSERT_TRUE(placed) << describe(placed.error());
  EXPECT_THAT(said(placed->report), ::testing::Not(HasSubstr("km from")));
  EXPECT_EQ(boundsInFile(*placed->document.underlays[0]).max, Eigen::Vector3d(500001, 5600001, 1));
}

TEST(Underlay, IsMovedTurnedHiddenAndRemovedByName) {
  const TemporaryFolder folder;
  const auto file = cloudFile(folder.path() / "a.xyz", {1, 0, 0});
  auto document = run("underlay", twoStoreyDocument(), {{"add", file.string()}, {"name", "scan"}})->document;
  const auto moved = run("underlay", document, {{"move", "scan"}, {"at", {10, 20, 30}}, {"yaw-deg", 90}});
  ASSERT_TRUE(moved) << describe(moved.error());
  const Bounds b = boundsInFile(*moved->document.underlays[0]);
  EXPECT_LT((b.min - Eigen::Vector3d(9, 21, 30)).norm(), 1e-12);
  EXPECT_EQ(document.underlays[0]->file_from_cloud.translation.x(), 0) << "a verb changes no document";
  const auto renamed = run("underlay", moved->document, {{"rename", "scan"}, {"name", "hall"}});
  ASSERT_TRUE(renamed) << describe(renamed.error());
  EXPECT_EQ(renamed->document.underlays[0]->name, "hall");
  EXPECT_FALSE(run("underlay", moved->document, {{"rename", "scan"}, {"name", ""}}));
  const auto hidden = run("underlay", moved->document, {{"hide", "scan"}});
  ASSERT_TRUE(hidden) << describe(hidden.error());
  EXPECT_FALSE(hidden->document.underlays[0]->visible);
  EXPECT_TRUE(run("underlay", hidden->document, {{"remove", "scan"}})->document.underlays.empty());
  const auto unknown = run("underlay", document, {{"remove", "sacn"}});
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().message, HasSubstr("available: scan"));
  EXPECT_FALSE(run("underlay", document, {{"hide", "scan"}, {"show", "scan"}}));
}

TEST(Underlay, OfTheSameNameGetsANumber) {
  const TemporaryFolder folder;
  const auto file = cloudFile(folder.path() / "a.xyz", {500000, 5600000, 0});
  auto document = run("underlay", twoStoreyDocument(), {{"add", file.string()}})->document;
  document = run("underlay", document, {{"add", file.string()}})->document;
  EXPECT_EQ(document.underlays.at(1)->name, "a-2");
}

TEST(Underlay, ComesBackFromTheDiskAndMovesWithItsProject) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "here");
  const auto file = cloudFile(folder.path() / "here" / "a.xyz", {500000, 5600000, 0});
  const auto document = run("underlay", twoStoreyDocument(), {{"add", file.string()}, {"yaw-deg", 30}})->document;
  Progress progress;
  ASSERT_TRUE(saveProject(document, folder.path() / "here" / "p", progress));
  fs::rename(folder.path() / "here", folder.path() / "there");
  const auto back = loadProject(folder.path() / "there" / "p", progress);
  ASSERT_TRUE(back) << describe(back.error());
  ASSERT_EQ(back->underlays.size(), 1u);
  const Underlay &a = *document.underlays[0], &b = *back->underlays[0];
  EXPECT_EQ(b.file, (folder.path() / "there" / "a.xyz").string());
  EXPECT_EQ(a.bounds_cloud_m.max, b.bounds_cloud_m.max);
  EXPECT_EQ(a.file_from_cloud.rotation.coeffs(), b.file_from_cloud.rotation.coeffs());
  EXPECT_EQ(a.points, b.points);
}

TEST(Underlay, IsNoPartOfAProjectThatHasNone) {
  const TemporaryFolder folder;
  Progress progress;
  ASSERT_TRUE(saveProject(twoStoreyDocument(), folder.path() / "p", progress));
  std::ifstream in(folder.path() / "p" / "project.json");
  const json project = json::parse(in);
  EXPECT_FALSE(project.contains("underlays")) << "older programs wrote none, and this one reads them";
  EXPECT_TRUE(loadProject(folder.path() / "p", progress)->underlays.empty());
}

TEST(Underlay, StaysUnderAChangedModel) {
  const TemporaryFolder folder;
  const auto model = (folder.path() / "m.obj").string();
  std::ofstream(model) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const auto file = cloudFile(folder.path() / "a.xyz", {0, 0, 0});
  auto document = run("import", {}, {{"files", {model}}})->document;
  document = run("underlay", document, {{"add", file.string()}})->document;
  ASSERT_EQ(document.underlays.size(), 1u);
  const auto updated = run("import", document, {{"files", {model}}, {"update", true}});
  ASSERT_TRUE(updated) << describe(updated.error());
  EXPECT_EQ(updated->document.underlays, document.underlays);
}

TEST(Underlay, WithoutPointsOrFileIsRefused) {
  const TemporaryFolder folder;
  EXPECT_EQ(run("underlay", twoStoreyDocument(), {{"add", (folder.path() / "no.e57").string()}}).error().kind,
            ErrorKind::file_system);
  std::ofstream(folder.path() / "empty.ply")
      << "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
         "property float z\nend_header\n";
  EXPECT_THAT(run("underlay", twoStoreyDocument(), {{"add", (folder.path() / "empty.ply").string()}}).error().message,
              HasSubstr("is empty"));
}

}  // namespace
}  // namespace standpoint
