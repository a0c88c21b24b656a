// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/optimizer/models.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace standpoint::models {

namespace {

using Eigen::Vector3d;
constexpr double kTurn = 2 * std::numbers::pi;

void triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t surface = 0) {
  mesh.triangles.push_back({a, b, c});
  mesh.surface_of_triangle.push_back(surface);
}

// A grid of u x v cells over [0, 1]²; surface by the cell.
Mesh grid(int u, int v, const std::function<Vector3d(double, double)>& at, std::uint32_t surface = 0) {
  Mesh mesh;
  for (int j = 0; j <= v; ++j)
    for (int i = 0; i <= u; ++i) mesh.positions.emplace_back(at(double(i) / u, double(j) / v).cast<float>());
  const auto index = [&](int i, int j) { return static_cast<std::uint32_t>(j * (u + 1) + i); };
  for (int j = 0; j < v; ++j)
    for (int i = 0; i < u; ++i) {
      triangle(mesh, index(i, j), index(i + 1, j), index(i + 1, j + 1), surface);
      triangle(mesh, index(i, j), index(i + 1, j + 1), index(i, j + 1), surface);
    }
  return mesh;
}

// Distance of p from triangle abc: to the plane where the foot lies inside, else to the nearest edge.
double distance(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const auto to_edge = [&](const Vector3d& s, const Vector3d& e) {
    const double length = (e - s).squaredNorm();
    const double t = length > 0 ? std::clamp((p - s).dot(e - s) / length, 0.0, 1.0) : 0;
    return (s + t * (e - s) - p).norm();
  };
  const double edges = std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
  const Vector3d n = (b - a).cross(c - a);
  if (n.squaredNorm() < 1e-24) return edges;
  const bool inside =
      n.dot((b - a).cross(p - a)) >= 0 && n.dot((c - b).cross(p - b)) >= 0 && n.dot((a - c).cross(p - c)) >= 0;
  return inside ? std::abs(n.dot(p - a)) / n.norm() : edges;
}

double toMesh(const Vector3d& p, const Mesh& mesh) {
  double best = 1e300;
  for (const auto& t : mesh.triangles)
    best = std::min(best, distance(p, mesh.positions[t[0]].cast<double>(), mesh.positions[t[1]].cast<double>(),
                                   mesh.positions[t[2]].cast<double>()));
  return best;
}

std::vector<Vector3d> pointsByArea(const Mesh& mesh, int count) {
  std::vector<double> areas;
  for (const auto& t : mesh.triangles)
    areas.push_back(
        (mesh.positions[t[1]] - mesh.positions[t[0]]).cross(mesh.positions[t[2]] - mesh.positions[t[0]]).norm());
  std::mt19937 random(7);
  std::discrete_distribution<std::size_t> which(areas.begin(), areas.end());
  std::uniform_real_distribution<double> fraction(0, 1);
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const auto& t = mesh.triangles[which(random)];
    double u = fraction(random), v = fraction(random);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Vector3d a = mesh.positions[t[0]].cast<double>();
    points.push_back(a + u * (mesh.positions[t[1]].cast<double>() - a) + v * (mesh.positions[t[2]].cast<double>() - a));
  }
  return points;
}

}  // namespace

void append(Mesh& mesh, const Mesh& other, const Eigen::Affine3d& place) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const auto& p : other.positions) mesh.positions.emplace_back((place * p.cast<double>()).cast<float>());
  for (std::size_t i = 0; i < other.triangles.size(); ++i) {
    const auto& t = other.triangles[i];
    triangle(mesh, first + t[0], first + t[1], first + t[2], other.surface_of_triangle[i]);
  }
  sortBySurface(mesh);
}

Mesh sphere(double radius, int rings, int segments) {
  Mesh mesh;
  mesh.positions.emplace_back(0, 0, radius);
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < segments; ++j) {
      const double polar = kTurn / 2 * i / rings, turn = kTurn * j / segments;
      mesh.positions.emplace_back(
          (radius * Vector3d(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)))
              .cast<float>());
    }
  mesh.positions.emplace_back(0, 0, -radius);
  const auto index = [&](int i, int j) { return static_cast<std::uint32_t>(1 + (i - 1) * segments + j % segments); };
  const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  for (int j = 0; j < segments; ++j) {
    triangle(mesh, 0, index(1, j), index(1, j + 1));
    for (int i = 1; i + 1 < rings; ++i) {
      triangle(mesh, index(i, j), index(i + 1, j), index(i + 1, j + 1));
      triangle(mesh, index(i, j), index(i + 1, j + 1), index(i, j + 1));
    }
    triangle(mesh, index(rings - 1, j), last, index(rings - 1, j + 1));
  }
  return mesh;
}

