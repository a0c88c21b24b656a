// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/surface/shape.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace standpoint {

namespace {

constexpr auto kNoShape = std::numeric_limits<std::uint32_t>::max();
constexpr double kSameDirection = 0.99996;  // half a degree

constexpr std::uint32_t kPartBits =
    6;  // what is looked up is told apart by hash into so many parts, that are looked at side by side
constexpr std::size_t kShapeChunk = 16'384;  // things that one task looks at

template <class Task>
void forEachIndex(std::size_t count, Task task) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kShapeChunk), [&](const auto& range) {
    for (auto i = range.begin(); i < range.end(); ++i) task(static_cast<std::uint32_t>(i));
  });
}

template <class... Part>
std::uint32_t hashOf(Part... parts) {
  std::uint64_t hash = 0;
  ((hash = (hash ^ parts) * 0x9E3779B97F4A7C15U, hash ^= hash >> 29U), ...);
  return static_cast<std::uint32_t>(hash >> 32U);
}

std::uint32_t bitsOf(float f) { return std::bit_cast<std::uint32_t>(f + 0.0F); }  // both zeros are one

// For each of `count` things the first one that is alike: of the same hash, and of the same key where hashes are equal.
template <class Hash, class Key>
std::vector<std::uint32_t> firstAlike(std::size_t count, Hash hash, Key key) {
  std::vector<std::uint32_t> hashes(count), order(count), first(count);
  forEachIndex(count, [&](std::uint32_t i) { hashes[i] = hash(i); });
  const auto part = [&](std::size_t i) { return hashes[i] >> (32 - kPartBits); };
  std::array<std::size_t, (1U << kPartBits) + 1> begin{};
  for (std::size_t i = 0; i < count; ++i) ++begin[part(i) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  auto next = begin;
  for (std::size_t i = 0; i < count; ++i) order[next[part(i)]++] = static_cast<std::uint32_t>(i);
  tbb::parallel_for(
      std::size_t{0}, begin.size() - 1, [&](std::size_t p) {  // each its own things, the first of them first
        const auto size = std::bit_ceil(2 * (begin[p + 1] - begin[p]) + 1);
        std::vector<std::pair<std::uint32_t, std::uint32_t>> table(size, {0, kNoShape});  // hash, thing
        for (auto k = begin[p]; k < begin[p + 1]; ++k) {
          const auto i = order[k];
          auto at = hashes[i] & (size - 1);
          while (table[at].second != kNoShape && (table[at].first != hashes[i] || key(table[at].second) != key(i)))
            at = (at + 1) & (size - 1);
          if (table[at].second == kNoShape) table[at] = {hashes[i], i};
          first[i] = table[at].second;
        }
      });
  return first;
}

auto placeOf(const Mesh& mesh, std::uint32_t i) {
  return std::tuple(mesh.positions[i].x(), mesh.positions[i].y(), mesh.positions[i].z());
}

auto paintOf(const Mesh& mesh, std::uint32_t i) {
  const auto uv = mesh.texture_coordinates.empty() ? Eigen::Vector2f(0, 0) : mesh.texture_coordinates[i];
  return std::tuple(uv.x(), uv.y(), mesh.colours.empty() ? std::array<std::uint8_t, 4>{} : mesh.colours[i]);
}

std::uint32_t placeHash(const Mesh& mesh, std::uint32_t i) {
  const auto& p = mesh.positions[i];
  return hashOf(bitsOf(p.x()), bitsOf(p.y()), bitsOf(p.z()));
}

// Keeps the first of triangles that are equal up to rotation and have the same surface.
void removeRepetitions(Shape& shape) {
  const auto turned = [&](std::uint32_t i) {
    const auto& t = shape.triangles[i];
    const int k = t[0] < t[1] ? (t[0] < t[2] ? 0 : 2) : (t[1] < t[2] ? 1 : 2);
    return std::tuple(t[k], t[(k + 1) % 3], t[(k + 2) % 3], shape.surface_of_triangle[i]);
  };
  const auto first = firstAlike(
      shape.triangles.size(),
      [&](std::uint32_t i) { return std::apply([](auto... part) { return hashOf(part...); }, turned(i)); }, turned);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i] != i) continue;
    shape.triangles[kept] = shape.triangles[i];
    if (!shape.wedges.empty()) shape.wedges[kept] = shape.wedges[i];
    shape.surface_of_triangle[kept++] = shape.surface_of_triangle[i];
  }
  shape.triangles.resize(kept);
  if (!shape.wedges.empty()) shape.wedges.resize(kept);
  shape.surface_of_triangle.resize(kept);
}

}  // namespace

