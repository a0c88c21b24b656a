// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/quality/scan_marks.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

#include <tbb/parallel_for.h>

#include "pointclouds/statistics/coverage.h"

namespace standpoint {

namespace {

// Does the body end within the radius behind this face?
bool isThin(const RayScene& scene, const SurfaceSample& sample, double radius_m) {
  constexpr double kInside_m = 1e-3;
  const Eigen::Vector3d from = sample.place.position - kInside_m * sample.place.normal;
  return scene.intersect(from, -sample.place.normal, radius_m).has_value();
}

}  // namespace

SampleCells::SampleCells(const RayScene& scene, const SurfaceSamples& samples, double radius_m)
    : samples_(samples), radius_m_(radius_m), thin_(samples.samples.size()) {
  tbb::parallel_for(std::size_t{0}, thin_.size(), [&](std::size_t k) {  // each into its own slot
    thin_[k] = static_cast<std::uint8_t>(isThin(scene, samples.samples[k], radius_m));
  });
  for (std::uint32_t k = 0; k < samples.samples.size(); ++k) {
    if (!samples.samples[k].exposed) continue;
    const Cell home = cellAt(samples.samples[k].place.position, radius_m);
    for (int n = 0; n < 27; ++n) entries_.push_back({hashOf(home + Cell(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1)), k});
  }
  mask_ = std::bit_ceil(entries_.size() + 1) - 1;
  begins_.assign(mask_ + 2, 0);
  for (const auto& e : entries_) ++begins_[(e.cell & mask_) + 1];
  for (std::size_t b = 1; b < begins_.size(); ++b) begins_[b] += begins_[b - 1];
  std::sort(entries_.begin(), entries_.end(), [this](const Entry& a, const Entry& b) {
    return std::pair(a.cell & mask_, a.sample) < std::pair(b.cell & mask_, b.sample);
  });
}

void SampleCells::each(const Eigen::Vector3d& point, const Eigen::Vector3d& origin, const auto& visit) const {
  const std::uint64_t cell = hashOf(cellAt(point, radius_m_));
  for (auto e = begins_[cell & mask_]; e < begins_[(cell & mask_) + 1]; ++e) {
    if (entries_[e].cell != cell) continue;
    const auto k = entries_[e].sample;
    const auto& place = samples_.samples[k].place;
    const Eigen::Vector3d way = point - place.position;
    if (!(way.squaredNorm() <= radius_m_ * radius_m_)) continue;
    if (std::abs(way.dot(place.normal)) > radius_m_ / 2) continue;
    if (thin_[k] != 0 && place.normal.dot(origin - place.position) <= 0) continue;
    visit(k);
  }
}

void SampleCells::mark(const Eigen::Vector3d& point, const Eigen::Vector3d& origin,
                       std::span<std::uint32_t> counts) const {
  each(point, origin, [&](std::uint32_t k) { std::atomic_ref(counts[k]).fetch_add(1, std::memory_order_relaxed); });
}

void SampleCells::samplesAt(const Eigen::Vector3d& point, const Eigen::Vector3d& origin,
                            std::vector<std::uint32_t>& found) const {
  each(point, origin, [&](std::uint32_t k) { found.push_back(k); });
}

void EvenDraw::offer(const Eigen::Vector3d& point) {
  const std::uint64_t hash = mixed(number_++);
  if (hash > limit_) return;
  points_.push_back(point);
  hashes_.push_back(hash);
  if (points_.size() <= most_) return;
  limit_ /= 2;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < hashes_.size(); ++i) {
    if (hashes_[i] > limit_) continue;
    points_[kept] = points_[i];
    hashes_[kept++] = hashes_[i];
  }
  points_.resize(kept);
  hashes_.resize(kept);
}

MarkingSink::MarkingSink(const SampleCells& cells, const Pose& placed, const Eigen::Vector3d& origin, double patch_m,
                         ScanMarks& marks)
    : cells_(cells), placed_(placed), origin_(origin), marks_(marks), patches_(marks.patches, patch_m) {}

Result<void> MarkingSink::begin(const ScanHeader& header) {
  ScanHeader placed = header;
  placed.file_from_scanner = placed_;
  return patches_.begin(placed);
}

Result<void> MarkingSink::write(const PointBlock& block) {
  points_.resize(block.size());
  tbb::parallel_for(std::size_t{0}, points_.size(), [&](std::size_t i) {  // counts add up alike in any order
    points_[i] = placed_ * Eigen::Vector3d(block.x_m[i], block.y_m[i], block.z_m[i]);
    cells_.mark(points_[i], origin_, marks_.counts);
  });
  for (const auto& point : points_) marks_.drawn.offer(point);
  marks_.points += block.size();
  return patches_.write(block);
}

}  // namespace standpoint
