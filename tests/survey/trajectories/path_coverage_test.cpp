// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/trajectories/path_coverage.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "scanners/instruments/instrument.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using Eigen::Vector3d;

Instrument instrumentOf(const char* id) {
  return *readInstrument(dataFolder() / "scanners" / "instruments" / (std::string(id) + ".json"));
}

// Along y at x = 0, 1.5 m up, from -length/2 to length/2; it looks along x. A length of 0 stands.
CarriedMotion pathOf(double length_m, double seconds = 20) {
  Trajectory samples;
  for (int k = 0; k <= 20; ++k) {
    samples.time_s.push_back(seconds * k / 20);
    samples.pose.push_back({Eigen::Quaterniond::Identity(), {0, length_m * (k / 20.0 - 0.5), 1.5}});
  }
  CarriedMotion carried;
  carried.path = carried.truth = std::make_shared<const PoseSpline>(*PoseSpline::through(samples));
  carried.length_m = length_m;
  return carried;
}

// What a scanner sees of the boxes of an environment.
class PathCoverage : public ::testing::Test {
 protected:
  void SetUp() override { environment->surfaces.push_back({"Concrete", {0.6F, 0.6F, 0.6F, 1}, "#1", {}, {}}); }
  void build() {
    Progress progress;
    scene = *RayScene::build(environment, progress);
    samples = *sampleSurfaces(*scene, 30000, 1, progress);
  }
  std::vector<SampleSight> sightsFrom(const CarriedMotion& path, const char* id = "velodyne-vlp-16",
                                      const PassingBodies* passing = nullptr) {
    Progress progress;
    const auto instrument = instrumentOf(id);
    const auto settings = *resolveMovingSettings(instrument, {});
    const Expectation expectation(scene, std::make_shared<const MaterialAssignment>(), ReturnLaw(instrument, settings));
    return *predictSights(path, expectation, PulseDensity(*instrument.moving, settings), samples, wanted, progress,
                          passing);
  }
  double spacing_m() const { return std::sqrt(samples.each_m2()); }
  std::shared_ptr<Environment> environment = std::make_shared<Environment>();
  std::shared_ptr<const RayScene> scene;
  SurfaceSamples samples;
  CoveredWhen wanted;
};

// A plate of w = 1 m, a = 2 m away, before a wall at b = 5 m: from a path of length P along them the blind strip is
// 2 (b/a) (w/2 - (P/2) (1 - a/b)) wide (mobile.md, M14).
TEST_F(PathCoverage, LeavesAStripBehindAPlateThatALongerPathSees) {
  addBox(*environment, "wall", "IfcWall", {5, -6, 0}, {5.2, 6, 3});
  addBox(*environment, "plate", "IfcPlate", {2, -0.5, 0}, {2.001, 0.5, 3});
  build();
  for (const auto& [length_m, strip_m] : {std::pair{0.0, 2.5}, {1.0, 1.0}, {1.7, 0.0}}) {
    const auto sights = sightsFrom(pathOf(length_m));
    double low = 0, high = 0;
    int blind = 0, seen = 0;
    for (std::size_t k = 0; k < sights.size(); ++k) {
      const auto& place = samples.samples[k].place;
      if (samples.samples[k].product != 0 || std::abs(place.position.x() - 5) > 1e-6) continue;
      if (place.position.z() < 1.2 || place.position.z() > 1.8 || std::abs(place.position.y()) > 4) continue;
      if (sights[k].blind == Blindness::occluded) {
        low = std::min(low, place.position.y()), high = std::max(high, place.position.y());
        ++blind;
      } else {
        EXPECT_EQ(sights[k].blind, Blindness::covered) << place.position.transpose();
        ++seen;
      }
    }
    EXPECT_NEAR(high - low, strip_m, 2 * spacing_m()) << "P = " << length_m;
    EXPECT_EQ(blind > 0, strip_m > 0) << "P = " << length_m;
    EXPECT_GT(seen, 200);
  }
}

