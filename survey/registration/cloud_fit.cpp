// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/registration/cloud_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/decompositions.h"
#include "pointclouds/statistics/cloud_sample.h"
#include "pointclouds/statistics/coverage.h"
#include "survey/scene/model_surface.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kCell_m = 0.15;
constexpr std::size_t kLeastInCell = 6;
constexpr double kFlat_m = 0.01;  // off its plane: more is an edge or a bush
constexpr double kThinning_m = 0.05;
constexpr std::size_t kPointsOfFit = 40000;

void addPatch(Mesh& mesh, const std::vector<Vector3d>& points, const Vector3d& seen_from) {
  Vector3d middle = Vector3d::Zero();
  for (const auto& p : points) middle += p / static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const auto& p : points) spread += (p - middle) * (p - middle).transpose() / static_cast<double>(points.size());
  const auto [values, axes] = principalAxes(spread);
  if (std::sqrt(std::max(0.0, values[0])) > kFlat_m || values[1] < 9 * values[0] || values[1] < 1e-4) return;
  Vector3d normal = axes.col(0);
  if (normal.dot(seen_from - middle) < 0) normal = -normal;
  const Vector3d u = kCell_m / 2 * axes.col(2), v = normal.cross(u);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vector3d& corner :
       {Vector3d(middle - u - v), Vector3d(middle + u - v), Vector3d(middle + u + v), Vector3d(middle - u + v)})
    mesh.positions.push_back(corner.cast<float>());
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

// A square in each cell whose points lie on a plane, facing the station that saw them.
void addPatches(Mesh& mesh, const PlacedCloud& cloud) {
  std::vector<std::pair<std::uint64_t, std::size_t>> cells;
  std::vector<Vector3d> placed;
  for (const auto& p : cloud.points) {
    placed.push_back(cloud.local_from_station * p);
    cells.emplace_back(hashOf(cellAt(placed.back(), kCell_m)), placed.size() - 1);
  }
  std::sort(cells.begin(), cells.end());
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    points.push_back(placed[cells[i].second]);
    if (i + 1 < cells.size() && cells[i + 1].first == cells[i].first) continue;
    if (points.size() >= kLeastInCell) addPatch(mesh, points, cloud.local_from_station.translation);
    points.clear();
  }
}

Environment environmentOf(Mesh mesh) {
  Environment e;
  mesh.surface_of_triangle.assign(mesh.triangles.size(), 0);
  e.surfaces.resize(1);
  e.products.resize(1);
  e.meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
  e.instances.push_back({});
  return e;
}

// Where fewer of the points see their triangle from the front, the model's faces are not oriented at all.
constexpr double kOriented = 0.7;

struct Points {
  std::vector<Vector3d> place;                   // cloud's frame
  std::vector<std::optional<Vector3d>> station;  // the same frame
};

Points pointsOfFit(const CloudSample& sample) {
  Points points;
  for (const auto i : thinned(sample.position, kThinning_m, kPointsOfFit)) {
    points.place.push_back(sample.position[i]);
    points.station.push_back(sample.scans[sample.scan[i]].station);
  }
  return points;
}

bool facesAreOriented(const ModelSurface& surface, const Points& points, const Pose& local_from_cloud, double reach_m) {
  std::size_t front = 0, met = 0;
  const std::size_t step = std::max<std::size_t>(1, points.place.size() / 2000);
  for (std::size_t i = 0; i < points.place.size(); i += step) {
    if (!points.station[i]) continue;
    const Vector3d p = local_from_cloud * points.place[i];
    const SurfaceTouch touch = surface.nearest(p, reach_m);
    if (touch.normal.isZero()) continue;
    ++met;
    front += touch.normal.dot(local_from_cloud * *points.station[i] - p) > 0 ? 1 : 0;
  }
  return static_cast<double>(front) >= kOriented * static_cast<double>(met);
}

}  // namespace

Result<SurfaceFit> fitCloudToClouds(std::span<const Vector3d> points, const Pose& start,
                                    std::span<const PlacedCloud> others, double reach_m, Progress& progress) {
  Mesh mesh;
  for (const auto& cloud : others) addPatches(mesh, cloud);
  if (mesh.triangles.empty())
    return failure(ErrorKind::unusable, "the other scans contain no planar surface to fit to");
  const ModelSurface surface(environmentOf(std::move(mesh)));
  std::vector<Vector3d> all(points.begin(), points.end()), thin;
  for (const auto i : thinned(all, kThinning_m, kPointsOfFit)) thin.push_back(all[i]);
  const Vector3d station = start.translation;
  const SurfaceSearch search = [&](std::span<const Vector3d> placed, double reach, std::span<SurfaceTouch> touches) {
    tbb::parallel_for(std::size_t{0}, placed.size(),
                      [&](std::size_t i) { touches[i] = surface.nearest(placed[i], reach, &station); });
  };
  SurfaceFitOptions options;
  options.reach_m = reach_m;
  return fitToSurface(thin, start, search, options, progress);
}

Result<SurfaceFit> fitCloudToModel(const Environment& model, const Vector3d& shift_m, const CloudSample& sample,
                                   const Pose& file_from_cloud, double reach_m, Progress& progress) {
  const ModelSurface surface(model);
  if (surface.empty()) return failure(ErrorKind::unusable, "the model has no surfaces");
  const Points points = pointsOfFit(sample);
  Pose local_from_cloud = file_from_cloud;
  local_from_cloud.translation -= shift_m;
  const bool oriented = facesAreOriented(surface, points, local_from_cloud, reach_m);
  // Stations move with the cloud; how it is placed at first is good enough to tell the side of a wall.
  std::vector<std::optional<Vector3d>> station(points.place.size());
  if (oriented)
    for (std::size_t i = 0; i < station.size(); ++i)
      if (points.station[i]) station[i] = local_from_cloud * *points.station[i];
  const SurfaceSearch search = [&](std::span<const Vector3d> placed, double reach, std::span<SurfaceTouch> touches) {
    tbb::parallel_for(std::size_t{0}, placed.size(), [&](std::size_t i) {
      touches[i] = surface.nearest(placed[i], reach, station[i] ? &*station[i] : nullptr);
    });
  };
  SurfaceFitOptions options;
  options.reach_m = reach_m;
  auto fit = fitToSurface(points.place, local_from_cloud, search, options, progress);
  if (fit) fit->to_from.translation += shift_m;
  return fit;
}

std::string describe(const FreeMotion& motion) {
  const auto text = [](const Vector3d& v) { return fmt::format("({:.2f}, {:.2f}, {:.2f})", v.x(), v.y(), v.z()); };
  if (motion.axis.isZero()) return "along " + text(motion.shift);
  if (motion.shift.isZero()) return "around " + text(motion.axis);
  return "along " + text(motion.shift) + " combined with rotation around " + text(motion.axis);
}

}  // namespace standpoint
