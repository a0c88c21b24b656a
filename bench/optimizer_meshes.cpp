// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/optimizer_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <utility>

#include "core/random.h"

namespace standpoint::bench {

namespace {

using Eigen::Affine3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

void add(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  mesh.triangles.push_back({a, b, c});
  mesh.surface_of_triangle.push_back(0);
}

// A grid of u x v cells; where it is closed around, the last column is the first.
void addGrid(Mesh& mesh, int u, int v, bool around, const std::function<Vector3d(double, double)>& at) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const int columns = around ? u : u + 1;
  for (int j = 0; j <= v; ++j)
    for (int i = 0; i < columns; ++i) mesh.positions.emplace_back(at(double(i) / u, double(j) / v).cast<float>());
  const auto index = [&](int i, int j) { return first + static_cast<std::uint32_t>(j * columns + i % columns); };
  for (int j = 0; j < v; ++j)
    for (int i = 0; i < u; ++i) {
      add(mesh, index(i, j), index(i + 1, j), index(i + 1, j + 1));
      add(mesh, index(i, j), index(i + 1, j + 1), index(i, j + 1));
    }
}

// Waves in many directions: amplitude falls with frequency, as on things that grew or were carved.
class Relief {
 public:
  explicit Relief(std::uint32_t seed) {
    for (int i = 0; i < kWaves; ++i) {
      const auto a = normals(philox({seed, 1}, static_cast<std::uint32_t>(i), 0, 0));
      const double frequency = 2 * std::pow(60.0, double(i) / kWaves);
      const Vector3d direction = Vector3d(a[0], a[1], a[2]).normalized();
      waves_[i] = {direction * frequency, a[3] * 4, kRoughness * std::pow(frequency, -1.0)};
    }
  }
  double operator()(const Vector3d& p) const {
    double sum = 0;
    for (const auto& w : waves_) sum += w.amplitude * std::sin(w.vector.dot(p) + w.phase);
    return sum;
  }

