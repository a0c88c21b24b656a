// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <random>
#include <set>
#include <sys/resource.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "pointclouds/e57/crc32c.h"
#include "pointclouds/octree/octree_builder.h"
#include "pointclouds/octree/octree_file.h"
#include "pointclouds/octree/octree_grid.h"
#include "pointclouds/octree/octree_layout.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

constexpr OctreeKey kKey{1234, 5678};
using Places = std::vector<std::array<float, 3>>;

class OctreeTest : public ::testing::Test {
 protected:
  TemporaryFolder folder;
  std::filesystem::path file = folder / "cloud.octree";
  Progress progress;

  // Each point's time is its number.
  static CloudSource sourceOf(const Places& places, bool backwards = false) {
    return [&places, backwards](PointSink& sink, Progress&) -> Result<void> {
      ScanHeader scan;
      scan.name = "S1";
      scan.has_time = true;
      scan.file_from_scanner.translation = {1000, 2000, 3};
      TRY(sink.begin(scan));
      for (std::size_t at = 0; at < places.size(); at += 1000) {
        PointBlock block;
        for (std::size_t k = at; k < std::min(places.size(), at + 1000); ++k) {
          const std::size_t i = backwards ? places.size() - 1 - k : k;
          block.x_m.push_back(places[i][0]);
          block.y_m.push_back(places[i][1]);
          block.z_m.push_back(places[i][2]);
          block.intensity.push_back(0.5F);
          block.time_s.push_back(static_cast<double>(i));
        }
        TRY(sink.write(block));
      }
      return sink.end();
    };
  }
  Result<OctreeBuilt> build(const Places& places, int threads = 0, std::size_t at_once = 30000) {
    return buildOctree(sourceOf(places), kKey, file, {at_once, threads, nullptr}, progress);
  }
  std::string bytes() const {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::string& content) const { std::ofstream(file, std::ios::binary) << content; }
  std::size_t filesInFolder() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder.path()), {}));
  }
  // What a viewer sees: opens and reads all; the first trouble.
  Result<void> readAll() const {
    TRY_ASSIGN(const auto octree, OctreeFile::open(file, kKey));
    for (std::size_t i = 0; i < octree->nodes().size(); ++i) TRY(octree->read(i));
    return {};
  }
};

// The floor and a wall of a room, densest near the corner, as a scanner leaves them.
Places room(std::size_t points) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> even(0, 1);
  Places places;
  for (std::size_t i = 0; i < points; ++i) {
    const float a = even(random), b = even(random), x = 12 * a * a * a - 3, y = 9 * b * b - 4;
    places.push_back(i % 3 == 0 ? std::array{x, -4.0F, y + 4} : std::array{x, y, 0.0F});
  }
  return places;
}

TEST_F(OctreeTest, HoldsEveryPointOnce) {
  const auto places = room(100000);
  const auto built = build(places);
  ASSERT_TRUE(built) << describe(built.error());
  EXPECT_EQ(built->points, places.size());
  EXPECT_GT(built->levels, 2);
  const auto octree = OctreeFile::open(file, kKey);
  ASSERT_TRUE(octree) << describe(octree.error());
  std::set<float> seen;
  for (std::size_t i = 0; i < (*octree)->nodes().size(); ++i) {
    const auto points = (*octree)->read(i);
    ASSERT_TRUE(points);
    const auto& node = (*octree)->nodes()[i];
    for (const auto& p : *points) {
      ASSERT_TRUE(seen.insert(p.time_s).second) << "point " << p.time_s << " twice";
      const auto& place = places[static_cast<std::size_t>(p.time_s)];
      for (int k = 0; k < 3; ++k) {
        const auto own = static_cast<std::size_t>(k);
        ASSERT_NEAR(node.min_m[k] + static_cast<double>(p.position_m[own]), place[own], 1e-6);
        ASSERT_GE(p.position_m[own], 0);
        ASSERT_LE(p.position_m[own], node.size_m) << "outside its node";
      }
    }
  }
  EXPECT_EQ(seen.size(), places.size());
  EXPECT_EQ((*octree)->header().stations.front().points, places.size());
  EXPECT_EQ((*octree)->header().origin_m, Eigen::Vector3d(1000, 2000, 3));
  EXPECT_NEAR((*octree)->bounds().max.x(), 9, 0.01);
}

