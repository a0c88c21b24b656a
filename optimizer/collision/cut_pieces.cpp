// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/winding_number.h"
#include "optimizer/collision/pieces.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;
using Loop = std::vector<Vector3d>;

constexpr double kOn = 1e-6;              // m; a point this near to a plane is on it
constexpr double kSamePlane = 1 - 1e-10;  // cosine
constexpr std::size_t kMostPieces = 300;
constexpr std::size_t kMostCandidates = 24;
constexpr std::size_t kManyFacets = 400;         // of which each cut is not tried, but judged by what it severs
constexpr double kClear = 1e-4;                  // m; a face this little within a hull is at its surface
constexpr std::size_t kMostMerged = 120;         // pieces of which pairs are tried
constexpr std::uint64_t kMostWork = 60'000'000;  // points held against planes: a third of a second

struct Plane {
  Vector3d normal = Vector3d::UnitZ();
  double offset = 0;
  double area = 0;
  double above(const Vector3d& p) const { return normal.dot(p) - offset; }
};

// A bit of a face, as far as it lies in a cell.
struct Facet {
  Loop loop;
  std::uint32_t plane = 0;  // index of the one that its outside is above of
};

// A convex part of space and what of the solid's surface is in it.
struct Cell {
  std::vector<Loop> walls;  // convex, in any sense
  std::vector<Facet> facets;
};

// The convex loop on the plane's side; points on the plane belong to both sides.
Loop clipped(const Loop& loop, const Plane& plane, double side) {
  Loop result;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector3d &p = loop[i], &q = loop[(i + 1) % loop.size()];
    const double a = side * plane.above(p), b = side * plane.above(q);
    if (a >= -kOn) result.push_back(p);
    if ((a > kOn && b < -kOn) || (a < -kOn && b > kOn)) result.push_back(p + (q - p) * (a / (a - b)));
  }
  return result.size() < 3 ? Loop{} : result;
}

bool liesOn(const Loop& loop, const Plane& plane) {
  return std::all_of(loop.begin(), loop.end(), [&](const Vector3d& p) { return std::abs(plane.above(p)) <= kOn; });
}

// The new wall where a plane cuts a convex cell: the points on it in their order around the middle.
Loop capOf(const std::vector<Loop>& walls, const Plane& plane) {
  Loop points;
  for (const auto& loop : walls)
    for (const auto& p : loop)
      if (std::abs(plane.above(p)) <= 2 * kOn && std::none_of(points.begin(), points.end(), [&](const Vector3d& q) {
            return (p - q).squaredNorm() < kOn * kOn;
          }))
        points.push_back(p);
  if (points.size() < 3) return {};
  Vector3d middle = Vector3d::Zero();
  for (const auto& p : points) middle += p / static_cast<double>(points.size());
  const Vector3d u = plane.normal.unitOrthogonal(), v = plane.normal.cross(u);
  std::sort(points.begin(), points.end(), [&](const Vector3d& a, const Vector3d& b) {
    return std::atan2(v.dot(a - middle), u.dot(a - middle)) < std::atan2(v.dot(b - middle), u.dot(b - middle));
  });
  return points;
}

// The corners, each once or nearly so.
std::vector<Vector3d> cornersOf(const std::vector<Facet>& facets) {
  std::vector<Vector3d> points;
  for (const auto& facet : facets) points.insert(points.end(), facet.loop.begin(), facet.loop.end());
  std::sort(points.begin(), points.end(), [](const Vector3d& a, const Vector3d& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  });
  points.erase(std::unique(points.begin(), points.end(),
                           [](const Vector3d& a, const Vector3d& b) { return (a - b).squaredNorm() < kOn * kOn; }),
               points.end());
  return points;
}

class Cutter {
 public:
  Cutter(const Shape& part, double tolerance_m) : part_(part), tolerance_(tolerance_m) {}

  std::vector<Piece> run() {
    std::vector<Cell> cells{whole()};
    std::vector<Piece> pieces;
    while (!cells.empty()) {
      Cell cell = std::move(cells.back());
      cells.pop_back();
      const auto plane = cutOf(cell);
      if (work_ > kMostWork || pieces.size() + cells.size() > kMostPieces) return {};
      if (plane) {
        cells.push_back(half(cell, *plane, -1));
        cells.push_back(half(cell, *plane, 1));
      } else if (auto piece = solidIn(cell)) {
        pieces.push_back(std::move(*piece));
      }
    }
    merge(pieces);
    return pieces;
  }

 private:
  std::uint32_t planeOf(const Plane& plane) {
    const auto same = std::find_if(planes_.begin(), planes_.end(), [&](const Plane& p) {
      return p.normal.dot(plane.normal) > kSamePlane && std::abs(p.offset - plane.offset) < kOn;
    });
    if (same == planes_.end()) return planes_.push_back(plane), static_cast<std::uint32_t>(planes_.size() - 1);
    same->area += plane.area;
    return static_cast<std::uint32_t>(same - planes_.begin());
  }

