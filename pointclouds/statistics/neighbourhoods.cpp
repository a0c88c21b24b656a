// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/statistics/neighbourhoods.h"

#include <algorithm>
#include <cmath>

#include "core/decompositions.h"

namespace standpoint {
namespace {

constexpr std::uint64_t kFilterBits = 1 << 22;

struct Plane {
  Eigen::Vector3d point, normal;
  Eigen::Vector3d spread;  // standard deviations, ascending: across the plane first
  double largest_residual = 0;
  std::size_t points = 0;
};

template <class Chosen>
std::optional<Plane> fitPlane(const Neighbourhood& at, std::size_t fewest, Chosen chosen) {
  Plane plane{Eigen::Vector3d::Zero(), {}, {}};
  for (const auto& n : at.neighbours)
    if (chosen(n)) plane.point += n.from_centre.cast<double>(), ++plane.points;
  if (plane.points < fewest) return std::nullopt;
  plane.point /= static_cast<double>(plane.points);
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const auto& n : at.neighbours) {
    const Eigen::Vector3d d = n.from_centre.cast<double>() - plane.point;
    if (chosen(n)) moments += d * d.transpose();
  }
  const auto [values, axes] = principalAxes(moments);
  plane.normal = axes.col(0);
  plane.spread = (values.cwiseMax(0) / std::max(1.0, static_cast<double>(plane.points) - 3)).cwiseSqrt();
  for (const auto& n : at.neighbours)
    if (chosen(n))
      plane.largest_residual =
          std::max(plane.largest_residual, std::abs(plane.normal.dot(n.from_centre.cast<double>() - plane.point)));
  return plane;
}

}  // namespace

std::optional<double> planeNoise(const Neighbourhood& at) {
  const auto plane = fitPlane(at, 12, [](const auto& n) { return n.same_scan; });
  if (!plane) return std::nullopt;
  const double sigma = plane->spread[0], slant = std::abs(plane->normal.dot(at.beam));
  if (plane->spread[1] < 5 * sigma || plane->largest_residual > 4 * sigma || slant < 0.3) return std::nullopt;
  return sigma / slant;
}

std::optional<double> roughness(const Neighbourhood& at) {
  const auto plane = fitPlane(at, 3, [](const auto&) { return true; });
  if (!plane) return std::nullopt;
  return std::abs(plane->normal.dot(plane->point));
}

NeighbourSink::NeighbourSink(std::vector<Neighbourhood>& all, double radius_m)
    : all_(all), radius_m_(radius_m), any_(kFilterBits) {
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    const Cell home = cellAt(all[i].centre, radius_m);
    for (int k = 0; k < 27; ++k) {
      const std::uint64_t cell = hashOf(home + Cell(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
      entries_.push_back({cell, i});
      any_[cell % kFilterBits] = true;
    }
  }
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return std::pair(a.cell, a.neighbourhood) < std::pair(b.cell, b.neighbourhood);
  });
}

Result<void> NeighbourSink::begin(const ScanHeader& header) {
  if (begun_) ++scan_;
  begun_ = true;
  pose_ = header.file_from_scanner;
  return {};
}

void NeighbourSink::offer(Neighbourhood& to, const Eigen::Vector3d& point) {
  const Eigen::Vector3d from_centre = point - to.centre;
  if (to.index == index_ || from_centre.squaredNorm() > radius_m_ * radius_m_) return;
  const Neighbourhood::Neighbour neighbour{from_centre.cast<float>(), to.scan == scan_};
  ++to.seen;
  if (to.neighbours.size() < kMostNeighbours) {
    to.neighbours.push_back(neighbour);
  } else if (const std::uint64_t place = mixed(index_) % to.seen; place < kMostNeighbours) {
    to.neighbours[place] = neighbour;  // reservoir sampling (Vitter 1985, algorithm R)
  }
}

Result<void> NeighbourSink::write(const PointBlock& block) {
  for (std::size_t i = 0; i < block.size(); ++i, ++index_) {
    const Eigen::Vector3d point = pose_ * Eigen::Vector3d(block.x_m[i], block.y_m[i], block.z_m[i]);
    const std::uint64_t cell = hashOf(cellAt(point, radius_m_));
    if (!any_[cell % kFilterBits]) continue;
    auto entry = std::lower_bound(entries_.begin(), entries_.end(), cell,
                                  [](const Entry& e, std::uint64_t c) { return e.cell < c; });
    for (; entry != entries_.end() && entry->cell == cell; ++entry) offer(all_[entry->neighbourhood], point);
  }
  return {};
}

}  // namespace standpoint
