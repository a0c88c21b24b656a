// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/target_network.h"

#include <cmath>

#include <gmock/gmock.h>

#include "core/match_places.h"
#include "core/random.h"
#include "core/rigid_fit.h"

namespace standpoint {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;

std::vector<Vector3d> places(std::size_t n) {
  std::vector<Vector3d> all;
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto r = philox({3, 9}, i, 0, 0);
    all.emplace_back(20 * uniform(r[0]) - 10, 20 * uniform(r[1]) - 10, 4 * uniform(r[2]));
  }
  return all;
}

Pose poseOf(double x, double y, double yaw) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Vector3d::UnitZ())), {x, y, 1.6}};
}

Vector3d noise(std::uint32_t run, std::uint32_t station, std::uint32_t target) {
  const auto n = normals(philox({run, 4}, station, target, 0));
  return {n[0], n[1], n[2]};
}

TargetNetwork seen(const std::vector<Vector3d>& targets, const std::vector<Pose>& stations, double sigma_m,
                   std::uint32_t run) {
  TargetNetwork network{stations.size(), targets.size(), {}, {}, std::pair{std::size_t{0}, stations[0]}};
  for (std::size_t s = 0; s < stations.size(); ++s)
    for (std::size_t t = 0; t < targets.size(); ++t)
      network.sightings.push_back(
          {s, t,
           stations[s].rotation.conjugate() * (targets[t] - stations[s].translation) +
               sigma_m * noise(run, static_cast<std::uint32_t>(s), static_cast<std::uint32_t>(t)),
           0.001});
  return network;
}

// physics.md §6: σ√6 √((3n − 6)/3n), that is 1.41, 1.73, 2.00, 2.19 mm for 3, 4, 6, 10 targets at σ = 1 mm.
TEST(V15_Registration, LeavesTheResidualsThatTheNumberOfTargetsAllows) {
  for (const auto& [n, expected_mm] :
       {std::pair{3, 1.414}, std::pair{4, 1.732}, std::pair{6, 2.0}, std::pair{10, 2.191}}) {
    double rigid = 0, network_mm = 0, unbiased = 0;
    const auto targets = places(static_cast<std::size_t>(n));
    constexpr std::uint32_t kRuns = 500;
    double rigid_squares = 0;
    for (std::uint32_t run = 0; run < kRuns; ++run) {
      const auto network = seen(targets, {poseOf(0, 0, 0), poseOf(5, 3, 1)}, 0.001, run);
      std::vector<Vector3d> a, b;
      for (const auto& s : network.sightings) (s.station == 0 ? a : b).push_back(s.place_m);
      const auto fit = fitRigid(b, a);
      ASSERT_TRUE(fit);
      rigid_squares += fit->rms_m * fit->rms_m * 1e6 / kRuns;
      const auto all = fitNetwork(network);
      ASSERT_TRUE(all) << all.error().message;
      const auto links = linksOf(network, *all);
      ASSERT_EQ(links.size(), 1U);
      network_mm += links[0].rms_m * links[0].rms_m * 1e6 / kRuns;
      unbiased += *links[0].unbiased_m * *links[0].unbiased_m * 1e6 / kRuns;
    }
    rigid = std::sqrt(rigid_squares), network_mm = std::sqrt(network_mm);
    EXPECT_NEAR(rigid, expected_mm, 0.03 * expected_mm) << n;
    EXPECT_NEAR(network_mm, rigid, 0.001) << "two stations are a rigid fit";
    EXPECT_NEAR(std::sqrt(unbiased), std::sqrt(6.0), 0.03 * std::sqrt(6.0))
        << "tied to the true error: σ√6 of any number";
  }
}

TEST(TargetNetwork, OfExactSightingsComesBackExactlyThroughAChain) {
  const auto targets = places(9);
  const std::vector<Pose> stations = {poseOf(0, 0, 0.3), poseOf(6, 1, 2), poseOf(12, -4, -1), poseOf(-3, 8, 3)};
  auto network = seen(targets, stations, 0, 1);
  // Each station sees four or so; neighbours in the chain share three, the ends nothing.
  std::erase_if(network.sightings,
                [](const Sighting& s) { return s.target < 2 * s.station || s.target > 2 * s.station + 4; });
  const auto fit = fitNetwork(network);
  ASSERT_TRUE(fit) << fit.error().message;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    EXPECT_LT((fit->pose[i].translation - stations[i].translation).norm(), 1e-9);
    EXPECT_LT(fit->pose[i].rotation.angularDistance(stations[i].rotation), 1e-9);
  }
}