double Shape::rounding() const {
  // Half a unit in the last place of each coordinate, as seen from a plane through three such points.
  return 2 * std::numeric_limits<float>::epsilon() * (centre.cwiseAbs() + half_size).maxCoeff();
}

bool isPainted(const Mesh& mesh) { return !mesh.texture_coordinates.empty() || !mesh.colours.empty(); }

Shape weld(const Mesh& mesh, WeldCounts* counts) {
  Shape shape;
  const auto hash = [&](std::uint32_t i) { return placeHash(mesh, i); };
  const auto first = firstAlike(mesh.positions.size(), hash, [&](std::uint32_t i) { return placeOf(mesh, i); });
  std::vector<std::uint32_t> wedge;
  const auto painted_hash = [&](std::uint32_t i) {
    const auto uv = mesh.texture_coordinates.empty() ? Eigen::Vector2f(0, 0) : mesh.texture_coordinates[i];
    return hashOf(placeHash(mesh, i), bitsOf(uv.x()), bitsOf(uv.y()),
                  mesh.colours.empty() ? 0U : std::bit_cast<std::uint32_t>(mesh.colours[i]));
  };
  if (isPainted(mesh))
    wedge = firstAlike(mesh.positions.size(), painted_hash,
                       [&](std::uint32_t i) { return std::tuple(placeOf(mesh, i), paintOf(mesh, i)); });
  shape.triangles.reserve(mesh.triangles.size());
  shape.surface_of_triangle.reserve(mesh.triangles.size());
  std::vector<std::uint32_t> index(mesh.positions.size(), kNoShape);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Triangle t{};
    for (int k = 0; k < 3; ++k) t[k] = first[mesh.triangles[i][k]];
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    for (auto& corner : t) {
      if (index[corner] == kNoShape) {
        index[corner] = static_cast<std::uint32_t>(shape.positions.size());
        shape.positions.emplace_back(mesh.positions[corner].cast<double>());
      }
      corner = index[corner];
    }
    shape.triangles.push_back(t);
    shape.surface_of_triangle.push_back(mesh.surface_of_triangle[i]);
    if (!wedge.empty())
      shape.wedges.push_back({wedge[mesh.triangles[i][0]], wedge[mesh.triangles[i][1]], wedge[mesh.triangles[i][2]]});
  }
  const auto proper = shape.triangles.size();
  removeRepetitions(shape);
  if (counts)
    *counts = {mesh.positions.size() - shape.positions.size(), mesh.triangles.size() - proper,
               proper - shape.triangles.size()};
  if (shape.positions.empty()) return shape;
  Eigen::Vector3d low = shape.positions[0], high = low;
  for (const auto& p : shape.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  shape.centre = 0.5 * (low + high);
  shape.half_size = 0.5 * (high - low);
  for (auto& p : shape.positions) p -= shape.centre;
  return shape;
}

Mesh meshOf(const Shape& shape) {
  Mesh mesh;
  std::vector<std::uint32_t> index(shape.positions.size(), kNoShape);
  mesh.triangles.reserve(shape.triangles.size());
  for (auto t : shape.triangles) {
    for (auto& corner : t) {
      if (index[corner] == kNoShape) {
        index[corner] = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.emplace_back((shape.positions[corner] + shape.centre).cast<float>());
      }
      corner = index[corner];
    }
    mesh.triangles.push_back(t);
  }
  mesh.surface_of_triangle = shape.surface_of_triangle;
  sortBySurface(mesh);
  return mesh;
}

std::vector<Eigen::Vector3d> faceDirections(const Shape& shape) {
  struct Face {
    double area;
    Eigen::Vector3d normal;
  };
  std::vector<Face> faces;
  for (const auto& t : shape.triangles) {
    const Eigen::Vector3d normal =
        (shape.positions[t[1]] - shape.positions[t[0]]).cross(shape.positions[t[2]] - shape.positions[t[0]]);
    if (normal.norm() > 0) faces.push_back({normal.norm(), normal.normalized()});
  }
  const auto larger = [](const Face& a, const Face& b) { return a.area > b.area; };
  std::stable_sort(faces.begin(), faces.end(), larger);
  std::vector<Face> directions;
  for (const auto& face : faces) {
    const auto same = std::find_if(directions.begin(), directions.end(),
                                   [&](const Face& d) { return std::abs(d.normal.dot(face.normal)) > kSameDirection; });
    if (same != directions.end())
      same->area += face.area;
    else if (directions.size() < 32)
      directions.push_back(face);  // a round part has no directions worth more
  }
  std::stable_sort(directions.begin(), directions.end(), larger);
  std::vector<Eigen::Vector3d> result;
  for (const auto& direction : directions) result.push_back(direction.normal);
  return result;
}

}  // namespace standpoint