  Cell whole() {
    Cell cell;
    Vector3d low = part_.positions[0], high = low;
    for (const auto& p : part_.positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
    low.array() -= 0.1, high.array() += 0.1;
    for (int axis = 0; axis < 3; ++axis)
      for (const double at : {low[axis], high[axis]}) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        Loop loop(4, low);
        for (auto& p : loop) p[axis] = at;
        loop[1][u] = loop[2][u] = high[u];
        loop[2][v] = loop[3][v] = high[v];
        cell.walls.push_back(std::move(loop));
      }
    for (const auto& t : part_.triangles) {
      const Vector3d &a = part_.positions[t[0]], &b = part_.positions[t[1]], &c = part_.positions[t[2]];
      const Vector3d normal = (b - a).cross(c - a);
      const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
      if (!(normal.norm() > 1e-5 * longest)) continue;  // a sliver says nothing of its plane
      const Vector3d unit = normal.normalized();
      cell.facets.push_back({{a, b, c}, planeOf({unit, unit.dot(a + b + c) / 3, normal.norm() / 2})});
    }
    return cell;
  }

  std::vector<Facet> halfOf(const std::vector<Facet>& facets, const Plane& plane, double side) const {
    std::vector<Facet> result;
    for (const auto& facet : facets) {
      // What lies on the plane bounds the solid on the side that it turns its back to.
      if (liesOn(facet.loop, plane)) {
        if (side * planes_[facet.plane].normal.dot(plane.normal) < 0) result.push_back(facet);
      } else if (auto part = clipped(facet.loop, plane, side); !part.empty() && !liesOn(part, plane)) {
        result.push_back({std::move(part), facet.plane});
      }
    }
    return result;
  }

  Cell half(const Cell& cell, const Plane& plane, double side) const {
    Cell result;
    for (const auto& loop : cell.walls)
      if (auto part = clipped(loop, plane, side); !part.empty() && !liesOn(part, plane))
        result.walls.push_back(std::move(part));
    if (auto cap = capOf(result.walls, plane); !cap.empty()) result.walls.push_back(std::move(cap));
    result.facets = halfOf(cell.facets, plane, side);
    return result;
  }

  // The planes before which there is something of the surface, so that the solid is not convex; largest faces first.
  std::vector<std::uint32_t> reflexPlanes(const std::vector<Facet>& facets) {
    const auto corners = cornersOf(facets);
    std::vector<std::uint32_t> result;
    for (const auto& facet : facets) result.push_back(facet.plane);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    std::erase_if(result, [&](std::uint32_t i) {
      const auto before = std::find_if(corners.begin(), corners.end(),
                                       [&](const Vector3d& p) { return planes_[i].above(p) > tolerance_; });
      work_ += static_cast<std::uint64_t>(before - corners.begin()) + 1;
      return before == corners.end();
    });
    return result;
  }

  // The plane of a face that leaves least to do, or nothing where all is convex already.
  std::optional<Plane> cutOf(const Cell& cell) {
    auto candidates = reflexPlanes(cell.facets);
    std::stable_sort(candidates.begin(), candidates.end(),
                     [&](auto a, auto b) { return planes_[a].area > planes_[b].area; });
    if (candidates.size() > kMostCandidates) candidates.resize(kMostCandidates);
    std::optional<Plane> best;
    std::size_t least = std::numeric_limits<std::size_t>::max();
    for (const auto i : candidates) {
      const auto& plane = planes_[i];
      const std::size_t cost = cell.facets.size() > kManyFacets
                                   ? severed(cell.facets, plane)
                                   : reflexPlanes(halfOf(cell.facets, plane, -1)).size() +
                                         reflexPlanes(halfOf(cell.facets, plane, 1)).size();
      if (cost < least) best = plane, least = cost;
    }
    return best;
  }

  // For the many facets of a round or rich part: how many are cut in two, and how unevenly.
  std::size_t severed(const std::vector<Facet>& facets, const Plane& plane) {
    work_ += facets.size() * 3;
    std::size_t both = 0, before = 0;
    for (const auto& facet : facets) {
      double low = 0, high = 0;
      for (const auto& p : facet.loop) low = std::min(low, plane.above(p)), high = std::max(high, plane.above(p));
      if (low < -kOn && high > kOn)
        ++both;
      else if (high > kOn)
        ++before;
    }
    const std::size_t behind = facets.size() - before;
    return 8 * both + std::max(before, behind) - std::min(before, behind);
  }

