// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "pointclouds/statistics/coverage.h"

namespace standpoint {

// Voting by free space: a place where something was measured and through which rays of another time went has been empty
// then. Cells are counted with their rays as in Schauer & Nüchter 2018 (The Peopleremover, IEEE RA-L 3(3)) and OctoMap
// (Hornung et al. 2013); but only cells with points are kept, a ray walks by them as Amanatides & Woo 1987 do, and two
// laws of our own say when it went through one:
//
// - What was hit in a cell is a patch: the plane of its points, as far as they reach (1.5 sigma of each of its axes).
//   A ray goes through it where it crosses the plane within the patch and ends behind it by more than `distance_m` and
//   three sigma of the points about the plane. So a ray that comes in flatly and ends on the same floor has crossed
//   nothing, however long it was beside it in the cell; one that passes an edge, a thin pole or a corner goes by the
//   patch; and two walls in one cell, or the two sides of one, are a thick patch.
// - Where a cell has too few points for a plane, or they lie in a line (one line of a scanner), or fill it, the patch
//   stands square to the beams that hit it, and a ray must end behind it by three cells, and by so much that it did not
//   just pass above a floor that it meets farther on: from half a metre above the floor, by the patch's reach for each
//   half metre of range.
//
// Rays are counted by slices: a scan, or a second of a carried one. A slice with a point in the cell has seen that
// something is there, whatever else of it went through (leaves, railings, mesh); one without, and with rays that went
// through, has seen that nothing is.
struct SeenCellLimits {
  double cell_m = 0.1;
  double distance_m = 0.05;
};

struct SeenRay {
  Eigen::Vector3d from, to;  // file frame
};

class SeenCells {
 public:
  // 116 bytes each while they are gathered, then 80, and 2 kB for each block of 8 × 8 × 8 cells: up to 1 GB.
  static constexpr std::size_t kMostCells = 4'000'000;
  static constexpr double kLongest_m = 5000;  // a longer ray is no measurement, and left out

  explicit SeenCells(const SeenCellLimits& limits) : limits_(limits) {}

  // First all hits, in the order of the file; false where there are too many cells.
  bool add(const SeenRay& ray);
  void settle();
  // Then the same rays slice by slice; on all threads, and the order within a slice does not matter.
  void look(std::span<const SeenRay> rays);
  void endSlice();

  // At last, once: what moved. A cell that enough rays of enough slices went through, in a large enough share of those
  // that saw it; and one that no more slices hit than went through it, and one, where most of the cells around it have
  // moved, at least four: at a body's rim few rays meet what is left of it.
  struct Law {
    std::uint64_t rays = 1, slices = 1;
    double share = 0.5;
  };
  void judge(const Law& law);
  bool hasMoved(const Eigen::Vector3d& place) const;
  std::size_t cells() const { return counts_.size(); }

 private:
  // Slices that have seen something in a cell, those that have seen through it, and the rays of these.
  struct Votes {
    std::uint16_t hit = 0, through = 0, rays = 0;
  };
  static constexpr int kSide = 8;  // cells along an edge of a block
  static constexpr std::uint32_t kEmpty = ~std::uint32_t{0};
  using Block = std::array<std::uint32_t, kSide * kSide * kSide>;  // the cells' numbers

  struct Moments {  // of a cell's points about its own corner, m
    double points = 0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero(), beams = Eigen::Vector3d::Zero();
    std::array<double, 6> squares{};  // xx, yy, zz, xy, xz, yz
  };
  struct Patch {
    Eigen::Vector3f middle, normal, along;  // relative to origin_; unit; unit in the plane
    float reach_m = 0, reach_across_m = 0;  // along `along`, and across it in the plane
    float behind_m = 0;                     // that a ray must end behind it
    float behind_each = 0;                  // and for each metre of its way to it
  };
  struct Count {
    Votes votes;                 // of the slices before
    std::uint8_t is_hit = 0;     // in this slice
    std::uint8_t has_moved = 0;  // at last
    std::uint32_t rays = 0;      // of this slice that went through
  };

  static Patch patchOf(const Moments& moments, const Eigen::Vector3d& corner, const SeenCellLimits& limits);
  std::uint32_t numberOf(const Cell& cell) const;
  bool isAmongMoved(const Cell& cell) const;
  void walk(const SeenRay& ray, std::vector<std::uint32_t>& touched);
  void walkBlock(const Block& block, const Cell& at, const SeenRay& ray, double from, double to,
                 std::vector<std::uint32_t>& touched);
  bool goesThrough(const Patch& patch, const SeenRay& ray) const;

  SeenCellLimits limits_;
  bool begun_ = false;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();           // all is relative to it: near the first point
  std::unordered_map<std::uint64_t, std::uint32_t> block_of_;  // by the place's key; never walked through
  std::vector<Block> blocks_;
  std::vector<Moments> moments_;
  std::vector<Eigen::Vector3i> places_;  // of the cells in the grid
  std::vector<Patch> patches_;
  std::vector<Count> counts_;
  std::vector<std::uint32_t> touched_;  // cells of this slice, some of them twice
};

}  // namespace standpoint
