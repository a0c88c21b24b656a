// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/beam_strips.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/portable_math.h"
#include "core/random.h"

namespace standpoint {

namespace {

constexpr double kLeastTurn = 0.05;  // sine of the angle between edge and beam: below it the edge runs into the depth
constexpr double kChord = 1.2;       // in w: edges go on that far from the axis, or there is a corner
constexpr double kOneLine = 0.02;    // in w: edges so near to each other are one
constexpr double kParallel = 0.02;   // sine of the angle between two edges across the beam
constexpr double kStray = 0.14;      // in w, of a sum of three random numbers: σ 0.07

// Where an edge passes the axis, as the rays of the beam see it: in w, across and upward.
struct Passing {
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();  // unit, across the edge
  double off = 0;                                     // of the edge, along it
  double from = 0, to = 0;                            // its ends, along the edge
};

// None: the edge runs into the depth, or is behind the scanner.
std::optional<Passing> passing(const Beam& beam, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                               const Instrument& instrument) {
  const Eigen::Vector3d edge = to - from, start = from - beam.origin;
  const double length = edge.norm();
  if (!(length > 0)) return std::nullopt;
  const Eigen::Vector3d along = edge / length;
  const Eigen::Vector3d normal = beam.direction.cross(along);
  const double turn = normal.norm(), both = beam.direction.dot(along), depth = beam.direction.dot(start);
  if (turn < kLeastTurn) return std::nullopt;
  const double place = (both * depth - along.dot(start)) / (turn * turn);  // on the edge, where it passes
  const double range = depth + place * both;
  if (!(range > 0)) return std::nullopt;
  // lineOf() the other way round: a place p there is of the ray p / (offset + i lean), and |offset + i lean| is w.
  const double offset = 0.5 * instrument.exit_diameter_m, lean = 0.5 * instrument.divergence_rad * range;
  const double radius = std::sqrt(offset * offset + lean * lean);
  const double across = normal.dot(beam.across) / turn, upward = normal.dot(beam.upward) / turn;
  Passing result;
  result.normal = Eigen::Vector2d(across * offset + upward * lean, upward * offset - across * lean) / radius;
  result.normal.normalize();
  result.off = normal.dot(start) / turn / radius;
  result.from = -place * turn / radius, result.to = (length - place) * turn / radius;
  return result;
}

// Of a normal distribution: its density at z, and what of it is beyond, to 2e-7 (Abramowitz and Stegun 7.1.26).
struct Normal {
  double density = 0, tail = 1;

  Normal() = default;
  explicit Normal(double z) {
    const double x = std::abs(z) * 0.7071067811865476, t = 1 / (1 + 0.3275911 * x);
    const auto falling = static_cast<double>(portable::exp2(static_cast<float>(-x * x * 1.4426950408889634)));
    const double sum =
        t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429))));
    density = 0.3989422804014327 * falling;
    tail = z < 0 ? 1 - 0.5 * sum * falling : 0.5 * sum * falling;
  }
};

// Do these edges of one line go through the whole beam together?
bool goThrough(const Passing* first, const Passing* end) {
  const double half = std::sqrt(std::max(0.0, kChord * kChord - first->off * first->off));
  double reached = -half;
  for (const Passing* round = first; round != end; ++round)
    for (const Passing* p = first; p != end; ++p)
      if (p->from <= reached + kOneLine) reached = std::max(reached, p->to);
  return reached >= half;
}

}  // namespace

int drawStrips(const EmbreeScene& scene, const Instrument& instrument, const Beam& beam, const BeamEdges& edges,
               const std::array<std::uint32_t, 4>& draw, SubRay* rays) {
  if (edges.several) return 0;
  Passing lines[BeamEdges::kMost];
  int count = 0;
  for (int i = 0; i < edges.count; ++i) {
    const auto [from, to] = scene.edgeEnds(edges.edge[i]);
    auto line = passing(beam, from, to, instrument);
    if (!line) return 0;
    if (std::abs(line->off) >= kBeamEdge) continue;
    if (count > 0) {  // along the first one's normal
      const Eigen::Vector2d& normal = lines[0].normal;
      if (std::abs(normal.x() * line->normal.y() - normal.y() * line->normal.x()) > kParallel) return 0;
      if (normal.dot(line->normal) < 0) {
        line->off = -line->off;
        std::swap(line->from, line->to);
        line->from = -line->from, line->to = -line->to;
      }
    }
    lines[count++] = *line;
  }
  const Eigen::Vector2d normal = lines[0].normal;
  std::stable_sort(lines, lines + count, [](const Passing& a, const Passing& b) { return a.off < b.off; });
  double bounds[BeamEdges::kMost];
  int bound_count = 0;
  for (int from = 0, to = 0; from < count; from = to) {
    while (to < count && lines[to].off <= lines[from].off + kOneLine) ++to;
    if (!goThrough(lines + from, lines + to)) return 0;
    bounds[bound_count++] = lines[from].off;
  }
  const double stray = kStray * (uniform(draw[0]) + uniform(draw[1]) + uniform(draw[2]) - 1.5);
  Normal here;  // where the strip begins
  double strayed = 1;
  for (int i = 0; i <= bound_count; ++i) {
    const bool last = i == bound_count;
    Normal there;
    there.tail = 0;
    double next_strayed = 0;
    if (!last) {
      there = Normal(2 * bounds[i]);
      next_strayed = Normal(2 * (bounds[i] + stray)).tail;
    }
    const double mean = 0.5 * (here.density - there.density) / (here.tail - there.tail);
    const double least = i > 0 ? bounds[i - 1] : -2 * kBeamEdge, most = last ? 2 * kBeamEdge : bounds[i];
    const double place = std::clamp(mean, least, most);
    rays[i] = {place * normal.x(), place * normal.y(), static_cast<float>(strayed - next_strayed)};
    here = there, strayed = next_strayed;
  }
  return bound_count + 1;
}

}  // namespace standpoint
