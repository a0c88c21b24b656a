// SPDX-License-Identifier: GPL-3.0-or-later
// What a tree of edges finds in beams against a look at every edge.
#include "scanners/engine/edge_tree.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using namespace testing;

// The nearest that an edge comes to a beam's axis ahead of it, over the beam's reach there, by a search in small steps:
// no closed form that the tree might share.
double leastShare(const Beam& beam, const Instrument& instrument, const Eigen::Vector3d& from,
                  const Eigen::Vector3d& to) {
  const Eigen::Vector3d middle = 0.5 * (from + to) - beam.origin;
  const double aside = middle.cross(beam.direction).norm() - 0.5 * (to - from).norm();
  double least = 1e9;
  if (aside > kBeamEdge * beamRadius(instrument, 40)) return least;
  constexpr int kSteps = 2000;
  for (int i = 0; i <= kSteps; ++i) {
    const Eigen::Vector3d off = from + i * (to - from) / kSteps - beam.origin;
    const double ahead = off.dot(beam.direction);
    if (ahead <= 0.01) continue;
    least = std::min(least, (off - ahead * beam.direction).norm() / (kBeamEdge * beamRadius(instrument, ahead)));
  }
  return least;
}

Beam beamTo(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d across = direction.unitOrthogonal();
  return {origin, direction, across, direction.cross(across)};
}

BeamLanes lanesOf(const Beam& beam) {
  BeamLanes lanes;
  lanes.set(0, beam);
  return lanes;
}

class EdgesInBeams : public ::testing::TestWithParam<double> {};

// The parameter: degrees from one beam of sixteen to the next.
TEST_P(EdgesInBeams, AreFoundByTheTreeAsByALookAtEachOfThem) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto place = [&](double size) -> Eigen::Vector3d {
    return size * Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
  };
  const Eigen::Vector3d far_off(2400, -1800, 60);  // from the origin: coordinates lose half a millimetre
  std::vector<EdgeTree::Edge> edges;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const Eigen::Vector3d from = far_off + place(15), to = from + place(i % 3 == 0 ? 5 : 0.1);
    edges.push_back({from.cast<float>(), to.cast<float>(), i});
  }
  const EdgeTree tree(edges);
  Instrument instrument;
  instrument.exit_diameter_m = 0.01, instrument.divergence_rad = 0.01;
  int in_beams = 0;
  for (int k = 0; k < 80; ++k) {
    BeamLanes beams;
    const Eigen::Vector3d origin = far_off + place(10), first = place(1).normalized();
    const Eigen::Vector3d axis = first.unitOrthogonal();
    for (int lane = 0; lane < kPacket; ++lane)
      beams.set(static_cast<std::uint32_t>(lane),
                beamTo(origin + 0.002 * lane * first,
                       Eigen::AngleAxisd(GetParam() * lane * std::numbers::pi / 180, axis) * first));
    BeamPacket packet(instrument);
    const std::uint32_t lanes = 0xF7FF;
    packet.set(lanes, beams, tree.farthestCoordinate_m());
    std::map<std::uint64_t, std::uint32_t> found;
    for (std::uint32_t left = lanes; left != 0;) {
      const std::uint32_t together = packet.together(left);
      left &= ~together;
      packet.narrow(together, 20);
      tree.find(packet, [&](std::uint64_t edge, std::uint32_t near) { found[edge] |= near; });
    }
    for (const auto& [edge, near] : found) EXPECT_EQ(near & ~lanes, 0U);
    for (const EdgeTree::Edge& edge : edges) {
      const Eigen::Vector3d from = edge.from.cast<double>(), to = edge.to.cast<double>();
      for (std::uint32_t lane = 0; lane < kPacket; ++lane) {
        if ((lanes >> lane & 1U) == 0 || (from - origin).norm() > 18) continue;
        const double share = leastShare(beams.at(lane), instrument, from, to);
        if (share > 0.99) continue;
        ++in_beams;
        EXPECT_TRUE(found.contains(edge.number) && (found[edge.number] >> lane & 1U) != 0)
            << "edge " << edge.number << ", lane " << lane << ", " << share << " of the beam's radius off";
      }
    }
    // It is of use only where it leaves nearly all of them out.
    EXPECT_LT(found.size(), edges.size() / 4);
  }
  EXPECT_GT(in_beams, 200);
}

INSTANTIATE_TEST_SUITE_P(EdgeTree, EdgesInBeams, ::testing::Values(0.0, 0.05, 0.5, 6.0, 25.0));

TEST(EdgeTree, OfNothingHoldsNothing) {
  Instrument instrument;
  BeamPacket packet(instrument);
  const Beam beam = beamTo({0, 0, 0}, {1, 0, 0});
  packet.set(1, lanesOf(beam), 0);
  packet.narrow(1, 100);
  EdgeTree().find(packet, [](std::uint64_t, std::uint32_t) { FAIL(); });
  EdgeTree(std::vector<EdgeTree::Edge>()).find(packet, [](std::uint64_t, std::uint32_t) { FAIL(); });
}

TEST(EdgeTree, OfOneHoldsIt) {
  Instrument instrument;
  instrument.exit_diameter_m = 0.005;
  BeamPacket packet(instrument);
  const Beam beam = beamTo({0, 0, 0}, {1, 0, 0});
  for (const double off_m : {0.002, 0.2}) {
    int count = 0;
    const EdgeTree tree(
        {{Eigen::Vector3f(5, -1, static_cast<float>(off_m)), Eigen::Vector3f(5, 1, static_cast<float>(off_m)), 42}});
    packet.set(1, lanesOf(beam), tree.farthestCoordinate_m());
    packet.narrow(1, 100);
    tree.find(packet, [&](std::uint64_t edge, std::uint32_t lanes) {
      EXPECT_EQ(edge, 42U);
      EXPECT_EQ(lanes, 1U);
      ++count;
    });
    EXPECT_EQ(count, off_m < 0.1 ? 1 : 0);
  }
}

}  // namespace
}  // namespace standpoint