Mesh torus(double radius, double tube, int rings, int segments) {
  Mesh mesh;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < segments; ++j) {
      const double u = kTurn * i / rings, v = kTurn * j / segments, r = radius + tube * std::cos(v);
      mesh.positions.emplace_back(Vector3d(r * std::cos(u), r * std::sin(u), tube * std::sin(v)).cast<float>());
    }
  const auto index = [&](int i, int j) { return static_cast<std::uint32_t>(i % rings * segments + j % segments); };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < segments; ++j) {
      triangle(mesh, index(i, j), index(i + 1, j), index(i + 1, j + 1));
      triangle(mesh, index(i, j), index(i + 1, j + 1), index(i, j + 1));
    }
  return mesh;
}

Mesh box(const Vector3d& size, int n, bool surface_per_face) {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const int u = (axis + 1 + side) % 3, v = (axis + 2 - side) % 3;  // swapped on one side, so that all face outward
      append(mesh, grid(
                       n, n,
                       [&](double s, double t) {
                         Vector3d p = Vector3d::Zero();
                         p[axis] = side == 0 ? size[axis] : 0;
                         p[u] = s * size[u];
                         p[v] = t * size[v];
                         return p;
                       },
                       surface_per_face ? static_cast<std::uint32_t>(2 * axis + side) : 0));
    }
  return mesh;
}

Mesh cylinder(double radius, double height, int segments, int rows) {
  Mesh mesh = grid(segments, rows, [&](double s, double t) {
    return Vector3d(radius * std::cos(kTurn * s), radius * std::sin(kTurn * s), height * t);
  });
  for (const double z : {0.0, height}) {
    Mesh cap;
    cap.positions.emplace_back(Vector3d(0, 0, z).cast<float>());
    for (int j = 0; j <= segments; ++j)
      cap.positions.emplace_back(
          Vector3d(radius * std::cos(kTurn * j / segments), radius * std::sin(kTurn * j / segments), z).cast<float>());
    for (std::uint32_t j = 1; j <= static_cast<std::uint32_t>(segments); ++j)
      z > 0 ? triangle(cap, 0, j, j + 1) : triangle(cap, 0, j + 1, j);
    append(mesh, cap);
  }
  for (auto& p : mesh.positions)  // the seam's two columns, exactly one place
    if (std::abs(p.y()) < 1e-5F * static_cast<float>(radius) && p.x() > 0) p = {static_cast<float>(radius), 0, p.z()};
  return mesh;
}

Mesh plateWithHole(double width, double height, double hole, double cell) {
  const int u = static_cast<int>(std::lround(width / cell)), v = static_cast<int>(std::lround(height / cell));
  const Mesh whole = grid(u, v, [&](double s, double t) { return Vector3d(s * width, 0, t * height); });
  Mesh mesh;
  mesh.positions = whole.positions;
  for (const auto& t : whole.triangles) {
    const Vector3d centre = (whole.positions[t[0]] + whole.positions[t[1]] + whole.positions[t[2]]).cast<double>() / 3;
    if (std::abs(centre.x() - width / 2) < hole / 2 && std::abs(centre.z() - height / 2) < hole / 2) continue;
    triangle(mesh, t[0], t[1], t[2], centre.z() < height / 2 ? 0 : 1);
  }
  sortBySurface(mesh);
  return mesh;
}

void add(Environment& environment, Mesh mesh, const std::string& ifc_class, const Eigen::Affine3d& place) {
  std::uint32_t surfaces = 1;
  for (const auto s : mesh.surface_of_triangle) surfaces = std::max(surfaces, s + 1);
  if (environment.surfaces.size() < surfaces) environment.surfaces.resize(surfaces);
  Product product;
  product.id = "#" + std::to_string(environment.products.size() + 1);
  product.ifc_class = ifc_class;
  environment.instances.push_back({static_cast<std::uint32_t>(environment.meshes.size()),
                                   static_cast<std::uint32_t>(environment.products.size()), place});
  environment.products.push_back(product);
  environment.meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
}

double farthest(const Mesh& a, const Mesh& b, int samples) {
  double result = 0;
  for (const auto& p : pointsByArea(a, samples)) result = std::max(result, toMesh(p, b));
  for (const auto& t : a.triangles)
    for (const auto v : t) result = std::max(result, toMesh(a.positions[v].cast<double>(), b));
  return result;
}

double meanDistance(const Mesh& a, const Mesh& b, int samples) {
  double sum = 0;
  for (const auto& p : pointsByArea(a, samples)) sum += toMesh(p, b);
  return sum / samples;
}

}  // namespace standpoint::models