  // The solid in a cell without reflex facets: the corners of its facets, and those of the cell that lie in it.
  std::optional<Piece> solidIn(const Cell& cell) {
    auto points = cornersOf(cell.facets);
    std::vector<Vector3d> corners;
    for (const auto& loop : cell.walls)
      for (const auto& p : loop)
        if (std::none_of(corners.begin(), corners.end(),
                         [&](const Vector3d& q) { return (p - q).squaredNorm() < kOn * kOn; }))
          corners.push_back(p);
    work_ += corners.size() * part_.triangles.size() * 10;
    for (const auto& p : corners) {
      // A corner of the cell may lie in the plane of a face without being on it: asked a little inwards.
      Vector3d middle = Vector3d::Zero();
      for (const auto& q : corners) middle += q / static_cast<double>(corners.size());
      if (windingNumber(part_.positions, part_.triangles, p + (middle - p) * 1e-4) > 0.5) points.push_back(p);
    }
    auto piece = hullPiece(points);
    if (piece && volumeOf(piece->positions, piece->triangles) < 1e-9) return std::nullopt;
    return piece;
  }

  // Whether nothing of the surface runs through the hull, but for a depth of `tolerance_m`: then it is all solid, or
  // all not.
  bool isClear(const Piece& hull, double tolerance_m) const {
    std::vector<Plane> planes;
    for (const auto& t : hull.triangles) {
      const Vector3d &a = hull.positions[t[0]], ab = hull.positions[t[1]] - a, ac = hull.positions[t[2]] - a,
                     normal = ab.cross(ac);
      if (normal.norm() < 1e-5 * std::max(ab.norm(), ac.norm())) continue;
      const Vector3d unit = normal.normalized();
      planes.push_back({unit, unit.dot(a) - tolerance_m});
    }
    Vector3d low = hull.positions[0], high = low;
    for (const auto& p : hull.positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
    for (const auto& t : part_.triangles) {
      const Vector3d &a = part_.positions[t[0]], &b = part_.positions[t[1]], &c = part_.positions[t[2]];
      if ((a.cwiseMin(b).cwiseMin(c).array() > high.array()).any() ||
          (a.cwiseMax(b).cwiseMax(c).array() < low.array()).any())
        continue;
      Loop loop{a, b, c};
      for (const auto& plane : planes)
        if (loop = clipped(loop, plane, -1); loop.empty()) break;
      if (!loop.empty()) return false;
    }
    return true;
  }

  bool isSolid(const std::vector<Vector3d>& points) const {
    return std::all_of(points.begin(), points.end(),
                       [&](const Vector3d& p) { return windingNumber(part_.positions, part_.triangles, p) > 0.5; });
  }

  // Where two pieces of an open shape may have nothing but a missing face between them.
  static std::vector<Vector3d> between(const Piece& a, const Piece& b) {
    const auto middle = [](const Piece& piece) {
      Vector3d sum = Vector3d::Zero();
      for (const auto& p : piece.positions) sum += p / static_cast<double>(piece.positions.size());
      return sum;
    };
    const Vector3d from = middle(a), to = middle(b);
    return {0.75 * from + 0.25 * to, 0.5 * (from + to), 0.25 * from + 0.75 * to};
  }

  // Joins pieces whose common hull is still within the solid, the largest first; it may lie over others.
  void merge(std::vector<Piece>& pieces) const {
    if (pieces.size() > kMostMerged) return;
    const auto volume = [](const Piece& p) { return volumeOf(p.positions, p.triangles); };
    std::stable_sort(pieces.begin(), pieces.end(),
                     [&](const Piece& a, const Piece& b) { return volume(a) > volume(b); });
    const auto touch = [](const Piece& a, const Piece& b) {
      for (int axis = 0; axis < 3; ++axis) {
        const auto by_axis = [&](const Vector3d& p, const Vector3d& q) { return p[axis] < q[axis]; };
        const auto [a0, a1] = std::minmax_element(a.positions.begin(), a.positions.end(), by_axis);
        const auto [b0, b1] = std::minmax_element(b.positions.begin(), b.positions.end(), by_axis);
        if ((*a0)[axis] > (*b1)[axis] + kClear || (*b0)[axis] > (*a1)[axis] + kClear) return false;
      }
      return true;
    };
    for (std::size_t i = 0; i < pieces.size(); ++i)
      for (std::size_t k = i + 1; k < pieces.size();) {
        if (!touch(pieces[i], pieces[k])) {
          ++k;
          continue;
        }
        auto points = pieces[i].positions;
        points.insert(points.end(), pieces[k].positions.begin(), pieces[k].positions.end());
        auto both = hullPiece(points);
        if (both && isClear(*both, std::max(kClear, 0.25 * tolerance_)) && isSolid(between(pieces[i], pieces[k]))) {
          pieces[i] = std::move(*both);
          pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(k));
          k = i + 1;
        } else {
          ++k;
        }
      }
  }

  const Shape& part_;
  double tolerance_;
  std::vector<Plane> planes_;
  std::uint64_t work_ = 0;
};

}  // namespace

std::vector<Piece> cutPieces(const Shape& part, double tolerance_m) { return Cutter(part, tolerance_m).run(); }

}  // namespace standpoint