// Less from a border between nodes than the difference of two places can say.
TEST_F(OctreeTest, ReadsBackPointsNextToNothingBesideABorder) {
  auto places = room(100000);
  places.push_back({-4, -4, 0});  // then borders are at 4 and at 0
  for (int i = 0; i < 500; ++i) places.push_back({-2e-17F, 0.01F * static_cast<float>(i) - 4, -3e-17F});
  ASSERT_TRUE(build(places, 0, 1000000));
  const auto read = readAll();
  EXPECT_TRUE(read) << describe(read.error());
}

TEST_F(OctreeTest, HasTheSameBytesOnAnyNumberOfThreadsAndInAnyOrderOfThePoints) {
  const auto places = room(60000);
  ASSERT_TRUE(build(places, 1));
  const auto once = bytes();
  ASSERT_TRUE(build(places, 4));
  EXPECT_EQ(bytes() == once, true);
  ASSERT_TRUE(buildOctree(sourceOf(places, true), kKey, file, {30000, 3, nullptr}, progress));
  EXPECT_EQ(bytes() == once, true) << "read backwards";
}

// A coarse node is an even part: no two points of it share one of its cells.
TEST_F(OctreeTest, SpreadsThePointsOfDividedNodesEvenly) {
  const auto places = room(80000);
  ASSERT_TRUE(build(places));
  const auto octree = OctreeFile::open(file);
  ASSERT_TRUE(octree);
  int divided = 0;
  for (std::size_t i = 0; i < (*octree)->nodes().size(); ++i) {
    const auto& node = (*octree)->nodes()[i];
    if (node.children == 0) {
      EXPECT_LE(node.points, 30000U);
      continue;
    }
    ++divided;
    std::set<std::uint64_t> cells;
    const auto points = (*octree)->read(i);
    ASSERT_TRUE(points);
    for (const auto& p : *points) {
      const auto& place = places[static_cast<std::size_t>(p.time_s)];  // not rounded once more
      EXPECT_TRUE(cells.insert(octree::cellOf({node.min_m, node.size_m, 0}, place, 7)).second);
    }
  }
  EXPECT_GT(divided, 0);
}

TEST_F(OctreeTest, TakesOnePointFarAwayAndManyInOnePlace) {
  auto places = room(50000);
  places.push_back({3e6F, 0, 0});
  places.insert(places.end(), 40000, {1, 1, 1});
  places.push_back({NAN, 0, 0});
  const auto built = build(places);
  ASSERT_TRUE(built) << describe(built.error());
  EXPECT_EQ(built->points, places.size() - 1);
  EXPECT_EQ(built->left_out, 1U);
  EXPECT_TRUE(readAll());
}

TEST_F(OctreeTest, OfNoPointsIsAnEmptyNode) {
  ASSERT_TRUE(build({}));
  const auto octree = OctreeFile::open(file, kKey);
  ASSERT_TRUE(octree) << describe(octree.error());
  EXPECT_EQ((*octree)->points(), 0U);
  EXPECT_TRUE(readAll());
}

TEST_F(OctreeTest, IsRefusedWhenTheCloudHasChanged) {
  ASSERT_TRUE(build(room(1000)));
  const auto octree = OctreeFile::open(file, OctreeKey{1234, 5679});
  ASSERT_FALSE(octree);
  EXPECT_NE(octree.error().message.find("changed"), std::string::npos);
}

TEST_F(OctreeTest, IsRefusedWithItsPlaceWhenItEndsEarly) {
  ASSERT_TRUE(build(room(30000)));
  const auto whole = bytes();
  for (std::size_t i = 0; i < 40; ++i) {
    write(whole.substr(0, whole.size() * i / 40));
    const auto ok = readAll();
    ASSERT_FALSE(ok) << i;
    EXPECT_NE(ok.error().source.find("cloud.octree"), std::string::npos);
  }
}

TEST_F(OctreeTest, IsRefusedWhereverAByteIsAnother) {
  ASSERT_TRUE(build(room(30000)));
  const auto whole = bytes();
  std::mt19937 random(3);
  std::vector<std::size_t> at;
  for (std::size_t i = 0; i < 252; ++i) at.push_back(i);  // the head; its last four bytes mean nothing
  for (std::size_t i = 0; i < 60; ++i) at.push_back(256 + random() % (whole.size() - 256));
  for (std::size_t i = 1; i < 400; i += 7) at.push_back(whole.size() - i);
  for (const auto i : at) {
    auto other = whole;
    other[i] = static_cast<char>(other[i] ^ (1 << random() % 8));
    write(other);
    EXPECT_FALSE(readAll()) << "byte " << i;
  }
}

