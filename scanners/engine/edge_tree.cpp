// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/edge_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/portable_math.h"
#include "scanners/engine/edge_sight.h"
#include "scanners/math/target_clones.h"

namespace standpoint {

namespace {

constexpr std::size_t kLeaf = 4;
constexpr double kNearest_m = 1e-3;

// Where an edge runs in a beam: through two places of a plane at unit distance, and 1 / range there.
struct InBeam {
  double across[2], upward[2], nearness[2];

  // How far from the one to the other it comes nearest to the axis, of the whole.
  double nearestAlong() const {
    const double x = across[1] - across[0], y = upward[1] - upward[0], square = x * x + y * y;
    return square > 0 ? std::clamp(-(across[0] * x + upward[0] * y) / square, 0.0, 1.0) : 0;
  }
  double squaredOff() const {
    const double along = nearestAlong();
    const double x = across[0] + along * (across[1] - across[0]), y = upward[0] + along * (upward[1] - upward[0]);
    return x * x + y * y;
  }
};

// Nothing of what is behind the scanner.
bool inBeam(const Beam& beam, Eigen::Vector3d from, Eigen::Vector3d to, InBeam& in) {
  from -= beam.origin, to -= beam.origin;
  double from_ahead = beam.direction.dot(from), to_ahead = beam.direction.dot(to);
  if (from_ahead < kNearest_m && to_ahead < kNearest_m) return false;
  if (from_ahead < kNearest_m || to_ahead < kNearest_m) {
    const double cut = (kNearest_m - from_ahead) / (to_ahead - from_ahead);
    (from_ahead < kNearest_m ? from : to) = from + cut * (to - from);
    (from_ahead < kNearest_m ? from_ahead : to_ahead) = kNearest_m;
  }
  in.across[0] = beam.across.dot(from) / from_ahead, in.across[1] = beam.across.dot(to) / to_ahead;
  in.upward[0] = beam.upward.dot(from) / from_ahead, in.upward[1] = beam.upward.dot(to) / to_ahead;
  in.nearness[0] = 1 / from_ahead, in.nearness[1] = 1 / to_ahead;
  return true;
}

// The beams that an edge may be in, as bits; those that it passes close by their origin are among them.
template <class Lanes>
STANDPOINT_INLINE std::uint32_t nearLanes(const Lanes& b, const double* from, const double* to, double exit_m,
                                          double divergence_rad) {
  constexpr double kSafe = 1.5, kMost = kSafe * kBeamEdge * kBeamEdge / 4;
  std::uint64_t bits[kPacket];
  for (int k = 0; k < kPacket; ++k) {
    const double fx = from[0] - b.origin[0][k], fy = from[1] - b.origin[1][k], fz = from[2] - b.origin[2][k];
    const double tx = to[0] - b.origin[0][k], ty = to[1] - b.origin[1][k], tz = to[2] - b.origin[2][k];
    const double f = b.direction[0][k] * fx + b.direction[1][k] * fy + b.direction[2][k] * fz;
    const double t = b.direction[0][k] * tx + b.direction[1][k] * ty + b.direction[2][k] * tz;
    const double f_near = 1 / std::max(f, kNearest_m), t_near = 1 / std::max(t, kNearest_m);
    const double u = (b.across[0][k] * fx + b.across[1][k] * fy + b.across[2][k] * fz) * f_near;
    const double v = (b.upward[0][k] * fx + b.upward[1][k] * fy + b.upward[2][k] * fz) * f_near;
    const double du = (b.across[0][k] * tx + b.across[1][k] * ty + b.across[2][k] * tz) * t_near - u;
    const double dv = (b.upward[0][k] * tx + b.upward[1][k] * ty + b.upward[2][k] * tz) * t_near - v;
    const double square = du * du + dv * dv, toward = -(u * du + v * dv) / std::max(square, 1e-30);
    const double along = toward > 0 ? (toward < 1 ? toward : 1) : 0;
    const double x = u + along * du, y = v + along * dv, nearness = f_near + along * (t_near - f_near);
    const double exit = exit_m * nearness;
    const bool beside = x * x + y * y <= kMost * (exit * exit + divergence_rad * divergence_rad);
    const bool cut = (f < kNearest_m) != (t < kNearest_m);
    bits[k] = beside || cut ? std::uint64_t{1} << static_cast<unsigned>(k) : 0;
  }
  std::uint64_t lanes = 0;
  for (int k = 0; k < kPacket; ++k) lanes |= bits[k];
  return static_cast<std::uint32_t>(lanes);
}

}  // namespace

STANDPOINT_CLONES std::uint32_t EdgeTree::BeamLanes::near(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                                          double exit_m, double divergence_rad) const {
  return nearLanes(*this, from.data(), to.data(), exit_m, divergence_rad);
}

EdgeTree::EdgeTree(const ScanPlan& plan) : plan_(plan) {
  for (std::uint32_t placement = 0; placement < plan.scene.stillCount(); ++placement) {
    const auto count = static_cast<std::uint32_t>(plan.scene.edges(plan.scene.placed(placement).mesh).size());
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint64_t edge = std::uint64_t{placement} << 32U | i;
      const auto ends = plan.scene.edgeEnds(edge);
      edges_.push_back({ends[0].cast<float>(), ends[1].cast<float>(), edge});
    }
  }
  if (!edges_.empty()) build(0, edges_.size());
}

