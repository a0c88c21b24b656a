// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/edge_map.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "core/portable_math.h"
#include "scanners/engine/corner_light.h"
#include "scanners/engine/edge_sight.h"

namespace standpoint {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kStraight_rows = 0.2;  // that a piece may be bent
constexpr double kEven = 2e-4;          // relative, of the range along a piece
constexpr double kMargin_rows = 0.25;   // of the beam's radius, for that
constexpr int kMostCuts = 12;           // of a half into halves

// Cuts the edges that one thread deals with.
class Cutter {
 public:
  Cutter(const ScanPlan& plan, EdgeMap::Edges edges, std::vector<EdgeMap::Piece>& pieces)
      : plan_(plan),
        half_field_rad_(edges == EdgeMap::Edges::corners ? plan.field_of_view_rad / 2 : 0),
        pieces_(pieces),
        row_step_(plan.rowStep_rad()),
        column_step_(plan.columnStep_rad()),
        turn_columns_(kTurn / plan.columnStep_rad()) {}

  // In the scanner's frame.
  void add(std::uint64_t edge, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double reach) {
    edge_ = edge, reach_ = reach;
    cut(placeOf(from), placeOf(to), 0);
  }

 private:
  struct Place {
    Eigen::Vector3d at;
    double range_m, column, row, elevation_rad;
  };

  Place placeOf(const Eigen::Vector3d& at) const {
    const double elevation = kTurn * portable::turnOf(at.z(), std::sqrt(at.x() * at.x() + at.y() * at.y()));
    const double azimuth = kTurn * portable::turnOf(-at.y(), at.x());  // clockwise seen from above
    return {at, std::max(1e-3, at.norm()), (azimuth - plan_.settings.azimuth_from_rad) / column_step_,
            (elevation - plan_.settings.elevation_from_rad) / row_step_ - 0.5, elevation};
  }
  double besideOf(double column, double other) const {
    return column - turn_columns_ * std::nearbyint((column - other) / turn_columns_);
  }

  void cut(const Place& from, Place to, int cuts) {
    to.column = besideOf(to.column, from.column);
    if (cuts < kMostCuts) {
      // Half-way as the scanner sees it.
      Place middle = placeOf(from.at + from.range_m / (from.range_m + to.range_m) * (to.at - from.at));
      middle.column = besideOf(middle.column, from.column);
      if (bent(from, middle, to)) {
        cut(from, middle, cuts + 1);
        cut(middle, to, cuts + 1);
        return;
      }
    }
    append(from, to);
  }

  // In the grid, or in 1 / range along it.
  bool bent(const Place& from, const Place& middle, const Place& to) const {
    if (std::abs(0.5 * middle.range_m * (1 / from.range_m + 1 / to.range_m) - 1) > kEven) return true;
    const double narrowing = cosine(std::abs(middle.elevation_rad)) * column_step_ / row_step_;
    const double across = (to.column - from.column) * narrowing, up = to.row - from.row;
    const double length = std::sqrt(across * across + up * up);
    if (length < 1) return false;
    const double off = (middle.column - from.column) * narrowing * up - (middle.row - from.row) * across;
    return std::abs(off) > kStraight_rows * length || std::abs(to.column - from.column) > turn_columns_ / 16;
  }

  void append(const Place& from, const Place& to) {
    const double nearest = std::min(from.range_m, to.range_m);
    const double radius =
        half_field_rad_ > 0 ? half_field_rad_ : reach_ * beamRadius(plan_.instrument, nearest) / nearest;
    const double rows = radius / row_step_ + kMargin_rows;
    if (std::max(from.row, to.row) < -rows || std::min(from.row, to.row) > plan_.settings.rows + rows) return;
    const double steepest = std::max(std::abs(from.elevation_rad), std::abs(to.elevation_rad)) + rows * row_step_;
    // cos x ≥ 1 - 2x/π; of all columns where it ends near the zenith.
    const double narrowing = std::numbers::pi / 2 - steepest > 1e-3 ? cosine(steepest) : 0;
    EdgeMap::Piece piece;
    piece.row[0] = static_cast<float>(from.row), piece.row[1] = static_cast<float>(to.row);
    piece.nearness[0] = static_cast<float>(1 / from.range_m), piece.nearness[1] = static_cast<float>(1 / to.range_m);
    piece.radius_rows = static_cast<float>(rows);
    piece.edge = edge_;
    piece.rows_per_column = static_cast<float>(narrowing * column_step_ / row_step_);
    const double columns = piece.rows_per_column > 0 ? rows / (narrowing * column_step_ / row_step_) : turn_columns_;
    if (columns > turn_columns_ / 4) {
      piece.rows_per_column = 0;
      pieces_.push_back(piece);
      return;
    }
    for (int turn = -2; turn <= 2; ++turn) {  // the grid begins and ends anywhere within two turns
      const double shift = turn * turn_columns_;
      if (std::max(from.column, to.column) + shift < -columns ||
          std::min(from.column, to.column) + shift > plan_.settings.columns + columns)
        continue;
      piece.column[0] = static_cast<float>(from.column + shift);
      piece.column[1] = static_cast<float>(to.column + shift);
      pieces_.push_back(piece);
    }
  }