// As a file of somebody else may be: every checksum holds.
TEST_F(OctreeTest, IsRefusedWhenAPointIsOfAScanThatThereIsNot) {
  ASSERT_TRUE(build(room(1000)));
  auto other = bytes();
  const auto nodes_at = [&] {
    octree::Head head;
    std::memcpy(&head, other.data(), sizeof head);
    return head.nodes_at;
  }();
  octree::TableNode node;
  std::memcpy(&node, other.data() + nodes_at, sizeof node);
  CloudPoint point;
  std::memcpy(&point, other.data() + node.offset, sizeof point);
  point.station = 7;
  std::memcpy(other.data() + node.offset, &point, sizeof point);
  const auto sum = [&](std::size_t at, std::size_t count) {
    return crc32c({reinterpret_cast<const std::uint8_t*>(other.data()) + at, count});
  };
  node.checksum = sum(node.offset, node.points * sizeof(CloudPoint));
  std::memcpy(other.data() + nodes_at, &node, sizeof node);
  octree::Head head;
  std::memcpy(&head, other.data(), sizeof head);
  head.nodes_checksum = sum(nodes_at, head.nodes * sizeof(octree::TableNode));
  std::memcpy(other.data(), &head, sizeof head);
  head.checksum = sum(0, offsetof(octree::Head, checksum));
  std::memcpy(other.data(), &head, sizeof head);
  write(other);
  const auto ok = readAll();
  ASSERT_FALSE(ok);
  EXPECT_NE(ok.error().source.find("node 0 point 0"), std::string::npos) << describe(ok.error());
}

TEST_F(OctreeTest, LeavesNothingWhenItIsCancelled) {
  progress.cancel();
  const auto built = build(room(30000));
  ASSERT_FALSE(built);
  EXPECT_EQ(built.error().kind, ErrorKind::cancelled);
  EXPECT_EQ(filesInFolder(), 0U);
}

