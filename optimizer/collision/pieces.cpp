// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/collision/pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/winding_number.h"
#include "optimizer/simplify/collapses/collapse.h"
#include "optimizer/surface/deviation.h"
#include "optimizer/surface/triangle_tree.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostParts = 1000;        // a mesh of more stays a mesh
constexpr std::size_t kMostTriangles = 20'000;  // of a part that is taken apart
constexpr double kSameVolume = 1e-3;            // a part with this little concavity is convex
constexpr std::size_t kMostInVain = 20'000;     // triangles of a shape that are cut for nothing before it is given up
constexpr std::size_t kFew = 4;                 // pieces that need not become fewer
constexpr double kThin = 1e-6;                  // m of volume for each m² of a part that is a sheet
constexpr double kCovered = 1e-4;               // m; a point this near to a piece is covered by it
constexpr double kSliver = 1e-4;                // m; a triangle lower than this
constexpr std::size_t kManyTriangles = 300;     // of a part that is flattened before it is cut
constexpr double kCutFraction = 0.4;            // of the largest deviation
constexpr double kSectionFraction = 0.85;       // …
constexpr double kFlattenFractions[] = {0.4, 0.1, 0.05, 0.025};
constexpr std::uint32_t kSamples = 2000, kLeastSamples = 150;  // of a part, and of each of its pieces

// The sets of triangles that `root` calls one, in the order of their first triangles; one set where there would be too
// many.
template <class Root>
std::vector<Shape> gathered(const Shape& shape, Root root) {
  constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> part_of(std::max(shape.positions.size(), shape.triangles.size()), kNone);
  std::vector<std::vector<std::uint32_t>> members;
  for (std::uint32_t i = 0; i < shape.triangles.size(); ++i) {
    auto& part = part_of[root(i)];
    if (part == kNone) {
      part = static_cast<std::uint32_t>(members.size());
      members.emplace_back();
      if (members.size() > kMostParts) return {shape};
    }
    members[part].push_back(i);
  }
  std::vector<Shape> parts(members.size());
  std::vector<std::uint32_t> index(shape.positions.size(), kNone), seen_by(shape.positions.size(), kNone);
  for (std::uint32_t p = 0; p < members.size(); ++p) {
    parts[p].half_size = shape.half_size;
    for (const auto i : members[p]) {
      Triangle t = shape.triangles[i];
      for (auto& v : t) {
        if (seen_by[v] != p) {
          seen_by[v] = p;
          index[v] = static_cast<std::uint32_t>(parts[p].positions.size());
          parts[p].positions.push_back(shape.positions[v]);
        }
        v = index[v];
      }
      parts[p].triangles.push_back(t);
      parts[p].surface_of_triangle.push_back(shape.surface_of_triangle[i]);
    }
  }
  return parts;
}

