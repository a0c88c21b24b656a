// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/filters/seen_cells.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Geometry>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "core/decompositions.h"

namespace standpoint {

namespace {

constexpr double kReach = 1.5;            // sigma: of points that fill a square, 0.87 of half its edge
constexpr double kFewestOfPlane = 8;      // points
constexpr double kFlat = 3;               // a plane is so many times wider than thick
constexpr double kLeastWidth = 1.0 / 20;  // of a plane, one sigma; of the cell
constexpr double kLeastReach = 1.0 / 5;   // of a patch across the beams, of the cell
constexpr double kBehindLoose = 3;        // cells
constexpr double kLowest_m = 0.5;         // of a scanner above a floor that it sees flatly
constexpr int kFewestMoved = 4;           // cells around one

// The number of a block, if it is not absurdly far off.
std::optional<std::uint64_t> keyOf(const Cell& block) {
  constexpr std::int64_t kHalf = std::int64_t{1} << 20;
  if ((block.array() < -kHalf).any() || (block.array() >= kHalf).any()) return std::nullopt;
  std::uint64_t key = 0;
  for (const std::int64_t at : block) key = key << 21U | static_cast<std::uint64_t>(at + kHalf);
  return key;
}

// The cells of a grid along a stretch of a ray, as Amanatides & Woo 1987 (A Fast Voxel Traversal Algorithm for Ray
// Tracing) go: visit(cell, where the ray comes in, where it goes out), as shares of the whole ray.
template <class Visit>
void walkGrid(const SeenRay& ray, double edge_m, double from, double to, const Visit& visit) {
  const Eigen::Vector3d way = ray.to - ray.from;
  Cell cell = cellAt(ray.from + from * way, edge_m);
  Cell step = Cell::Zero();
  Eigen::Vector3d next = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), each = next;
  for (int axis = 0; axis < 3; ++axis) {
    if (way[axis] == 0) continue;
    step[axis] = way[axis] > 0 ? 1 : -1;
    const double border = static_cast<double>(cell[axis] + (way[axis] > 0 ? 1 : 0)) * edge_m;
    next[axis] = (border - ray.from[axis]) / way[axis];
    each[axis] = edge_m / std::abs(way[axis]);
  }
  for (double at = from; at < to;) {
    int axis = 0;
    next.minCoeff(&axis);
    const double out = std::min(next[axis], to);
    visit(cell, at, out);
    at = std::max(at, next[axis]);
    cell[axis] += step[axis];
    next[axis] += each[axis];
  }
}

}  // namespace

bool SeenCells::add(const SeenRay& ray) {
  if (!begun_) origin_ = ray.to.array().round().matrix();
  begun_ = true;
  const Eigen::Vector3d place = ray.to - origin_;
  const Cell cell = cellAt(place, limits_.cell_m);
  const auto block = Cell(cell.array().unaryExpr([](std::int64_t at) { return at >> 3; }));
  const auto key = keyOf(block);
  if (!key || !((ray.to - ray.from).norm() < kLongest_m)) return true;
  const auto [found, is_new] = block_of_.try_emplace(*key, static_cast<std::uint32_t>(blocks_.size()));
  if (is_new) blocks_.emplace_back().fill(kEmpty);
  const Cell in_block = cell - block * kSide;
  auto& number =
      blocks_[found->second][static_cast<std::size_t>((in_block.x() * kSide + in_block.y()) * kSide + in_block.z())];
  if (number == kEmpty) {
    if (moments_.size() == kMostCells) return false;
    number = static_cast<std::uint32_t>(moments_.size());
    moments_.emplace_back();
    places_.push_back(cell.cast<int>());
  }
  Moments& m = moments_[number];
  const Eigen::Vector3d p = place - cell.cast<double>() * limits_.cell_m;
  m.points += 1;
  m.sum += p;
  m.beams += (ray.to - ray.from).normalized();
  const std::array products = {p.x() * p.x(), p.y() * p.y(), p.z() * p.z(),
                               p.x() * p.y(), p.x() * p.z(), p.y() * p.z()};
  for (std::size_t k = 0; k < products.size(); ++k) m.squares[k] += products[k];
  return true;
}

