// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <csignal>
#include <cstring>
#include <fstream>
#include <sys/resource.h>
#include <utility>

#include "tests/pointclouds/kept_scans.h"
#include "tests/pointclouds/made_up_scan.h"

namespace standpoint {
namespace {

using testing::KeptScans;
using testing::madeUpHeader;
using testing::writeScan;

// The kernel refuses to let a file grow beyond `bytes`, as a full disk would.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

std::vector<std::string> filesIn(const TemporaryFolder& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

class Writers : public ::testing::TestWithParam<CloudFormat> {
 protected:
  TemporaryFolder folder;
  std::filesystem::path file = folder / (std::string("cloud") + GetParam().extension);
  Result<void> writeAll() {
    auto writer = GetParam().writer(file);
    if (!writer) return failure(writer.error());
    return writeScan(**writer, madeUpHeader({300, 300, true, true, "S"})).and_then([&] { return (*writer)->close(); });
  }
};

TEST_P(Writers, OnAFullDiskLeaveTheOldFileAndSaySo) {
  testing::putBytes(file, "old");
  ASSERT_OK(writeAll());
  const auto whole = std::filesystem::file_size(file);
  testing::putBytes(file, "old");
  for (const std::uintmax_t room : {std::uintmax_t{0}, std::uintmax_t{1000}, whole / 2, whole - 1}) {
    const FileSizeLimit limit(room);
    const auto written = writeAll();
    ASSERT_FALSE(written.has_value()) << room;
    EXPECT_EQ(written.error().kind, ErrorKind::file_system);
    EXPECT_EQ(written.error().source, file.string());
  }
  EXPECT_EQ(testing::bytesOf(file), "old");
  EXPECT_EQ(filesIn(folder).size(), 1u);
}

TEST_P(Writers, AbandonedLeaveNothingBehind) {
  {
    auto writer = GetParam().writer(file);
    ASSERT_OK(writer);
    ASSERT_OK((*writer)->begin(madeUpHeader({})));
    EXPECT_EQ(filesIn(folder).size(), 1u);  // the .part file
  }
  EXPECT_TRUE(filesIn(folder).empty());
}

TEST_P(Writers, ReplaceAFileOnlyWhenTheyAreDone) {
  testing::putBytes(file, "old");
  auto writer = GetParam().writer(file);
  ASSERT_OK(writer);
  ASSERT_OK(writeScan(**writer, madeUpHeader({})));
  EXPECT_EQ(testing::bytesOf(file), "old");
  ASSERT_OK((*writer)->close());
  EXPECT_NE(testing::bytesOf(file), "old");
  EXPECT_EQ(filesIn(folder).size(), 1u);
}

TEST_P(Writers, SayWhereAFolderIsMissing) {
  const auto writer = GetParam().writer(folder / "none/cloud");
  ASSERT_FALSE(writer.has_value());
  EXPECT_EQ(writer.error().kind, ErrorKind::file_system);
}

std::vector<CloudFormat> writtenFormats() {
  std::vector<CloudFormat> formats;
  for (const CloudFormat& format : cloudFormats())
    if (format.writer) formats.push_back(format);
  return formats;
}

INSTANTIATE_TEST_SUITE_P(OfEachFormat, Writers, ::testing::ValuesIn(writtenFormats()),
                         [](const auto& format) { return std::string(format.param.name); });

void writeThree(const std::filesystem::path& file) {
  auto writer = cloudFormatFor(file)->writer(file);
  ASSERT_OK(writer);
  for (const char* name : {"A", "B 1/2", "C"}) ASSERT_OK(writeScan(**writer, madeUpHeader({20, 30, true, true, name})));
  ASSERT_OK((*writer)->close());
}

TEST(ConvertCloud, OfE57ToPtxAndBackKeepsPointsAndPoses) {
  const TemporaryFolder folder;
  writeThree(folder / "a.e57");
  Report report;
  Progress progress;
  ASSERT_OK(convertCloud({folder / "a.e57"}, folder / "b.ptx", "", report, progress));
  ASSERT_OK(convertCloud({folder / "b.ptx"}, folder / "c.e57", "", report, progress));
  EXPECT_EQ(report.losses(), 0u) << testing::said(report);
  EXPECT_THAT(testing::said(report), ::testing::HasSubstr("labels"));
  KeptScans before, after;
  ASSERT_OK(readAll(folder / "a.e57", before));
  ASSERT_OK(readAll(folder / "c.e57", after));
  ASSERT_EQ(after.scans.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(after.scans[i].points.x_m, before.scans[i].points.x_m);
    EXPECT_EQ(after.scans[i].points.row, before.scans[i].points.row);
    EXPECT_EQ(after.scans[i].points.red, before.scans[i].points.red);
    EXPECT_EQ(after.scans[i].header.file_from_scanner.translation,
              before.scans[i].header.file_from_scanner.translation);
  }
}

TEST(ConvertCloud, GivesEachStationItsOwnFileWhereAFormatHoldsOne) {
  const TemporaryFolder folder;
  writeThree(folder / "a.e57");
  Report report;
  Progress progress;
  const auto files = convertCloud({folder / "a.e57"}, folder / "out.ply", "", report, progress);
  ASSERT_OK(files);
  EXPECT_THAT(*files, ::testing::ElementsAre(folder / "out-A.ply", folder / "out-B_1_2.ply", folder / "out-C.ply"));
  // 24 bytes of coordinates, 4 of intensity, 3 of colour, 8 of labels, 8 of indices for each point.
  const std::string ply = testing::bytesOf((*files)[0]);
  KeptScans kept;
  ASSERT_OK(readAll(folder / "a.e57", kept));
  const std::string end = "end_header\n";
  const std::size_t data = ply.find(end) + end.size();
  ASSERT_EQ(ply.size() - data, kept.scans[0].points.size() * 47);
  double x = 0;
  std::memcpy(&x, ply.data() + data, sizeof x);
  const auto& [header, points, ended] = kept.scans[0];
  EXPECT_EQ(x, (header.file_from_scanner * Eigen::Vector3d(points.x_m[0], points.y_m[0], points.z_m[0])).x());
}

TEST(ConvertCloud, PutsTheScansOfSeveralFilesOneAfterTheOther) {
  const TemporaryFolder folder;
  writeThree(folder / "a.e57");
  auto writer = cloudFormatFor(folder / "b.ptx")->writer(folder / "b.ptx");
  ASSERT_OK(writer);
  ASSERT_OK(writeScan(**writer, madeUpHeader({10, 12, true, false, "D"})));
  ASSERT_OK((*writer)->close());
  Report report;
  Progress progress;
  double told = 0;
  bool falls = false;
  progress.onChange([&] { falls = falls || progress.fraction() < std::exchange(told, progress.fraction()); });
  const auto files = convertCloud({folder / "a.e57", folder / "b.ptx"}, folder / "all.e57", "", report, progress);
  ASSERT_OK(files);
  EXPECT_THAT(*files, ::testing::ElementsAre(folder / "all.e57"));
  KeptScans first, second, all;
  ASSERT_OK(readAll(folder / "a.e57", first));
  ASSERT_OK(readAll(folder / "b.ptx", second));
  ASSERT_OK(readAll(folder / "all.e57", all));
  ASSERT_EQ(all.scans.size(), 4u);
  EXPECT_EQ(all.scans[2].header.name, "C");
  EXPECT_EQ(all.scans[2].points.x_m, first.scans[2].points.x_m);
  EXPECT_EQ(all.scans[3].points.x_m, second.scans[0].points.x_m);
  EXPECT_EQ(all.scans[3].header.file_from_scanner.translation, second.scans[0].header.file_from_scanner.translation);

  const auto single = convertCloud({folder / "a.e57", folder / "b.ptx"}, folder / "out.xyz", "", report, progress);
  ASSERT_OK(single);
  EXPECT_EQ(single->size(), 4u) << "one for each scan";
}

TEST(ConvertCloud, WritesNothingWhereOneOfSeveralFilesCannotBeRead) {
  const TemporaryFolder folder;
  writeThree(folder / "a.e57");
  std::ofstream(folder / "b.ptx") << "2\n1\n";
  Report report;
  Progress progress;
  const auto files = convertCloud({folder / "a.e57", folder / "b.ptx"}, folder / "all.e57", "", report, progress);
  ASSERT_FALSE(files.has_value());
  EXPECT_THAT(describe(files.error()), ::testing::HasSubstr("b.ptx"));
  EXPECT_EQ(filesIn(folder).size(), 2u);
}

TEST(ConvertCloud, NamesWhatItCannotDo) {
  const TemporaryFolder folder;
  Report report;
  Progress progress;
  const auto unknown = convertCloud({folder / "a.e57"}, folder / "b.xyzzy", "", report, progress);
  ASSERT_FALSE(unknown.has_value());
  EXPECT_EQ(unknown.error().kind, ErrorKind::usage);
  EXPECT_THAT(unknown.error().message, ::testing::HasSubstr(".ptx"));
  EXPECT_EQ(convertCloud({folder / "a.e57"}, folder / "b.laz", "", report, progress).error().kind, ErrorKind::usage);
  const auto variant = convertCloud({folder / "a.e57"}, folder / "b.e57", "short", report, progress);
  ASSERT_FALSE(variant.has_value());
  EXPECT_THAT(describe(variant.error()), ::testing::HasSubstr("available: scaled, spherical"));
  EXPECT_EQ(convertCloud({folder / "none.e57"}, folder / "b.ptx", "", report, progress).error().kind,
            ErrorKind::file_system);
  EXPECT_TRUE(filesIn(folder).empty());
}

TEST(ConvertCloud, CanBeCancelled) {
  const TemporaryFolder folder;
  writeThree(folder / "a.e57");
  Report report;
  Progress progress;
  progress.cancel();
  const auto files = convertCloud({folder / "a.e57"}, folder / "b.ptx", "", report, progress);
  ASSERT_FALSE(files.has_value());
  EXPECT_EQ(files.error().kind, ErrorKind::cancelled);
  EXPECT_EQ(filesIn(folder).size(), 1u);
}

}  // namespace
}  // namespace standpoint