// With what single precision has lost.
Eigen::AlignedBox3f EdgeTree::Placed::box() const {
  constexpr float kRounding = 1e-6F;
  const Eigen::Vector3f margin = kRounding * from.cwiseAbs().cwiseMax(to.cwiseAbs());
  return {from.cwiseMin(to) - margin, from.cwiseMax(to) + margin};
}

// Halves by the middles along the longer side, in an order that does not depend on the library's.
void EdgeTree::build(std::size_t from, std::size_t to) {
  const std::size_t at = nodes_.size();
  nodes_.emplace_back();
  Eigen::AlignedBox3f box, middles;
  for (std::size_t i = from; i < to; ++i) box.extend(edges_[i].box()), middles.extend(edges_[i].from + edges_[i].to);
  nodes_[at].box = box;
  if (to - from <= kLeaf) {
    nodes_[at].first_edge = static_cast<std::uint32_t>(from), nodes_[at].end_edge = static_cast<std::uint32_t>(to);
    return;
  }
  int side = 0;
  middles.sizes().maxCoeff(&side);
  const std::size_t middle = from + (to - from) / 2;
  const auto begin = edges_.begin();
  std::nth_element(begin + static_cast<std::ptrdiff_t>(from), begin + static_cast<std::ptrdiff_t>(middle),
                   begin + static_cast<std::ptrdiff_t>(to), [side](const Placed& a, const Placed& b) {
                     const float one = a.from[side] + a.to[side], other = b.from[side] + b.to[side];
                     return one != other ? one < other : a.edge < b.edge;
                   });
  build(from, middle);
  nodes_[at].second = static_cast<std::uint32_t>(nodes_.size());
  build(middle, to);
}

// By the sphere about the box.
bool EdgeTree::Cone::meets(const Eigen::AlignedBox3f& box) const {
  const Eigen::Vector3d off = box.center().cast<double>() - apex;
  const double radius = 0.5 * static_cast<double>(box.sizes().norm()) * 1.000001 + aside_m;
  const double square = off.squaredNorm(), far = reach_m + radius;
  if (square > far * far) return false;
  const double along = off.dot(axis);
  const double across = std::sqrt(std::max(0.0, square - along * along));
  if (across * cosine - along * sine <= radius) return along * cosine + across * sine >= -radius;
  return square <= radius * radius;
}

void EdgeTree::setCone(const ColumnHits& hits, FacetCache& facets, Packet& packet) const {
  Cone& cone = packet.cone = {};
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::uint32_t left = packet.lanes; left != 0; left &= left - 1)
    sum += hits.axis(packet.first_row + static_cast<std::uint32_t>(std::countr_zero(left))).direction;
  cone.apex = hits.axis(packet.first_row + static_cast<std::uint32_t>(std::countr_zero(packet.lanes))).origin;
  cone.axis = sum / std::max(1e-9, sum.norm());
  cone.aside_m = kBeamEdge * plan_.instrument.exit_diameter_m / 2;
  double spread = 0;
  for (std::uint32_t left = packet.lanes; left != 0; left &= left - 1) {
    const std::uint32_t row = packet.first_row + static_cast<std::uint32_t>(std::countr_zero(left));
    const RayLine axis = hits.axis(row);
    cone.cosine = std::min(cone.cosine, axis.direction.dot(cone.axis));
    spread = std::max(spread, (axis.origin - cone.apex).norm());
    cone.reach_m = std::max(cone.reach_m, farthestEdge_m(plan_, facets, hits.hit(row)));
  }
  cone.aside_m += spread;
  const double half = kBeamEdge * plan_.instrument.divergence_rad / 2 + 1e-6;  // sin(a + b) ≤ sin a + sin b
  cone.sine = std::min(1.0, std::sqrt(std::max(0.0, 1 - cone.cosine * cone.cosine)) + half);
  cone.cosine = cone.cosine > 0 ? std::sqrt(1 - cone.sine * cone.sine) : -1;
  const Eigen::Vector3d across = cone.axis.unitOrthogonal();
  packet.middle = {cone.apex, cone.axis, across, cone.axis.cross(across)};
}