TEST(TargetNetwork, TellsASigmaThatTheTrueErrorsHave) {
  const auto targets = places(6);
  const std::vector<Pose> stations = {poseOf(0, 0, 0), poseOf(5, 3, 1), poseOf(-4, 6, 2)};
  double squares = 0, told = 0, factor = 0;
  constexpr std::uint32_t kRuns = 300;
  for (std::uint32_t run = 0; run < kRuns; ++run) {
    const auto fit = fitNetwork(seen(targets, stations, 0.002, run));
    ASSERT_TRUE(fit);
    squares += (fit->pose[2].translation - stations[2].translation).squaredNorm() / kRuns;
    told += fit->sigma_shift_m[2].squaredNorm() / kRuns;
    factor += fit->sigma_factor * fit->sigma_factor / kRuns;
  }
  EXPECT_NEAR(std::sqrt(factor), 2, 0.1) << "twice the millimetre that was stated";
  EXPECT_NEAR(std::sqrt(told / squares), 1, 0.1);
}

TEST(TargetNetwork, IsHeldByKnownPlacesAsWell) {
  const auto targets = places(5);
  const std::vector<Pose> stations = {poseOf(0, 0, 0.5), poseOf(5, 3, 1)};
  auto network = seen(targets, stations, 0, 1);
  network.held.reset();
  for (std::size_t t = 0; t < 4; ++t) network.known.push_back({t, targets[t], 0.002});
  const auto fit = fitNetwork(network);
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_LT((fit->pose[0].translation - stations[0].translation).norm(), 1e-9);
}

TEST(TargetNetwork, SaysWhichStationHangsLoose) {
  auto network = seen(places(4), {poseOf(0, 0, 0), poseOf(5, 3, 1)}, 0, 1);
  auto two = network;
  std::erase_if(two.sightings, [](const Sighting& s) { return s.target > 1; });
  NetworkProblem problem;
  EXPECT_THAT(fitNetwork(two, &problem).error().message, HasSubstr("shares 2 targets"));
  EXPECT_EQ(problem.station, 1U);
  auto line = seen({{0, 0, 0}, {1, 0, 1}, {3, 0, 3}, {7, 0, 7}}, {poseOf(0, 0, 0), poseOf(5, 3, 1)}, 0, 1);
  EXPECT_THAT(fitNetwork(line, &problem).error().message, HasSubstr("collinear"));
  network.held.reset();
  EXPECT_THAT(fitNetwork(network).error().message, HasSubstr("not fixed"));
}

TEST(MatchPlaces, ByDistancesFindsWhichIsWhichAmongStrangers) {
  const auto to = places(8);
  const Pose motion = poseOf(4, -7, 2.2);
  std::vector<Vector3d> from;
  for (const std::size_t i : {5U, 2U, 7U, 0U})
    from.emplace_back(motion.rotation.conjugate() * (to[i] - motion.translation) +
                      0.001 * noise(1, 0, static_cast<std::uint32_t>(i)));
  from.insert(from.begin() + 1, Vector3d(3, 3, 30));
  const auto match = matchPlaces(from, to, 0.01);
  ASSERT_TRUE(match) << match.error().message;
  EXPECT_EQ(match->pairs, (std::vector<std::pair<std::size_t, std::size_t>>{{0, 5}, {2, 2}, {3, 7}, {4, 0}}));
}

TEST(MatchPlaces, RefusesASymmetricArrangementAndALine) {
  const std::vector<Vector3d> square = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  EXPECT_THAT(matchPlaces(square, square, 0.01).error().message, HasSubstr("symmetric"));
  const std::vector<Vector3d> line = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}};
  EXPECT_THAT(matchPlaces(line, line, 0.01).error().message, HasSubstr("non-collinear"));
  auto broken = square;
  broken.emplace_back(1, 2, 1.5);
  EXPECT_TRUE(matchPlaces(broken, broken, 0.01));
}

}  // namespace
}  // namespace standpoint
