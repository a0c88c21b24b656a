// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>

#include "tests/pointclouds/kept_scans.h"
#include "tests/pointclouds/made_up_picture.h"
#include "tests/pointclouds/made_up_scan.h"
#include "tests/pointclouds/same_points.h"

namespace standpoint {
namespace {

using testing::madeUpHeader;
using testing::ScanKind;
using testing::writeScan;

std::string output(const std::string& command) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen((command + " 2>&1").c_str(), "r"), ::pclose);
  std::string text;
  std::array<char, 4096> piece;
  while (const std::size_t n = std::fread(piece.data(), 1, piece.size(), pipe.get())) text.append(piece.data(), n);
  return text;
}

bool installed(const std::string& program) { return !output("command -v " + program).empty(); }

Result<void> writeWithPictures(CloudWriter& writer, const ScanHeader& header) {
  PointBlock block;
  for (std::uint32_t c = 0; c < header.columns; ++c) testing::appendColumn(block, header, c);
  return writer.begin(header)
      .and_then([&] { return writer.picture(testing::madeUpPicture(StationPicture::Projection::spherical)); })
      .and_then([&] { return writer.write(block); })
      .and_then([&] { return writer.picture(testing::madeUpPicture(StationPicture::Projection::pinhole, 2051)); })
      .and_then([&] { return writer.end(); });
}

std::uint64_t write(const std::filesystem::path& file, const std::vector<ScanKind>& kinds,
                    const CloudVariant* as = nullptr) {
  auto writer = (as ? as->writer : cloudFormatFor(file)->writer)(file);
  std::uint64_t points = 0;
  for (const ScanKind& kind : kinds) {
    const ScanHeader header = madeUpHeader(kind);
    if (kind.all_channels) {
      EXPECT_TRUE(writeWithPictures(**writer, header).has_value());
    } else {
      EXPECT_TRUE(writeScan(**writer, header).has_value());
    }
    PointBlock block;
    for (std::uint32_t c = 0; c < header.columns; ++c) testing::appendColumn(block, header, c);
    points += block.size();
  }
  EXPECT_TRUE((*writer)->close().has_value());
  return points;
}

const std::vector<std::vector<ScanKind>> kFiles = {
    {{}},
    {{100, 50, true, true, "A"}, {70, 40, false, false, "B"}, {33, 20, true, false, "C"}},
    {{1, 0, true, true, "no points"}},
    {{1, 1, true, true, "one point or none"}},
    {{1, 300, false, true, "one row"}},
    {{300, 1, true, false, "one column"}},
    {{100, 50, true, true, "all channels", true}, {70, 40, false, false, "truth without labels", true}},
    {{2000, 1150, true, true, "two million"}}};

// The standard's own rules, checked by a program that shares no code with this one.
TEST(OutsideReaders, OfTheStandardFindNothingWrongInOurE57) {
  const auto source = testing::sharedFolder() / "oracles" / "e57_lint.cpp";
  if (!std::filesystem::exists(source)) GTEST_SKIP() << "e57_lint is not here";
  const TemporaryFolder folder;
  const std::string lint = (folder / "e57_lint").string();
  output("g++ -O1 -std=c++17 -w " + source.string() + " -lxerces-c -o " + lint);
  if (!std::filesystem::exists(lint)) GTEST_SKIP() << "e57_lint needs libxerces-c-dev";
  for (const auto& kinds : kFiles) {
    write(folder / "s.e57", kinds);
    EXPECT_THAT(output(lint + " " + (folder / "s.e57").string()), ::testing::HasSubstr("PASS errors=0 warnings=0"))
        << kinds[0].name;
    for (const CloudVariant& variant : cloudFormatFor("s.e57")->variants) {
      write(folder / "s.e57", kinds, &variant);
      EXPECT_THAT(output(lint + " " + (folder / "s.e57").string()), ::testing::HasSubstr("PASS errors=0 warnings=0"))
          << kinds[0].name << " as " << variant.name;
    }
  }
}