// It stands where the plate above stood, or goes away: its shadow of 2.5 m is hidden by it, or has the share of the
// points that came before.
TEST_F(PathCoverage, TellsApartWhatSomethingThatMovesHides) {
  addBox(*environment, "wall", "IfcWall", {5, -6, 0}, {5.2, 6, 3});
  build();
  const auto with_plate = std::make_shared<Environment>(*environment);
  addBox(*with_plate, "plate", "Vehicle", {2, -0.5, 0}, {2.001, 0.5, 3});
  const auto rests = std::make_shared<const ConstantPose>(Pose{});
  const auto passing = [&](double from_s, double to_s) {
    std::vector<MovingBody> bodies{{{}, rests, from_s, to_s}};
    for (std::uint32_t i = 0; i < with_plate->instances.size(); ++i)
      if (with_plate->instances[i].product == 1) bodies[0].instances.push_back(i);
    Progress progress;
    return std::make_unique<PassingBodies>(*RayScene::build(with_plate, progress, {}, {}, bodies), 100);
  };
  wanted.density_per_m2 = 1;
  const auto open = sightsFrom(pathOf(0));
  const auto always = sightsFrom(pathOf(0), "velodyne-vlp-16", passing(0, 1000).get());
  const auto later = sightsFrom(pathOf(0), "velodyne-vlp-16", passing(105, 1000).get());  // it comes after 5 s of 20
  int hidden = 0;
  for (std::size_t k = 0; k < open.size(); ++k) {
    const Vector3d& at = samples.samples[k].place.position;
    if (std::abs(at.x() - 5) > 1e-6 || at.z() < 1.2 || at.z() > 1.8 || std::abs(std::abs(at.y()) - 1.25) < 0.02)
      continue;
    const bool behind = std::abs(at.y()) < 1.25;
    ASSERT_EQ(open[k].blind, Blindness::covered);
    EXPECT_EQ(always[k].blind, behind ? Blindness::passed_by : Blindness::covered) << at.transpose();
    EXPECT_EQ(always[k].density_per_m2, behind ? 0 : open[k].density_per_m2);
    EXPECT_NEAR(later[k].density_per_m2, (behind ? 0.25 : 1) * open[k].density_per_m2, 1e-6 * open[k].density_per_m2);
    hidden += behind ? 1 : 0;
  }
  EXPECT_GT(hidden, 200);
}

TEST_F(PathCoverage, TellsWhyASurfaceIsBlind) {
  addBox(*environment, "wall", "IfcWall", {5, -6, -2}, {5.2, 6, 12});    // 0: above and below the beams of 15 degrees
  addBox(*environment, "far", "IfcWall", {300, -2, 0}, {300.2, 2, 20});  // 1
  addBox(*environment, "along", "IfcWall", {1, 20, 1}, {40, 20.1, 2});   // 2
  addBox(*environment, "box", "IfcFurniture", {3, -3, 0.5}, {3.5, -2, 2.5});  // 3
  build();
  wanted.density_per_m2 = 20;
  auto sights = sightsFrom(pathOf(1));
  const auto shareOf = [&](std::uint32_t product, Blindness blind, const auto& where) {
    int all = 0, of = 0;
    for (std::size_t k = 0; k < sights.size(); ++k)
      if (samples.samples[k].product == product && where(samples.samples[k].place.position)) {
        ++all;
        of += static_cast<int>(sights[k].blind == blind);
      }
    return all == 0 ? -1 : static_cast<double>(of) / all;
  };
  const auto face = [](double x) { return [x](const Vector3d& p) { return std::abs(p.x() - x) < 1e-6; }; };
  EXPECT_GT(shareOf(0, Blindness::covered,
                    [](const Vector3d& p) { return p.x() == 5 && p.z() > 1 && p.z() < 2 && p.y() > 0; }),
            0.95);
  EXPECT_GT(shareOf(0, Blindness::out_of_view, [](const Vector3d& p) { return p.x() == 5 && p.z() > 5; }), 0.95);
  EXPECT_GT(shareOf(0, Blindness::occluded, face(5.2)), 0.95) << "its back";
  EXPECT_GT(shareOf(1, Blindness::out_of_range, face(300)), 0.95);
  EXPECT_GT(shareOf(3, Blindness::covered, face(3)), 0.95);
  EXPECT_GT(shareOf(3, Blindness::occluded, face(3.5)), 0.95);
  wanted.max_incidence_rad = 10 * kRadPerDeg;
  sights = sightsFrom(pathOf(1));
  EXPECT_GT(shareOf(0, Blindness::grazing,
                    [](const Vector3d& p) { return p.x() == 5 && p.z() > 1 && p.z() < 2 && p.y() > 3; }),
            0.95);
}