class Sets {
 public:
  explicit Sets(std::size_t count) : joined_(count) { std::iota(joined_.begin(), joined_.end(), 0U); }
  std::uint32_t root(std::uint32_t i) {
    while (joined_[i] != i) i = joined_[i] = joined_[joined_[i]];
    return i;
  }
  void join(std::uint32_t i, std::uint32_t k) {
    const auto a = root(i), b = root(k);
    joined_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> joined_;
};

std::vector<Shape> connectedParts(const Shape& shape) {
  Sets sets(shape.positions.size());
  for (const auto& t : shape.triangles) sets.join(t[0], t[1]), sets.join(t[0], t[2]);
  return gathered(shape, [&](std::uint32_t i) { return sets.root(shape.triangles[i][0]); });
}

// Parted also along edges of more than two triangles: a pane that ends on its frame becomes a part of its own.
std::vector<Shape> manifoldParts(const Shape& shape) {
  std::vector<std::array<std::uint32_t, 3>> edges;  // its ends, and the triangle
  for (std::uint32_t i = 0; i < shape.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(shape.triangles[i][k], shape.triangles[i][(k + 1) % 3]);
      edges.push_back({low, high, i});
    }
  std::sort(edges.begin(), edges.end());
  Sets sets(shape.triangles.size());
  for (std::size_t first = 0, end = 0; first < edges.size(); first = end) {
    while (end < edges.size() && edges[end][0] == edges[first][0] && edges[end][1] == edges[first][1]) ++end;
    if (end - first == 2) sets.join(edges[first][2], edges[first + 1][2]);
  }
  return gathered(shape, [&](std::uint32_t i) { return sets.root(i); });
}

// A part that is inside out beside one that is not is a cavity: such parts are taken as one.
std::vector<Shape> parts(const Shape& shape) {
  auto result = connectedParts(shape);
  bool positive = false, negative = false;
  for (const auto& part : result) (volumeOf(part.positions, part.triangles) < 0 ? negative : positive) = true;
  if (positive && negative) return {shape};
  return result;
}

bool contains(const Piece& piece, const Vector3d& p, double tolerance) {
  for (const auto& t : piece.triangles) {
    const Vector3d& a = piece.positions[t[0]];
    const Vector3d ab = piece.positions[t[1]] - a, ac = piece.positions[t[2]] - a, normal = ab.cross(ac);
    if (normal.norm() < kSliver * std::max(ab.norm(), ac.norm())) continue;  // whose normal says nothing
    if (normal.dot(p - a) > tolerance * normal.norm()) return false;
  }
  return true;
}

struct Box {
  Vector3d low, high;
  explicit Box(const Piece& piece) : low(piece.positions[0]), high(low) {
    for (const auto& p : piece.positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
  bool holds(const Vector3d& p) const {
    return ((p - low).array() >= -kCovered).all() && ((high - p).array() >= -kCovered).all();
  }
};

// Both ways: the part's surface from the pieces, and the pieces' surface from the part's where no other piece covers
// it. Where the pieces have the part's volume, a face within them is one that the file put into its solid, and not a
// hollow. Infinite as soon as it is more than max_deviation_m.
double deviationOf(const std::vector<Piece>& pieces, const Shape& part, double max_deviation_m) {
  std::vector<Vector3d> positions;
  std::vector<Triangle> triangles;
  std::vector<Box> boxes;
  double sum = 0;
  for (const auto& piece : pieces) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), piece.positions.begin(), piece.positions.end());
    for (const auto& t : piece.triangles) triangles.push_back({first + t[0], first + t[1], first + t[2]});
    boxes.emplace_back(piece);
    sum += volumeOf(piece.positions, piece.triangles);
  }
  const double volume = std::abs(volumeOf(part.positions, part.triangles));
  const bool closed = isClosed(meshOf(part)), same_volume = closed && std::abs(sum - volume) <= kSameVolume * volume;
  const TriangleTree tree(positions, triangles), part_tree(part.positions, part.triangles);
  const auto covered = [&](const Vector3d& p, std::size_t except, double tolerance) {
    for (std::size_t k = 0; k < pieces.size(); ++k)
      if (k != except && boxes[k].holds(p) && contains(pieces[k], p, tolerance)) return true;
    return false;
  };
  double worst = 0;
  const double limit = max_deviation_m * max_deviation_m;
  const auto inward = [&](const Vector3d& p) {
    const double distance = tree.squaredDistance(p);
    if (distance > worst && !(same_volume && covered(p, pieces.size(), 0))) worst = distance;
    return worst <= limit;
  };
  const auto outward = [&](const Vector3d& p, std::size_t piece) {
    const double distance = part_tree.squaredDistance(p);
    // Not where another piece covers it, nor where a crack between pieces is within the solid.
    if (distance > worst && !covered(p, piece, kCovered) &&
        !(closed && windingNumber(part.positions, part.triangles, p) > 0.5))
      worst = distance;
    return worst <= limit;
  };
  constexpr auto kInfinite = std::numeric_limits<double>::infinity();
  for (const auto& p : part.positions)
    if (!inward(p)) return kInfinite;
  for (const auto& point : pointsByArea(part.positions, part.triangles, kSamples, {1, 0}))
    if (!inward(point.position)) return kInfinite;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto& p = pieces[i].positions;
    for (const auto& t : pieces[i].triangles) {  // a hull is farthest off in the middle of what it spans
      if (!outward((p[t[0]] + p[t[1]] + p[t[2]]) / 3, i)) return kInfinite;
      for (int k = 0; k < 3; ++k)
        if (!outward(0.5 * (p[t[k]] + p[t[(k + 1) % 3]]), i)) return kInfinite;
    }
    for (const auto& point : pointsByArea(p, pieces[i].triangles,
                                          kSamples / static_cast<std::uint32_t>(pieces.size()) + kLeastSamples, {2, 0}))
      if (!outward(point.position, i)) return kInfinite;
  }
  return std::sqrt(worst);
}

struct Attempt {
  std::vector<Piece> pieces;
  double deviation_m = std::numeric_limits<double>::infinity();
};

