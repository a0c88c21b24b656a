// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "core/random.h"
#include "core/units.h"
#include "scanners/engine/footprint.h"
#include "scanners/engine/scene_edges.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using namespace testing;

constexpr Effects kBeamsAlone = Effects::none().with(Effect::footprint);

// `way`: a pose, or a motion.
template <class Way>
Scanned dotted(const SceneBuilder& scene, const Instrument& instrument, const ScanSettings& settings, const Way& way,
               ScanQuality quality = ScanQuality::standard) {
  PointsKept sink;
  Progress progress;
  ScanOptions options{1, kBeamsAlone};
  options.quality = quality;
  options.channels.truth = true;
  const auto count =
      scan(*scene.build(), allOf(*scene.environment(), 0.5), instrument, settings, way, options, sink, progress);
  EXPECT_TRUE(count);
  return {std::move(sink.all), count.value_or(ScanCount{})};
}

// Forty wires of 4 mm at 10 m with nothing behind, at 6 and at 12 mm between pulses, by a beam of 7.8 mm. At 12 mm the
// worst wire has 2 % of the beam's power: near the threshold.
TEST(ThinThings, AreMetHoweverFarApartThePulses) {
  const Instrument instrument = testing::instrument("leica-rtc360");
  SceneBuilder scene;
  const std::uint32_t first = scene.box({-0.002, -0.002, -0.3}, {0.002, 0.002, 0.3}, false);
  scene.hide(first);
  for (std::uint32_t i = 0; i < 40; ++i) {
    const double stray = 0.0012 * (uniform(philox({2, 0}, i, 0, 0)[0]) - 0.5);
    const double azimuth = (-14 + 28.0 * i / 39) * kRadPerDeg + stray;
    scene.again(first, Eigen::Affine3d(Eigen::Translation3d(10 * std::cos(azimuth), 10 * std::sin(azimuth), 0)));
  }
  for (const auto& [step_m, least] : {std::pair{0.006, 40U}, std::pair{0.012, 38U}}) {
    const auto columns = static_cast<std::uint32_t>(30 * kRadPerDeg * 10 / step_m);
    const auto result =
        scanned(*scene.build(), allOf(*scene.environment(), 0.5), instrument,
                window(instrument, -15, 15, -1, 1, columns, columns / 15), {1, Effects().without(Effect::halo)});
    std::set<std::uint32_t> met(result.points.product.begin(), result.points.product.end());
    met.erase(static_cast<std::uint32_t>(scene.environment()->products.size()));
    EXPECT_GE(met.size(), least) << step_m;
  }
}

// The power that a thin strip sends back, in the mean over pulses at each distance from its middle: the beam's Gaussian
// over its width, ½ (erf(√2 (x + a)/w) - erf(√2 (x - a)/w)).
TEST(ThinThings, SendBackTheirShareOfTheBeam) {
  const Instrument instrument = testing::instrument("riegl-vz-400i");
  const double half = 0.0005, radius = beamRadius(instrument, 10);
  SceneBuilder scene;
  scene.quad({10, -half, -2}, {0, 2 * half, 0}, {0, 0, 4});
  const double window_deg = 1.2 * radius / 10 / kRadPerDeg;
  constexpr std::uint32_t kColumns = 21, kRows = 3000;
  const auto settings = window(instrument, -window_deg, window_deg, -1, 1, kColumns, kRows);
  const auto result = dotted(scene, instrument, settings, Pose{});
  std::array<double, kColumns> share{};
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const double x = std::pow(10.0, static_cast<double>(result.points.truth.received_db[i]) / 10);
    share[result.points.column[i]] += x * 100 / 0.5 / kRows;  // of the whole beam's: ρ / R²
  }
  for (std::uint32_t column = 0; column < kColumns; ++column) {
    const double aside = 10 * std::tan((settings.azimuth_from_rad + column * (2 * window_deg * kRadPerDeg / kColumns)));
    const auto below = [&](double place) { return std::erf(std::numbers::sqrt2 * place / radius); };
    EXPECT_NEAR(share[column], 0.5 * (below(aside + half) - below(aside - half)), 0.012) << aside / radius;
  }
}