 private:
  static constexpr int kWaves = 48;
  static constexpr double kRoughness = 0.137;
  struct Wave {
    Vector3d vector;
    double phase, amplitude;
  };
  std::array<Wave, kWaves> waves_;
};

// The faces of an icosahedron, each a triangular grid; vertices on shared edges are made once.
Mesh geodesic(int n) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  const std::array<Vector3d, 12> corners{Vector3d(-1, g, 0), {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                         {0, -1, g},         {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                         {g, 0, -1},         {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  const std::array<std::array<int, 3>, 20> faces{{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                                  {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                                  {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                                  {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};
  Mesh mesh;
  std::map<std::array<int, 6>, std::uint32_t> made;  // by corners and their weights, zeros left out
  for (const auto& face : faces) {
    const auto vertex = [&](int i, int j) {
      std::array<std::pair<int, int>, 3> weights{std::pair{face[0], n - i - j}, {face[1], i}, {face[2], j}};
      for (auto& w : weights)
        if (w.second == 0) w.first = -1;
      std::sort(weights.begin(), weights.end());
      const auto [place, fresh] = made.try_emplace({weights[0].first, weights[0].second, weights[1].first,
                                                    weights[1].second, weights[2].first, weights[2].second},
                                                   static_cast<std::uint32_t>(mesh.positions.size()));
      if (fresh) {
        const Vector3d p = (n - i - j) * corners[face[0]] + i * corners[face[1]] + j * corners[face[2]];
        mesh.positions.emplace_back(p.normalized().cast<float>());
      }
      return place->second;
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        add(mesh, vertex(i, j), vertex(i + 1, j), vertex(i, j + 1));
        if (i + j + 1 < n) add(mesh, vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
      }
  }
  return mesh;
}

void addPanel(Mesh& mesh, int n, const Vector3d& corner, const std::function<double(double, double)>& depth) {
  addGrid(mesh, n, n, false,
          [&](double s, double t) { return Vector3d(corner + Vector3d(2.8 * s, -depth(s, t), 2.8 * t)); });
}

double rosette(double s, double t, int petals) {
  const double x = 2 * s - 1, y = 2 * t - 1, r = std::hypot(x, y), turn = std::atan2(y, x);
  return 0.04 * std::exp(-4 * r * r) * (1 + 0.6 * std::cos(petals * turn)) + 0.006 * std::cos(18 * r) * std::exp(-r);
}

double blocks(double s, double t, int rows) {
  const double v = t * rows, row = std::floor(v), u = s * 4 + 0.5 * std::fmod(row, 2);
  const double joint =
      std::min({v - row, 1 - (v - row), 4 * (u - std::floor(u)) / 2, 4 * (1 - (u - std::floor(u))) / 2});
  return 0.015 * std::min(1.0, joint * 8);
}

void addColumn(Mesh& mesh, const Vector3d& foot, int flutes) {
  const int u = 74, v = 16;
  addGrid(mesh, u, v, true, [&](double s, double t) {
    const double turn = -2 * kPi * s, r = 0.3 * (1 - 0.15 * t * t) + 0.05 * std::exp(-60 * t * t) +
                                          0.05 * std::exp(-60 * (1 - t) * (1 - t)) + 0.006 * std::cos(flutes * turn);
    const double close = t == 0 || t == 1 ? 0.0 : 1.0;  // its ends are closed by a fan without thickness
    return Vector3d(foot + Vector3d(close * r * std::cos(turn), close * r * std::sin(turn), 2.8 * t));
  });
}

void addDentils(Mesh& mesh, int n, const Vector3d& corner, int teeth) {
  addGrid(mesh, n, n, false, [&](double s, double t) {
    const double tooth = std::sin(2 * kPi * teeth * s) > 0 && t > 0.35 && t < 0.7 ? 0.05 : 0.0;
    return Vector3d(corner + Vector3d(2.8 * s, -0.3 * t * t - tooth - 0.05 * std::cos(9 * t), 0.9 * t));
  });
}

// A leaf of metal on each of the first edges of the panel's middle row: there three faces meet.
void addFins(Mesh& mesh, std::uint32_t first, int n, int count) {
  for (int i = 0; i < count; ++i) {
    const auto a = first + static_cast<std::uint32_t>(n / 2 * (n + 1) + i);
    const auto tip = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.emplace_back(0.5F * (mesh.positions[a] + mesh.positions[a + 1]) + Eigen::Vector3f(0, -0.1F, 0));
    add(mesh, a, a + 1, tip);
  }
}

// A chair, a lamp, a plant, …: turned parts. The first kinds are finely made, of about 16 000 triangles, the others of
// a few hundred.
constexpr std::uint32_t kFineKinds = 12;

Mesh furniture(std::uint32_t kind) {
  Mesh mesh;
  const auto random = [&](std::uint32_t i) { return uniform(philox({kind, 3}, i, 0, 0)[0]); };
  const bool fine = kind < kFineKinds;
  const int parts = fine ? 5 : 2, around = fine ? 40 : 12, along = fine ? 40 : 6;
  for (int k = 0; k < parts; ++k) {
    const auto i = static_cast<std::uint32_t>(10 * k);
    const double r = 0.015 + 0.2 * random(i + 1) * random(i + 2), h = 0.1 + 0.7 * random(i + 3),
                 waist = 0.5 * random(i + 4);
    const Vector3d foot(0.4 * random(i + 5), 0.4 * random(i + 6), 0.3 * random(i + 7));
    addGrid(mesh, around, along, true, [&](double s, double t) {
      const double radius = t == 0 || t == 1 ? 0 : r * (1 - waist * std::sin(kPi * t)), turn = -2 * kPi * s;
      return Vector3d(foot + Vector3d(radius * std::cos(turn), radius * std::sin(turn), h * t));
    });
  }
  return mesh;
}

void addBox(Mesh& mesh, const Vector3d& low, const Vector3d& high) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int i = 0; i < 8; ++i)
    mesh.positions.emplace_back(Vector3d((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                                         (i & 4) != 0 ? high.z() : low.z())
                                    .cast<float>());
  for (const auto& t : {Triangle{0, 3, 1},
                        {0, 2, 3},
                        {4, 5, 7},
                        {4, 7, 6},
                        {0, 1, 5},
                        {0, 5, 4},
                        {2, 7, 3},
                        {2, 6, 7},
                        {0, 6, 2},
                        {0, 4, 6},
                        {1, 3, 7},
                        {1, 7, 5}})
    add(mesh, first + t[0], first + t[1], first + t[2]);
}

void place(Environment& environment, Mesh mesh, const char* ifc_class) {
  environment.instances.push_back({static_cast<std::uint32_t>(environment.meshes.size()),
                                   static_cast<std::uint32_t>(environment.products.size()), Affine3d::Identity()});
  environment.products.push_back({.id = "#" + std::to_string(environment.products.size() + 1), .ifc_class = ifc_class});
  environment.meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
}

}  // namespace

Mesh scanLike(int frequency) {
  Mesh mesh = geodesic(frequency);
  const Relief relief(11), warp(12);
  for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) {
    const Vector3d p = mesh.positions[i].cast<double>();
    const double noise = 2e-5 * normals(philox({13, 1}, i, 0, 0))[0];
    const double folded = relief(p + 0.3 * Vector3d(warp(p), warp(p + Vector3d(3, 1, 2)), warp(p + Vector3d(1, 5, 2))));
    mesh.positions[i] = (p.cwiseProduct(Vector3d(0.8, 0.9, 1.1)) * (1 + folded + noise)).cast<float>();
  }
  return mesh;
}

Mesh facade() {
  Mesh mesh;
  int fins = 529;
  for (int bay = 0; bay < 800; ++bay) {
    const Vector3d corner(3.0 * (bay % 40), 0, 3.0 * (bay / 40));
    const int kind = bay % 40 % 4;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    if (kind == 0) {
      addPanel(mesh, 35, corner, [&](double s, double t) { return rosette(s, t, 5 + bay % 7); });
      const int here = std::min(fins, 23);
      addFins(mesh, first, 35, here);
      fins -= here;
    } else if (kind == 1) {
      addPanel(mesh, 35, corner, [&](double s, double t) { return blocks(s, t, 6 + bay % 3); });
    } else if (kind == 2) {
      addColumn(mesh, corner + Vector3d(1.4, -0.5, 0), 12 + bay % 9);
    } else {
      addDentils(mesh, 33, corner, 6 + bay % 5);
    }
  }
  return mesh;
}

Environment restaurant() {
  Environment environment;
  environment.surfaces.resize(1);
  for (int i = 0; i < 40; ++i) {  // walls and slabs
    Mesh wall;
    addBox(wall, {2.4 * i, 0, 0}, {2.4 * i + 2.3, 0.2, 3}), place(environment, wall, "IfcWall");
    Mesh slab;
    addBox(slab, {2.4 * i, 0, -0.2}, {2.4 * i + 2.4, 40, 0}), place(environment, slab, "IfcSlab");
  }
  std::vector<Mesh> kinds;
  for (std::uint32_t k = 0; k < 420; ++k) kinds.push_back(furniture(k));
  std::size_t triangles = 0;
  for (std::uint32_t piece = 0; triangles < 9'400'000;
       ++piece) {  // each light kind once, the fine ones as often as it takes
    const auto block = philox({21, 1}, piece, 0, 0);
    const std::uint32_t kind =
        piece % 2 == 0 && piece / 2 + kFineKinds < kinds.size() ? piece / 2 + kFineKinds : block[0] % kFineKinds;
    Mesh mesh = kinds[kind];
    const Affine3d stands = Translation3d(95 * uniform(block[2]), 1 + 38 * uniform(block[3]), 0) *
                            Eigen::AngleAxisd(kPi / 6 * (block[1] % 12), Vector3d::UnitZ());
    for (auto& p : mesh.positions) p = (stands * p.cast<double>()).cast<float>();
    triangles += mesh.triangles.size();
    place(environment, std::move(mesh), "IfcFurnishingElement");
  }
  return environment;
}

}  // namespace standpoint::bench
