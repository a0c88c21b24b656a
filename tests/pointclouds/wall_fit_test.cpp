// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/inspection/wall_fit.h"

#include <cmath>
#include <vector>

#include "core/random.h"
#include "core/units.h"
#include "pointclouds/e57/e57.h"
#include "pointclouds/inspection/region_points.h"
#include "tests/pointclouds/kept_scans.h"
#include "tests/pointclouds/made_up_scan.h"

namespace standpoint {
namespace {

// A plane through `centre` as a scanner in the origin sees it, each point moved along its beam by white noise.
struct MadeWall {
  Eigen::Vector3d centre{5, 0, 0}, along{0, 1, 0}, up{0, 0, 1};
  double sigma_m = 0.002, half_m = 0.6, spacing_m = 0.01;
  double bow_m = 0;  // how far its middle stands out
};

std::vector<BeamPoint> seen(const MadeWall& wall, std::uint32_t seed = 1) {
  std::vector<BeamPoint> points;
  const Eigen::Vector3d normal = wall.along.cross(wall.up);
  const int side = static_cast<int>(std::lround(wall.half_m / wall.spacing_m));
  for (int i = -side; i <= side; ++i)
    for (int k = -side; k <= side; ++k) {
      const double u = i * wall.spacing_m, v = k * wall.spacing_m;
      const Eigen::Vector3d place =
          wall.centre + u * wall.along + v * wall.up + wall.bow_m * (1 - std::pow(u / wall.half_m, 2)) * normal;
      const auto noise =
          normals(philox({seed, 3}, static_cast<std::uint32_t>(i + side), static_cast<std::uint32_t>(k + side), 0));
      const Eigen::Vector3d beam = place.normalized();
      points.push_back({place + wall.sigma_m * noise[0] * beam, beam});
    }
  return points;
}

double angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return std::acos(std::min(1.0, a.dot(b))); }

TEST(WallFit, FindsTheNoiseOfAWallThatStandsSquareToTheBeam) {
  const auto points = seen({});
  const auto fit = fitWall(points, {});
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_EQ(fit->points, points.size());
  EXPECT_GT(fit->fitted, 0.99 * static_cast<double>(points.size()));
  // A normal distribution cut at three sigma has 0.9866 sigma.
  EXPECT_NEAR(fit->sigma_m, 0.9866 * 0.002, 0.02 * 0.002);
  EXPECT_NEAR(*fit->beam_sigma_m, 0.9866 * 0.002, 0.02 * 0.002);
  EXPECT_LE(fit->max_m, 3.1 * 0.002);
  EXPECT_LT(angle(fit->normal, -Eigen::Vector3d::UnitX()), 2e-4);
  EXPECT_FALSE(fit->level);
  EXPECT_LT(fit->tilt_rad, 2e-4);
  EXPECT_NEAR(fit->width_m, 1.2, 0.02);
  EXPECT_NEAR(fit->height_m, 1.2, 0.02);
}

// Pure noise sigma gives a mean roughness of sigma * sqrt(2 / pi) * sqrt(1 + 1 / n), here with n near 78 neighbours.
TEST(WallFit, StatesARoughnessWithItsRadius) {
  const auto fit = fitWall(seen({}), {});
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->roughness.radius_m, 0.05);
  EXPECT_GT(fit->roughness.samples, 1000u);
  EXPECT_NEAR(fit->roughness.mean_m, 0.002 * std::sqrt(2 / M_PI) * std::sqrt(1 + 1 / 78.0), 0.05 * 0.0016);
}

TEST(WallFit, TellsNoiseAlongTheBeamFromResidualsAtASlant) {
  const double slant = 55 * kRadPerDeg;
  const auto fit = fitWall(seen({.along = {-std::sin(slant), std::cos(slant), 0}, .sigma_m = 0.003}), {});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(*fit->beam_sigma_m, 0.9866 * 0.003, 0.03 * 0.003);
  EXPECT_NEAR(fit->sigma_m, std::cos(slant) * 0.9866 * 0.003, 0.05 * 0.003);
  EXPECT_NEAR(*fit->incidence_rad, slant, 0.02);
}

