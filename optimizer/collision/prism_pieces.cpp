// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <map>
#include <queue>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "optimizer/collision/pieces.h"
#include "optimizer/collision/section_cover.h"

namespace standpoint {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase =
    CGAL::Constrained_triangulation_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<int, Kernel>>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                               CGAL::Exact_predicates_tag>;

constexpr double kFlatEnd = 0.001;  // m; a face this flat along the axis is a cap
constexpr double kUpright = 2e-3;   // sine of the largest angle between the axis and a side
constexpr double kSnap = 1e-5;      // m; points of the section this near are one
constexpr std::size_t kMostPrisms = 100;
constexpr std::size_t kMostSheetTriangles = 2000;
constexpr double kHalfSheet = 0.0005;  // m
constexpr std::size_t kMostDirections = 6;
constexpr std::size_t kMostSegments = 4000;
constexpr std::size_t kFewPolygons = 4;  // that need not become fewer
constexpr std::size_t kMostOblique = 8;  // planes that cut off a prism's ends
constexpr double kInside = 0.001;        // m from its caps where a prism with oblique ends is sliced

using Key = std::array<long long, 2>;
using Segment = std::pair<Key, Key>;
using Polygon = std::vector<int>;

struct Section {
  std::vector<Vector2d> points;
  std::vector<Polygon> polygons;  // convex, counter-clockwise
  std::vector<Polygon> gaps;      // the rest of their hull, likewise
};

// A plane that a part lies behind of.
struct CutPlane {
  Vector3d normal;
  double offset = 0;
};

struct Frame {
  Vector3d u, v, axis;
  Vector2d flat(const Vector3d& p) const { return {u.dot(p), v.dot(p)}; }
  Vector3d lifted(const Vector2d& p, double height) const { return u * p.x() + v * p.y() + axis * height; }
};

double cross(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b - a).x() * (c - b).y() - (b - a).y() * (c - b).x();
}

// Heights of the caps, and the planes of faces that are neither cap nor side, such as mitred ends; no heights where the
// part does not lie behind such planes.
std::vector<double> levels(const Shape& part, const Vector3d& axis, std::vector<CutPlane>& oblique) {
  std::vector<double> heights;
  for (const auto& t : part.triangles) {
    const auto &a = part.positions[t[0]], &b = part.positions[t[1]], &c = part.positions[t[2]];
    const Vector3d normal = (b - a).cross(c - a);
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const auto [low, high] = std::minmax({axis.dot(a), axis.dot(b), axis.dot(c)});
    if (high - low <= kFlatEnd) {
      heights.push_back(0.5 * (low + high));
      continue;
    }
    if (normal.norm() <= kFlatEnd * longest || std::abs(normal.normalized().dot(axis)) <= kUpright) continue;
    const CutPlane plane{normal.normalized(), normal.normalized().dot(a)};
    if (std::any_of(oblique.begin(), oblique.end(), [&](const CutPlane& p) {
          return (p.normal - plane.normal).norm() < kFlatEnd && std::abs(p.offset - plane.offset) < kFlatEnd;
        }))
      continue;
    if (oblique.size() == kMostOblique ||
        std::any_of(part.positions.begin(), part.positions.end(),
                    [&](const Vector3d& p) { return plane.normal.dot(p) > plane.offset + kFlatEnd; }))
      return {};
    oblique.push_back(plane);
  }
  return distinct(std::move(heights), kFlatEnd);
}

// Where the sides cross the plane at `height`: segments between snapped points, each of which bounds the section.
std::vector<Segment> slice(const Shape& part, const Frame& frame, double height) {
  std::vector<Segment> segments;
  for (const auto& t : part.triangles) {
    std::vector<Key> ends;
    for (int k = 0; k < 3; ++k) {
      const Vector3d &p = part.positions[t[k]], &q = part.positions[t[(k + 1) % 3]];
      const double hp = frame.axis.dot(p) - height, hq = frame.axis.dot(q) - height;
      if ((hp < 0) == (hq < 0)) continue;
      const Vector2d at = frame.flat(p + (q - p) * (hp / (hp - hq)));
      ends.push_back({std::llround(at.x() / kSnap), std::llround(at.y() / kSnap)});
    }
    if (ends.size() == 2 && ends[0] != ends[1])
      segments.emplace_back(std::min(ends[0], ends[1]), std::max(ends[0], ends[1]));
  }
  std::sort(segments.begin(), segments.end());
  std::vector<Segment> odd;  // two faces at one place bound nothing
  for (const auto& segment : segments) {
    if (!odd.empty() && odd.back() == segment)
      odd.pop_back();
    else
      odd.push_back(segment);
  }
  return odd;
}