// In the plane at unit distance that the cone is a disc of.
bool EdgeTree::mayHold(const Packet& packet, const Placed& edge) const {
  const Cone& cone = packet.cone;
  if (cone.cosine < 0.1) return true;
  InBeam in;
  const Eigen::Vector3d from = edge.from.cast<double>(), to = edge.to.cast<double>();
  if (!inBeam(packet.middle, from, to, in)) return false;
  const double nearest = std::max(in.nearness[0], in.nearness[1]);
  const double rounding = 1e-6 * (from.cwiseAbs().maxCoeff() + to.cwiseAbs().maxCoeff());
  const double radius = cone.sine / cone.cosine + 2 * (cone.aside_m + rounding) * nearest;
  return in.squaredOff() <= radius * radius;
}

void EdgeTree::mark(const ColumnHits& hits, FacetCache& facets, ColumnEdges& found) const {
  const std::uint32_t rows = plan_.settings.rows;
  found.begin(rows);
  if (nodes_.empty()) return;
  Packet packet;
  for (packet.first_row = 0; packet.first_row < rows; packet.first_row += kPacket) {
    packet.lanes = hits.measured(packet.first_row, std::min<std::uint32_t>(kPacket, rows - packet.first_row));
    if (packet.lanes == 0) continue;
    setCone(hits, facets, packet);
    packet.has_beams = false;
    std::array<std::uint32_t, 64> open{};
    std::size_t count = 1;
    while (count > 0) {
      const std::uint32_t at = open[--count];
      const Node& node = nodes_[at];
      if (!packet.cone.meets(node.box)) continue;
      if (node.second != 0) {
        open[count++] = node.second, open[count++] = at + 1;
        continue;
      }
      for (std::uint32_t i = node.first_edge; i < node.end_edge; ++i)
        if (mayHold(packet, edges_[i])) markEdge(edges_[i].edge, hits, packet, facets, found);
    }
  }
}

void EdgeTree::markEdge(std::uint64_t edge, const ColumnHits& hits, Packet& packet, FacetCache& facets,
                        ColumnEdges& found) const {
  if (!packet.has_beams)
    for (std::uint32_t left = packet.lanes; left != 0; left &= left - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(left));
      const Beam& beam = packet.beams[lane] = hits.beam(packet.first_row + lane);
      for (int i = 0; i < 3; ++i) {
        packet.side_by_side.origin[i][lane] = beam.origin[i];
        packet.side_by_side.direction[i][lane] = beam.direction[i];
        packet.side_by_side.across[i][lane] = beam.across[i];
        packet.side_by_side.upward[i][lane] = beam.upward[i];
      }
    }
  packet.has_beams = true;
  const auto placement = static_cast<std::uint32_t>(edge >> 32U);
  const Instance& instance = plan_.scene.placed(placement);
  const MeshEdge& of = plan_.scene.edges(instance.mesh)[edge & 0xFFFFFFFFU];
  const auto corner = [&](std::uint32_t k) -> Eigen::Vector3d {
    return instance.world_from_mesh * plan_.scene.environment().meshes[instance.mesh]->positions[k].cast<double>();
  };
  const Eigen::Vector3d from = corner(of.from), to = corner(of.to);
  double reach = -1;  // about the same for all of them
  for (std::uint32_t left = packet.lanes & packet.side_by_side.near(from, to, plan_.instrument.exit_diameter_m,
                                                                    plan_.instrument.divergence_rad);
       left != 0; left &= left - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(left));
    const std::uint32_t row = packet.first_row + lane;
    const Beam& beam = packet.beams[lane];
    InBeam in;
    if (!inBeam(beam, from, to, in)) continue;
    const double along = in.nearestAlong();
    const double x = in.across[0] + along * (in.across[1] - in.across[0]);
    const double y = in.upward[0] + along * (in.upward[1] - in.upward[0]);
    const double range = 1 / (in.nearness[0] + along * (in.nearness[1] - in.nearness[0]));
    const double off = std::sqrt(x * x + y * y) * range, radius = beamRadius(plan_.instrument, range);
    if (off > kBeamEdge * radius) continue;
    if (reach < 0)
      reach = of.right == kNoCorner ? kBeamEdge
                                    : edgeReach(plan_.instrument, from - beam.origin, to - beam.origin,
                                                corner(of.left) - beam.origin, corner(of.right) - beam.origin);
    if (off > reach * radius) continue;
    const auto range_m = static_cast<float>(range);
    const NearestHit hit = hits.hit(row);
    if (range_m <= hit.range_m + kBehindHit_m ||
        edgeShows(plan_, facets, hit, beam.origin, beam.direction + x * beam.across + y * beam.upward, range_m))
      found.add(row, plan_.scene.isBall(placement) ? BeamEdges::kRound : edge);
    else
      found.addHidden(row, range_m);
  }
}

}  // namespace standpoint
