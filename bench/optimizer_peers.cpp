// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/optimizer_peers.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <random>
#include <utility>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <meshoptimizer.h>

namespace standpoint::bench {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;

double wallSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Point pointOf(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z()}; }

struct FewEnough {  // counts faces, as borders make edges a poor measure of them
  const Surface& surface;
  std::size_t target;
  template <class Cost, class Profile>
  bool operator()(const Cost&, const Profile&, std::size_t, std::size_t) const {
    return surface.number_of_faces() <= target;
  }
};

Mesh meshOf(const Surface& surface) {
  Mesh mesh;
  std::vector<std::uint32_t> index(surface.num_vertices(), 0);
  for (const auto v : surface.vertices()) {
    index[v.idx()] = static_cast<std::uint32_t>(mesh.positions.size());
    const Point& p = surface.point(v);
    mesh.positions.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
  }
  for (const auto f : surface.faces()) {
    Triangle t{};
    int k = 0;
    for (const auto v : surface.vertices_around_face(surface.halfedge(f))) t[k++] = index[v.idx()];
    mesh.triangles.push_back(t);
    mesh.surface_of_triangle.push_back(0);
  }
  return mesh;
}

using Corners = std::vector<Kernel::Triangle_3>;

Corners cornersOf(const Mesh& mesh) {
  Corners corners;
  for (const auto& t : mesh.triangles) {
    const Kernel::Triangle_3 triangle(pointOf(mesh.positions[t[0]]), pointOf(mesh.positions[t[1]]),
                                      pointOf(mesh.positions[t[2]]));
    if (!triangle.is_degenerate()) corners.push_back(triangle);
  }
  return corners;
}

std::vector<Point> samples(const Corners& corners) {
  std::vector<double> areas;
  for (const auto& t : corners) areas.push_back(std::sqrt(t.squared_area()));
  std::mt19937_64 random(5);
  std::discrete_distribution<std::size_t> which(areas.begin(), areas.end());
  std::uniform_real_distribution<double> fraction(0, 1);
  std::vector<Point> points;
  for (int i = 0; i < 100'000; ++i) {
    const auto& t = corners[which(random)];
    double u = fraction(random), v = fraction(random);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    points.push_back(t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]));
  }
  return points;
}

struct OneWay {
  double mean = 0, max = 0;
};

OneWay oneWay(const Corners& from, const Corners& to) {
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, Corners::const_iterator>;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(to.begin(), to.end());
  tree.accelerate_distance_queries();
  OneWay result;
  const auto points = samples(from);
  for (const auto& p : points) {
    const double distance = std::sqrt(tree.squared_distance(p));
    result.mean += distance / static_cast<double>(points.size());
    result.max = std::max(result.max, distance);
  }
  return result;
}

}  // namespace

Stopwatch::Stopwatch() : wall_(wallSeconds()), cpu_(cpuSeconds()) {}

Simplified Stopwatch::stop(Mesh mesh) const { return {std::move(mesh), wallSeconds() - wall_, cpuSeconds() - cpu_}; }

Simplified lindstromTurk(const Mesh& mesh, std::size_t target) {
  std::vector<Point> points;
  for (const auto& p : mesh.positions) points.push_back(pointOf(p));
  std::vector<std::vector<std::size_t>> faces;
  for (const auto& t : mesh.triangles)
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) faces.push_back({t[0], t[1], t[2]});
  CGAL::Polygon_mesh_processing::orient_polygon_soup(points, faces);
  Surface surface;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, faces, surface);
  const Stopwatch watch;
  CGAL::Surface_mesh_simplification::edge_collapse(surface, FewEnough{surface, target});
  auto result = watch.stop({});
  surface.collect_garbage();
  result.mesh = meshOf(surface);
  return result;
}

Simplified meshoptimizer(const Mesh& mesh, std::size_t target) {
  std::vector<unsigned> indices;
  for (const auto& t : mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());
  std::vector<unsigned> result(indices.size());
  const Stopwatch watch;
  const auto count =
      meshopt_simplify(result.data(), indices.data(), indices.size(), mesh.positions[0].data(), mesh.positions.size(),
                       sizeof(mesh.positions[0]), 3 * target, std::numeric_limits<float>::max(), 0, nullptr);
  auto made = watch.stop({});
  made.mesh.positions = mesh.positions;
  for (std::size_t i = 0; i + 2 < count; i += 3) {
    made.mesh.triangles.push_back({result[i], result[i + 1], result[i + 2]});
    made.mesh.surface_of_triangle.push_back(0);
  }
  return made;
}

ErrorPercent errorBetween(const Mesh& before, const Mesh& after) {
  if (after.triangles.empty()) return {100, 100};
  const double diagonal = bounds(before, Eigen::Affine3d::Identity()).diagonal();
  const auto a = cornersOf(before), b = cornersOf(after);
  const OneWay there = oneWay(a, b), back = oneWay(b, a);
  return {50 * (there.mean + back.mean) / diagonal, 100 * std::max(there.max, back.max) / diagonal};
}

}  // namespace standpoint::bench
