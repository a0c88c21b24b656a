// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/edge_finder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "scanners/engine/edge_sight.h"

namespace standpoint {

namespace {

constexpr double kAhead_m = 1e-3;

// Where an edge runs in a beam: through two places of a plane at unit distance, and 1 / range there.
struct InBeam {
  double across[2], upward[2], nearness[2];

  // How far from the one to the other it comes nearest to the axis, of the whole.
  double nearestAlong() const {
    const double x = across[1] - across[0], y = upward[1] - upward[0], square = x * x + y * y;
    return square > 0 ? std::clamp(-(across[0] * x + upward[0] * y) / square, 0.0, 1.0) : 0;
  }
};

// Nothing of what is behind the scanner.
bool inBeam(const Beam& beam, Eigen::Vector3d from, Eigen::Vector3d to, InBeam& in) {
  from -= beam.origin, to -= beam.origin;
  double from_ahead = beam.direction.dot(from), to_ahead = beam.direction.dot(to);
  if (from_ahead < kAhead_m && to_ahead < kAhead_m) return false;
  if (from_ahead < kAhead_m || to_ahead < kAhead_m) {
    const double cut = (kAhead_m - from_ahead) / (to_ahead - from_ahead);
    (from_ahead < kAhead_m ? from : to) = from + cut * (to - from);
    (from_ahead < kAhead_m ? from_ahead : to_ahead) = kAhead_m;
  }
  in.across[0] = beam.across.dot(from) / from_ahead, in.across[1] = beam.across.dot(to) / to_ahead;
  in.upward[0] = beam.upward.dot(from) / from_ahead, in.upward[1] = beam.upward.dot(to) / to_ahead;
  in.nearness[0] = 1 / from_ahead, in.nearness[1] = 1 / to_ahead;
  return true;
}

}  // namespace

// One column's.
struct EdgeFinder::Search {
  const ScanPlan& plan;
  const ColumnHits& hits;
  TimedScene& scene;
  FacetCache& facets;
  ColumnEdges& found;
  BeamPacket packet{plan.instrument};
  BeamLanes beams = {};

  // The farthest edge that one of the lanes may show.
  double reach_m(std::uint32_t first_row, std::uint32_t lanes) {
    double reach = 0;
    for (std::uint32_t left = lanes; left != 0; left &= left - 1) {
      const std::uint32_t row = first_row + static_cast<std::uint32_t>(std::countr_zero(left));
      reach = std::max(reach, farthestEdge_m(plan, facets, hits.hit(row)));
    }
    return reach;
  }

  void look(const EdgeTree& tree, const BeamLanes& of, std::uint32_t first_row, std::uint32_t lanes, bool of_body) {
    if (tree.empty()) return;
    packet.set(lanes, of, tree.farthestCoordinate_m());
    for (std::uint32_t left = lanes; left != 0;) {
      const std::uint32_t together = packet.together(left);
      left &= ~together;
      packet.narrow(together, reach_m(first_row, together));
      tree.find(packet, [&](std::uint64_t edge, std::uint32_t near) { markEdge(edge, first_row, near, of_body); });
    }
  }

  void markEdge(std::uint64_t edge, std::uint32_t first_row, std::uint32_t lanes, bool of_body) {
    const auto placement = static_cast<std::uint32_t>(edge >> 32U);
    const Instance& instance = plan.scene.placed(placement);
    const MeshEdge& of = plan.scene.edges(instance.mesh)[edge & 0xFFFFFFFFU];
    const auto corner = [&](std::uint32_t k) -> Eigen::Vector3d {
      return instance.world_from_mesh * plan.scene.environment().meshes[instance.mesh]->positions[k].cast<double>();
    };
    const Eigen::Vector3d from = corner(of.from), to = corner(of.to);
    double reach = -1;  // about the same for all of them
    for (std::uint32_t left = lanes; left != 0; left &= left - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(left));
      const std::uint32_t row = first_row + lane;
      const Beam beam = packet.beam(lane);
      InBeam in;
      if (!inBeam(beam, from, to, in)) continue;
      const double along = in.nearestAlong();
      const double x = in.across[0] + along * (in.across[1] - in.across[0]);
      const double y = in.upward[0] + along * (in.upward[1] - in.upward[0]);
      const double range = 1 / (in.nearness[0] + along * (in.nearness[1] - in.nearness[0]));
      const double off = std::sqrt(x * x + y * y) * range, radius = beamRadius(plan.instrument, range);
      if (off > kBeamEdge * radius || range > packet.reach_m()) continue;
      if (reach < 0)
        reach = of.right == kNoCorner ? kBeamEdge
                                      : edgeReach(plan.instrument, from - beam.origin, to - beam.origin,
                                                  corner(of.left) - beam.origin, corner(of.right) - beam.origin);
      if (off > reach * radius) continue;
      if (const auto range_m = static_cast<float>(range); shows(row, range_m, x, y))
        found.add(row, of_body || plan.scene.isBall(placement) ? BeamEdges::kRound : edge);
      else
        found.addHidden(row, range_m);
    }
  }

