// SPDX-License-Identifier: GPL-3.0-or-later
// What moves while it is scanned against what follows from how it does (docs/explanation/mobile.md).
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "core/portable_math.h"
#include "core/units.h"
#include "scanners/engine/timed_scene.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using namespace testing;

class Moves final : public PoseFunction {
 public:
  explicit Moves(const Eigen::Vector3d& speed, double yaw_radps = 0, const Eigen::Vector3d& about = {0, 0, 0},
                 const Eigen::Vector3d& axis = Eigen::Vector3d::UnitZ())
      : speed_(speed), yaw_radps_(yaw_radps), about_(about), axis_(axis) {}
  Pose pose(double time_s) const override {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(yaw_radps_ * time_s, axis_));
    return {turn, about_ - turn * about_ + time_s * speed_};
  }
  double first_s() const override { return 0; }
  double last_s() const override { return 1e9; }

 private:
  Eigen::Vector3d speed_;
  double yaw_radps_;
  Eigen::Vector3d about_, axis_;
};

std::vector<std::uint32_t> instancesOf(const Environment& environment, std::uint32_t product) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < environment.instances.size(); ++i)
    if (environment.instances[i].product == product) found.push_back(i);
  return found;
}

struct MovingScene {
  SceneBuilder builder;
  std::vector<MovingBody> bodies;
  void move(std::uint32_t product, PoseFunctionPtr how) {
    bodies.push_back({instancesOf(*builder.environment(), product), std::move(how)});
  }
  std::shared_ptr<const RayScene> build() const {
    Progress progress;
    return *RayScene::build(builder.environment(), progress, {}, {}, bodies);
  }
};

// A whole round, whose front half goes clockwise past x at half of the time, when the bodies' clock shows 0. Points in
// the local frame.
Scanned frontOver(const MovingScene& scene, double seconds, std::uint32_t columns, double half_high_deg,
                  std::uint32_t rows, const Effects& effects) {
  const Instrument device = instrument("leica-rtc360");
  ScanSettings settings = window(device, 0, 360, -half_high_deg, half_high_deg, columns, rows);
  settings.scan_seconds = seconds + device.overhead_s, settings.passes = 1;
  PointsKept sink;
  Progress progress;
  ScanOptions options{1, effects};
  options.channels = {.time = true, .returns = true, .truth = true};
  options.bodies_ahead_s = -seconds / 2;
  const Pose pose{Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ())),
                  Eigen::Vector3d::Zero()};
  const auto count =
      scan(*scene.build(), allOf(*scene.builder.environment(), 0.5), device, settings, pose, options, sink, progress);
  EXPECT_TRUE(count) << (count ? "" : count.error().message);
  for (std::size_t i = 0; i < sink.all.size(); ++i) {
    const float x = sink.all.x_m[i];
    sink.all.x_m[i] = -sink.all.y_m[i], sink.all.y_m[i] = x;
  }
  return {std::move(sink.all), count.value_or(ScanCount{})};
}

TEST(MovingBodies, AreMetWhereTheyAreAtEachRaysOwnTime) {
  MovingScene scene;
  scene.builder.quad({50, -50, -50}, {0, 100, 0}, {0, 0, 100});
  const auto plate = scene.builder.box({5, -0.5, -0.5}, {5.1, 0.5, 0.5}, false);
  scene.move(plate, std::make_shared<Moves>(Eigen::Vector3d(1, 0, 0)));
  const auto built = scene.build();
  TimedScene timed(dynamic_cast<const EmbreeScene&>(*built), {});
  for (const double time_s : {0.0, 0.1, 0.25, 3.9999, 7.0, 100.0}) {
    const NearestHit hit = timed.nearest({0, 0.1, 0.2}, {1, 0, 0}, 0, 100, time_s);
    const double range = time_s < 44 ? 5 + time_s : 50;
    ASSERT_NE(hit.facet, kNoFacet);
    EXPECT_NEAR(static_cast<double>(hit.range_m), range, 2e-4) << time_s;
    const Facet facet = timed.at(dynamic_cast<const EmbreeScene&>(*built).facet(hit.facet), time_s);
    EXPECT_NEAR(facet.offset / facet.normal.x(), range, 1e-9);
    EXPECT_EQ(facet.body == kNoBody, time_s > 44);
  }
  // Aside of it nothing is in the way.
  EXPECT_NEAR(static_cast<double>(timed.nearest({0, 0.6, 0.2}, {1, 0, 0}, 0, 100, 1).range_m), 50, 2e-4);
}