  static double cosine(double angle_rad) {
    float sine, cosine;
    portable::sinCosTurn(static_cast<float>(angle_rad / kTurn), sine, cosine);
    return static_cast<double>(cosine);
  }

  const ScanPlan& plan_;
  double half_field_rad_;  // instead of the beam's reach; 0 = the beam's
  std::vector<EdgeMap::Piece>& pieces_;
  double row_step_, column_step_, turn_columns_;
  double reach_ = kBeamEdge;
  std::uint64_t edge_ = 0;
};

}  // namespace

EdgeMap::EdgeMap(const ScanPlan& plan, Edges wanted) : plan_(plan) {
  struct Part {
    std::uint32_t placement, from, to;
  };
  constexpr std::uint32_t kPart = 4096;
  std::vector<Part> parts;
  for (std::uint32_t k = 0; k < plan.scene.stillCount(); ++k) {
    const auto count = static_cast<std::uint32_t>(plan.scene.edges(plan.scene.placed(k).mesh).size());
    for (std::uint32_t from = 0; from < count; from += kPart) parts.push_back({k, from, std::min(count, from + kPart)});
  }
  const Pose& pose = plan.start;
  const Eigen::Affine3d local_from_scanner(Eigen::Translation3d(pose.translation) * pose.rotation);
  const Eigen::Affine3d scanner_from_local = local_from_scanner.inverse();
  tbb::enumerable_thread_specific<std::vector<Piece>> found;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, parts.size(), 16), [&](const auto& range) {
    Cutter cutter(plan, wanted, found.local());
    for (std::size_t p = range.begin(); p < range.end(); ++p) {
      const Instance& instance = plan.scene.placed(parts[p].placement);
      const Mesh& mesh = *plan.scene.environment().meshes[instance.mesh];
      const Eigen::Affine3d scanner_from_mesh = scanner_from_local * instance.world_from_mesh;
      const auto corner = [&](std::uint32_t k) -> Eigen::Vector3d {
        return scanner_from_mesh * mesh.positions[k].cast<double>();
      };
      const auto& edges = plan.scene.edges(instance.mesh);
      const bool round = plan.scene.isBall(parts[p].placement);
      for (std::uint32_t i = parts[p].from; i < parts[p].to; ++i) {
        const MeshEdge& edge = edges[i];
        const Eigen::Vector3d from = corner(edge.from), to = corner(edge.to);
        if (wanted == Edges::corners) {
          const bool ends = edge.right == kNoCorner;
          const Eigen::Vector3d left = corner(edge.left), right = ends ? left : corner(edge.right);
          if (isConcave(plan.scene, local_from_scanner, from, to, left, ends ? nullptr : &right))
            cutter.add(BeamEdges::kRound, from, to, kBeamEdge);
          continue;
        }
        const double reach = edge.right == kNoCorner
                                 ? kBeamEdge
                                 : edgeReach(plan.instrument, from, to, corner(edge.left), corner(edge.right));
        const std::uint64_t number = std::uint64_t{parts[p].placement} << 32U | i;
        if (reach > 0) cutter.add(round ? BeamEdges::kRound : number, from, to, reach);
      }
    }
  });
  sort({found.begin(), found.end()});
}

namespace {

// The columns that a piece reaches, of the grid's.
std::pair<std::uint32_t, std::uint32_t> columnsOf(const EdgeMap::Piece& piece, std::uint32_t columns) {
  if (piece.rows_per_column <= 0) return {0, columns - 1};
  const float aside = piece.radius_rows / piece.rows_per_column;
  const auto inside = [&](float column) {
    return static_cast<std::uint32_t>(std::clamp(column, 0.0F, static_cast<float>(columns - 1)));
  };
  return {inside(std::min(piece.column[0], piece.column[1]) - aside),
          inside(std::max(piece.column[0], piece.column[1]) + aside + 1)};
}

std::pair<std::uint32_t, std::uint32_t> cellOf(const EdgeMap::Piece& piece, std::uint32_t columns) {
  const auto [from, to] = columnsOf(piece, columns);
  const auto level = static_cast<std::uint32_t>(std::bit_width(to - from));
  return {level, from >> level};
}

}  // namespace

void EdgeMap::sort(std::vector<std::vector<Piece>> found) {
  const std::uint32_t columns = plan_.settings.columns;
  for (std::uint32_t level = 0; level <= static_cast<std::uint32_t>(std::bit_width(columns)); ++level)
    first_.emplace_back((columns >> level) + 2, 0);
  for (const auto& pieces : found)
    for (const Piece& piece : pieces) {
      const auto [level, cell] = cellOf(piece, columns);
      ++first_[level][cell];
    }
  std::size_t sum = 0;
  for (auto& cells : first_)
    for (std::size_t& cell : cells) sum += std::exchange(cell, sum);
  pieces_.resize(sum);
  auto next = first_;
  for (auto& pieces : found) {
    for (const Piece& piece : pieces) {
      const auto [level, cell] = cellOf(piece, columns);
      pieces_[next[level][cell]++] = piece;
    }
    pieces = {};
  }
}

