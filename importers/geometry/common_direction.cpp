// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "importers/geometry/boolean_ways.h"
#include "importers/geometry/polygon.h"

namespace standpoint::geometry {
namespace {

constexpr std::size_t kMaxCandidates = 12;

struct FaceFacts {
  Eigen::Vector3d normal;
  double area = 0;
};

std::vector<FaceFacts> factsOf(const PolyMesh& mesh) {
  std::vector<FaceFacts> facts;
  for (const Face& face : mesh.faces) {
    const Eigen::Vector3d v = areaVector(mesh.points, face.outer);
    const double length = v.norm();
    if (length > 0) facts.push_back({v / length, length});
  }
  return facts;
}

double areaWithoutHoles(const PolyMesh& mesh, const Face& face, double outer_area) {
  for (const auto& hole : face.holes) outer_area -= areaVector(mesh.points, hole).norm();
  return outer_area;
}

// Every corner of a face that lies across the direction is at one height; the others run along it. The volume under the
// caps must be the volume of the body: a surface that lacks a wall or a cap is no prism, and its sections would be
// wrong.
bool isPrismatic(const PolyMesh& mesh, const Eigen::Vector3d& direction) {
  double under_caps = 0, whole_area = 0;
  Eigen::Vector3d unbalanced = Eigen::Vector3d::Zero();
  for (const Face& face : mesh.faces) {
    const Eigen::Vector3d v = areaVector(mesh.points, face.outer);
    const double length = v.norm();
    if (length == 0) continue;
    const double cosine = v.dot(direction) / length;
    const Eigen::Vector3d& first = mesh.points[face.outer[0]];
    double low = 0, high = 0, extent = 0;
    for (std::uint32_t i : face.outer) {
      const Eigen::Vector3d d = mesh.points[i] - first;
      const double height = direction.dot(d);
      low = std::min(low, height), high = std::max(high, height), extent = std::max(extent, d.norm());
    }
    const bool across = high - low <= kSnap_m && std::abs(cosine) > 0.5;
    const bool along = std::abs(cosine) * extent <= kSnap_m;
    if (!across && !along) return false;
    const double own_area = areaWithoutHoles(mesh, face, length);
    whole_area += own_area;
    unbalanced += v * (own_area / length);
    if (across) under_caps += std::copysign(own_area, cosine) * direction.dot(first - mesh.points[0]);
  }
  const double tolerance = 1e-9 + 3 * kSnap_m * whole_area;
  return unbalanced.norm() <= 1e-9 + 1e-5 * whole_area && std::abs(under_caps - volume(mesh)) <= tolerance;
}

std::size_t levelCount(const PolyMesh& first, std::span<const PolyMesh> others, const std::vector<bool>& fits,
                       const Eigen::Vector3d& direction) {
  std::vector<double> heights;
  for (const Eigen::Vector3d& p : first.points) heights.push_back(direction.dot(p));
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  const double bottom = *low, top = *high;
  for (std::size_t i = 0; i < others.size(); ++i) {
    if (!fits[i]) continue;
    for (const Eigen::Vector3d& p : others[i].points) heights.push_back(std::clamp(direction.dot(p), bottom, top));
  }
  std::sort(heights.begin(), heights.end());
  std::size_t count = 1;
  for (std::size_t i = 1; i < heights.size(); ++i) count += heights[i] > heights[i - 1] + kSnap_m;
  return count;
}

}  // namespace

std::optional<CommonDirection> commonDirection(const PolyMesh& first, std::span<const PolyMesh> others) {
  std::vector<FaceFacts> facts = factsOf(first);
  std::sort(facts.begin(), facts.end(), [](const FaceFacts& a, const FaceFacts& b) { return a.area > b.area; });
  std::vector<Eigen::Vector3d> candidates;
  for (const FaceFacts& fact : facts) {
    const bool known = std::any_of(candidates.begin(), candidates.end(),
                                   [&](const Eigen::Vector3d& c) { return c.cross(fact.normal).norm() < 1e-6; });
    if (!known && candidates.size() < kMaxCandidates) candidates.push_back(fact.normal);
  }
  std::optional<CommonDirection> best;
  std::size_t best_fits = 0, best_levels = 0;
  for (const Eigen::Vector3d& candidate : candidates) {
    if (!isPrismatic(first, candidate)) continue;
    CommonDirection common{candidate, {}};
    for (const PolyMesh& other : others) common.fits.push_back(isPrismatic(other, candidate));
    const auto fits = static_cast<std::size_t>(std::count(common.fits.begin(), common.fits.end(), true));
    if (fits == 0) continue;
    const std::size_t levels = levelCount(first, others, common.fits, candidate);
    if (best && (fits < best_fits || (fits == best_fits && levels >= best_levels))) continue;
    best = std::move(common), best_fits = fits, best_levels = levels;
  }
  return best;
}

}  // namespace standpoint::geometry