// Each face's number of borders between it and the outside; odd ones are solid.
void countBorders(Triangulation& triangulation) {
  for (const auto face : triangulation.all_face_handles()) face->info() = -1;
  std::deque<Triangulation::Face_handle> near{triangulation.infinite_face()};
  near.front()->info() = 0;
  while (!near.empty()) {
    const auto face = near.front();
    near.pop_front();
    for (int k = 0; k < 3; ++k) {
      const auto next = face->neighbor(k);
      if (next->info() >= 0) continue;
      const bool border = triangulation.is_constrained({face, k});
      next->info() = face->info() + (border ? 1 : 0);
      if (border)
        near.push_back(next);
      else
        near.push_front(next);
    }
  }
}

// Joins two convex polygons along the edge a-b that they share; empty when the result would not be convex.
Polygon joined(const std::vector<Vector2d>& points, Polygon p, Polygon q, int a, int b) {
  std::rotate(p.begin(), std::find(p.begin(), p.end(), b), p.end());  // p: b ... a (the edge a-b closes it)
  std::rotate(q.begin(), std::find(q.begin(), q.end(), a), q.end());  // q: a ... b
  p.insert(p.end(), q.begin() + 1, q.end() - 1);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto &x = points[p[i]], &y = points[p[(i + 1) % p.size()]], &z = points[p[(i + 2) % p.size()]];
    if (cross(x, y, z) < -1e-4 * (y - x).norm() * (z - y).norm() * std::min(1.0, (y - x).norm() + (z - y).norm()))
      return {};
  }
  return p;
}

// Hertel and Mehlhorn (1983): drop diagonals, longest first, while what they part stays convex.
std::vector<Polygon> convexPartition(const std::vector<Vector2d>& points, std::vector<Polygon> polygons) {
  struct Diagonal {
    double length;
    int a, b;
    std::size_t left, right;
  };
  std::map<std::pair<int, int>, std::size_t> side;
  for (std::size_t i = 0; i < polygons.size(); ++i)
    for (int k = 0; k < 3; ++k) side[{polygons[i][k], polygons[i][(k + 1) % 3]}] = i;
  std::vector<Diagonal> diagonals;
  for (const auto& [edge, left] : side)
    if (edge.first < edge.second)
      if (const auto other = side.find({edge.second, edge.first}); other != side.end())
        diagonals.push_back(
            {(points[edge.first] - points[edge.second]).norm(), edge.first, edge.second, left, other->second});
  std::stable_sort(diagonals.begin(), diagonals.end(),
                   [](const Diagonal& x, const Diagonal& y) { return x.length > y.length; });
  std::vector<std::size_t> now(polygons.size());
  for (std::size_t i = 0; i < now.size(); ++i) now[i] = i;
  const auto find = [&](std::size_t i) {
    while (now[i] != i) i = now[i];
    return i;
  };
  for (const auto& d : diagonals) {
    const auto left = find(d.left), right = find(d.right);
    if (left == right) continue;
    auto whole = joined(points, polygons[left], polygons[right], d.a, d.b);
    if (whole.empty()) continue;
    polygons[left] = std::move(whole);
    polygons[right].clear();
    now[right] = left;
  }
  std::erase_if(polygons, [](const Polygon& p) { return p.empty(); });
  return polygons;
}

// Closed loops of segments with fewer sides that stay within tolerance_m; the segments as they are where they make no
// such loops.
std::vector<Segment> withFewerSides(const std::vector<Segment>& segments, double tolerance_m) {
  std::map<Key, std::vector<Key>> next;
  for (const auto& [a, b] : segments) next[a].push_back(b), next[b].push_back(a);
  std::vector<Segment> result;
  while (!next.empty()) {
    const Key start = next.begin()->first;
    Outline loop;
    for (Key at = start, before = start;;) {
      const auto node = next.find(at);
      if (node == next.end() || node->second.size() != 2) return segments;
      loop.emplace_back(static_cast<double>(at[0]) * kSnap, static_cast<double>(at[1]) * kSnap);
      const Key to = node->second[0] == before ? node->second[1] : node->second[0];
      next.erase(node);
      before = at, at = to;
      if (at == start) break;
    }
    loop = simplified(loop, tolerance_m);
    std::vector<Key> keys;
    for (const auto& p : loop) keys.push_back({std::llround(p.x() / kSnap), std::llround(p.y() / kSnap)});
    for (std::size_t i = 0; i < keys.size(); ++i)
      if (const auto& to = keys[(i + 1) % keys.size()]; keys[i] != to) result.emplace_back(keys[i], to);
  }
  return result;
}