SeenCells::Patch SeenCells::patchOf(const Moments& moments, const Eigen::Vector3d& corner,
                                    const SeenCellLimits& limits) {
  const Eigen::Vector3d mean = moments.sum / moments.points;
  const auto& s = moments.squares;
  Eigen::Matrix3d spread;
  spread << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
  spread = spread / moments.points - mean * mean.transpose();
  const auto sigma = [](double variance) { return std::sqrt(std::max(0.0, variance)); };
  const PrincipalAxes axes = principalAxes(spread);
  const double thick = sigma(axes.values[0]), wide = sigma(axes.values[1]);
  Patch patch;
  patch.middle = (corner + mean).cast<float>();
  if (moments.points >= kFewestOfPlane && wide > kLeastWidth * limits.cell_m && wide > kFlat * thick) {
    patch.normal = axes.axes.col(0).cast<float>();
    patch.along = axes.axes.col(2).cast<float>();
    patch.reach_m = static_cast<float>(kReach * sigma(axes.values[2]));
    patch.reach_across_m = static_cast<float>(kReach * wide);
    patch.behind_m = static_cast<float>(limits.distance_m + 3 * thick);
    return patch;
  }
  const Eigen::Vector3d beam = moments.beams.norm() > 1e-9 ? moments.beams.normalized() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d up = std::abs(beam.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d along = beam.cross(up).normalized(), across = beam.cross(along);
  const auto reach = [&](const Eigen::Vector3d& axis) {
    return static_cast<float>(std::max(kReach * sigma(axis.dot(spread * axis)), kLeastReach * limits.cell_m));
  };
  patch.normal = beam.cast<float>(), patch.along = along.cast<float>();
  patch.reach_m = reach(along), patch.reach_across_m = reach(across);
  patch.behind_m = static_cast<float>(std::max(kBehindLoose * limits.cell_m, limits.distance_m));
  patch.behind_each = std::max(patch.reach_m, patch.reach_across_m) / static_cast<float>(kLowest_m);
  return patch;
}

void SeenCells::settle() {
  patches_.reserve(moments_.size());
  for (std::size_t i = 0; i < moments_.size(); ++i)
    patches_.push_back(patchOf(moments_[i], places_[i].cast<double>() * limits_.cell_m, limits_));
  counts_.resize(moments_.size());
  moments_ = {};
}

bool SeenCells::goesThrough(const Patch& patch, const SeenRay& ray) const {
  const Eigen::Vector3d normal = patch.normal.cast<double>(), middle = patch.middle.cast<double>();
  const double before = normal.dot(ray.from - middle), behind = normal.dot(ray.to - middle);
  if ((before < 0) == (behind < 0) || std::abs(behind) < static_cast<double>(patch.behind_m)) return false;
  const Eigen::Vector3d way = before / (before - behind) * (ray.to - ray.from), off = ray.from + way - middle;
  if (std::abs(behind) < static_cast<double>(patch.behind_each) * way.norm()) return false;
  const Eigen::Vector3d along = patch.along.cast<double>();
  return std::abs(off.dot(along)) <= static_cast<double>(patch.reach_m) &&
         std::abs(off.dot(normal.cross(along))) <= static_cast<double>(patch.reach_across_m);
}

void SeenCells::walkBlock(const Block& block, const Cell& at, const SeenRay& ray, double from, double to,
                          std::vector<std::uint32_t>& touched) {
  walkGrid(ray, limits_.cell_m, from, to, [&](const Cell& cell, double, double) {
    const Cell in = cell - at * kSide;
    if ((in.array() < 0).any() || (in.array() >= kSide).any()) return;  // by rounding
    const auto number = block[static_cast<std::size_t>((in.x() * kSide + in.y()) * kSide + in.z())];
    if (number == kEmpty || !goesThrough(patches_[number], ray)) return;
    if (std::atomic_ref(counts_[number].rays).fetch_add(1, std::memory_order_relaxed) == 0) touched.push_back(number);
  });
}

void SeenCells::walk(const SeenRay& ray, std::vector<std::uint32_t>& touched) {
  walkGrid(ray, kSide * limits_.cell_m, 0, 1, [&](const Cell& at, double from, double to) {
    const auto key = keyOf(at);
    const auto found = key ? block_of_.find(*key) : block_of_.end();
    if (found != block_of_.end()) walkBlock(blocks_[found->second], at, ray, from, to, touched);
  });
  const auto end = numberOf(cellAt(ray.to, limits_.cell_m));
  if (end != kEmpty && std::atomic_ref(counts_[end].is_hit).exchange(1, std::memory_order_relaxed) == 0)
    touched.push_back(end);
}

void SeenCells::look(std::span<const SeenRay> rays) {
  tbb::enumerable_thread_specific<std::vector<std::uint32_t>> touched;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), 1024), [&](const auto& part) {
    for (std::size_t i = part.begin(); i < part.end(); ++i) {
      const SeenRay ray{rays[i].from - origin_, rays[i].to - origin_};
      if ((ray.to - ray.from).norm() < kLongest_m) walk(ray, touched.local());
    }
  });
  for (const auto& some : touched) touched_.insert(touched_.end(), some.begin(), some.end());
}