// A blade's edge from the hub on, at random times and radii: met on one side of where it exactly is, missed on the
// other, whatever the windows are.
TEST(MovingBodies, HaveTheirEdgesWhereAnExactRotationPutsThem) {
  MovingScene scene;
  const auto blade = scene.builder.box({-1, 8, -0.1}, {1, 58, 0.1}, false);
  const double rate = 1.2;
  scene.move(blade, std::make_shared<Moves>(Eigen::Vector3d::Zero(), rate));
  const auto built = scene.build();
  TimedScene timed(dynamic_cast<const EmbreeScene&>(*built), {});
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> times(0, 600), radii(8.1, 57.9);
  for (int k = 0; k < 2000; ++k) {
    const double time_s = times(random), radius = radii(random);
    const Eigen::AngleAxisd turn(rate * time_s, Eigen::Vector3d::UnitZ());
    for (const double off : {-0.0005, 0.0005}) {
      const Eigen::Vector3d place = turn * Eigen::Vector3d(1 + off, radius, 0);
      const NearestHit hit = timed.nearest(place + Eigen::Vector3d(0, 0, 20), {0, 0, -1}, 0, 100, time_s);
      ASSERT_EQ(hit.facet != kNoFacet, off < 0) << time_s << " " << radius;
    }
  }
}

// Width of the streak, w / |1 - v/(ΩR)|, mirrored where the walker is faster than the front; 180° in 26 s at 8 m.
TEST(MovingBodies, AreAsWideAsTheFrontOfTheScanFindsThem) {
  const double front = std::numbers::pi / 26, distance = 8;
  struct Case {
    double speed, width;
    bool mirrored;
  };
  for (const Case& c : {Case{1.34, 1.295, true}, Case{0.5, 1.036, false}, Case{-1.34, 0.210, false}}) {
    MovingScene scene;
    // A cylinder of small plates that keep their distance: turning about the scanner with the tangential speed. Dark on
    // its right, so that it shows which way round it is.
    const double angular = c.speed / distance, width = 0.5;
    SceneBuilder& builder = scene.builder;
    const double half_rad = width / distance / 2, middle = 0;
    const auto at = [&](double angle, double z) {
      return Eigen::Vector3d(distance * std::cos(angle), distance * std::sin(angle), z);
    };
    std::vector<std::uint32_t> halves;
    for (int k = 0; k < 2; ++k) {
      const double from = middle + (k - 1) * half_rad, to = middle + k * half_rad;
      halves.push_back(builder.quad(at(from, -1), at(to, -1) - at(from, -1), {0, 0, 2}));
    }
    // The front goes clockwise.
    for (const auto product : halves) scene.move(product, std::make_shared<Moves>(Eigen::Vector3d(0, 0, 0), -angular));
    const Scanned scan = frontOver(scene, 26, 36000, 5, 21, Effects::none());
    ASSERT_GT(scan.points.size(), 100U);
    std::map<std::uint32_t, std::pair<double, double>> span;  // of each half: angles
    double least = 1e9, most = -1e9, first_time = 1e9, last_time = -1e9;
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
      if (std::abs(scan.points.time_s[i] - 13) > 3) continue;  // the back half of the front may meet it, too
      const double angle = std::atan2(scan.points.y_m[i], scan.points.x_m[i]);
      auto& of = span.try_emplace(scan.points.product[i], 1e9, -1e9).first->second;
      of.first = std::min(of.first, angle), of.second = std::max(of.second, angle);
      least = std::min(least, angle), most = std::max(most, angle);
      first_time = std::min(first_time, scan.points.time_s[i]), last_time = std::max(last_time, scan.points.time_s[i]);
      EXPECT_TRUE(scan.points.truth.flags[i] & point_flag::kMoving);
    }
    EXPECT_NEAR((most - least) * distance, c.width, 0.03 * c.width) << c.speed;
    EXPECT_NEAR(last_time - first_time, c.width / distance / front, 0.03 * c.width / distance / front);
    const bool right_way_round = span[halves[0]].first < span[halves[1]].first;  // at rest 0 is on the right
    EXPECT_EQ(right_way_round, !c.mirrored) << c.speed;
  }
}

// Away at 1.34 m/s: the depth that it gains while the front passes it.
TEST(MovingBodies, AreShearedWhenTheyGoAway) {
  MovingScene scene;
  const auto plate = scene.builder.quad({8, -0.25, -1}, {0, 0.5, 0}, {0, 0, 2});
  scene.move(plate, std::make_shared<Moves>(Eigen::Vector3d(1.34, 0, 0)));
  const PointBlock points = frontOver(scene, 26, 36000, 1, 11, Effects::none()).points;
  ASSERT_GT(points.size(), 100U);
  const auto [nearest, farthest] = std::minmax_element(points.x_m.begin(), points.x_m.end());
  EXPECT_NEAR(static_cast<double>(*farthest - *nearest), 0.693, 0.03 * 0.693);
}

