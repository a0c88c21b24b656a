// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstring>
#include <map>
#include <sstream>

#include "pointclouds/datasets/datasets.h"
#include "tests/pointclouds/kept_scans.h"
#include "tests/pointclouds/made_up_scan.h"
#include "tests/pointclouds/same_points.h"

namespace standpoint {
namespace {

using testing::allPoints;
using testing::bytesOf;
using ::testing::HasSubstr;
using testing::madeUpHeader;
using testing::writeFile;

std::filesystem::path classesOf(const std::string& set) { return SOURCE_DIR "/pointclouds/classes/" + set + ".json"; }

const Dataset& setNamed(const std::string& name) {
  return *std::find_if(datasets().begin(), datasets().end(), [&](const Dataset& d) { return name == d.name; });
}

// Two stations: walls, a door, and slabs below and above the scanner.
std::vector<ScanHeader> headers() {
  std::vector<ScanHeader> all = {madeUpHeader({20, 30, true, true, "A_1"}), madeUpHeader({20, 30, false, true, "B"})};
  for (auto& h : all)
    h.products = {{"#1", "gidWall", "IfcWallStandardCase", "w, \"1\""},
                  {"#2", "gidDoor", "IfcDoor", ""},
                  {"#3", "gidSlab", "IfcSlab", ""}};
  return all;
}

Result<Report> convert(const TemporaryFolder& folder, const std::string& set) {
  writeFile(folder / "in.e57", headers());
  auto map = readClassMap(classesOf(set));
  if (!map) return failure(map.error());
  Progress progress;
  return convertToDataset(folder / "in.e57", folder / "out", setNamed(set), *map, progress);
}

// What the class of each point must be, by the rules of the S3DIS map as its readers would state them.
std::string s3disClass(const PointBlock& points, std::size_t i) {
  constexpr const char* kProducts[2] = {"wall", "door"};
  return points.product[i] < 2 ? kProducts[points.product[i]] : points.z_m[i] > 0 ? "ceiling" : "floor";
}

std::size_t linesOf(const std::filesystem::path& file) {
  const std::string text = bytesOf(file);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(Datasets, S3disHasAFileForEachInstanceAndTheRoomIsTheirSum) {
  const TemporaryFolder folder;
  ASSERT_OK(convert(folder, "s3dis"));
  const PointBlock points = allPoints(headers()[0]);
  std::map<std::string, std::size_t> wanted;
  for (std::size_t i = 0; i < points.size(); ++i)
    ++wanted[s3disClass(points, i) + "_" + std::to_string(points.product[i] + 1) + ".txt"];
  const auto room = folder / "out/Area_1/A-1";
  std::map<std::string, std::size_t> found;
  for (const auto& entry : std::filesystem::directory_iterator(room / "Annotations"))
    found[entry.path().filename().string()] = linesOf(entry.path());
  EXPECT_EQ(found, wanted);
  EXPECT_EQ(linesOf(room / "A-1.txt"), points.size());
  EXPECT_EQ(linesOf(folder / "out/Area_5/B/B.txt"), allPoints(headers()[1]).size());
  std::istringstream first(bytesOf(room / "A-1.txt"));
  double x = 0, y = 0, z = 0;
  int r = 0, g = 0, b = 0;
  first >> x >> y >> z >> r >> g >> b;
  const Eigen::Vector3d shift(5000000, -5000000, 0);  // whole metres of the first station's place
  const Eigen::Vector3d p =
      headers()[0].file_from_scanner * Eigen::Vector3d(points.x_m[0], points.y_m[0], points.z_m[0]) - shift;
  EXPECT_LE((p - Eigen::Vector3d(x, y, z)).cwiseAbs().maxCoeff(), 0.6e-5);
  EXPECT_EQ(r, points.red[0]);
  EXPECT_EQ(b, points.blue[0]);
  EXPECT_THAT(bytesOf(folder / "out/instances.csv"),
              HasSubstr("1,\"#1\",\"gidWall\",\"IfcWallStandardCase\",\"w, \"\"1\"\"\"\n"));
  EXPECT_THAT(bytesOf(folder / "out/dataset.json"), HasSubstr("5000000.0"));
}

TEST(Datasets, SemanticKittiHasClassAndInstanceInOneNumber) {
  const TemporaryFolder folder;
  ASSERT_OK(convert(folder, "semantickitti"));
  const PointBlock points = allPoints(headers()[1]);
  const std::string cloud = bytesOf(folder / "out/sequences/08/velodyne/000000.bin");
  const std::string labels = bytesOf(folder / "out/sequences/08/labels/000000.label");
  ASSERT_EQ(cloud.size(), 16 * points.size());
  ASSERT_EQ(labels.size(), 4 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::uint32_t label = 0;
    std::memcpy(&label, labels.data() + 4 * i, 4);
    const std::uint32_t wanted = points.product[i] < 2 || points.z_m[i] > 0 ? 50 : 49;  // building, other-ground
    ASSERT_EQ(label & 0xFFFF, wanted) << i;
    ASSERT_EQ(label >> 16, points.product[i] + 1);
    float z = 0;
    std::memcpy(&z, cloud.data() + 16 * i + 8, 4);
    ASSERT_EQ(z, points.z_m[i]);
  }
  EXPECT_EQ(linesOf(folder / "out/sequences/08/poses.txt"), 1u);
  EXPECT_EQ(linesOf(folder / "out/sequences/00/calib.txt"), 5u);
}

TEST(Datasets, Semantic3dAndCustom3dHaveALabelForEachPoint) {
  const TemporaryFolder folder;
  ASSERT_OK(convert(folder, "semantic3d"));
  const PointBlock points = allPoints(headers()[0]);
  for (const char* end : {".txt", ".labels", ".instances"})
    EXPECT_EQ(linesOf(folder / (std::string("out/A-1") + end)), points.size());
  std::filesystem::remove_all(folder / "out");
  ASSERT_OK(convert(folder, "custom3d"));
  const std::string numpy = bytesOf(folder / "out/train/A-1.npy");
  ASSERT_EQ(numpy.size(), 128 + 32 * points.size());
  EXPECT_THAT(numpy.substr(0, 128), HasSubstr("'shape': (" + std::to_string(points.size()) + ", 8)"));
  float label = -1;
  std::memcpy(&label, numpy.data() + 128 + 12, 4);
  EXPECT_EQ(label, points.product[0] == 0 ? 1 : points.product[0] == 1 ? 8 : points.z_m[0] > 0 ? 3 : 2);
  EXPECT_TRUE(std::filesystem::exists(folder / "out/val/B.npy"));
  EXPECT_TRUE(std::filesystem::is_directory(folder / "out/test"));
}

TEST(Datasets, AreThereWholeOrNotAtAll) {
  const TemporaryFolder folder;
  ScanHeader bare = madeUpHeader({5, 5, true, false, "no labels"});
  writeFile(folder / "bare.e57", {headers()[0], bare});
  Progress progress;
  for (const Dataset& set : datasets()) {
    const auto map = readClassMap(classesOf(set.name));
    ASSERT_OK(map);
    const auto report = convertToDataset(folder / "bare.e57", folder / "out", set, *map, progress);
    ASSERT_FALSE(report.has_value());
    EXPECT_THAT(describe(report.error()), HasSubstr("no labels"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out.part"));
  }
  ASSERT_OK(convert(folder, "semantic3d"));
  const auto again = convert(folder, "semantic3d");
  ASSERT_FALSE(again.has_value());
  EXPECT_EQ(again.error().kind, ErrorKind::usage);
}

TEST(ClassMaps, NameWhatIsWrongWithThem) {
  const TemporaryFolder folder;
  const std::pair<const char*, const char*> faults[] = {
      {"[1]", "must be an object"},
      {"{\"name\":\"a\",\"unknown\":\"x\",\"noise\":\"x\",\"classes\":{\"x\":1},\"ifc\":{},\"more\":1}", "/more"},
      {"{\"name\":\"a\",\"unknown\":\"x\",\"classes\":{\"x\":1},\"ifc\":{}}", "/noise"},
      {"{\"name\":\"a\",\"unknown\":\"x\",\"noise\":\"x\",\"classes\":{\"x\":70000},\"ifc\":{}}", "/classes/x"},
      {"{\"name\":\"a\",\"unknown\":\"x\",\"noise\":\"x\",\"classes\":{\"x\":1},\"ifc\":{\"IfcWall\":\"y\"}}",
       "'y' is not one of the classes"},
      {"{\"name\": \"a\", \"name\": \"b\"}", "more than once"},
      {"{\"name\":", "map.json line 1: is not JSON"}};
  for (const auto& [text, says] : faults) {
    testing::putBytes(folder / "map.json", text);
    const auto map = readClassMap(folder / "map.json");
    ASSERT_FALSE(map.has_value()) << text;
    EXPECT_THAT(describe(map.error()), HasSubstr(says));
  }
}

}  // namespace
}  // namespace standpoint