double areaOf(const Shape& part) {
  double sum = 0;
  for (const auto& t : part.triangles)
    sum +=
        0.5 * (part.positions[t[1]] - part.positions[t[0]]).cross(part.positions[t[2]] - part.positions[t[0]]).norm();
  return sum;
}

Shape flattened(const Shape& part, double max_deviation_m, const Progress& progress) {
  const auto log = recordCollapses(part, {max_deviation_m, false}, progress);
  return replay(part, log, log.size());
}

// `cheaply`: not by cuts, which take long for rich parts.
Attempt takeApart(Shape part, double max_deviation_m, bool cheaply, const Progress& progress) {
  if (part.triangles.empty() || part.triangles.size() > kMostTriangles) return {};
  double volume = volumeOf(part.positions, part.triangles);
  if (volume < 0)
    for (auto& t : part.triangles) std::swap(t[1], t[2]);
  volume = std::abs(volume);
  const bool closed = isClosed(meshOf(part));
  Attempt best;
  const auto take = [&](std::vector<Piece> pieces) {
    if (pieces.empty() || (!best.pieces.empty() && pieces.size() >= best.pieces.size())) return;
    const double deviation = deviationOf(pieces, part, max_deviation_m);
    if (deviation <= max_deviation_m) best = {std::move(pieces), deviation};
  };
  if (volume <= kThin * areaOf(part)) take(sheetPieces(part));
  if (closed) take(boxPieces(part, volume));
  if (best.pieces.size() == 1) return best;
  if (auto piece = hullPiece(part.positions)) {
    const double hull_volume = volumeOf(piece->positions, piece->triangles);
    if (!closed || hull_volume <= (1 + kSameVolume) * volume) take({std::move(*piece)});
  }
  if (closed && (best.pieces.empty() || best.pieces.size() > kFew)) {
    take(prismPieces(part, volume, 0));
    if (best.pieces.empty() || best.pieces.size() > kFew)
      take(prismPieces(part, volume, kSectionFraction * max_deviation_m));
  }
  if (cheaply || (!best.pieces.empty() && best.pieces.size() <= kFew)) return best;
  if (part.triangles.size() <= kManyTriangles) take(cutPieces(part, kCutFraction * max_deviation_m));
  // Rounded parts have more planes than are worth a cut: these are cut as they look after a little flattening.
  for (const double fraction : kFlattenFractions) {
    if (!best.pieces.empty() || progress.cancelled()) break;
    const Shape light = flattened(part, fraction * max_deviation_m, progress);
    if (light.triangles.size() >= 4) take(cutPieces(light, kCutFraction * max_deviation_m));
  }
  return best;
}

void addAsMesh(const Shape& part, Piece& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
  for (const auto& t : part.triangles) mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

}  // namespace

double volumeOf(const std::vector<Vector3d>& positions, const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const auto& t : triangles)
    sum += (positions[t[0]] - positions[0]).dot((positions[t[1]] - positions[0]).cross(positions[t[2]] - positions[0]));
  return sum / 6;
}

std::vector<double> distinct(std::vector<double> values, double tolerance) {
  std::sort(values.begin(), values.end());
  std::vector<double> result;
  for (const double value : values)
    if (result.empty() || value - result.back() > tolerance) result.push_back(value);
  return result;
}

Pieces collisionPieces(const Shape& shape, double max_deviation_m, const Progress& progress) {
  Pieces result;
  Piece mesh{CollisionShapeKind::mesh};
  std::size_t in_vain = 0;  // triangles of parts that were cut for nothing
  const auto take = [&](const Shape& part) {
    auto best = takeApart(part, max_deviation_m, in_vain > kMostInVain || progress.cancelled(), progress);
    if (best.pieces.empty()) in_vain += part.triangles.size();
    result.max_deviation_m = std::max(result.max_deviation_m, best.pieces.empty() ? 0 : best.deviation_m);
    std::move(best.pieces.begin(), best.pieces.end(), std::back_inserter(result.pieces));
    return !best.pieces.empty();
  };
  for (const auto& part : parts(shape)) {
    if (take(part)) continue;
    const auto smaller = manifoldParts(part);
    for (const auto& own : smaller)
      if (smaller.size() == 1 || !take(own)) addAsMesh(own, mesh);
  }
  result.fell_back = !mesh.triangles.empty();
  if (result.fell_back) result.pieces.push_back(std::move(mesh));
  return result;
}

}  // namespace standpoint
