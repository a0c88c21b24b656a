// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/stations/levelling.h"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random.h"
#include "core/units.h"
#include "pointclouds/formats.h"
#include "survey/instruments.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using testing::HasSubstr;

Station leaning(double tilt_deg, double towards_deg, const std::string& name = "S") {
  Station s;
  s.name = name;
  s.true_pose = {rotationOf(0.7, {tilt_deg * kRadPerDeg, towards_deg * kRadPerDeg}), {1, 2, 3}};
  return s;
}

double between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return (a * Eigen::Vector3d::UnitZ()).cross(b * Eigen::Vector3d::UnitZ()).norm();
}

TEST(Levelling, ATiltIsARotationOfTheStandingAxisTowardsItsAzimuth) {
  const auto r = rotationOf(0.5, {0.1, 2.0});
  const Eigen::Vector3d axis = r * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(axis.x(), std::sin(0.1) * std::cos(2.0), 1e-15);
  EXPECT_NEAR(axis.y(), std::sin(0.1) * std::sin(2.0), 1e-15);
  EXPECT_NEAR(axis.z(), std::cos(0.1), 1e-15);
  EXPECT_NEAR(yawOf(r), 0.5, 1e-12);
  EXPECT_NEAR(tiltOf(r).angle_rad, 0.1, 1e-12);
  EXPECT_NEAR(tiltOf(r).towards_rad, 2.0, 1e-12);
  EXPECT_EQ(tiltOf(rotationOf(0.5, {})).angle_rad, 0);
}

TEST(Levelling, TheCompensatorsErrorHasTheSigmaOfItsSheetInEachAxis) {
  const auto instrument = *instrumentById("faro-focus-s350");
  Report report;
  double sum = 0;
  constexpr int kScans = 4000;
  for (int k = 0; k < kScans; ++k) {
    const auto s = leaning(1, 40);
    const auto pose = believedPose(s, instrument, {.seed = static_cast<std::uint64_t>(k)}, report);
    sum += std::pow(between(pose->rotation, s.true_pose.rotation), 2);
  }
  EXPECT_NEAR(std::sqrt(sum / kScans / 2) / kRadPerArcsec, 19, 0.5) << "19 arc seconds: instrument-facts.md §1.2";
  EXPECT_TRUE(report.issues.empty());
}

TEST(Levelling, IsExactWhereTheStationStandsLevelOrTheErrorIsLeftOut) {
  const auto instrument = *instrumentById("leica-rtc360");
  Report report;
  EXPECT_EQ(believedPose(leaning(0, 0), instrument, {}, report)->rotation.coeffs(),
            leaning(0, 0).true_pose.rotation.coeffs());
  EXPECT_EQ(believedPose(leaning(2, 30), instrument, {.exact = true}, report)->rotation.coeffs(),
            leaning(2, 30).true_pose.rotation.coeffs());
}

TEST(Levelling, IsRefusedBeyondTheCompensatorsRangeAndTiltedWithoutIt) {
  const auto p40 = *instrumentById("leica-p40");
  Report report;
  const auto refused = believedPose(leaning(0.1, 0), p40, {}, report);
  ASSERT_FALSE(refused) << "6 arc minutes; the liquid runs out at 5";
  EXPECT_THAT(refused.error().message,
              AllOf(HasSubstr("6 arc minutes"), HasSubstr("5 arc minutes"), HasSubstr("turn the compensator off")));
  EXPECT_TRUE(believedPose(leaning(0.08, 0), p40, {}, report));
  const auto off = believedPose(leaning(0.1, 0), p40, {.compensator = false}, report);
  ASSERT_TRUE(off);
  EXPECT_EQ(tiltOf(off->rotation).angle_rad, 0);
  EXPECT_NEAR(yawOf(off->rotation), 0.7, 1e-12);
  EXPECT_THAT(said(report), HasSubstr("points stay tilted"));
}

TEST(Levelling, DrawsATiltWithinTheLimitByNameAndSeed) {
  double most = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) most = std::max(most, drawnTilt(0.01, seed, "S1").angle_rad);
  EXPECT_LE(most, 0.01);
  EXPECT_GT(most, 0.0095);
  EXPECT_NE(drawnTilt(0.01, 1, "S1").towards_rad, drawnTilt(0.01, 1, "S2").towards_rad);
  EXPECT_EQ(drawnTilt(0.01, 1, "S1").towards_rad, drawnTilt(0.01, 1, "S1").towards_rad);
}