void SeenCells::endSlice() {
  const auto add = [](std::uint16_t& count, std::uint32_t more) {
    count = static_cast<std::uint16_t>(std::min<std::uint32_t>(0xFFFF, count + std::min<std::uint32_t>(0xFFFF, more)));
  };
  for (const auto number : touched_) {
    Count& count = counts_[number];
    if (count.is_hit != 0) {
      add(count.votes.hit, 1);
    } else if (count.rays > 0) {
      add(count.votes.through, 1);
      add(count.votes.rays, count.rays);
    }
    count.rays = 0;
    count.is_hit = 0;
  }
  touched_.clear();
}

std::uint32_t SeenCells::numberOf(const Cell& cell) const {
  const auto block = Cell(cell.array().unaryExpr([](std::int64_t at) { return at >> 3; }));
  const auto key = keyOf(block);
  const auto found = key ? block_of_.find(*key) : block_of_.end();
  if (found == block_of_.end()) return kEmpty;
  const Cell in = cell - block * kSide;
  return blocks_[found->second][static_cast<std::size_t>((in.x() * kSide + in.y()) * kSide + in.z())];
}

bool SeenCells::isAmongMoved(const Cell& cell) const {
  int moved = 0, others = 0;
  for (int k = 0; k < 27; ++k) {
    const auto number = k == 13 ? kEmpty : numberOf(cell + Cell(k / 9 - 1, k / 3 % 3 - 1, k % 3 - 1));
    if (number != kEmpty) ++(counts_[number].has_moved == 1 ? moved : others);
  }
  return moved >= kFewestMoved && moved > others;
}

void SeenCells::judge(const Law& law) {
  constexpr std::uint8_t kWithOthers = 2;
  for (auto& [votes, is_hit, has_moved, rays] : counts_)
    has_moved = votes.rays >= law.rays && votes.through >= law.slices &&
                        votes.through >= law.share * (static_cast<double>(votes.hit) + votes.through)
                    ? 1
                    : 0;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    auto& [votes, is_hit, has_moved, rays] = counts_[i];
    if (has_moved == 0 && votes.hit <= 1 + votes.through && isAmongMoved(places_[i].cast<std::int64_t>()))
      has_moved = kWithOthers;
  }
}

bool SeenCells::hasMoved(const Eigen::Vector3d& place) const {
  const auto number = numberOf(cellAt(place - origin_, limits_.cell_m));
  return number != kEmpty && counts_[number].has_moved != 0;
}

}  // namespace standpoint