Instrument rangeMeter(double hertz) {
  Instrument device = instrument("velodyne-vlp-16");
  MovingHead& head = *device.moving;
  head.channel_elevations_rad = {0};
  head.channel_heights_m = {};
  head.firing_s = 1 / hertz, head.channel_s = 0;
  head.points_per_s = hertz;
  device.max_range_m = 300;
  return device;
}

Scanned fixedBeam(const RayScene& scene, const Instrument& device, const Pose& pose, double seconds,
                  ScanOptions options = {1, Effects::none()}, double rotation_hz = 0) {
  ScanSettings settings = *resolveMovingSettings(device, {});
  settings.rotation_hz = rotation_hz;
  settings.max_range_m = device.max_range_m;
  const ConstantPose still(pose);
  PointsKept sink;
  Progress progress;
  options.channels = {.time = true, .returns = true, .truth = true};
  const auto count = scan(scene, allOf(scene.environment(), 0.5), device, settings,
                          {.true_pose = still, .to_s = seconds}, options, sink, progress);
  EXPECT_TRUE(count) << (count ? "" : count.error().message);
  return {std::move(sink.all), count.value_or(ScanCount{})};
}

// 4.5 m at 13.9 m/s: 3237 pulses of 10 kHz; of 100 lines a second 32 or 33 profiles 139 mm apart.
TEST(MovingBodies, PassAFixedBeamForAsLongAsTheyAre) {
  MovingScene scene;
  const auto car = scene.builder.box({6, -20, -1}, {7.8, -15.5, 1}, false);
  scene.move(car, std::make_shared<Moves>(Eigen::Vector3d(0, 13.9, 0)));
  const auto rays = scene.build();
  const auto points = fixedBeam(*rays, rangeMeter(10000), Pose{}, 2.5).points;
  EXPECT_NEAR(static_cast<double>(points.size()), 3237, 1);
  const Instrument lines = rangeMeter(100000);
  // A mirror of 100 Hz that turns in the plane across the road.
  const Pose across{Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX())),
                    Eigen::Vector3d::Zero()};
  const auto profiles = fixedBeam(*rays, lines, across, 2.5, {1, Effects::none()}, 100).points;
  std::map<int, double> when;  // of each turn
  for (std::size_t i = 0; i < profiles.size(); ++i)
    if (profiles.x_m[i] < 6.001F)
      when.try_emplace(static_cast<int>(profiles.time_s[i] * 100 + 0.5), profiles.time_s[i]);
  EXPECT_GE(when.size(), 32U);
  EXPECT_LE(when.size(), 33U);
  for (auto at = when.begin(), next = std::next(at); next != when.end(); ++at, ++next)
    EXPECT_NEAR((next->second - at->second) * 13.9, 0.139, 0.002);
}

// At 1.2 rad/s about an axis along the beam, 3° of torsion, 40 m from the axis: a strip in the plane across the axis
// (x), 2 m along z at y = radius, twisted about y. At 0 s its middle is in the beam.
struct TurningBlade {
  double rate = 1.2, radius_m = 40, twist_rad = 3 * kRadPerDeg, chord_m = 2;
  MovingScene scene;
  std::shared_ptr<const RayScene> rays;
  Pose beside{Eigen::Quaterniond::Identity(), {0, radius_m, 0}};
  TurningBlade() {
    const Eigen::Vector3d chord(chord_m * std::sin(twist_rad), 0, chord_m * std::cos(twist_rad));
    const auto blade = scene.builder.quad(Eigen::Vector3d(100, 20, 0) - chord / 2, {0, 40, 0}, chord);
    scene.move(blade, std::make_shared<Moves>(Eigen::Vector3d::Zero(), rate, Eigen::Vector3d(100, 0, 0),
                                              Eigen::Vector3d::UnitX()));
    rays = scene.build();
  }
  double passage_s() const { return 2 * std::asin(std::cos(twist_rad) * chord_m / 2 / radius_m) / rate; }
  // Depth over chord: the slope of a straight line through the points in the blade's own frame.
  double torsionOf(const PointBlock& points, double ahead_s = 0) const {
    double sum_x = 0, sum_z = 0, sum_xx = 0, sum_xz = 0;
    const auto count = static_cast<double>(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::AngleAxisd back(-rate * (points.time_s[i] + ahead_s), Eigen::Vector3d::UnitX());
      const Eigen::Vector3d place = back * Eigen::Vector3d(points.x_m[i], points.y_m[i], points.z_m[i]);
      sum_x += place.z(), sum_z += place.x(), sum_xx += place.z() * place.z(), sum_xz += place.z() * place.x();
    }
    return std::atan((count * sum_xz - sum_x * sum_z) / (count * sum_xx - sum_x * sum_x));
  }
};