// How two scans of one grid differ, pulse by pulse.
struct Differences {
  std::size_t others = 0;             // one has no point there, or of another product
  std::size_t astray = 0;             // in power, by more than 0.2 %
  double power = 0, known_power = 0;  // of those, in all
};

Differences between(const PointBlock& found, const PointBlock& known, const ScanSettings& settings) {
  std::vector<std::int64_t> place(std::size_t{settings.columns} * settings.rows, -1);
  for (std::size_t i = 0; i < found.size(); ++i)
    place[std::size_t{found.column[i]} * settings.rows + found.row[i]] = static_cast<std::int64_t>(i);
  Differences differences;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const auto at = place[std::size_t{known.column[i]} * settings.rows + known.row[i]];
    if (at < 0 || found.product[static_cast<std::size_t>(at)] != known.product[i]) {
      ++differences.others;
      continue;
    }
    const double power = std::pow(10, static_cast<double>(found.truth.received_db[static_cast<std::size_t>(at)]) / 10);
    const double known_power = std::pow(10, static_cast<double>(known.truth.received_db[i]) / 10);
    if (std::abs(power / known_power - 1) < 0.002) continue;
    ++differences.astray;
    differences.power += power, differences.known_power += known_power;
  }
  return differences;
}

// What is found by edges is what is found when every beam is looked at, but for bends of one surface, which matter to
// the map within 0.8 w of the axis only. Of a beam that edges cut the power is the mean of what drawn rays say: single
// ones stray from it, together they do not. The tree that beams of a scanner on its way ask finds what the map has.
TEST(Edges, AreWhereverABeamMeetsSeveralSurfaces) {
  for (const char* id : {"leica-rtc360", "zf-imager-5016", "faro-focus-s70"}) {
    const Instrument instrument = testing::instrument(id);
    SceneBuilder scene;
    scene.box({-4, -3, -1.7}, {5, 6, 2}, true);
    scene.box({2, -1, -1.7}, {2.4, -0.4, 0.1}, false);
    scene.quad({1, 2, -1}, {0.002, 0, 0}, {0.3, 0.1, 2.5});   // a wire that leans
    scene.quad({-3, -1, 1.2}, {7, 2, 0}, {0, 0.004, 0});      // and one overhead
    scene.box({1, 3, -1.7}, {1.02, 3.02, 2}, false);          // a pole
    scene.box({-1.5, 1, 0.7}, {-1.4, 1.1, 0.8}, false);       // what floats
    scene.box({0.2, -0.3, -1.1}, {0.3, -0.2, -1.05}, false);  // below
    const auto ball = scene.sphere({3, 3, 0.3}, 0.0725, 30);
    scene.again(ball,
                Eigen::Affine3d(Eigen::Translation3d(-5, 0.3, 0) * Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX())));
    ScanSettings settings = window(instrument, -180, 180, -60, 90, 700, 300);
    const auto turned = Pose{Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Eigen::Vector3d(0.6, 0.8, 0))), {0.1, 0.2, 0.3}};
    const auto found = dotted(scene, instrument, settings, turned);
    const auto all = dotted(scene, instrument, settings, turned, ScanQuality::reference);
    ASSERT_EQ(found.count.pulses, all.count.pulses);
    const auto is_mixed = [](std::uint8_t flags) { return (flags & point_flag::kMixed) != 0; };
    EXPECT_GT(std::count_if(all.points.truth.flags.begin(), all.points.truth.flags.end(), is_mixed), 50) << id;
    const auto count = static_cast<double>(all.points.size());
    EXPECT_NEAR(static_cast<double>(found.points.size()), count, count / 1e4) << id;
    const Differences far = between(found.points, all.points, settings);
    EXPECT_LT(far.others, all.points.size() / 3000) << id;
    EXPECT_LT(far.astray, all.points.size() / 100) << id;
    EXPECT_NEAR(far.power / far.known_power, 1, 0.02) << id;

    const ConstantPose stays(turned);
    const auto carried =
        dotted(scene, instrument, settings, ScanMotion{.true_pose = stays, .to_s = 1e6, .local_from_points = turned});
    EXPECT_EQ(carried.points.size(), found.points.size()) << id;
    const Differences near = between(carried.points, found.points, settings);
    EXPECT_LE(near.others, 2U) << id;
    EXPECT_LT(near.astray, found.points.size() / 5000) << id;
  }
}