TEST(WallFit, MeasuresHowFarAWallIsOutOfPlumbAndAFloorOutOfLevel) {
  const double lean = 0.8 * kRadPerDeg;
  const auto wall = fitWall(seen({.up = {std::sin(lean), 0, std::cos(lean)}}), {});
  ASSERT_TRUE(wall);
  EXPECT_FALSE(wall->level);
  EXPECT_NEAR(wall->tilt_rad, lean, 0.02 * kRadPerDeg);
  const auto floor =
      fitWall(seen({.centre = {0.5, 0, -1.5}, .along = {std::cos(lean), 0, std::sin(lean)}, .up = {0, 1, 0}}), {});
  ASSERT_TRUE(floor);
  EXPECT_TRUE(floor->level);
  EXPECT_NEAR(floor->tilt_rad, lean, 0.02 * kRadPerDeg);
  EXPECT_GT(floor->normal.z(), 0.9);  // towards the scanner above it
}

// A quarter of the points lie on furniture and a wall behind.
TEST(WallFit, IsNotMovedByWhatStandsBeforeTheWall) {
  auto points = seen({});
  const auto alone = fitWall(points, {});
  const std::size_t wall = points.size();
  for (std::uint32_t i = 0; points.size() < wall * 4 / 3; ++i) {
    const auto random = philox({5, 5}, i, 0, 0);
    const Eigen::Vector3d place(4.2 + 0.75 * uniform(random[0]), uniform(random[1]) - 0.5, uniform(random[2]) - 0.5);
    points.push_back({place, place.normalized()});
  }
  const auto fit = fitWall(points, {});
  ASSERT_TRUE(fit && alone);
  EXPECT_LT(angle(fit->normal, alone->normal), 5e-4);
  EXPECT_NEAR(fit->normal.dot(fit->centre - Eigen::Vector3d(5, 0, 0)), 0, 2e-4);
  EXPECT_NEAR(fit->sigma_m, alone->sigma_m, 0.05 * alone->sigma_m);
}

TEST(WallFit, TakesOfTwoWallsInACornerTheOneThatTheModelsFaceIs) {
  auto points = seen({.centre = {5, 0.6, 0}});
  const auto other = seen({.centre = {4.4, 1.2, 0}, .along = {-1, 0, 0}}, 2);
  points.insert(points.end(), other.begin(), other.end());
  for (const Eigen::Vector3d& wanted : {Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(0, -1, 0)}) {
    const auto fit = fitWall(points, {.normal = wanted});
    ASSERT_TRUE(fit);
    EXPECT_LT(angle(fit->normal, wanted), 2e-3);
  }
  EXPECT_FALSE(fitWall(other, {.normal = Eigen::Vector3d(0, 0, 1)}));
}

// The same points through the normal equations of x = a + b y + c z, which a plane square to X may be fitted by.
TEST(WallFit, AgreesWithAFitOfAnotherKind) {
  const auto points = seen({.up = {0.05, 0, 1}});
  const auto fit = fitWall(points, {});
  ASSERT_TRUE(fit);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const auto& p : points) {
    if (std::abs(fit->normal.dot(p.place - fit->centre)) > fit->max_m) continue;
    const Eigen::Vector3d row(1, p.place.y(), p.place.z());
    normal += row * row.transpose();
    right += row * p.place.x();
  }
  const Eigen::Vector3d x = normal.inverse() * right;
  const Eigen::Vector3d expected = Eigen::Vector3d(-1, x[1], x[2]).normalized();
  EXPECT_LT(angle(fit->normal, expected), 2e-6);
  EXPECT_NEAR(fit->centre.x(), x[0] + x[1] * fit->centre.y() + x[2] * fit->centre.z(), 1e-8);
}