// Seen along the axis by 50 kHz: 2083 pulses, and its torsion.
TEST(MovingBodies, KeepTheTorsionOfABlade) {
  const TurningBlade blade;
  // Until it comes by a second time it is gone.
  const auto ideal = fixedBeam(*blade.rays, rangeMeter(50000), blade.beside, 0.05).points;
  const auto passing = fixedBeam(*blade.rays, rangeMeter(50000), blade.beside, 6).points;
  std::size_t second = 0;
  for (const double time_s : passing.time_s) second += time_s > 1 ? 1 : 0;
  // Round once more; the first pass begins in its middle. 2083 of a chord that lies in the plane.
  EXPECT_NEAR(static_cast<double>(second), blade.passage_s() * 50000, 1);
  EXPECT_NEAR(blade.torsionOf(ideal) / kRadPerDeg, 3.000, 0.001);
}

// M11 with 2 mm of noise: one passage finds the torsion with a σ of σ_r √12 / (c √N) = 0.0043°.
TEST(MovingBodies, KeepTheTorsionOfABladeWithinTheNoiseOfItsPoints) {
  const TurningBlade blade;
  Instrument meter = withoutBias(rangeMeter(50000));
  meter.range_noise = {{100, 0.5, 0.002}};
  meter.correlated = {};
  constexpr int kPassages = 100;
  const double before_s = 0.025;  // of the blade's middle
  double sum = 0, squares = 0;
  for (int k = 0; k < kPassages; ++k) {
    ScanOptions options{static_cast<std::uint64_t>(k) + 1, Effects::none().with(Effect::range_noise)};
    options.bodies_ahead_s = -before_s;
    const auto points = fixedBeam(*blade.rays, meter, blade.beside, 2 * before_s, options).points;
    ASSERT_NEAR(static_cast<double>(points.size()), 2083, 5);
    const double off = blade.torsionOf(points, -before_s) / kRadPerDeg - 3;
    sum += off, squares += off * off;
  }
  const double mean = sum / kPassages, sigma = std::sqrt(squares / kPassages - mean * mean);
  RecordProperty("sigma_deg", std::to_string(sigma));
  EXPECT_NEAR(sigma, 0.0043, 0.0009) << "three σ of a σ of 100";
  EXPECT_NEAR(mean, 0, 3 * 0.0043 / std::sqrt(kPassages));
}

// A corridor with somebody in it, scanned twice: what either saw past is not the building's.
TEST(MovingBodies, AreFlaggedAndHideWhatIsBehindThem) {
  MovingScene scene;
  const auto wall = scene.builder.quad({5, -10, -2}, {0, 20, 0}, {0, 0, 4});
  const auto walker = scene.builder.box({2.8, -0.25, -1.5}, {3.1, 0.25, 0.3}, false);
  scene.move(walker, std::make_shared<Moves>(Eigen::Vector3d(0, -0.3, 0)));
  const Scanned scan = frontOver(scene, 26, 8000, 20, 101, Effects{});
  std::size_t on_wall = 0, on_walker = 0;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const bool moving = (scan.points.truth.flags[i] & point_flag::kMoving) != 0;
    EXPECT_EQ(moving, scan.points.product[i] == walker);
    (moving ? on_walker : on_wall) += 1;
    EXPECT_TRUE(moving || scan.points.product[i] == wall);
  }
  EXPECT_GT(on_wall, 10000U);
  EXPECT_GT(on_walker, 1000U);
  EXPECT_LT(on_wall + on_walker, scan.count.pulses + scan.count.pulses / 20);
}