// By the limit on the size of a file: the scratch file, or the octree itself.
TEST_F(OctreeTest, LeavesNothingOnAFullDisk) {
  std::signal(SIGXFSZ, SIG_IGN);
  for (const std::size_t points : {30000U, 500U}) {
    rlimit limit{};
    getrlimit(RLIMIT_FSIZE, &limit);
    const rlimit small{10000, limit.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    const auto built = build(room(points));
    setrlimit(RLIMIT_FSIZE, &limit);
    ASSERT_FALSE(built);
    EXPECT_EQ(built.error().kind, ErrorKind::file_system);
    EXPECT_EQ(filesInFolder(), 0U);
  }
}

// Killed in another process, once it makes levels (at 60 %) or before.
void buildUntil(double fraction, const char* where) {
  Progress progress;
  progress.onChange([&] {
    if (progress.fraction() >= fraction) _exit(7);
  });
  const auto places = room(100000);
  const CloudSource source = [&](PointSink& sink, Progress&) -> Result<void> {
    ScanHeader scan;
    scan.name = "S1";
    TRY(sink.begin(scan));
    PointBlock block;
    for (const auto& p : places) {
      block.x_m.push_back(p[0]);
      block.y_m.push_back(p[1]);
      block.z_m.push_back(p[2]);
      block.intensity.push_back(0.5F);
    }
    TRY(sink.write(block));
    return sink.end();
  };
  const std::filesystem::path file = where;
  (void)buildOctree(source, kKey, file, {30000, 1, nullptr}, progress);
  _exit(8);
}

TEST_F(OctreeTest, ThatIsKilledGoesOnWithThePointsThatItHasSorted) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  setenv("OCTREE_TEST_FILE", file.c_str(), 0);
  const std::filesystem::path where = std::getenv("OCTREE_TEST_FILE");
  const auto whole = where.parent_path() / "whole.octree";
  EXPECT_EXIT(buildUntil(2, whole.c_str()), testing::ExitedWithCode(8), "");
  EXPECT_EXIT(buildUntil(0.8, where.c_str()), testing::ExitedWithCode(7), "");
  EXPECT_FALSE(std::filesystem::exists(where));
  const auto hidden = where.parent_path() / ".cloud.octree.sorted";
  ASSERT_TRUE(std::filesystem::exists(hidden));
  int reads = 0;
  const CloudSource counted = [&](PointSink&, Progress&) -> Result<void> { return ++reads, Result<void>(); };
  const auto built = buildOctree(counted, kKey, where, {30000, 2, nullptr}, progress);
  ASSERT_TRUE(built) << describe(built.error());
  EXPECT_EQ(reads, 0) << "the cloud is not read again";
  EXPECT_EQ(built->points, 100000U);
  EXPECT_FALSE(std::filesystem::exists(hidden));
  const auto contentOf = [](const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(contentOf(where), contentOf(whole)) << "byte by byte";
  unsetenv("OCTREE_TEST_FILE");
}

TEST_F(OctreeTest, BeginsAnewWhereWhatWasLeftIsOfAnotherCloudOrDamaged) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  setenv("OCTREE_TEST_FILE", file.c_str(), 0);
  const std::filesystem::path where = std::getenv("OCTREE_TEST_FILE");
  const auto hidden = where.parent_path() / ".cloud.octree.sorted";
  const auto places = room(5000);
  const auto readsFor = [&](const OctreeKey& key) {
    int reads = 0;
    const CloudSource counted = [&](PointSink& sink, Progress& p) { return ++reads, sourceOf(places)(sink, p); };
    const auto built = buildOctree(counted, key, where, {30000, 1, nullptr}, progress);
    EXPECT_TRUE(built && built->points == places.size());
    return reads;
  };
  EXPECT_EXIT(buildUntil(0.8, where.c_str()), testing::ExitedWithCode(7), "");
  EXPECT_EQ(readsFor({1235, 5678}), 2) << "the cloud has changed";
  EXPECT_EXIT(buildUntil(0.3, where.c_str()), testing::ExitedWithCode(7), "");
  EXPECT_EQ(readsFor(kKey), 2) << "it was killed before all was sorted";
  EXPECT_EXIT(buildUntil(0.8, where.c_str()), testing::ExitedWithCode(7), "");
  std::string bytes;
  {
    std::ifstream in(hidden, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  }
  for (const std::size_t back : {20U, 60U, 200U, 2000U}) {
    auto wrong = bytes;
    wrong[wrong.size() - back] = static_cast<char>(wrong[wrong.size() - back] ^ 0x55);
    std::ofstream(hidden, std::ios::binary) << wrong;
    EXPECT_EQ(readsFor(kKey), 2) << back;
  }
  unsetenv("OCTREE_TEST_FILE");
}

TEST_F(OctreeTest, KeepsTheOldOneWhenTheCloudBreaksOff) {
  ASSERT_TRUE(build(room(1000)));
  const auto before = bytes();
  const auto places = room(5000);
  int passes = 0;
  const auto breaks = [&](PointSink& sink, Progress& p) -> Result<void> {
    if (++passes == 2) return failure(ErrorKind::file_system, "cannot read", "cloud.e57");
    return sourceOf(places)(sink, p);
  };
  EXPECT_FALSE(buildOctree(breaks, kKey, file, {}, progress));
  EXPECT_EQ(bytes(), before);
  EXPECT_EQ(filesInFolder(), 1U);
}

TEST_F(OctreeTest, SaysThatTheCloudChangedWhileItWasRead) {
  const auto first = room(5000);
  auto second = first;
  second.front() = {500, 500, 500};
  int passes = 0;
  const auto changes = [&](PointSink& sink, Progress& p) { return sourceOf(++passes == 1 ? first : second)(sink, p); };
  const auto built = buildOctree(changes, kKey, file, {1000, 0, nullptr}, progress);
  ASSERT_FALSE(built);
  EXPECT_NE(built.error().message.find("changed"), std::string::npos);
}

TEST(OctreeGrid, CountsTheSameInAnyOrderAndSize) {
  const auto places = room(3000);
  auto backwards = places;
  std::reverse(backwards.begin(), backwards.end());
  octree::GrowingCounts one, other;
  one.add(places);
  for (const auto& p : backwards) other.add({&p, 1});
  const auto cube = one.cube();
  EXPECT_EQ(cube.min_m, other.cube().min_m);
  EXPECT_EQ(cube.size_m, other.cube().size_m);
  const auto counts = one.counts();
  EXPECT_EQ(counts, other.counts());
  std::vector<std::uint64_t> counted(counts.size(), 0);
  for (const auto& p : places) ++counted[octree::cellOf(cube, p, 7)];
  EXPECT_EQ(counts, counted);
}

}  // namespace
}  // namespace standpoint
