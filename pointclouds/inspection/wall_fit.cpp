// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/inspection/wall_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/decompositions.h"
#include "core/random.h"
#include "pointclouds/statistics/coverage.h"
#include "pointclouds/statistics/neighbourhoods.h"
#include "pointclouds/targets/tukey.h"

namespace standpoint {

namespace {

constexpr int kSeeds = 300;                // 99.9 % to draw three good points where one in three is good
constexpr std::size_t kSeedPoints = 1500;  // that a seed is judged by
constexpr double kLeastScale_m = 1e-6;     // below it lie only the roundings of stored coordinates
constexpr double kNearNormal = 0.94;       // cosine of 20°
constexpr double kGrazing = 0.3;           // cosine beyond which a residual says little of the range
constexpr std::size_t kRoughnessSamples = 1024;
constexpr std::size_t kProfileBins = 40;

struct Plane {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::UnitZ();
  double distance(const Eigen::Vector3d& p) const { return normal.dot(p - centre); }
};

std::size_t chosen(std::uint32_t random, std::size_t count) {
  return static_cast<std::size_t>((static_cast<std::uint64_t>(random) * count) >> 32U);
}

// Evenly spread over the points, which lie in the order of the scan.
std::vector<std::size_t> spread(std::size_t count, std::size_t most) {
  const std::size_t kept = std::min(count, most);
  std::vector<std::size_t> picked(kept);
  for (std::size_t i = 0; i < kept; ++i) picked[i] = i * count / kept;
  return picked;
}

std::optional<Plane> seedPlane(std::span<const BeamPoint> points, const WallOptions& options) {
  const auto judges = spread(points.size(), kSeedPoints);
  std::optional<Plane> best;
  double least = 0;
  std::vector<double> absolute(judges.size());
  for (std::uint32_t i = 0; i < kSeeds; ++i) {
    const auto random = philox({1, 0}, i, 0, 0);
    const auto& a = points[chosen(random[0], points.size())].place;
    const auto& b = points[chosen(random[1], points.size())].place;
    const auto& c = points[chosen(random[2], points.size())].place;
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    if (normal.norm() < 1e-9) continue;
    const Plane plane{a, normal.normalized()};
    if (options.normal && std::abs(plane.normal.dot(*options.normal)) < kNearNormal) continue;
    std::transform(judges.begin(), judges.end(), absolute.begin(),
                   [&](std::size_t k) { return std::abs(plane.distance(points[k].place)); });
    const double scale = medianScale(absolute);
    if (!best || scale < least) best = plane, least = scale;
  }
  return best;
}

Plane leastSquares(std::span<const BeamPoint> points, const std::vector<std::size_t>& kept) {
  Plane plane;
  for (const auto i : kept) plane.centre += points[i].place - points.front().place;
  plane.centre = points.front().place + plane.centre / static_cast<double>(kept.size());
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const auto i : kept) {
    const Eigen::Vector3d d = points[i].place - plane.centre;
    moments += d * d.transpose();
  }
  plane.normal = principalAxes(moments).axes.col(0);
  return plane;
}

std::vector<std::size_t> within(std::span<const BeamPoint> points, const Plane& plane, double reach_m) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::abs(plane.distance(points[i].place)) <= reach_m) kept.push_back(i);
  return kept;
}

double scaleOf(std::span<const BeamPoint> points, const std::vector<std::size_t>& kept, const Plane& plane) {
  std::vector<double> absolute;
  for (const auto i : kept) absolute.push_back(std::abs(plane.distance(points[i].place)));
  return std::max(medianScale(absolute), kLeastScale_m);
}

// From the seed to the fit; `kept` becomes the points that it goes through.
Plane refined(std::span<const BeamPoint> points, Plane plane, std::vector<std::size_t>& kept) {
  kept = spread(points.size(), points.size());
  for (int round = 0; round < 20; ++round) {
    auto now = within(points, plane, 3 * scaleOf(points, kept, plane));
    const bool same = round > 0 && now == kept;
    kept = std::move(now);
    if (same || kept.size() < 3) break;
    plane = leastSquares(points, kept);
  }
  return plane;
}

// The normal towards the scanner, else up, else towards +X; `along` level and `up` across it.
void orient(WallFit& fit, std::span<const BeamPoint> points, const std::vector<std::size_t>& kept) {
  Eigen::Vector3d towards = Eigen::Vector3d::Zero();
  for (const auto i : kept) towards -= points[i].beam;
  double sense = fit.normal.dot(towards);
  if (sense == 0) sense = std::abs(fit.normal.z()) > 1e-9 ? fit.normal.z() : fit.normal.x() + 1e-3 * fit.normal.y();
  if (sense < 0) fit.normal = -fit.normal;
  Eigen::Vector3d along = Eigen::Vector3d::UnitZ().cross(fit.normal);
  if (along.norm() < 1e-6) along = Eigen::Vector3d::UnitX();
  fit.along = (along - fit.normal * fit.normal.dot(along)).normalized();
  fit.up = fit.normal.cross(fit.along);
  const double steep = std::asin(std::clamp(std::abs(fit.normal.z()), 0.0, 1.0));
  fit.level = steep > std::numbers::pi / 4;
  fit.tilt_rad = fit.level ? std::numbers::pi / 2 - steep : steep;
}