Section section(const Shape& part, const Frame& frame, double height, double tolerance_m) {
  auto segments = slice(part, frame, height);
  if (segments.size() > kMostSegments) return {};
  if (tolerance_m > 0) segments = withFewerSides(segments, tolerance_m);
  Triangulation triangulation;
  const auto point = [](const Key& key) {
    return Kernel::Point_2(static_cast<double>(key[0]) * kSnap, static_cast<double>(key[1]) * kSnap);
  };
  for (const auto& [a, b] : segments) triangulation.insert_constraint(point(a), point(b));
  Section result;
  if (triangulation.dimension() < 2) return result;
  countBorders(triangulation);
  for (const auto vertex : triangulation.finite_vertex_handles()) {
    vertex->info() = static_cast<int>(result.points.size());
    result.points.emplace_back(vertex->point().x(), vertex->point().y());
  }
  for (const auto face : triangulation.finite_face_handles())
    (face->info() % 2 == 1 ? result.polygons : result.gaps)
        .push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  result.polygons = convexPartition(result.points, std::move(result.polygons));
  result.gaps = convexPartition(result.points, std::move(result.gaps));
  return result;
}

std::vector<Outline> outlinesOf(const Section& section, const std::vector<Polygon>& polygons) {
  std::vector<Outline> result;
  for (const auto& polygon : polygons) {
    auto& outline = result.emplace_back();
    for (const int i : polygon) outline.push_back(section.points[static_cast<std::size_t>(i)]);
  }
  return result;
}

Piece lift(const Outline& outline, const Frame& frame, double low, double high) {
  std::vector<Vector3d> bottom, top;
  std::vector<Vector2d> corners;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto &x = outline[(i + outline.size() - 1) % outline.size()], &y = outline[i],
               &z = outline[(i + 1) % outline.size()];
    if (std::abs(cross(x, y, z)) <= 1e-4 * (z - x).norm() * std::min((y - x).norm(), (z - y).norm()))
      continue;  // on a line
    bottom.push_back(frame.lifted(y, low));
    top.push_back(frame.lifted(y, high));
    corners.push_back(y);
  }
  if (corners.size() < 3) return {};
  bool square = corners.size() == 4;
  for (std::size_t i = 0; square && i < 4; ++i) {
    const Vector2d a = corners[(i + 1) % 4] - corners[i], b = corners[(i + 2) % 4] - corners[(i + 1) % 4];
    square = std::abs(a.dot(b)) < 1e-3 * a.norm() * b.norm();
  }
  return prism(bottom, top, square ? CollisionShapeKind::box : CollisionShapeKind::convex);
}

// What of a convex piece is behind the planes.
Piece cutOff(Piece piece, const std::vector<CutPlane>& planes) {
  for (const auto& plane : planes) {
    const auto above = [&](const Vector3d& p) { return plane.normal.dot(p) - plane.offset; };
    if (std::all_of(piece.positions.begin(), piece.positions.end(),
                    [&](const Vector3d& p) { return above(p) <= kSnap; }))
      continue;
    std::vector<Vector3d> points;
    for (const auto& p : piece.positions)
      if (above(p) <= 0) points.push_back(p);
    for (const auto& p : piece.positions)  // also of diagonals: they end within the face of the cut
      for (const auto& q : piece.positions)
        if (const double a = above(p), b = above(q); a < 0 && b > 0) points.push_back(p + (q - p) * (a / (a - b)));
    auto rest = hullPiece(points);
    if (!rest) return {};
    piece = std::move(*rest);
  }
  return piece;
}