// A bar of 12 mm before the sky in a beam of 8: what comes back of its power in the mean, ½ (erf(√2 (x + a)/w) - …),
// and how far single pulses stray from it. Of a preview all or nothing does.
TEST(Quality, IsHowWellAPulseKnowsItsBeam) {
  const Instrument instrument = testing::instrument("leica-rtc360");
  const double half = 0.006, radius = beamRadius(instrument, 10);
  SceneBuilder scene;
  scene.quad({10, -half, -2}, {0, 2 * half, 0}, {0, 0, 4});
  const double aside = half + 0.5 * radius;  // of the axis, from the bar's middle
  constexpr std::uint32_t kRows = 4000;
  const double azimuth_deg = std::atan(aside / 10) / kRadPerDeg;
  const double expected = 0.5 * (std::erf(std::numbers::sqrt2 * (aside + half) / radius) -
                                 std::erf(std::numbers::sqrt2 * (aside - half) / radius));
  for (const auto& [quality, stray] :
       {std::pair{ScanQuality::standard, 0.057}, std::pair{ScanQuality::reference, 0.02}}) {
    ScanOptions options{1, kBeamsAlone};
    options.channels.truth = true;
    options.quality = quality;
    const auto result = scanned(*scene.build(), allOf(*scene.environment(), 0.5), instrument,
                                window(instrument, azimuth_deg, azimuth_deg + 1e-7, -1, 1, 1, kRows), options);
    double sum = 0, square = 0;
    for (const float db : result.points.truth.received_db) {
      const double share = std::pow(10.0, static_cast<double>(db) / 10) * 100 / 0.5;
      sum += share, square += share * share;
    }
    EXPECT_NEAR(sum / kRows, expected, 0.006);
    EXPECT_LT(std::sqrt(square / kRows - sum * sum / kRows / kRows), stray);
  }
  ScanOptions preview{1, kBeamsAlone};
  preview.quality = ScanQuality::preview;
  EXPECT_EQ(scanned(*scene.build(), allOf(*scene.environment(), 0.5), instrument,
                    window(instrument, azimuth_deg, azimuth_deg + 1e-7, -1, 1, 1, kRows), preview)
                .points.size(),
            0U);
}

TEST(Edges, BehindAWallChangeNothing) {
  const Instrument instrument = testing::instrument("leica-rtc360");
  const auto points = [&](bool furnished) {
    SceneBuilder scene;
    scene.quad({5, -4, -3}, {0, 8, 0}, {0, 0, 6});
    for (int i = 0; furnished && i < 20; ++i) scene.box({5.5, -2 + 0.2 * i, -1}, {5.6, -1.9 + 0.2 * i, 0.3}, false);
    return scanned(*scene.build(), allOf(*scene.environment(), 0.5), instrument,
                   window(instrument, -20, 20, -20, 20, 300, 300), {1, Effects()})
        .points;
  };
  const PointBlock bare = points(false), hidden = points(true);
  EXPECT_EQ(bare.x_m, hidden.x_m);
  EXPECT_EQ(bare.intensity, hidden.intensity);
}

TEST(OutlineEdges, OfABoxAreTwelveAndOfASheetItsBounds) {
  SceneBuilder scene;
  scene.box({0, 0, 0}, {1, 2, 3}, false);  // its faces share no vertex
  scene.quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const auto& meshes = scene.environment()->meshes;
  const auto box = outlineEdges(*meshes[0]);
  EXPECT_EQ(box.size(), 12U);
  for (const MeshEdge& edge : box) EXPECT_NE(edge.right, kNoCorner);
  const auto sheet = outlineEdges(*meshes[1]);
  EXPECT_EQ(sheet.size(), 4U);
  for (const MeshEdge& edge : sheet) EXPECT_EQ(edge.right, kNoCorner);
  Mesh twice = *meshes[1];  // both sides of it, as two faces
  for (const Triangle t : meshes[1]->triangles) twice.triangles.push_back({t[2], t[1], t[0]});
  EXPECT_EQ(outlineEdges(twice).size(), 4U);
}

}  // namespace
}  // namespace standpoint
