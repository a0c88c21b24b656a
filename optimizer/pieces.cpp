// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "optimizer/deviation.h"
#include "optimizer/triangle_tree.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostParts = 200;           // a mesh of more stays a mesh
constexpr std::size_t kMostTriangles = 20'000;    // of a part that is taken apart
constexpr double kSameVolume = 1e-3;              // a part with this little concavity is convex
constexpr double kSameDirection = 0.99996;        // half a degree
constexpr std::uint32_t kSamples = 1000;

std::vector<Shape> connectedParts(const Shape& shape) {
  std::vector<std::uint32_t> joined(shape.positions.size());
  std::iota(joined.begin(), joined.end(), 0U);
  const auto root = [&](std::uint32_t v) {
    while (joined[v] != v) v = joined[v] = joined[joined[v]];
    return v;
  };
  for (const auto& t : shape.triangles)
    for (int k = 1; k < 3; ++k) joined[std::max(root(t[0]), root(t[k]))] = std::min(root(t[0]), root(t[k]));
  constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> part_of(shape.positions.size(), kNone), index(shape.positions.size(), kNone);
  std::vector<Shape> parts;
  for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
    Triangle t = shape.triangles[i];
    auto& part = part_of[root(t[0])];
    if (part == kNone) {
      part = static_cast<std::uint32_t>(parts.size());
      parts.emplace_back().half_size = shape.half_size;
    }
    for (auto& v : t) {
      if (index[v] == kNone) {
        index[v] = static_cast<std::uint32_t>(parts[part].positions.size());
        parts[part].positions.push_back(shape.positions[v]);
      }
      v = index[v];
    }
    parts[part].triangles.push_back(t);
    parts[part].surface_of_triangle.push_back(shape.surface_of_triangle[i]);
  }
  return parts;
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
    const Vector3d normal = (piece.positions[t[1]] - a).cross(piece.positions[t[2]] - a);
    if (normal.dot(p - a) > tolerance * normal.norm()) return false;
  }
  return true;
}

// Both ways: the part's surface from the pieces, and the pieces' surface from the part's where no other piece covers it.
double deviationOf(const std::vector<Piece>& pieces, const Shape& part) {
  std::vector<Vector3d> positions;
  std::vector<Triangle> triangles;
  for (const auto& piece : pieces) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), piece.positions.begin(), piece.positions.end());
    for (const auto& t : piece.triangles) triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  const TriangleTree tree(positions, triangles), part_tree(part.positions, part.triangles);
  double worst = 0;
  for (const auto& p : part.positions) worst = std::max(worst, tree.squaredDistance(p));
  for (const auto& point : pointsByArea(part.positions, part.triangles, kSamples, {1, 0})) worst = std::max(worst, tree.squaredDistance(point.position));
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (const auto& point : pointsByArea(pieces[i].positions, pieces[i].triangles, kSamples / static_cast<std::uint32_t>(pieces.size()) + 50, {2, 0})) {
      bool covered = false;
      for (std::size_t k = 0; k < pieces.size() && !covered; ++k) covered = k != i && contains(pieces[k], point.position, 1e-4);
      if (!covered) worst = std::max(worst, part_tree.squaredDistance(point.position));
    }
  return std::sqrt(worst);
}

struct Attempt {
  std::vector<Piece> pieces;
  double deviation_m = std::numeric_limits<double>::infinity();
};

Attempt attempt(std::vector<Piece> pieces, const Shape& part) {
  Attempt result{std::move(pieces)};
  if (!result.pieces.empty()) result.deviation_m = deviationOf(result.pieces, part);
  return result;
}

