// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/hand_over.h"

#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "core/units.h"
#include "pointclouds/formats.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

const Vector3d kShift_m{500000, 5600000, 0};

Pose turned(double deg, const Vector3d& translation) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(deg * kRadPerDeg, Vector3d::UnitZ())), translation};
}

std::string contentOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct ReadScan final : PointSink {
  ScanHeader header;
  std::vector<float> x_m, true_x_m;
  Result<void> begin(const ScanHeader& h) override { return header = h, Result<void>{}; }
  Result<void> write(const PointBlock& block) override {
    x_m.insert(x_m.end(), block.x_m.begin(), block.x_m.end());
    true_x_m.insert(true_x_m.end(), block.truth.x_m.begin(), block.truth.x_m.end());
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }
};

// Of a hundred points around the scanner, with the truth of each.
Result<void> writeScan(const fs::path& file, const Pose& pose) {
  ScanHeader header;
  header.name = file.stem().string();
  header.guid = "{" + header.name + "}";
  header.file_from_scanner = pose;
  header.rows = 1;
  header.columns = 100;
  header.has_truth = true;
  PointBlock block;
  for (std::uint32_t i = 0; i < header.columns; ++i) {
    block.x_m.push_back(5 * std::cos(0.06F * static_cast<float>(i)));
    block.y_m.push_back(5 * std::sin(0.06F * static_cast<float>(i)));
    block.z_m.push_back(0.5F);
    block.intensity.push_back(0.5F);
    block.row.push_back(0);
    block.column.push_back(i);
    auto& truth = block.truth;
    truth.x_m.push_back(block.x_m.back() + 0.001F), truth.y_m.push_back(block.y_m.back()), truth.z_m.push_back(0.5F);
    truth.range_m.push_back(5), truth.incidence_rad.push_back(0), truth.received_db.push_back(-20);
    truth.flags.push_back(0);
  }
  TRY_ASSIGN(const auto writer, cloudFormatFor(file)->writer(file));
  TRY(writer->begin(header));
  TRY(writer->write(block));
  TRY(writer->end());
  return writer->close();
}

// Three set-ups in a row, S1, S2 and S3, each 10 m further east.
class HandOver : public testing::Test {
 protected:
  HandOver() {
    state_.projects.resize(1);
    fs::create_directories(folder_.path() / "scans" / "House");
    for (int i = 0; i < 3; ++i) {
      StoredSetup setup;
      setup.file = (folder_.path() / "scans" / "House" / ("S" + std::to_string(i + 1) + ".e57")).string();
      const auto written = writeScan(setup.file, turned(0, kShift_m + Vector3d{10.0 * i, 0, 1.6}));
      EXPECT_TRUE(written) << describe(written.error());
      state_.projects[0].setups.push_back(setup);
    }
  }
  void link(int from, int to, const Pose& error, bool joined = true) {
    LinkResult link;
    link.joined = joined;
    link.error = error;
    link.to = setup(to).file;
    setup(from).link = link;
  }
  StoredSetup& setup(int number) { return state_.projects[0].setups[static_cast<std::size_t>(number) - 1]; }
  fs::path copyOf(int number, const char* extension = ".e57") const {
    return folder_.path() / "office" / ("House - S" + std::to_string(number) + extension);
  }
  void handedOver(const std::string& extension = "") {
    TransferOrder order{{}, "cable", extension};
    for (const auto& setup : state_.projects[0].setups) order.files.push_back(setup.file);
    Progress quiet;
    const auto done = handOver(order, linkedPlaces(state_), kShift_m, folder_.path() / "office", report_, quiet);
    ASSERT_TRUE(done) << describe(done.error());
  }
  static ReadScan read(const fs::path& file) {
    ReadScan scan;
    Progress quiet;
    EXPECT_TRUE(cloudFormatFor(file)->read(file, scan, quiet));
    return scan;
  }

  TemporaryFolder folder_;
  DeviceState state_;
  Report report_;
};

