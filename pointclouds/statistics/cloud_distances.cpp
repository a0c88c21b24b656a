// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/statistics/cloud_distances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <Eigen/Eigenvalues>
#include <nanoflann.hpp>
#include <tbb/parallel_for.h>

#include "pointclouds/statistics/cloud_sample.h"
#include "pointclouds/statistics/coverage.h"

namespace standpoint {

namespace {

constexpr std::size_t kMeasured = 600'000;  // points of one cloud: as many as are shown smoothly
constexpr double kThinned_m = 0.01;         // of the other one: wide against noise, so that a plane is seen as one
constexpr std::size_t kPlane = 16;          // points that one is laid through

// What nanoflann wants to know of the points.
struct TreePlaces {
  std::vector<Eigen::Vector3f> all;
  std::size_t kdtree_get_point_count() const { return all.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const { return all[i][static_cast<Eigen::Index>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using PlaceTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, TreePlaces>, TreePlaces, 3, std::size_t>;

// One of each small cell.
TreePlaces thinnedPlaces(const std::vector<Eigen::Vector3f>& places) {
  std::vector<Eigen::Vector3d> wide;
  wide.reserve(places.size());
  for (const auto& place : places) wide.push_back(place.cast<double>());
  TreePlaces kept;
  for (const auto i : thinned(wide, kThinned_m, wide.size())) kept.all.push_back(places[i]);
  return kept;
}

class OtherCloud {
 public:
  explicit OtherCloud(const std::vector<Eigen::Vector3f>& places)
      : places_(thinnedPlaces(places)), tree_(3, places_, nanoflann::KDTreeSingleIndexAdaptorParams(16)) {}
  bool empty() const { return places_.all.empty(); }

  float distanceOf(const Eigen::Vector3f& place) const {
    std::array<std::size_t, kPlane> near;
    std::array<float, kPlane> squared;
    const std::size_t found = tree_.knnSearch(place.data(), kPlane, near.data(), squared.data());
    const float nearest = std::sqrt(squared.front());
    if (found < kPlane) return nearest;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const auto i : near) middle += places_.all[i].cast<double>() / kPlane;
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    double reach = 0;
    for (const auto i : near) {
      const Eigen::Vector3d off = places_.all[i].cast<double>() - middle;
      spread += off * off.transpose();
      reach = std::max(reach, off.squaredNorm());
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
    constexpr double kFlat = 0.25 * 0.25;  // of the squares: the third extent against the second
    if (axes.eigenvalues()[0] > kFlat * axes.eigenvalues()[1]) return nearest;
    const Eigen::Vector3d off = place.cast<double>() - middle;
    const double along = axes.eigenvectors().col(0).dot(off);
    if (off.squaredNorm() - along * along > reach) return nearest;  // beside where it ends
    return static_cast<float>(std::abs(along));
  }

 private:
  TreePlaces places_;
  PlaceTree tree_;
};

std::optional<LargestDifference> largestOf(const CloudDistances& distances) {
  constexpr double kCell_m = 1;
  constexpr float kMost_m = 1;
  struct Sum {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    double counted = 0, distance = 0;
    std::uint64_t points = 0;
  };
  std::map<std::array<std::int64_t, 3>, Sum> cells;
  for (std::size_t i = 0; i < distances.place_m.size(); ++i) {
    const Eigen::Vector3d place = distances.place_m[i].cast<double>();
    const Cell cell = cellAt(place, kCell_m);
    auto& sum = cells[{cell.x(), cell.y(), cell.z()}];
    const auto weight = static_cast<double>(std::min(distances.distance_m[i], kMost_m));
    sum.place += weight * place;
    sum.counted += weight;
    sum.distance += weight * static_cast<double>(distances.distance_m[i]);
    ++sum.points;
  }
  const auto largest = std::max_element(
      cells.begin(), cells.end(), [](const auto& a, const auto& b) { return a.second.counted < b.second.counted; });
  if (largest == cells.end() || !(largest->second.counted > 0)) return std::nullopt;
  const auto& sum = largest->second;
  return LargestDifference{distances.origin_m + sum.place / sum.counted, sum.distance / sum.counted, sum.points};
}

}  // namespace

Result<void> PlaceSampler::begin(const ScanHeader& header) {
  pose_ = header.file_from_scanner;
  pose_.translation -= origin_m_;
  return {};
}

Result<void> PlaceSampler::write(const PointBlock& block) {
  for (std::size_t i = 0; i < block.size(); ++i) {
    const std::uint64_t hash = mixed(points_++);
    if (hash > limit_) continue;
    const Eigen::Vector3d place = pose_ * Eigen::Vector3d(block.x_m[i], block.y_m[i], block.z_m[i]);
    if (!place.allFinite()) continue;
    places_m_.push_back(place.cast<float>());
    hashes_.push_back(hash);
    if (hashes_.size() <= most_) continue;
    limit_ /= 2;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < hashes_.size(); ++k) {
      if (hashes_[k] > limit_) continue;
      hashes_[kept] = hashes_[k];
      places_m_[kept++] = places_m_[k];
    }
    hashes_.resize(kept), places_m_.resize(kept);
  }
  return {};
}

std::vector<Eigen::Vector3f> PlaceSampler::part(std::size_t most) const {
  if (places_m_.size() <= most) return places_m_;
  const auto share = static_cast<double>(most) / static_cast<double>(places_m_.size());
  const auto limit = static_cast<std::uint64_t>(share * static_cast<double>(limit_));
  std::vector<Eigen::Vector3f> part;
  for (std::size_t i = 0; i < places_m_.size() && part.size() < most; ++i)
    if (hashes_[i] <= limit) part.push_back(places_m_[i]);
  return part;
}

Result<CloudDistances> distancesBetween(const PlaceSampler& from, const PlaceSampler& to, Progress& progress) {
  CloudDistances distances{.origin_m = from.origin_m()};
  TRY(progress.check());
  if (from.places_m().empty() || to.places_m().empty()) {
    progress.advance(1);
    return distances;
  }
  std::vector<Eigen::Vector3f> others = to.places_m();
  const Eigen::Vector3f shift = (to.origin_m() - from.origin_m()).cast<float>();
  for (auto& place : others) place += shift;
  const OtherCloud other(others);
  distances.place_m = from.part(kMeasured);
  distances.distance_m.resize(distances.place_m.size());
  constexpr std::size_t kBatch = 1 << 15;
  for (std::size_t begin = 0; begin < distances.place_m.size(); begin += kBatch) {
    TRY(progress.check());
    progress.advance(static_cast<double>(begin) / static_cast<double>(distances.place_m.size()));
    const std::size_t end = std::min(distances.place_m.size(), begin + kBatch);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, 256), [&](const auto& range) {  // each its own slot
      for (auto i = range.begin(); i < range.end(); ++i)
        distances.distance_m[i] = other.distanceOf(distances.place_m[i]);
    });
  }
  distances.distribution_m = distributionOf({distances.distance_m.begin(), distances.distance_m.end()});
  distances.largest = largestOf(distances);
  progress.advance(1);
  return distances;
}

}  // namespace standpoint