Attempt takeApart(const Shape& part, double max_deviation_m) {
  if (part.triangles.size() > kMostTriangles) return {};
  const bool closed = isClosed(meshOf(part));
  const double volume = volumeOf(part.positions, part.triangles);
  Attempt boxes;
  if (closed) boxes = attempt(boxPieces(part, volume), part);
  if (boxes.pieces.size() == 1 && boxes.deviation_m <= max_deviation_m) return boxes;
  Attempt hull;
  if (auto piece = hullPiece(part.positions)) {
    const double hull_volume = volumeOf(piece->positions, piece->triangles);
    hull = attempt({std::move(*piece)}, part);
    if (closed && hull.deviation_m <= max_deviation_m && hull_volume <= (1 + kSameVolume) * std::abs(volume)) return hull;
  }
  if (boxes.deviation_m <= max_deviation_m) return boxes;
  if (closed)
    if (auto prisms = attempt(prismPieces(part, volume), part); prisms.deviation_m <= max_deviation_m) return prisms;
  return hull.deviation_m <= max_deviation_m ? hull : Attempt{};
}

void addAsMesh(const Shape& part, Piece& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
  for (const auto& t : part.triangles) mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

}  // namespace

double volumeOf(const std::vector<Vector3d>& positions, const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const auto& t : triangles) sum += (positions[t[0]] - positions[0]).dot((positions[t[1]] - positions[0]).cross(positions[t[2]] - positions[0]));
  return sum / 6;
}

std::vector<double> distinct(std::vector<double> values, double tolerance) {
  std::sort(values.begin(), values.end());
  std::vector<double> result;
  for (const double value : values)
    if (result.empty() || value - result.back() > tolerance) result.push_back(value);
  return result;
}

Piece prism(const std::vector<Vector3d>& bottom, const std::vector<Vector3d>& top, CollisionShapeKind kind) {
  Piece piece{kind, bottom, {}};
  piece.positions.insert(piece.positions.end(), top.begin(), top.end());
  const auto n = static_cast<std::uint32_t>(bottom.size());
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    piece.triangles.push_back({0, i + 1, i});
    piece.triangles.push_back({n, n + i, n + i + 1});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    piece.triangles.push_back({i, j, n + j});
    piece.triangles.push_back({i, n + j, n + i});
  }
  return piece;
}

std::vector<Vector3d> faceDirections(const Shape& part) {
  struct Face {
    double area;
    Vector3d normal;
  };
  std::vector<Face> faces;
  for (const auto& t : part.triangles) {
    const Vector3d normal = (part.positions[t[1]] - part.positions[t[0]]).cross(part.positions[t[2]] - part.positions[t[0]]);
    if (normal.norm() > 0) faces.push_back({normal.norm(), normal.normalized()});
  }
  const auto larger = [](const Face& a, const Face& b) { return a.area > b.area; };
  std::stable_sort(faces.begin(), faces.end(), larger);
  std::vector<Face> directions;
  for (const auto& face : faces) {
    const auto same = std::find_if(directions.begin(), directions.end(), [&](const Face& d) { return std::abs(d.normal.dot(face.normal)) > kSameDirection; });
    if (same != directions.end()) same->area += face.area;
    else if (directions.size() < 32) directions.push_back(face);  // a round part has no directions worth more
  }
  std::stable_sort(directions.begin(), directions.end(), larger);
  std::vector<Vector3d> result;
  for (const auto& direction : directions) result.push_back(direction.normal);
  return result;
}

Pieces collisionPieces(const Shape& shape, double max_deviation_m) {
  Pieces result;
  Piece mesh{CollisionShapeKind::mesh};
  auto all = parts(shape);
  if (all.size() > kMostParts) all = {shape};
  for (const auto& part : all) {
    auto best = all.size() == 1 || part.triangles.size() >= 4 ? takeApart(part, max_deviation_m) : Attempt{};
    if (best.pieces.empty()) {
      addAsMesh(part, mesh);
      continue;
    }
    result.max_deviation_m = std::max(result.max_deviation_m, best.deviation_m);
    std::move(best.pieces.begin(), best.pieces.end(), std::back_inserter(result.pieces));
  }
  result.fell_back = !mesh.triangles.empty();
  if (result.fell_back) result.pieces.push_back(std::move(mesh));
  return result;
}

}  // namespace standpoint