TEST_F(HandOver, CopiesWithoutLinksByteForByte) {
  link(3, 2, turned(5, {}), false);  // which did not join
  handedOver();
  for (int i = 1; i <= 3; ++i) EXPECT_TRUE(contentOf(copyOf(i)) == contentOf(setup(i).file)) << i;
}

// The link of S2 is wrong by 2° and half a metre about the origin: S3, rightly linked to S2, goes with it.
TEST_F(HandOver, MovesASetUpWithAWrongLinkAndWhatHangsOnIt) {
  const Pose wrong = turned(2, {0.5, 0, 0});
  link(2, 1, wrong);
  link(3, 2, Pose());
  handedOver();
  EXPECT_TRUE(contentOf(copyOf(1)) == contentOf(setup(1).file));
  for (int i = 2; i <= 3; ++i) {
    const auto before = read(setup(i).file), after = read(copyOf(i));
    const Vector3d place = wrong * Vector3d{10.0 * (i - 1), 0, 1.6} + kShift_m;
    EXPECT_LT((after.header.file_from_scanner.translation - place).norm(), 1e-6) << i;
    EXPECT_NEAR(after.header.file_from_scanner.rotation.angularDistance(wrong.rotation), 0, 1e-9);
    ASSERT_TRUE(after.header.true_file_from_scanner) << "the truth stands beside it";
    EXPECT_LT((after.header.true_file_from_scanner->translation - before.header.file_from_scanner.translation).norm(),
              1e-9);
    EXPECT_EQ(after.x_m, before.x_m);
    EXPECT_EQ(after.true_x_m, before.true_x_m);
    EXPECT_NE(after.header.guid, before.header.guid);
  }
}

TEST_F(HandOver, MovesThePointsOfACopyWithoutPoses) {
  link(2, 1, turned(0, {0, 0.25, 0}));
  handedOver(".las");
  Progress quiet;
  const auto before = measureCloud(setup(2).file, quiet), after = measureCloud(copyOf(2, ".las"), quiet);
  ASSERT_TRUE(before && after);
  EXPECT_EQ(after->points, before->points);
  const Vector3d moved = after->bounds_file_m.min - before->bounds_file_m.min;
  EXPECT_LT((moved - Vector3d{0, 0.25, 0}).norm(), 1e-3);
}

TEST_F(HandOver, ListsWhatAnotherFormatCannotHold) {
  handedOver();
  EXPECT_EQ(report_.issues.size(), 0U) << "byte for byte";
  handedOver(".ptx");
  Report wanted;
  Progress quiet;
  for (int i = 1; i <= 3; ++i)
    ASSERT_TRUE(
        convertCloud({setup(i).file}, folder_.path() / ("by-hand-" + std::to_string(i) + ".ptx"), "", wanted, quiet));
  ASSERT_FALSE(wanted.issues.empty());
  ASSERT_EQ(report_.issues.size(), wanted.issues.size());
  EXPECT_EQ(report_.issues.front().message, wanted.issues.front().message);
}

TEST_F(HandOver, OfARingOfLinksComesToAnEnd) {
  link(1, 3, turned(0, {1, 0, 0}));
  link(2, 1, turned(0, {1, 0, 0}));
  link(3, 2, turned(0, {1, 0, 0}));
  const auto places = linkedPlaces(state_);
  ASSERT_EQ(places.size(), 3U);
  for (const auto& [file, moved] : places) EXPECT_LE(moved.translation.norm(), 3 + 1e-9) << file;
}

TEST_F(HandOver, NamesTheScanThatIsGone) {
  fs::remove(setup(2).file);
  link(2, 1, turned(0, {1, 0, 0}));
  TransferOrder order{{setup(2).file}, "cable", ""};
  Progress quiet;
  const auto done = handOver(order, linkedPlaces(state_), kShift_m, folder_.path() / "office", report_, quiet);
  ASSERT_FALSE(done);
  EXPECT_NE(describe(done.error()).find("S2.e57"), std::string::npos);
  EXPECT_FALSE(fs::exists(copyOf(2)));
}

}  // namespace
}  // namespace standpoint