// Its text has x y z of the file's frame in three words of each line, scan after scan.
void expectSameAs(const std::string& web, const TemporaryFolder& folder, const std::vector<ScanKind>& kinds,
                  const CloudVariant* as) {
  SCOPED_TRACE(kinds[0].name + (as ? std::string(" as ") + as->name : ""));
  write(folder / "s.e57", kinds, as);
  std::filesystem::remove(folder / "s.xyz");
  output("node " + web + "/e57_web.mjs " + (folder / "s.e57").string() + " XYZ " + (folder / "s.xyz").string());
  std::ifstream text(folder / "s.xyz");
  ASSERT_TRUE(text.is_open());
  for (const ScanKind& kind : kinds) {
    const ScanHeader header = madeUpHeader(kind);
    const PointBlock points = testing::allPoints(header);
    double worst_m = 0;
    std::string line;
    for (std::size_t i = 0; i < points.size(); ++i) {
      Eigen::Vector3d read;
      ASSERT_TRUE(std::getline(text, line)) << "point " << i;
      std::istringstream(line) >> read.x() >> read.y() >> read.z();
      const Eigen::Vector3d made(points.x_m[i], points.y_m[i], points.z_m[i]);
      worst_m = std::max(worst_m, (header.file_from_scanner * made - read).cwiseAbs().maxCoeff());
    }
    // Half a step of 0.1 mm along each axis, turned, is 0.087 mm.
    EXPECT_LE(worst_m, as ? 8.9e-5 : 2e-6);
  }
  std::string more;
  EXPECT_FALSE(std::getline(text, more));
}

// STANDPOINT_WEB_E57 names a folder with e57_web.mjs and the npm package web-e57, which is another reader's code.
TEST(OutsideReaders, WebE57FindsThePointsOfOurE57) {
  const char* const web = std::getenv("STANDPOINT_WEB_E57");
  if (!web || !installed("node")) GTEST_SKIP() << "web-e57 or node is not here";
  const TemporaryFolder folder;
  for (std::size_t i = 0; i + 1 < kFiles.size(); ++i) {
    for (const CloudVariant& as : cloudFormatFor("s.e57")->variants) expectSameAs(web, folder, kFiles[i], &as);
    expectSameAs(web, folder, kFiles[i], nullptr);
  }
}

// Header, records, extra bytes, counts and bounds of LAS 1.4 by the standard's tables.
TEST(OutsideReaders, OfLasFindNothingWrongInOurs) {
  const auto check = testing::sharedFolder() / "oracles" / "las_check.mjs";
  if (!std::filesystem::exists(check) || !installed("node")) GTEST_SKIP() << "las_check or node is not here";
  const TemporaryFolder folder;
  for (const CloudVariant* as : {static_cast<const CloudVariant*>(nullptr), &cloudFormatFor("s.las")->variants[0]})
    for (const std::size_t i : {0, 1, 3, 4, 5, 6}) {
      const std::uint64_t points = write(folder / "s.las", kFiles[i], as);
      const std::string said = output("node " + check.string() + " " + (folder / "s.las").string());
      EXPECT_THAT(said, ::testing::HasSubstr("PASS errors=0")) << said;
      EXPECT_THAT(said, ::testing::HasSubstr("points " + std::to_string(points))) << said;
    }
}

TEST(OutsideReaders, OfPtxFindNothingWrongInOurs) {
  const auto check = testing::sharedFolder() / "oracles" / "ptx_check.mjs";
  if (!std::filesystem::exists(check) || !installed("node")) GTEST_SKIP() << "ptx_check or node is not here";
  const TemporaryFolder folder;
  for (const std::size_t i : {0, 1, 4, 5}) {
    write(folder / "s.ptx", kFiles[i]);
    EXPECT_THAT(output("node " + check.string() + " " + (folder / "s.ptx").string()),
                ::testing::HasSubstr("PASS errors=0"));
  }
}