// A layer of a part, parted or covered, whichever takes fewer pieces; `volume_m3` grows by what is parted.
std::vector<Piece> layer(const Section& section, const Frame& frame, double low, double high,
                         const std::vector<CutPlane>& oblique, double& volume_m3) {
  const auto lifted = [&](const std::vector<Outline>& outlines) {
    std::vector<Piece> pieces;
    for (const auto& outline : outlines)
      if (auto piece = cutOff(lift(outline, frame, low, high), oblique); !piece.triangles.empty())
        pieces.push_back(std::move(piece));
    return pieces;
  };
  const auto parts = outlinesOf(section, section.polygons);
  auto pieces = lifted(parts);
  for (const auto& piece : pieces) volume_m3 += volumeOf(piece.positions, piece.triangles);
  if (pieces.size() <= kFewPolygons || pieces.size() > kMostPrisms) return pieces;
  auto covering = lifted(coverOf(parts, outlinesOf(section, section.gaps)));
  return covering.empty() || covering.size() >= pieces.size() ? pieces : covering;
}

std::vector<Piece> prismsAlong(const Shape& part, const Vector3d& axis, double volume_m3, double tolerance_m) {
  std::vector<CutPlane> oblique;
  const auto heights = levels(part, axis, oblique);
  if (heights.size() < 2 || (heights.size() > 2 && !oblique.empty())) return {};
  const Frame frame{axis.unitOrthogonal(), axis.cross(axis.unitOrthogonal()), axis};
  // With oblique ends, the section is as long as it gets beside one of the caps, and they are cut off afterwards.
  const auto slices =
      oblique.empty() ? std::vector<double>{0} : std::vector<double>{heights[0] + kInside, heights[1] - kInside};
  std::vector<Piece> best;
  double least = 0.01 * std::abs(volume_m3);
  for (const double beside : slices) {
    std::vector<Piece> result;
    double sum = 0;
    for (std::size_t i = 0; i + 1 < heights.size() && result.size() <= kMostPrisms; ++i) {
      const double at = oblique.empty() ? 0.5 * (heights[i] + heights[i + 1]) : beside;
      auto pieces = layer(section(part, frame, at, tolerance_m), frame, heights[i], heights[i + 1], oblique, sum);
      std::move(pieces.begin(), pieces.end(), std::back_inserter(result));
    }
    if (const double off = std::abs(sum - std::abs(volume_m3)); result.size() <= kMostPrisms && off <= least)
      least = off, best = std::move(result);
  }
  return best;
}

}  // namespace

std::vector<Piece> sheetPieces(const Shape& part) {
  const auto directions = faceDirections(part);
  if (directions.size() != 1) return {};
  const Vector3d& axis = directions[0];
  const Frame frame{axis.unitOrthogonal(), axis.cross(axis.unitOrthogonal()), axis};
  Section sheet;
  double height = 0;
  for (const auto& p : part.positions) {
    sheet.points.push_back(frame.flat(p));
    height += axis.dot(p) / static_cast<double>(part.positions.size());
  }
  std::vector<Triangle> seen;
  for (auto t : part.triangles) {
    auto sorted = t;
    std::sort(sorted.begin(), sorted.end());
    if (std::find(seen.begin(), seen.end(), sorted) != seen.end()) continue;  // the same face from behind
    seen.push_back(sorted);
    const double turn = cross(sheet.points[t[0]], sheet.points[t[1]], sheet.points[t[2]]);
    if (turn < 0) std::swap(t[1], t[2]);
    if (turn != 0) sheet.polygons.push_back({static_cast<int>(t[0]), static_cast<int>(t[1]), static_cast<int>(t[2])});
    if (seen.size() > kMostSheetTriangles) return {};
  }
  sheet.polygons = convexPartition(sheet.points, std::move(sheet.polygons));
  std::vector<Piece> result;
  for (const auto& outline : outlinesOf(sheet, sheet.polygons))
    if (auto piece = lift(outline, frame, height - kHalfSheet, height + kHalfSheet); !piece.triangles.empty())
      result.push_back(std::move(piece));
  return result.size() > kMostPrisms ? std::vector<Piece>{} : result;
}

std::vector<Piece> prismPieces(const Shape& part, double volume_m3, double tolerance_m) {
  std::vector<Piece> best;
  auto directions = faceDirections(part);
  directions.resize(std::min(directions.size(), kMostDirections));
  for (const auto& axis : directions) {
    try {
      auto pieces = prismsAlong(part, axis, volume_m3, tolerance_m);
      if (!pieces.empty() && (best.empty() || pieces.size() < best.size())) best = std::move(pieces);
    } catch (const std::exception&) {
      // CGAL refuses sections that cross themselves beyond repair; such a part is not prismatic along this axis.
    }
  }
  return best;
}

}  // namespace standpoint