// The floor of the lower room as a file has it: the normal of the plane through its points.
struct FloorSeen {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  Pose file_from_scanner;
};

class FloorSink : public PointSink {
 public:
  FloorSeen seen;
  Result<void> begin(const ScanHeader& header) override {
    seen.file_from_scanner = header.file_from_scanner;
    floor_ = static_cast<std::uint32_t>(
        std::find_if(header.products.begin(), header.products.end(), [](const auto& p) { return p.id == "slab0"; }) -
        header.products.begin());
    return {};
  }
  Result<void> write(const PointBlock& b) override {
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (b.product[i] != floor_) continue;
      const Eigen::Vector3d p = seen.file_from_scanner.rotation * Eigen::Vector3d(b.x_m[i], b.y_m[i], b.z_m[i]);
      if (std::abs(p.z() + 1.6) > 0.2) continue;  // the slab's top, not its edges
      sum_ += p;
      products_ += p * p.transpose();
      n_ += 1;
    }
    return {};
  }
  Result<void> end() override {
    const Eigen::Vector3d mean = sum_ / n_;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(products_ / n_ - mean * mean.transpose());
    seen.normal = solver.eigenvectors().col(0);
    if (seen.normal.z() < 0) seen.normal *= -1;
    return {};
  }
  Result<void> close() override { return {}; }

 private:
  std::uint32_t floor_ = 0;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products_ = Eigen::Matrix3d::Zero();
  double n_ = 0;
};

FloorSeen floorOf(const json& scan_options) {
  const TemporaryFolder folder;
  const auto d = run(
      "station", twoStoreyDocument(),
      {{"add", "S"}, {"at", {500002.5, 5600002, 1.6}}, {"yaw-deg", 25}, {"tilt-deg", 1.5}, {"tilt-towards-deg", 60}});
  EXPECT_TRUE(d) << describe(d.error());
  EXPECT_NEAR(d->answer["placed"]["tilt_deg"].get<double>(), 1.5, 1e-9);
  const auto file = folder.path() / "s.e57";
  json options = {
      {"instrument", "faro-focus-s350"}, {"set", {"resolution=1/32", "quality=4x"}}, {"output", file.string()}};
  options.update(scan_options);
  const auto scanned = run("scan", d->document, options);
  EXPECT_TRUE(scanned) << describe(scanned.error());
  FloorSink sink;
  Progress progress;
  EXPECT_TRUE(cloudFormatFor(file)->read(file, sink, progress));
  return sink.seen;
}

TEST(Levelling, AScanOfALeaningStationHasALevelFloorUpToTheCompensatorsError) {
  const auto with = floorOf({{"ideal", true}});
  EXPECT_LT(std::hypot(with.normal.x(), with.normal.y()), 2e-6) << "points in float, nothing else";
  const auto off = floorOf({{"ideal", true}, {"compensator", "off"}});
  EXPECT_NEAR(std::atan2(std::hypot(off.normal.x(), off.normal.y()), off.normal.z()) / kRadPerDeg, 1.5, 1e-4);
  EXPECT_NEAR(std::atan2(off.normal.y(), off.normal.x()) / kRadPerDeg, 60 - 180, 0.01)
      << "the floor leans the other way";
}

TEST(Levelling, TheFilesPoseIsWhatTheDeviceBelievesAndTheFloorLeansByTheDifference) {
  const auto exact = floorOf({{"ideal", true}});
  const auto real = floorOf({{"without", "range-noise,angle-noise,bias,striping,footprint,quantisation"}, {"seed", 7}});
  const double error = between(exact.file_from_scanner.rotation, real.file_from_scanner.rotation);
  EXPECT_GT(error, 1 * kRadPerArcsec);
  EXPECT_LT(error, 80 * kRadPerArcsec);
  EXPECT_NEAR(std::hypot(real.normal.x(), real.normal.y()), error, 3e-6)
      << "analytic: the plane is turned by just that";
}

}  // namespace
}  // namespace standpoint