// CloudCompare tells how many points each cloud of the file has.
TEST(OutsideReaders, CloudCompareFindsThePointsOfOurPtxAndPly) {
  if (!installed("CloudCompare")) GTEST_SKIP() << "CloudCompare is not installed";
  const TemporaryFolder folder;
  const auto look = [&](const std::string& name) {
    return output("QT_QPA_PLATFORM=offscreen HOME=" + folder.path().string() + " timeout 60 CloudCompare -SILENT -O " +
                  (folder / name).string());
  };
  const std::vector<ScanKind> scans = {{100, 50, true, false, "A"}, {70, 40, false, false, "B"}};
  for (const ScanKind& kind : scans) {
    const std::string points = std::to_string(write(folder / (kind.name + ".ptx"), {kind}));
    write(folder / (kind.name + ".ply"), {kind});
    EXPECT_THAT(look(kind.name + ".ptx"), ::testing::HasSubstr("with " + points + " points"));
    for (const char* extension : {".ply", ".pts", ".xyz", ".csv"}) {
      write(folder / (kind.name + extension), {kind});
      EXPECT_THAT(look(kind.name + extension), ::testing::HasSubstr("with " + points + " points")) << extension;
    }
  }
  write(folder / "both.ptx", scans);
  EXPECT_THAT(look("both.ptx"),
              ::testing::HasSubstr("with " + std::to_string(write(folder / "A.ptx", {scans[0]})) + " points"));

  // Without a grid the number of points stands in a header of fixed width.
  ScanHeader header = madeUpHeader({10, 10, true, false, "S"});
  PointBlock points;
  for (std::uint32_t c = 0; c < 10; ++c) testing::appendColumn(points, header, c);
  header.rows = header.columns = 0;
  auto writer = cloudFormatFor("s.ptx")->writer(folder / "s.ptx");
  ASSERT_OK(writer);
  ASSERT_OK((*writer)->begin(header));
  ASSERT_OK((*writer)->write(points));
  ASSERT_OK((*writer)->end());
  ASSERT_OK((*writer)->close());
  EXPECT_THAT(look("s.ptx"), ::testing::HasSubstr("with " + std::to_string(points.size()) + " points"));
}

// Number of points and the mean of their places.
TEST(OutsideReaders, Open3dFindsThePlacesOfOurPlyPcdAndText) {
  const std::string python = "/usr/bin/python3";
  if (output(python + " -c 'import open3d; print(1)'").find("1\n") != 0)
    GTEST_SKIP() << "python3-open3d is not installed";
  const TemporaryFolder folder;
  testing::putBytes(folder / "look.py",
                    "import sys, numpy as np, open3d as o3d\n"
                    "for f in sys.argv[1:]:\n"
                    "  t = o3d.t.io.read_point_cloud(f); p = t.point['positions'].numpy().astype(float)\n"
                    "  p = p[np.isfinite(p).all(1)]\n"
                    "  print(len(p), '%.5f %.5f %.5f' % tuple(p.mean(0)), *sorted(k for k, _ in t.point.items()))\n");
  const ScanKind kind{40, 30, true, true, "A", true};
  const ScanHeader header = madeUpHeader(kind);
  const PointBlock points = testing::allPoints(header);
  Eigen::Vector3d local = Eigen::Vector3d::Zero(), far = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p(points.x_m[i], points.y_m[i], points.z_m[i]);
    local += p / static_cast<double>(points.size());
    far += (header.file_from_scanner * p) / static_cast<double>(points.size());
  }
  for (const char* name : {"a.ply", "a.pcd", "a.pts", "a.xyz"}) {
    write(folder / name, {kind});
    const std::string said = output(python + " " + (folder / "look.py").string() + " " + (folder / name).string());
    SCOPED_TRACE(std::string(name) + ": " + said);
    std::istringstream stream(said.substr(said.find_last_of('\n', said.size() - 2) + 1));
    std::size_t count = 0;
    Eigen::Vector3d mean;
    stream >> count >> mean.x() >> mean.y() >> mean.z();
    EXPECT_EQ(count, points.size());
    const bool pcd = std::string(name) == "a.pcd";
    const bool single = name == std::string("a.pts") || name == std::string("a.xyz");  // Open3D keeps these as floats
    EXPECT_LE((mean - (pcd ? local : far)).cwiseAbs().maxCoeff(), single ? 0.3 : 2e-5);
    if (pcd) {
      EXPECT_THAT(said, ::testing::HasSubstr("intensity"));
    }
  }
}

}  // namespace
}  // namespace standpoint
