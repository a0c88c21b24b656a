// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>
#include <set>
#include <unistd.h>

#include <gtest/gtest.h>

#include "editor/clouds/cloud_loader.h"
#include "editor/points/cloud_nodes.h"
#include "editor/points/node_choice.h"
#include "editor/points/splatter.h"
#include "pointclouds/octree/octree_builder.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

constexpr int kWidth = 160, kHeight = 90;

// As OpenGL's, looking along -Z from 10 m away.
Eigen::Matrix4d lens() {
  constexpr double kNear = 1, kFar = 30, kScale = 2;
  Eigen::Matrix4d m = Eigen::Matrix4d::Zero(), back = Eigen::Matrix4d::Identity();
  m(0, 0) = kScale * kHeight / kWidth;
  m(1, 1) = kScale;
  m(2, 2) = (kFar + kNear) / (kNear - kFar);
  m(2, 3) = 2 * kFar * kNear / (kNear - kFar);
  m(3, 2) = -1;
  back(2, 3) = -10;
  return m * back;
}

PackedPoints scattered(std::size_t count) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> place(-12, 12);
  PackedPoints points;
  for (std::size_t i = 0; i < count; ++i) {
    points.x_m.push_back(place(random));
    points.y_m.push_back(place(random));
    points.z_m.push_back(place(random));
    points.colours.push_back(0xff000000U | random() % 0x1000000U);
  }
  return points;
}

PointRun allOf(const PackedPoints& points, int size_px = 1) {
  PointRun run;
  run.points = &points;
  run.count = points.size();
  run.clip_from_points = lens();
  run.size_px = size_px;
  return run;
}

// In double, a point after the other, as the formula is in any textbook.
PointPicture byHand(const PackedPoints& points, int size_px, double least_z_m) {
  PointPicture picture{kWidth, kHeight, std::vector<std::uint32_t>(kWidth * kHeight, 0),
                       std::vector<float>(kWidth * kHeight, 1)};
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points.z_m[i] < least_z_m) continue;
    const Eigen::Vector4d clip = lens() * Eigen::Vector4d(points.x_m[i], points.y_m[i], points.z_m[i], 1);
    if (clip.w() <= 0 || clip.head<3>().cwiseAbs().maxCoeff() > clip.w()) continue;
    const double x = (clip.x() / clip.w() + 1) / 2 * kWidth - 0.5 * (size_px - 1);
    const double y = (clip.y() / clip.w() + 1) / 2 * kHeight - 0.5 * (size_px - 1);
    const auto depth = static_cast<float>((clip.z() / clip.w() + 1) / 2);
    for (int row = std::max(0, static_cast<int>(y));
         row < std::min(kHeight, std::max(0, static_cast<int>(y)) + size_px); ++row)
      for (int column = std::max(0, static_cast<int>(x));
           column < std::min(kWidth, std::max(0, static_cast<int>(x)) + size_px); ++column) {
        const auto at = static_cast<std::size_t>(row * kWidth + column);
        if (depth >= picture.depths[at]) continue;
        picture.depths[at] = depth;
        picture.colours[at] = points.colours[i];
      }
  }
  return picture;
}

std::size_t differing(const PointPicture& a, const PointPicture& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.colours.size(); ++i)
    count += a.colours[i] != b.colours[i] || std::abs(a.depths[i] - b.depths[i]) > 1e-5F ? 1 : 0;
  return count;
}

TEST(Splatter, DrawsWhatOneByOneGives) {
  const auto points = scattered(20000);
  for (const int size : {1, 2, 3, 8}) {
    Splatter splatter;
    splatter.begin(kWidth, kHeight);
    splatter.draw(std::vector{allOf(points, size)});
    const auto hand = byHand(points, size, -100);
    EXPECT_GT(std::count_if(hand.depths.begin(), hand.depths.end(), [](float d) { return d < 1; }), 2000);
    EXPECT_LE(differing(splatter.picture(), hand), 5U) << size << " pixels: only where a float falls beside the border";
  }
}

TEST(Splatter, LeavesOutWhatIsCutAway) {
  const auto points = scattered(20000);
  auto run = allOf(points, 2);
  run.kept_sides.emplace_back(0, 0, 1, -2);
  Splatter splatter;
  splatter.begin(kWidth, kHeight);
  splatter.draw(std::vector{run});
  EXPECT_LE(differing(splatter.picture(), byHand(points, 2, 2)), 5U);
}