// A closed box in a room is seen from nowhere inside; the back of a cupboard from behind it.
TEST_F(PathCoverage, TellsApartWhatNoWalkablePlaceSees) {
  addBox(*environment, "floor", "IfcSlab", {-8, -8, -0.2}, {8, 8, 0});
  addBox(*environment, "cupboard", "IfcFurniture", {3, -1, 0}, {4, 1, 2.5});
  addBox(*environment, "shelf", "IfcPlate", {-4, -4, 0.05}, {-2, -2, 0.06});  // its lower side is seen by nobody
  build();
  const auto path = pathOf(2);
  auto sights = sightsFrom(path);
  const auto places = walkablePlaces(*scene, nullptr, 1.5);
  EXPECT_GT(places.size(), 150U);
  Progress progress;
  ASSERT_TRUE(findUnreachable(sights, samples, *scene, places, 100, wanted, progress));
  int back = 0, back_unreachable = 0, below = 0, below_unreachable = 0;
  for (std::size_t k = 0; k < sights.size(); ++k) {
    const auto& s = samples.samples[k];
    if (!s.exposed) continue;
    if (s.product == 1 && s.place.position.x() > 3.999) {
      ++back;
      back_unreachable += static_cast<int>(sights[k].blind == Blindness::unreachable);
    }
    if (s.product == 2 && s.place.position.z() < 0.0501) {
      ++below;
      below_unreachable += static_cast<int>(sights[k].blind == Blindness::unreachable);
    }
  }
  EXPECT_GT(back, 50);
  EXPECT_EQ(back_unreachable, 0);
  EXPECT_GT(below, 20);
  EXPECT_GT(below_unreachable, 0.9 * below);
}

TEST_F(PathCoverage, CountsPassesThatLieApart) {
  addBox(*environment, "wall", "IfcWall", {5, -1, 0}, {5.2, 1, 3});
  build();
  // Past it, 40 m away, and back again.
  Trajectory samples_of_way;
  const double y[] = {0, -60, 0};
  for (int k = 0; k <= 2; ++k) {
    samples_of_way.time_s.push_back(100.0 * k);
    samples_of_way.pose.push_back({Eigen::Quaterniond::Identity(), {0, y[k], 1.5}});
  }
  CarriedMotion carried;
  carried.path = carried.truth = std::make_shared<const PoseSpline>(*PoseSpline::through(samples_of_way));
  carried.length_m = 120;
  wanted.max_incidence_rad = 60 * kRadPerDeg;
  const auto sights = sightsFrom(carried);
  const auto once = sightsFrom(pathOf(1));
  for (std::size_t k = 0; k < sights.size(); ++k) {
    if (samples.samples[k].place.position.x() != 5 || std::abs(samples.samples[k].place.position.z() - 1.5) > 0.5)
      continue;
    EXPECT_EQ(sights[k].passes, 2U);
    EXPECT_EQ(once[k].passes, 1U);
    EXPECT_LT(sights[k].first_s, 30);
    EXPECT_GT(sights[k].last_s, 170);
  }
  const auto both = together(std::vector{&sights, &once}, wanted);
  for (std::size_t k = 0; k < both.size(); ++k) EXPECT_EQ(both[k].passes, sights[k].passes + once[k].passes);
}

// The same number of pulses, wherever they go.
TEST(PulseDensity, AddsUpToThePulsesOfASecond) {
  for (const char* id : {"velodyne-vlp-16", "hesai-xt32", "leica-blk2go", "ouster-os1-128", "riegl-vux-1uav"}) {
    const auto instrument = instrumentOf(id);
    const auto settings = *resolveMovingSettings(instrument, {});
    const PulseDensity density(*instrument.moving, settings);
    double sum = 0;
    constexpr int kRows = 720, kColumns = 1440;
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < kColumns; ++column) {
        const double elevation = ((row + 0.5) / kRows - 0.5) * std::numbers::pi,
                     azimuth = (column + 0.5) / kColumns * 2 * std::numbers::pi;
        const double solid = std::cos(elevation) * std::numbers::pi / kRows * 2 * std::numbers::pi / kColumns;
        sum += solid * density.along({std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                      std::sin(elevation)});
      }
    const auto& head = *instrument.moving;
    const double sent = static_cast<double>(head.channel_elevations_rad.size()) * head.heads / settings.firing_s;
    const double measured = head.turn_rad > 0 ? head.turn_rad / (2 * std::numbers::pi) : 1;
    EXPECT_NEAR(sum / (sent * measured), 1, 0.03) << id;
  }
}

}  // namespace
}  // namespace standpoint
