// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/edge_finder.h"

#include <algorithm>
#include <array>
#include <bit>

#include "scanners/math/target_clones.h"

namespace standpoint {

namespace {

// Next to the axis, half-way, and at the beam's edge.
std::array<std::uint32_t, 3> places(std::uint32_t reach) { return {1, (reach + 1) / 2, reach}; }

// Sixteen planes and those of their neighbours on either side, at most in three places up and across.
struct Neighbours {
  const std::uint32_t* own;
  const std::uint32_t* beside[12];
  int count = 0;

  void add(const std::uint32_t* planes) { beside[count++] = planes; }
};

// Which of them have a neighbour that is another one, as bits.
STANDPOINT_CLONES std::uint32_t unlikeOf(const Neighbours& n) {
  std::uint32_t differs[kPacket] = {};
  for (int i = 0; i < n.count; ++i)
    for (int k = 0; k < kPacket; ++k) differs[k] |= n.own[k] ^ n.beside[i][k];
  std::uint32_t bits[kPacket], rows = 0;
  for (int k = 0; k < kPacket; ++k) bits[k] = differs[k] != 0 ? 1U << static_cast<unsigned>(k) : 0U;
  for (int k = 0; k < kPacket; ++k) rows |= bits[k];
  return rows;
}

STANDPOINT_CLONES float least(const float* ranges_m) {
  float lanes[8];
  for (int k = 0; k < 8; ++k) lanes[k] = ranges_m[k] < ranges_m[k + 8] ? ranges_m[k] : ranges_m[k + 8];
  for (int half = 4; half > 0; half /= 2)
    for (int k = 0; k < half; ++k) lanes[k] = lanes[k] < lanes[k + half] ? lanes[k] : lanes[k + half];
  return lanes[0];
}

}  // namespace

std::uint32_t EdgeFinder::find(std::uint32_t first_row) {
  const ColumnHits& own = columns_.current(first_row);
  if (first_row >= kPacket) columns_.current(first_row - kPacket);
  if (first_row + kPacket < plan_.settings.rows) columns_.current(first_row + kPacket);
  std::uint32_t edges = 0;
  for (std::uint32_t left = unlike(own, first_row); left != 0; left &= left - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(left));
    if (atEdge(own, first_row + lane)) edges |= 1U << lane;
  }
  return edges;
}

EdgeFinder::Reach EdgeFinder::reachAt(double range_m, std::uint32_t row) const {
  const double start = plan_.instrument.exit_diameter_m / range_m, spread = plan_.instrument.divergence_rad;
  const double square =
      0.25 * kOuterFraction * kOuterFraction * (start * start + spread * spread);  // of the beam's edge, in rad
  const auto pulses = [&](double step) {
    std::uint32_t n = 1;
    while (n < plan_.reach() && n * step * n * step < square) ++n;
    return n;
  };
  return {pulses(row_step_), pulses(column_step_ * std::max(1e-3, plan_.cosine[row]))};
}

// Rows of which a neighbour up, down, left or right meets another plane.
std::uint32_t EdgeFinder::unlike(const ColumnHits& own, std::uint32_t first_row) {
  const auto nearest = static_cast<double>(least(own.ranges_m(first_row)));
  const Reach reach = reachAt(std::max(0.01, nearest), first_row);
  Neighbours neighbours{.own = own.planes(first_row)};
  std::uint32_t done = 0;
  for (const std::uint32_t apart : places(reach.rows)) {
    if (apart == done) continue;
    neighbours.add(neighbours.own - apart);
    neighbours.add(neighbours.own + apart);
    done = apart;
  }
  done = 0;
  for (const std::uint32_t apart : places(reach.columns)) {
    if (apart == done) continue;
    if (own.column() >= apart) neighbours.add(columns_.before(apart, first_row).planes(first_row));
    if (own.column() + apart < plan_.settings.columns)
      neighbours.add(columns_.after(apart, first_row).planes(first_row));
    done = apart;
  }
  const std::uint32_t rows = unlikeOf(neighbours);
  const std::uint32_t count = plan_.settings.rows - first_row;
  return count < kPacket ? rows & ((1U << count) - 1) : rows;
}

// Is a neighbour's axis on another surface than this one's, or on none?
bool EdgeFinder::atEdge(const ColumnHits& own, std::uint32_t row) {
  const NearestHit hit = own.hit(row);
  MetFacet met;
  double tolerance = 0;
  Reach reach{plan_.reach(), plan_.reach()};
  if (hit.facet != kNoFacet) {
    met = facets_.of(hit.facet);  // a copy: rows that are traced ask for others
    const auto range = std::max(0.01, static_cast<double>(hit.range_m));
    tolerance = edgeTolerance(plan_.instrument, range);
    reach = reachAt(range, row);
  }
  const std::uint32_t plane = *own.planes(row);
  const auto differs = [&](const ColumnHits& column, std::uint32_t there) {
    if (*column.planes(there) == plane) return false;
    const NearestHit other = column.hit(there);
    return other.facet == kNoFacet || hit.facet == kNoFacet || !met.holds(column.axis(there), other, tolerance);
  };
  for (const std::uint32_t apart : places(reach.rows))
    if ((row >= apart && differs(own, row - apart)) || (row + apart < plan_.settings.rows && differs(own, row + apart)))
      return true;
  const std::uint32_t number = own.column(), first_row = row / kPacket * kPacket;
  for (const std::uint32_t apart : places(reach.columns))
    if ((number >= apart && differs(columns_.before(apart, first_row), row)) ||
        (number + apart < plan_.settings.columns && differs(columns_.after(apart, first_row), row)))
      return true;
  return false;
}

}  // namespace standpoint
