// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/simplify/levels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <tbb/parallel_invoke.h>

#include "optimizer/surface/piece.h"

namespace standpoint {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::uint32_t kGuessSamples = 256;
constexpr std::uint32_t kMostMeasured =
    50'000;  // triangles; a larger form is not measured, as its tree would cost more than its log
constexpr std::size_t kMostBoxed = 200'000;                 // triangles; what has more is not a small thing
constexpr double kFineSpacing = 0.8, kCoarseSpacing = 0.5;  // of the triangle counts at which is measured
constexpr std::uint32_t kFineBelow = 5000;
// A form that reaches further than this out of the shape, at the height of the knees, closes a doorway, of which half
// is 0.3 m or more. A window may be closed: it begins higher, and its frame is a product of its own.
constexpr double kMostFilled = 0.25, kKneeLow = 0.3, kKneeHigh = 0.8;  // m
constexpr double kDoorway = 1.8;                                       // m; a shape that is lower has no room for one

struct Point {
  std::uint32_t triangles = 0;
  double loss = 0;  // m³
  std::uint32_t collapses = 0;
  std::int32_t stand_in = -1;
  std::uint32_t refused = 0;  // forms of the same log that were refused before it
};

// Rows: the largest face direction, the largest square to it, and their cross product.
Matrix3d faceAxes(const Shape& shape) {
  const auto directions = faceDirections(shape);
  Matrix3d axes = Matrix3d::Identity();
  if (directions.empty()) return axes;
  Vector3d second = directions[0].unitOrthogonal();
  const auto square = std::find_if(directions.begin(), directions.end(),
                                   [&](const Vector3d& d) { return std::abs(d.dot(directions[0])) < 1e-3; });
  if (square != directions.end()) second = (*square - directions[0] * directions[0].dot(*square)).normalized();
  axes.row(0) = directions[0];
  axes.row(1) = second;
  axes.row(2) = directions[0].cross(second);
  return axes;
}

std::uint32_t largestSurface(const Shape& shape) {
  std::map<std::uint32_t, double> areas;
  for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
    const auto& t = shape.triangles[i];
    areas[shape.surface_of_triangle[i]] +=
        (shape.positions[t[1]] - shape.positions[t[0]]).cross(shape.positions[t[2]] - shape.positions[t[0]]).norm();
  }
  return std::max_element(areas.begin(), areas.end(), [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

// The box around the shape in its own axes, and both sides of the rectangle in the middle of its thinnest direction.
std::vector<Shape> standIns(const Shape& shape) {
  const Matrix3d axes = faceAxes(shape);
  Vector3d low = Vector3d::Constant(1e300), high = -low;
  for (const auto& p : shape.positions) {
    low = low.cwiseMin(axes * p);
    high = high.cwiseMax(axes * p);
  }
  int thin = 0;
  (high - low).minCoeff(&thin);
  const auto quad = [&](const Vector3d& from, const Vector3d& to) {
    const int u = (thin + 1) % 3, v = (thin + 2) % 3;
    std::vector<Vector3d> corners(4, from);
    corners[1][u] = corners[2][u] = to[u];
    corners[2][v] = corners[3][v] = to[v];
    for (auto& corner : corners) corner = axes.transpose() * corner;
    return corners;
  };
  Vector3d upper = low, middle_low = low, middle_high = high;
  upper[thin] = high[thin];
  middle_low[thin] = middle_high[thin] = 0.5 * (low[thin] + high[thin]);
  const auto box = prism(quad(low, high), quad(upper, high), CollisionShapeKind::box);
  std::vector<Shape> result(2);
  result[0].positions = box.positions;
  result[0].triangles = box.triangles;
  result[1].positions = quad(middle_low, middle_high);
  result[1].triangles = {{0, 1, 2}, {0, 2, 3}, {0, 2, 1}, {0, 3, 2}};
  for (auto& stand_in : result) {
    stand_in.centre = shape.centre;
    stand_in.half_size = shape.half_size;
    stand_in.surface_of_triangle.assign(stand_in.triangles.size(), largestSurface(shape));
    // The bounds are the shape's own, also where its axes are not those of the mesh.
    for (auto& p : stand_in.positions) p = p.cwiseMax(-shape.half_size).cwiseMin(shape.half_size);
  }
  return result;
}

// Tells forms that close a doorway.
class DoorwayGuard {
 public:
  DoorwayGuard(const Shape& shape, const DeviationMeter& meter, const Placement& placement)
      : meter_(meter), up_(placement.up), scale_(placement.scale) {
    double high = -std::numeric_limits<double>::infinity();
    low_ = -high;
    for (const auto& p : shape.positions) {
      low_ = std::min(low_, up_.dot(p));
      high = std::max(high, up_.dot(p));
    }
    has_room_ = (high - low_) * scale_ >= kDoorway;
  }
  bool refuses(const Shape& form) const {
    const auto at_knees = [&](const Vector3d& p) {
      const double height = (up_.dot(p) - low_) * scale_;
      return height > kKneeLow && height < kKneeHigh;
    };
    return has_room_ && meter_.reachOf(form, at_knees) * scale_ > kMostFilled;
  }

 private:
  const DeviationMeter& meter_;
  Vector3d up_;
  double scale_, low_ = 0;
  bool has_room_ = false;
};

std::vector<Point> measure(const Shape& shape, const TriangleTree& tree, const ShapeLevels& made,
                           double max_deviation_m, const Placement& placement, std::uint64_t seed,
                           const Progress& progress) {
  auto left = static_cast<std::uint32_t>(shape.triangles.size());
  std::vector<Point> points{{left}};
  const DeviationMeter meter(shape, tree, kGuessSamples, seed);
  const auto target = [](std::uint32_t count) {
    return static_cast<std::uint32_t>(count * (count <= kFineBelow ? kFineSpacing : kCoarseSpacing));
  };
  std::uint32_t next = std::min(target(left), kMostMeasured);
  std::uint32_t refused = 0;
  LogPlayer player(shape, made.log);
  const DoorwayGuard guard(shape, meter, placement);
  for (std::uint32_t i = 0; i < made.log.size(); ++i) {
    left -= made.log[i].triangles;
    if (left > next && i + 1 < made.log.size()) continue;
    if (progress.cancelled()) return points;
    const Shape& form = player.at(i + 1);
    const auto deviation = meter.roughlyOf(form, kGuessSamples);
    if (guard.refuses(form))
      ++refused;
    else
      points.push_back({left, deviation.mean_m * deviation.area_m2, i + 1, -1, refused});
    next = target(left);
  }
  for (std::size_t i = 0; i < made.stand_ins.size(); ++i) {
    const auto deviation = meter.of(made.stand_ins[i]);
    if (deviation.max_m > max_deviation_m || guard.refuses(made.stand_ins[i])) continue;
    points.push_back({static_cast<std::uint32_t>(made.stand_ins[i].triangles.size()),
                      deviation.mean_m * deviation.area_m2, 0, static_cast<std::int32_t>(i)});
  }
  return points;
}

double slope(const Point& a, const Point& b) {
  return (b.loss - a.loss) / (static_cast<double>(a.triangles) - b.triangles);
}

std::vector<Point> lowerHull(std::vector<Point> points) {
  std::stable_sort(points.begin() + 1, points.end(), [](const Point& a, const Point& b) {
    return a.triangles > b.triangles || (a.triangles == b.triangles && a.loss < b.loss);
  });
  std::vector<Point> hull;
  for (const auto& point : points) {
    if (!hull.empty() && point.triangles >= hull.back().triangles) continue;
    while (hull.size() > 1 && slope(hull[hull.size() - 2], hull.back()) >= slope(hull.back(), point)) hull.pop_back();
    hull.push_back(point);
  }
  return hull;
}

}  // namespace

ShapeLevels makeLevels(const Shape& shape, std::unique_ptr<TriangleTree>& tree, const CollapseOptions& options,
                       const Placement& placement, std::uint64_t seed, const Progress& progress) {
  ShapeLevels made;
  tbb::parallel_invoke([&] { made.log = recordCollapses(shape, options, progress); },
                       [&] {
                         if (!tree) tree = std::make_unique<TriangleTree>(shape.positions, shape.triangles);
                       });
  if (shape.triangles.empty()) return made;
  if (made.log.empty() && options.lossless) return made;
  std::vector<Point> hull{{static_cast<std::uint32_t>(shape.triangles.size())}};
  if (options.lossless) {
    auto left = hull[0].triangles;
    for (const auto& step : made.log) left -= step.triangles;
    hull.push_back({left, 0, static_cast<std::uint32_t>(made.log.size())});
  } else {
    if (shape.wedges.empty() && shape.triangles.size() <= kMostBoxed) made.stand_ins = standIns(shape);
    auto points = measure(shape, *tree, made, options.max_deviation_m, placement, seed, progress);
    const bool reached =
        std::any_of(points.begin(), points.end(), [&](const Point& p) { return p.collapses == made.log.size(); });
    if (options.floor > 0 && !reached && !progress.cancelled()) {  // the last form was refused: a simpler one may do
      auto whole = options;
      whole.floor = 0;
      return makeLevels(shape, tree, whole, placement, seed, progress);
    }
    hull = lowerHull(std::move(points));
  }
  for (std::size_t i = 0; i + 1 < hull.size(); ++i) {
    const double cost = std::max(0.0, slope(hull[i], hull[i + 1]));
    const bool steps = hull[i].stand_in < 0 && hull[i + 1].stand_in < 0 && hull[i].refused == hull[i + 1].refused;
    if (steps) {  // each between the two is a level, too
      auto left = hull[i].triangles;
      for (auto k = hull[i].collapses; k < hull[i + 1].collapses; ++k) {
        left -= made.log[k].triangles;
        made.levels.push_back({left, k + 1, -1, cost});
      }
    } else {
      made.levels.push_back({hull[i + 1].triangles, hull[i + 1].collapses, hull[i + 1].stand_in, cost});
    }
  }
  return made;
}

Shape atLevel(const Shape& shape, const ShapeLevels& levels, std::size_t taken, std::vector<std::uint32_t>& image) {
  image.clear();
  const Level* level = taken > 0 ? &levels.levels[taken - 1] : nullptr;
  if (level && level->stand_in >= 0) return levels.stand_ins[static_cast<std::size_t>(level->stand_in)];
  return replay(shape, levels.log, level ? level->collapses : 0, &image);
}

}  // namespace standpoint
