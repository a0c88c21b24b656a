// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <iterator>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/units.h"
#include "emulated-ui/host.h"
#include "emulated-ui/menus.h"
#include "pointclouds/formats.h"
#include "survey/stations/levelling.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

struct HeaderOf final : PointSink {
  ScanHeader header;
  double sum_m = 0;  // of all coordinates: whether the points are the same
  Result<void> begin(const ScanHeader& h) override { return header = h, Result<void>{}; }
  Result<void> write(const PointBlock& block) override {
    for (std::size_t i = 0; i < block.size(); ++i) sum_m += block.x_m[i] + block.y_m[i] + block.z_m[i];
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }
};

// A P40 in the lower room, over the mark of S1 or of S2 a metre beside it, turned by 30°.
class BelievedPose : public testing::Test {
 protected:
  static constexpr double kRight_deg = 60;  // clockwise from north

  BelievedPose() {
    document_ = twoStoreyDocument();
    for (const auto& [name, x] : {std::pair{"S1", 500002.5}, std::pair{"S2", 500003.5}})
      document_ = run("station", document_, {{"add", name}, {"at", {x, 5600002, 1.6}}, {"yaw-deg", 30.0}})->document;
  }
  const Station& station(std::size_t index) const { return document_.job->stations[index]; }
  double height() const { return station(0).instrument_height_m; }

  struct Setup {
    double height_m = 0, azimuth_deg = kRight_deg;
  };
  // Sets up at S1, or goes on without; stands at `at` and scans there.
  void scan(const std::optional<Setup>& setup, const char* at = "S1") {
    folder_.emplace();
    host_ = std::make_unique<DeviceHost>(*loadDevice(*findDevice("leica-p-series")), document_, nullptr);
    host_->truth = true;
    press({"power"});
    host_->device().tick(70);
    ASSERT_TRUE(host_->device().hand("stand_at", "S1"));
    press({"manage", "new_project", "name=House", "create"});
    if (setup) press({"scan_menu"});
    ASSERT_TRUE(host_->device().hand("stand_at", at));  // the set-up is of the old mark
    if (setup)
      press({"method=quick", fmt::format("instrument_height={:.4f}", setup->height_m),
             fmt::format("azimuth={}", setup->azimuth_deg), "solve", "accept", "ok"});
    press({"scan_page", "resolution_page", "resolution=50mm", "back", "image_page", "images=off", "back", "scan"});
    if (!setup) press({"continue"});
    for (int i = 0; i < 200000; ++i) {
      if (auto stored = host_->update(document_, folder_->path() / "scans", 1))
        if (!stored->document.job->stations.empty() && host_->device().newestSetup() != nullptr) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ASSERT_NE(host_->device().newestSetup(), nullptr);
    const auto& file = host_->device().newestSetup()->file;
    std::ifstream in(file, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(in), {});
    read_ = {};
    Progress quiet;
    ASSERT_TRUE(cloudFormatFor(file)->read(file, read_, quiet));
  }
  void press(const std::vector<std::string>& widgets) {
    for (const auto& text : widgets) {
      const auto equals = text.find('=');
      const auto done =
          host_->device().act(text.substr(0, equals), equals == std::string::npos ? "" : text.substr(equals + 1));
      ASSERT_TRUE(done) << text << ": " << describe(done.error());
    }
  }
  // In the file's frame.
  Eigen::Vector3d place(std::size_t index) const {
    return station(index).true_pose.translation + document_.georeference->shift_m;
  }
  double fact(const char* name) const { return host_->device().fact(name)->number.value_or(-1); }

  Document document_;
  std::optional<TemporaryFolder> folder_;
  std::unique_ptr<DeviceHost> host_;
  std::string bytes_;
  HeaderOf read_;
};

TEST_F(BelievedPose, IsTheTrueOneAfterARightSetUp) {
  scan(Setup{height()});
  EXPECT_LT((read_.header.file_from_scanner.translation - place(0)).norm(), 1e-4);
  EXPECT_NEAR(yawOf(read_.header.file_from_scanner.rotation) / kRadPerDeg, 30, 1e-4);
  EXPECT_NEAR(fact("newest.height"), 0, 0.1);
  EXPECT_NEAR(fact("newest.azimuth"), 0, 1e-3);
}

// The points are the same, and where they are put is not: what the instrument was told reaches the file.
TEST_F(BelievedPose, IsWrongInTheFileAsTheSetUpWasAndTheTruthStandsBesideIt) {
  scan(Setup{height()});
  const auto right = bytes_;
  const double points = read_.sum_m;
  scan(Setup{height()});
  EXPECT_EQ(bytes_, right) << "the same work gives the same file";

  scan(Setup{height() + 0.18});
  EXPECT_NE(bytes_, right);
  EXPECT_EQ(read_.sum_m, points);
  EXPECT_NEAR(read_.header.file_from_scanner.translation.z() - place(0).z(), 0.18, 1e-4);
  ASSERT_TRUE(read_.header.true_file_from_scanner);
  EXPECT_LT((read_.header.true_file_from_scanner->translation - place(0)).norm(), 1e-9);
  EXPECT_NEAR(fact("newest.height"), 180, 0.1);
  EXPECT_NEAR(fact("newest.plan"), 0, 0.1);

  scan(Setup{height(), kRight_deg + 38});
  EXPECT_NE(bytes_, right);
  EXPECT_EQ(read_.sum_m, points);
  EXPECT_NEAR(yawOf(read_.header.file_from_scanner.rotation) / kRadPerDeg, 30 - 38, 1e-3);
  EXPECT_NEAR(fact("newest.azimuth"), 38, 1e-3);
}

TEST_F(BelievedPose, IsOverTheOldMarkWhereTheStationWasNotChosenAnew) {
  scan(Setup{height()}, "S2");
  EXPECT_LT((read_.header.file_from_scanner.translation - place(0)).norm(), 1e-4) << "S1, though it stands at S2";
  EXPECT_LT((read_.header.true_file_from_scanner->translation - place(1)).norm(), 1e-9);
  EXPECT_NEAR(fact("newest.plan"), 1000, 0.1);
}

TEST_F(BelievedPose, IsTheScannersOwnFrameWithoutASetUp) {
  scan(std::nullopt);
  EXPECT_LT(read_.header.file_from_scanner.translation.norm(), 1e-6);
  EXPECT_NEAR(yawOf(read_.header.file_from_scanner.rotation), 0, 1e-4);
  EXPECT_FALSE(host_->device().fact("newest.plan")->number);
}

}  // namespace
}  // namespace standpoint