// A grille of bars with a surface close behind, one far behind and none. Of the points between edge and background that
// there are where 64 rays of each beam are traced, as large a share is there where edges are looked for as of bars that
// stand.
TEST(MovingBodies, HaveMixedPointsAtTheirEdgesAsWhatStandsHas) {
  const Instrument device = instrument("leica-rtc360");
  ScanSettings settings = window(device, -12, 12, -14, 14, 300, 350);
  settings.scan_seconds = 6;
  std::map<bool, double> share;
  for (const bool moving : {false, true}) {
    MovingScene scene;
    scene.builder.quad({9, -10, -4}, {0, 20, 0}, {0, 0, 4});
    scene.builder.quad({6.3, -1, -2}, {0, 1, 0}, {0, 0, 4});
    for (int k = 0; k < 10; ++k) {
      const auto bar = scene.builder.box({6, -1 + 0.2 * k, -1}, {6.1, -0.95 + 0.2 * k, 1}, false);
      if (moving) scene.move(bar, std::make_shared<Moves>(Eigen::Vector3d(0.02, 0.05 + 0.01 * k, 0), 0.02));
    }
    const auto rays = scene.build();
    std::map<bool, std::size_t> points, mixed;
    for (const bool reference : {false, true}) {
      PointsKept sink;
      Progress progress;
      ScanOptions options{1, Effects::none().with(Effect::footprint)};
      options.quality = reference ? ScanQuality::reference : ScanQuality::standard;
      options.channels.truth = true;
      ASSERT_TRUE(
          scan(*rays, allOf(*scene.builder.environment(), 0.5), device, settings, Pose{}, options, sink, progress));
      points[reference] = sink.all.size();
      for (const auto flags : sink.all.truth.flags) mixed[reference] += (flags & point_flag::kMixed) != 0 ? 1 : 0;
    }
    EXPECT_GT(mixed[true], 1000U);
    EXPECT_NEAR(static_cast<double>(points[false]), static_cast<double>(points[true]),
                0.002 * static_cast<double>(points[true]));
    share[moving] = static_cast<double>(mixed[false]) / static_cast<double>(mixed[true]);
  }
  EXPECT_NEAR(share[true], share[false], 0.06 * share[false]);
}

TEST(MovingBodies, GiveTheSamePointsOnAnyThreadsAndInAnyParts) {
  MovingScene scene;
  scene.builder.box({-4, -3, -1.7}, {5, 6, 2}, true);
  for (int k = 0; k < 12; ++k) {
    const auto body = scene.builder.box({0.9 + 0.2 * k, -0.2, -1.5}, {1.0 + 0.2 * k, 0.1, 0.2}, false);
    scene.move(body, std::make_shared<Moves>(Eigen::Vector3d(0.02 * k, 0.1, 0), 0.3 * k));
  }
  const Instrument device = instrument("leica-rtc360");
  ScanSettings settings = window(device, -60, 60, -30, 30, 200, 150);
  settings.scan_seconds = 5;
  const auto with = [&](int threads, std::uint32_t from, std::uint32_t to) {
    PointsKept sink;
    Progress progress;
    ScanOptions options{5, Effects{}};
    options.channels = {.time = true, .returns = true, .truth = true};
    options.threads = threads, options.first_column = from, options.end_column = to;
    EXPECT_TRUE(scan(*scene.build(), allOf(*scene.builder.environment(), 0.5), device, settings, Pose{}, options, sink,
                     progress));
    return std::move(sink.all);
  };
  const PointBlock whole = with(1, 0, ~0U);
  ASSERT_GT(whole.size(), 25000U);
  const auto same = [](const PointBlock& a, const PointBlock& b, std::size_t from) {
    return std::memcmp(a.x_m.data() + from, b.x_m.data(), b.size() * sizeof(float)) == 0 &&
           std::memcmp(a.intensity.data() + from, b.intensity.data(), b.size() * sizeof(float)) == 0 &&
           std::memcmp(a.product.data() + from, b.product.data(), b.size() * 4) == 0;
  };
  for (const int threads : {2, 64}) {
    const PointBlock other = with(threads, 0, ~0U);
    ASSERT_EQ(other.size(), whole.size());
    EXPECT_TRUE(same(whole, other, 0));
  }
  const PointBlock tail = with(2, 133, ~0U), head = with(2, 0, 133);
  ASSERT_EQ(head.size() + tail.size(), whole.size());
  EXPECT_TRUE(same(whole, tail, head.size()));
  EXPECT_TRUE(same(whole, head, 0));
}

TEST(MovingBodies, AreThereWhileTheyAreSaidToBe) {
  MovingScene scene;
  const auto plate = scene.builder.box({5, -0.5, -0.5}, {5.1, 0.5, 0.5}, false);
  scene.move(plate, std::make_shared<Moves>(Eigen::Vector3d::Zero()));
  scene.bodies[0].from_s = 2, scene.bodies[0].to_s = 3;
  const auto built = scene.build();
  TimedScene timed(dynamic_cast<const EmbreeScene&>(*built), {});
  for (const double time_s : {1.99, 2.0, 2.5, 3.0, 3.01})
    EXPECT_EQ(timed.nearest({0, 0, 0}, {1, 0, 0}, 0, 100, time_s).facet != kNoFacet, time_s >= 2 && time_s <= 3);
}

}  // namespace
}  // namespace standpoint