TEST(Splatter, GivesTheSamePictureInPartsAndInAnyOrder) {
  const auto points = scattered(100000);
  Splatter whole, parts;
  whole.begin(kWidth, kHeight);
  whole.draw(std::vector{allOf(points)});
  parts.begin(kWidth, kHeight);
  for (std::size_t at = 100000; at > 0; at -= 20000) {
    auto run = allOf(points);
    run.first = at - 20000;
    run.count = 20000;
    parts.draw(std::vector{run});
    parts.picture();
  }
  EXPECT_EQ(whole.picture().colours, parts.picture().colours);
  EXPECT_EQ(whole.picture().depths, parts.picture().depths);
}

TEST(Splatter, TakesPlacesThatAreNoneAndPicturesOfNothing) {
  auto points = scattered(100);
  points.x_m[0] = NAN;
  points.y_m[1] = INFINITY;
  points.z_m[2] = 10;  // in the eye
  points.x_m[3] = 1e38F;
  Splatter splatter;
  splatter.begin(0, 0);
  splatter.draw(std::vector{allOf(points, 8)});
  EXPECT_EQ(splatter.picture().colours.size(), 1U);
}

TEST(EyeDomeLighting, DarkensWhatLiesBehindItsNeighbours) {
  PointPicture picture{4, 1, {0xff808080U, 0xff808080U, 0xff808080U, 0}, {0.5F, 0.9F, 0.9F, 1}};
  shadeByDepth(picture, {1, 10, true});
  EXPECT_EQ(picture.colours[0], 0xff808080U) << "in front";
  EXPECT_LT(picture.colours[1] & 255U, 0x60U) << "behind its left neighbour";
  EXPECT_EQ(picture.colours[2], 0xff808080U) << "what is empty throws no shadow";
  EXPECT_EQ(picture.colours[3], 0U);
}

// A root, its eight children, and eight of each.
std::vector<OctreeNode> threeLevels() {
  std::vector<OctreeNode> nodes(1);
  nodes[0].size_m = 16;
  for (std::size_t i = 0; i < nodes.size() && nodes.size() < 73; ++i) {
    nodes[i].first_child = static_cast<std::uint32_t>(nodes.size());
    nodes[i].children = 8;
    for (unsigned octant = 0; octant < 8; ++octant) {
      OctreeNode child;
      child.size_m = nodes[i].size_m / 2;
      child.min_m = nodes[i].min_m + child.size_m * Eigen::Vector3d(octant & 1U, octant >> 1 & 1U, octant >> 2 & 1U);
      child.level = static_cast<std::uint8_t>(nodes[i].level + 1);
      nodes.push_back(child);
    }
  }
  for (auto& n : nodes) n.points = 1000;
  return nodes;
}

NodeView fromAbove(double pixels) {
  NodeView view;
  view.eye_m = {8, 8, 40};
  view.pixels = pixels;
  view.clip_from_cloud = Eigen::Matrix4d::Identity() / 100;  // all of it is in sight
  view.clip_from_cloud(3, 3) = 1;
  return view;
}

TEST(NodeChoice, KeepsToItsBudgetAndNeverSkipsAParent) {
  const auto nodes = threeLevels();
  std::vector<std::uint32_t> parent(nodes.size(), 0);
  for (std::uint32_t i = 0; i < nodes.size(); ++i)
    for (std::uint32_t c = nodes[i].first_child; c < nodes[i].first_child + nodes[i].children; ++c) parent[c] = i;
  for (std::uint64_t most = 0; most <= 74000; most += 500) {
    const auto choice = chooseNodes(nodes, fromAbove(1e6), most);
    EXPECT_LE(choice.points, std::max<std::uint64_t>(most, 1000)) << "never blank";
    EXPECT_EQ(choice.all, most >= 73000);
    std::set<std::uint32_t> chosen;
    for (const auto n : choice.nodes) {
      EXPECT_TRUE(n == 0 || chosen.contains(parent[n])) << "node " << n << " of " << most;
      EXPECT_TRUE(chosen.insert(n).second);
    }
  }
}

TEST(NodeChoice, EndsWherePointsCanNoLongerBeToldApart) {
  // Seen from 40 m the cube of 16 m has its points 16 / 128 m apart.
  EXPECT_EQ(chooseNodes(threeLevels(), fromAbove(1), 1000000).nodes.size(), 1U);
  EXPECT_EQ(chooseNodes(threeLevels(), fromAbove(1e6), 1000000).nodes.size(), 73U);
}

TEST(NodeChoice, LeavesOutWhatIsNotInSight) {
  auto view = fromAbove(1e6);
  view.clip_from_cloud(0, 0) = 1 / 0.5;  // |x| <= 0.5 m is seen
  const auto nodes = threeLevels();
  const auto choice = chooseNodes(nodes, view, 1000000);
  EXPECT_LT(choice.nodes.size(), 73U);
  for (const auto n : choice.nodes) EXPECT_LE(nodes[n].min_m.x(), 4) << "as far as its sphere reaches";
}

class CloudFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    std::ofstream out(file);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> place(0, 10);
    for (int i = 0; i < kPoints; ++i)
      out << place(random) + 100 << ' ' << place(random) << ' ' << place(random) / 100 << ' ' << i % 200 << '\n';
  }
  void TearDown() override { std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all); }
  Result<Cloud> open(PointSink* preview = nullptr) { return openCloud(file, {100, 0, 0}, 1000, preview, progress); }

  static constexpr int kPoints = 60000;
  TemporaryFolder folder;
  std::filesystem::path file = folder / "cloud.xyz";
  std::filesystem::path octree = folder / "cloud.xyz.octree";
  Progress progress;
};

std::uint64_t readAll(const Cloud& cloud) {
  CloudNodes nodes(cloud.octree, ownPaint(cloud.colouring), 1 << 30);
  std::vector<std::uint32_t> all(cloud.octree->nodes().size());
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  nodes.want(all);
  while (nodes.reading()) nodes.waitForNews(1);
  std::uint64_t points = 0;
  for (const auto& n : nodes.want(all)) points += n ? n->size() : 0;
  return points;
}

TEST_F(CloudFiles, OfManyPointsAreShownByAnOctreeThatIsMadeOnce) {
  const auto first = open();
  ASSERT_TRUE(first) << describe(first.error());
  ASSERT_TRUE(first->octree);
  EXPECT_EQ(first->points_in_file, static_cast<std::uint64_t>(kPoints));
  EXPECT_EQ(readAll(*first), static_cast<std::uint64_t>(kPoints));
  for (const auto& p : first->points) {  // its octree is in the frame of the file
    const Eigen::Vector3d place = first->pointsOrigin_m() + Eigen::Vector3f(p.position_m.data()).cast<double>();
    ASSERT_TRUE(place.x() > -1e-3 && place.x() < 10.001) << place.transpose();
  }
  EXPECT_FALSE(first->points.empty()) << "the coarsest ones";
  const Eigen::Vector3d place = first->header.origin_m - first->shift_m;
  EXPECT_NEAR(place.x() + static_cast<double>(first->points.front().position_m[0]), 5, 5.01)
      << "led to the local frame";
  const auto made = std::filesystem::last_write_time(octree);
  ASSERT_TRUE(open());
  EXPECT_EQ(std::filesystem::last_write_time(octree), made);
  std::ofstream(file, std::ios::app) << "1 2 3 4\n";
  const auto again = open();
  ASSERT_TRUE(again) << describe(again.error());
  EXPECT_EQ(again->points_in_file, static_cast<std::uint64_t>(kPoints) + 1) << "made anew for another file";
}

TEST_F(CloudFiles, AreMovedWhenTheirNodesAreRead) {
  const auto cloud = open();
  ASSERT_TRUE(cloud) << describe(cloud.error());
  Pose aside;
  aside.translation = {0.25, 0, 0};
  const auto other = moved(*cloud, {aside});
  const std::vector<std::uint32_t> root = {0};
  const auto rootOf = [&](CloudNodes& nodes) {
    nodes.want(root);
    while (nodes.reading()) nodes.waitForNews(1);
    return nodes.want(root).front();
  };
  CloudNodes as_made(cloud->octree, ownPaint(cloud->colouring), 1 << 30);
  CloudNodes as_moved(cloud->octree, ownPaint(cloud->colouring), 1 << 30, [&](std::span<CloudPoint> points) {
    move(points, other.header.origin_m - other.shift_m, other.moves);
  });
  const auto before = rootOf(as_made), after = rootOf(as_moved);
  ASSERT_TRUE(before && after);
  ASSERT_EQ(before->size(), after->size());
  for (std::size_t i = 0; i < before->size(); ++i) {
    ASSERT_NEAR(after->x_m[i], before->x_m[i] + 0.25F, 1e-4F);
    ASSERT_NEAR(after->y_m[i], before->y_m[i], 1e-4F);
  }
  EXPECT_FLOAT_EQ(other.points.front().position_m[0], cloud->points.front().position_m[0] + 0.25F);
}