  // `across` and `upward`: of the edge in the beam, at unit distance.
  bool shows(std::uint32_t row, float range_m, double across, double upward) {
    const NearestHit hit = hits.hit(row);
    if (range_m <= hit.range_m + kBehindHit_m) return true;
    const Beam beam = hits.beam(row);
    const Eigen::Vector3d towards = beam.direction + across * beam.across + upward * beam.upward;
    return edgeShows(plan, facets, hit, beam.origin, towards, range_m, hits.bodiesTime_s(row));
  }
};

EdgeFinder::EdgeFinder(const ScanPlan& plan) : plan_(plan), bodies_(plan.scene.bodies().size()) {
  const auto still = static_cast<std::uint32_t>(plan.scene.stillCount());
  for (std::uint32_t placement = still; placement < plan.scene.placedCount(); ++placement)
    bodies_[plan.scene.bodyOf(placement)].placements.push_back(placement);
  if (!plan.moves()) return;
  std::vector<std::uint32_t> all(still);
  std::iota(all.begin(), all.end(), 0U);
  still_ = treeOf(all);
}

EdgeTree EdgeFinder::treeOf(const std::vector<std::uint32_t>& placements) const {
  const auto edgesOf = [this](std::uint32_t placement) -> const auto& {
    return plan_.scene.edges(plan_.scene.placed(placement).mesh);
  };
  std::size_t all = 0;
  for (const std::uint32_t placement : placements) all += edgesOf(placement).size();
  std::vector<EdgeTree::Edge> edges;
  edges.reserve(all);
  for (const std::uint32_t placement : placements) {
    const auto count = static_cast<std::uint32_t>(edgesOf(placement).size());
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint64_t edge = std::uint64_t{placement} << 32U | i;
      const auto ends = plan_.scene.edgeEnds(edge);
      edges.push_back({ends[0].cast<float>(), ends[1].cast<float>(), edge});
    }
  }
  return EdgeTree(std::move(edges));
}

const EdgeTree& EdgeFinder::bodyTree(std::uint32_t body) const {
  BodyTree& of = bodies_[body];
  std::call_once(of.made, [&] { of.tree = treeOf(of.placements); });
  return of.tree;
}

void EdgeFinder::mark(const ColumnHits& hits, TimedScene& scene, FacetCache& facets, ColumnEdges& found) const {
  const std::uint32_t rows = plan_.settings.rows;
  Search search{plan_, hits, scene, facets, found};
  for (std::uint32_t first_row = 0; first_row < rows; first_row += kPacket) {
    const std::uint32_t lanes = hits.measured(first_row, std::min<std::uint32_t>(kPacket, rows - first_row));
    if (lanes == 0 || (still_.empty() && hits.nearBodies(first_row).empty())) continue;
    hits.beams(first_row, search.beams);
    search.look(still_, search.beams, first_row, lanes, false);
    markBodies(search, first_row, lanes);
  }
}

void EdgeFinder::markBodies(Search& search, std::uint32_t first_row, std::uint32_t lanes) const {
  if (search.hits.nearBodies(first_row).empty()) return;
  double times_s[kPacket] = {};
  forLanes(lanes, [&](std::uint32_t k) { times_s[k] = search.hits.bodiesTime_s(first_row + k); });
  for (const NearBody& near : search.hits.nearBodies(first_row)) {
    const std::uint32_t of_body = near.lanes & lanes;
    if (of_body == 0) continue;
    PoseLanes local_from_rest;
    search.scene.poses(near.body, times_s, of_body, local_from_rest);
    BeamLanes beams;
    placesAtRest(local_from_rest, search.beams.axes.origin, beams.axes.origin);
    directionsAtRest(local_from_rest, search.beams.axes.direction, beams.axes.direction);
    directionsAtRest(local_from_rest, search.beams.across, beams.across);
    directionsAtRest(local_from_rest, search.beams.upward, beams.upward);
    search.look(bodyTree(near.body), beams, first_row, of_body, true);
  }
}

}  // namespace standpoint