void measureResiduals(WallFit& fit, std::span<const BeamPoint> points, const std::vector<std::size_t>& kept) {
  double squares = 0, beam_squares = 0, incidence = 0;
  std::size_t beams = 0, slanted = 0;
  for (const auto i : kept) {
    const double d = fit.normal.dot(points[i].place - fit.centre);
    squares += d * d;
    fit.max_m = std::max(fit.max_m, std::abs(d));
    const double cosine = std::abs(fit.normal.dot(points[i].beam));
    if (cosine == 0) continue;
    incidence += std::acos(std::min(cosine, 1.0));
    ++beams;
    if (cosine < kGrazing) continue;
    beam_squares += d * d / (cosine * cosine);
    ++slanted;
  }
  const auto sigma = [](double sum, std::size_t n) { return n > 3 ? std::sqrt(sum / static_cast<double>(n - 3)) : 0; };
  fit.sigma_m = sigma(squares, kept.size());
  if (beams > 0) fit.incidence_rad = incidence / static_cast<double>(beams);
  if (slanted > 3) fit.beam_sigma_m = sigma(beam_squares, slanted);
}

void countResiduals(WallFit& fit, std::span<const BeamPoint> points) {
  fit.histogram_reach_m = 4 * std::max(fit.sigma_m, kLeastScale_m);
  for (const auto& p : points) {
    const double at = (fit.normal.dot(p.place - fit.centre) / fit.histogram_reach_m + 1) / 2 * WallFit::kBins;
    if (at >= 0 && at < WallFit::kBins)
      ++fit.histogram[static_cast<std::size_t>(at)];
    else
      ++fit.beyond;
  }
}

WallProfile profileAlong(const WallFit& fit, const Eigen::Vector3d& axis, std::span<const BeamPoint> points,
                         const std::vector<std::size_t>& kept, double& extent_m) {
  double low = 1e300, high = -1e300;
  for (const auto i : kept) {
    const double at = axis.dot(points[i].place - fit.centre);
    low = std::min(low, at), high = std::max(high, at);
  }
  extent_m = high - low;
  WallProfile profile{low, std::max(extent_m, 1e-9) / kProfileBins, std::vector<WallProfile::Bin>(kProfileBins)};
  for (const auto i : kept) {
    const Eigen::Vector3d from_centre = points[i].place - fit.centre;
    const auto at = static_cast<std::size_t>(std::max(0.0, (axis.dot(from_centre) - low) / profile.step_m));
    auto& bin = profile.bins[std::min(at, kProfileBins - 1)];
    const double d = fit.normal.dot(from_centre);
    ++bin.points;
    bin.mean_m += d, bin.sigma_m += d * d;
  }
  for (auto& bin : profile.bins) {
    if (bin.points == 0) continue;
    const auto n = static_cast<double>(bin.points);
    bin.mean_m /= n;
    bin.sigma_m = std::sqrt(std::max(0.0, bin.sigma_m / n - bin.mean_m * bin.mean_m));
  }
  return profile;
}

WallRoughness roughnessOf(std::span<const BeamPoint> points, const std::vector<std::size_t>& kept, double radius_m) {
  struct Entry {
    std::uint64_t cell;
    std::size_t point;
  };
  std::vector<Entry> entries;
  for (const auto i : kept) entries.push_back({hashOf(cellAt(points[i].place, radius_m)), i});
  const auto before = [](const Entry& a, const Entry& b) {
    return a.cell != b.cell ? a.cell < b.cell : a.point < b.point;
  };
  std::sort(entries.begin(), entries.end(), before);
  WallRoughness result{radius_m};
  double sum = 0, squares = 0;
  for (const auto k : spread(kept.size(), kRoughnessSamples)) {
    Neighbourhood around;
    around.centre = points[kept[k]].place;
    const Cell home = cellAt(around.centre, radius_m);
    for (int c = 0; c < 27; ++c) {
      const std::uint64_t cell = hashOf(home + Cell(c % 3 - 1, c / 3 % 3 - 1, c / 9 - 1));
      for (auto e = std::lower_bound(entries.begin(), entries.end(), Entry{cell, 0}, before);
           e != entries.end() && e->cell == cell; ++e) {
        const Eigen::Vector3d from_centre = points[e->point].place - around.centre;
        if (e->point != kept[k] && from_centre.squaredNorm() <= radius_m * radius_m)
          around.neighbours.push_back({from_centre.cast<float>(), true});
      }
    }
    const auto distance_m = roughness(around);
    if (!distance_m) continue;
    ++result.samples;
    sum += *distance_m, squares += *distance_m * *distance_m;
  }
  if (result.samples == 0) return result;
  result.mean_m = sum / static_cast<double>(result.samples);
  result.rms_m = std::sqrt(squares / static_cast<double>(result.samples));
  return result;
}

}  // namespace

Result<WallFit> fitWall(std::span<const BeamPoint> points, const WallOptions& options) {
  const auto tooFew = [&](std::size_t found) {
    return failure(ErrorKind::unusable, "a plane needs " + std::to_string(options.fewest_points) +
                                            " points, and there are " + std::to_string(found) +
                                            ": choose a larger radius, or a place with more points");
  };
  if (points.size() < std::max<std::size_t>(options.fewest_points, 4)) return tooFew(points.size());
  const auto seed = seedPlane(points, options);
  if (!seed)
    return failure(ErrorKind::unusable,
                   "the points form no plane parallel to the face of the model: choose another place");
  std::vector<std::size_t> kept;
  const Plane plane = refined(points, *seed, kept);
  if (kept.size() < std::max<std::size_t>(options.fewest_points, 4)) return tooFew(kept.size());
  WallFit fit;
  fit.centre = plane.centre;
  fit.normal = plane.normal;
  fit.points = points.size();
  fit.fitted = kept.size();
  orient(fit, points, kept);
  measureResiduals(fit, points, kept);
  countResiduals(fit, points);
  fit.across = profileAlong(fit, fit.along, points, kept, fit.width_m);
  fit.upward = profileAlong(fit, fit.up, points, kept, fit.height_m);
  fit.roughness = roughnessOf(points, kept, options.roughness_radius_m);
  return fit;
}

}  // namespace standpoint