TEST_F(CloudFiles, AreShownTogether) {
  std::ofstream(folder / "few.xyz") << "101 0 0 1\n102 0 0 1\n";
  const std::vector<std::filesystem::path> files = {file, folder / "few.xyz"};
  const auto points = pointsIn(files);
  ASSERT_TRUE(points) << describe(points.error());
  const auto both = sampleCloud(files, *points, {100, 0, 0}, 100000, progress);
  ASSERT_TRUE(both) << describe(both.error());
  EXPECT_EQ(both->files, files);
  EXPECT_EQ(both->points.size(), static_cast<std::size_t>(kPoints) + 2);
  EXPECT_EQ(both->header.stations.size(), 2U);
  EXPECT_FLOAT_EQ(both->points.back().position_m[0], 2.0F);
  const std::vector<std::filesystem::path> lost = {file, folder / "gone.xyz"};
  EXPECT_FALSE(pointsIn(lost));
  EXPECT_FALSE(sampleCloud(lost, *points, {100, 0, 0}, 100000, progress));
}

TEST_F(CloudFiles, OfFewPointsNeedNoOctree) {
  const auto cloud = openCloud(file, {100, 0, 0}, 1000000, nullptr, progress);
  ASSERT_TRUE(cloud);
  EXPECT_FALSE(cloud->octree);
  EXPECT_EQ(cloud->points.size(), static_cast<std::size_t>(kPoints));
  EXPECT_FALSE(std::filesystem::exists(octree));
}

TEST_F(CloudFiles, WithADamagedOctreeGetAnotherOne) {
  ASSERT_TRUE(open());
  std::filesystem::resize_file(octree, std::filesystem::file_size(octree) / 2);
  const auto again = open();
  ASSERT_TRUE(again) << describe(again.error());
  EXPECT_EQ(readAll(*again), static_cast<std::uint64_t>(kPoints));
}

TEST_F(CloudFiles, InAFolderThatCannotBeWrittenToHaveTheirOctreeInTheCache) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const auto cache = folder / "cache";
  ::setenv("XDG_CACHE_HOME", cache.c_str(), 1);
  std::filesystem::create_directories(cache);
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  const auto cloud = open();
  ::unsetenv("XDG_CACHE_HOME");
  ASSERT_TRUE(cloud) << describe(cloud.error());
  EXPECT_FALSE(std::filesystem::exists(octree));
  EXPECT_FALSE(std::filesystem::is_empty(cache / "standpoint" / "octrees"));
}

TEST_F(CloudFiles, ArePreviewedWhileTheirOctreeIsMade) {
  LiveCloud preview({100, 0, 0}, {});
  ASSERT_TRUE(open(&preview));
  const auto seen = preview.newer(true);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->points_in_file, static_cast<std::uint64_t>(kPoints));
}

TEST_F(CloudFiles, ThatVanishKeepWhatIsInMemory) {
  const auto cloud = open();
  ASSERT_TRUE(cloud);
  CloudNodes nodes(cloud->octree, ownPaint(cloud->colouring), 1 << 30);
  const std::vector<std::uint32_t> root = {0}, both = {0, 1};
  nodes.want(root);
  while (nodes.reading()) nodes.waitForNews(1);
  ASSERT_EQ(nodes.trouble(), "");
  std::filesystem::resize_file(octree, 100);  // as a disk that has gone: nothing more can be read
  nodes.want(both);
  while (nodes.reading()) nodes.waitForNews(1);
  EXPECT_NE(nodes.trouble().find("node 1"), std::string::npos) << nodes.trouble();
  const auto there = nodes.want(both);
  EXPECT_TRUE(there[0]) << "stays";
  EXPECT_FALSE(there[1]);
  EXPECT_FALSE(nodes.reading()) << "is not tried again and again";
}

TEST_F(CloudFiles, TakeNoMoreMemoryThanTheyMay) {
  const auto cloud = open();
  ASSERT_TRUE(cloud);
  const auto& all = cloud->octree->nodes();
  ASSERT_GT(all.size(), 4U);
  CloudNodes nodes(cloud->octree, ownPaint(cloud->colouring), 16 * (std::uint64_t{all[0].points} + all[1].points));
  for (std::uint32_t n = 1; n < 5; ++n) {
    const std::vector<std::uint32_t> wanted = {0, n};
    nodes.want(wanted);
    while (nodes.reading()) nodes.waitForNews(1);
    EXPECT_TRUE(nodes.want(wanted)[0]) << "what is wanted does not go";
  }
  const std::vector<std::uint32_t> every = {0, 1, 2, 3, 4};
  std::uint64_t bytes = 0;
  for (const auto& n : nodes.want(every)) bytes += n ? n->bytes() : 0;
  EXPECT_LE(bytes, 16 * (std::uint64_t{all[0].points} + all[1].points));
}

}  // namespace
}  // namespace standpoint
