// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/shape.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

#include <tbb/parallel_sort.h>

namespace standpoint {

namespace {

constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();

// For each position the first one with an equal key.
template <class Key>
std::vector<std::uint32_t> firstWithKey(std::size_t count, Key key) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  tbb::parallel_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return std::tuple(key(a), a) < std::tuple(key(b), b); });
  std::vector<std::uint32_t> first(count);
  for (std::size_t i = 0; i < count; ++i) first[order[i]] = i > 0 && key(order[i - 1]) == key(order[i]) ? first[order[i - 1]] : order[i];
  return first;
}

auto placeOf(const Mesh& mesh, std::uint32_t i) { return std::tuple(mesh.positions[i].x(), mesh.positions[i].y(), mesh.positions[i].z()); }

auto paintOf(const Mesh& mesh, std::uint32_t i) {
  const auto uv = mesh.texture_coordinates.empty() ? Eigen::Vector2f(0, 0) : mesh.texture_coordinates[i];
  return std::tuple(uv.x(), uv.y(), mesh.colours.empty() ? std::array<std::uint8_t, 4>{} : mesh.colours[i]);
}

// Keeps the first of triangles that are equal up to rotation and have the same surface.
void removeRepetitions(Shape& shape) {
  const auto turned = [&](std::uint32_t i) {
    auto t = shape.triangles[i];
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return std::tuple(t, shape.surface_of_triangle[i]);
  };
  std::vector<std::uint32_t> order(shape.triangles.size());
  std::iota(order.begin(), order.end(), 0U);
  tbb::parallel_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return std::tuple(turned(a), a) < std::tuple(turned(b), b); });
  std::vector<bool> again(order.size(), false);
  for (std::size_t i = 1; i < order.size(); ++i) again[order[i]] = turned(order[i - 1]) == turned(order[i]);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (again[i]) continue;
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
  const auto first = firstWithKey(mesh.positions.size(), [&](std::uint32_t i) { return placeOf(mesh, i); });
  std::vector<std::uint32_t> wedge;
  if (isPainted(mesh)) wedge = firstWithKey(mesh.positions.size(), [&](std::uint32_t i) { return std::tuple(placeOf(mesh, i), paintOf(mesh, i)); });
  std::vector<std::uint32_t> index(mesh.positions.size(), kNone);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Triangle t{};
    for (int k = 0; k < 3; ++k) t[k] = first[mesh.triangles[i][k]];
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    for (auto& corner : t) {
      if (index[corner] == kNone) {
        index[corner] = static_cast<std::uint32_t>(shape.positions.size());
        shape.positions.emplace_back(mesh.positions[corner].cast<double>());
      }
      corner = index[corner];
    }
    shape.triangles.push_back(t);
    shape.surface_of_triangle.push_back(mesh.surface_of_triangle[i]);
    if (!wedge.empty()) shape.wedges.push_back({wedge[mesh.triangles[i][0]], wedge[mesh.triangles[i][1]], wedge[mesh.triangles[i][2]]});
  }
  const auto proper = shape.triangles.size();
  removeRepetitions(shape);
  if (counts) *counts = {mesh.positions.size() - shape.positions.size(), mesh.triangles.size() - proper, proper - shape.triangles.size()};
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
  std::vector<std::uint32_t> index(shape.positions.size(), kNone);
  mesh.triangles.reserve(shape.triangles.size());
  for (auto t : shape.triangles) {
    for (auto& corner : t) {
      if (index[corner] == kNone) {
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

}  // namespace standpoint