void ColumnEdges::begin(std::uint32_t rows) {
  rows_.assign((rows + kPacket - 1) / kPacket, 0);
  touched_ = rows_;
  edges_.resize(rows);
}

BeamEdges& ColumnEdges::at(std::uint32_t row) {
  const std::uint32_t bit = 1U << row % kPacket;
  BeamEdges& edges = edges_[row];
  if ((touched_[row / kPacket] & bit) == 0) {
    touched_[row / kPacket] |= bit;
    edges.count = 0, edges.several = false, edges.hidden_m = std::numeric_limits<float>::infinity();
  }
  return edges;
}

void ColumnEdges::add(std::uint32_t row, std::uint64_t edge) {
  rows_[row / kPacket] |= 1U << row % kPacket;
  BeamEdges& in = at(row);
  std::uint64_t* const end = in.edge + in.count;
  std::uint64_t* const place = std::lower_bound(in.edge, end, edge);
  if (place != end && *place == edge) return;
  if (in.count == BeamEdges::kMost || edge == BeamEdges::kRound) {
    in.several = true;
    return;
  }
  std::move_backward(place, end, end + 1);
  *place = edge;
  ++in.count;
}

void ColumnEdges::addHidden(std::uint32_t row, float range_m) {
  BeamEdges& in = at(row);
  in.hidden_m = std::min(in.hidden_m, range_m);
}

void EdgeMap::mark(const ColumnHits& hits, FacetCache& facets, ColumnEdges& found) const {
  const std::uint32_t column = hits.column();
  for (std::uint32_t level = 0; level < first_.size(); ++level) {
    const std::uint32_t cell = column >> level;
    const auto& cells = first_[level];
    for (std::size_t i = cells[cell > 0 ? cell - 1 : 0]; i < cells[cell + 1]; ++i)
      markPiece(pieces_[i], hits, facets, found);
  }
}

void EdgeMap::markPiece(const Piece& piece, const ColumnHits& hits, FacetCache& facets, ColumnEdges& found) const {
  const auto column = static_cast<float>(hits.column());
  const float radius = piece.radius_rows, scale = piece.rows_per_column;
  const float x0 = (piece.column[0] - column) * scale, x1 = (piece.column[1] - column) * scale;
  if (std::max(x0, x1) < -radius || std::min(x0, x1) > radius) return;
  const float across = x1 - x0, up = piece.row[1] - piece.row[0];
  const float square = across * across + up * up;
  float low = std::min(piece.row[0], piece.row[1]) - radius, high = std::max(piece.row[0], piece.row[1]) + radius;
  if (std::abs(across) > 1e-3F * radius) {
    const float crossing = piece.row[0] - x0 / across * up, half = radius * std::sqrt(square) / std::abs(across);
    low = std::max(low, crossing - half), high = std::min(high, crossing + half);
  }
  if (high < 0 || low > static_cast<float>(plan_.settings.rows - 1)) return;
  const auto from = static_cast<std::uint32_t>(std::max(0.0F, std::ceil(low)));
  const auto to = static_cast<std::uint32_t>(std::min(high, static_cast<float>(plan_.settings.rows - 1)));
  const float nearer = piece.nearness[1] - piece.nearness[0], inverse = square > 0 ? 1 / square : 0;
  for (std::uint32_t row = from; row <= to; ++row) {
    const float y = static_cast<float>(row) - piece.row[0];
    const float along = std::clamp((y * up - x0 * across) * inverse, 0.0F, 1.0F);
    const float dx = x0 + along * across, dy = y - along * up;
    if (dx * dx + dy * dy > radius * radius) continue;
    const float range = 1 / (piece.nearness[0] + along * nearer);
    if (range <= hits.ranges_m(row)[0] + kBehindHit_m ||
        visible(range, scale > 0 ? dx / scale : 0, -dy, row, hits, facets))
      found.add(row, piece.edge);
    else
      found.addHidden(row, range);
  }
}

// `column` and `row`: of the edge, beside the row's axis.
bool EdgeMap::visible(float range_m, float column, float row, std::uint32_t at_row, const ColumnHits& hits,
                      FacetCache& facets) const {
  const Beam beam = hits.beam(at_row);
  const Eigen::Vector3d direction =
      beam.direction + static_cast<double>(column) * plan_.columnStep_rad() * plan_.cosine[at_row] * beam.across +
      static_cast<double>(row) * plan_.rowStep_rad() * beam.upward;
  return edgeShows(plan_, facets, hits.hit(at_row), beam.origin, direction, range_m, hits.bodiesTime_s(at_row));
}

}  // namespace standpoint