TEST(WallFit, ShowsABowInTheProfileAcrossAndNotInTheOneUpward) {
  const auto fit = fitWall(seen({.sigma_m = 0.0005, .bow_m = 0.004}), {});
  ASSERT_TRUE(fit);
  const auto reach = [](const WallProfile& profile) {
    double low = 1, high = -1;
    for (const auto& bin : profile.bins)
      if (bin.points > 0) low = std::min(low, bin.mean_m), high = std::max(high, bin.mean_m);
    return high - low;
  };
  EXPECT_NEAR(reach(fit->across), 0.004, 0.0006);
  EXPECT_LT(reach(fit->upward), 0.0003);
}

TEST(WallFit, CountsEveryPointInTheHistogramOrBeyondIt) {
  const auto points = seen({});
  const auto fit = fitWall(points, {});
  ASSERT_TRUE(fit);
  std::size_t counted = fit->beyond;
  for (const auto n : fit->histogram) counted += n;
  EXPECT_EQ(counted, points.size());
  EXPECT_GT(fit->histogram[WallFit::kBins / 2], fit->histogram[5]);
}

TEST(WallFit, RefusesFewPointsAndPointsOnALine) {
  const auto few = seen({.half_m = 0.05});
  EXPECT_FALSE(fitWall(few, {}));
  std::vector<BeamPoint> line;
  for (int i = 0; i < 500; ++i) line.push_back({{5, 0.001 * i, 0}, Eigen::Vector3d::UnitX()});
  EXPECT_FALSE(fitWall(line, {}));
}

void writeScan(const std::filesystem::path& file, const std::vector<BeamPoint>& points, const Pose& pose) {
  auto writer = e57::createWriter(file);
  ASSERT_OK(writer);
  auto header = testing::madeUpHeader({static_cast<std::uint32_t>(points.size()), 1, false, false, "S1"});
  header.file_from_scanner = pose;
  PointBlock block;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f p = points[i].place.cast<float>();
    block.x_m.push_back(p.x()), block.y_m.push_back(p.y()), block.z_m.push_back(p.z());
    block.intensity.push_back(0.5F);
    block.row.push_back(static_cast<std::uint32_t>(i)), block.column.push_back(0);
  }
  ASSERT_OK((*writer)->begin(header));
  ASSERT_OK((*writer)->write(block));
  ASSERT_OK((*writer)->end());
  ASSERT_OK((*writer)->close());
}

TEST(RegionPoints, AreThePointsOfTheFileThatLieInTheBallWithTheirBeams) {
  const TemporaryFolder folder;
  Pose pose;
  pose.translation = {100.25, 200, 3};
  const auto points = seen({});
  writeScan(folder / "wall.e57", points, pose);
  Progress progress;
  const Ball ball{pose * Eigen::Vector3d(5, 0, 0), 0.3};
  const auto region = readRegion(folder / "wall.e57", ball, progress);
  ASSERT_OK(region);
  EXPECT_EQ(region->read, points.size());
  std::size_t expected = 0;
  for (const auto& p : points) expected += (p.place - Eigen::Vector3d(5, 0, 0)).norm() <= 0.3 ? 1 : 0;
  EXPECT_NEAR(static_cast<double>(region->points.size()), static_cast<double>(expected), 2);
  for (const auto& p : region->points) {
    EXPECT_LT((p.place - ball.centre).norm(), 0.3001);
    EXPECT_LT((p.beam - (p.place - pose.translation).normalized()).norm(), 1e-6);
  }
  const auto fit = fitWall(region->points, {});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(*fit->beam_sigma_m, 0.9866 * 0.002, 0.06 * 0.002);
  const auto thinned = readRegion(folder / "wall.e57", ball, progress, 1000);
  ASSERT_OK(thinned);
  EXPECT_EQ(thinned->inside, region->points.size());
  EXPECT_LE(thinned->points.size(), 1000u);
  EXPECT_GT(thinned->points.size(), 400u);
}

}  // namespace
}  // namespace standpoint
