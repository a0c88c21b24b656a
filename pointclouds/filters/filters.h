// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The makers behind the table of point_filters.cpp, which says what their options are called outside and how large they
// can be. What contradicts itself is an error without a place.

#include "pointclouds/filters/point_filter.h"

namespace standpoint {

// One of two words.
enum class Side { inside, outside };
enum class NeighbourSearch { grid, distance };

struct DuplicateOptions {
  double distance_m = 0.002;
};
MadeFilter makeDuplicateFilter(const DuplicateOptions& options);

struct OutlierOptions {
  std::uint64_t neighbours = 8;  // of each point
  double sigmas = 3;             // of the distances' logarithm
};
MadeFilter makeOutlierFilter(const OutlierOptions& options);

struct MixedOptions {
  double angle_deg = 10;              // between beam and surface
  double jump_m = 0.01;               // at least, of range
  std::uint64_t neighbours = 16;      // of each point of a cloud without a grid
  std::optional<NeighbourSearch> by;  // nothing: as the scan is
};
MadeFilter makeMixedFilter(const MixedOptions& options);

// As office software does it after the scan.
struct StrayOptions {
  std::uint64_t window = 3;  // cells of the grid to each side of a square about the point, odd
  double distance_m = 0.02;  // of range
  double share = 0.5;        // of the other points in the window that must be as far as the point
};
MadeFilter makeStrayFilter(const StrayOptions& options);

// What another scan saw past: of the same file, or of another.
struct MovingOptions {
  std::optional<std::string> against;  // a file
  double distance_m = 0.03;            // that it must have seen farther
  std::uint64_t votes = 1;             // of so many scans
  std::optional<double> cell_deg;      // of directions; nothing: as the scans are spaced
};
MadeFilter makeMovingFilter(const MovingOptions& options);

// What rays of other scans, of the same file and of another, or of another time of a carried one went through.
struct SeenThroughOptions {
  std::optional<std::string> against;     // a file
  std::optional<std::string> trajectory;  // a file
  Eigen::Vector3d lever_m{0, 0, 0};       // of the scanner on what carries it
  double cell_m = 0.1;
  double distance_m = 0.05;  // that a ray must go on behind the surface
  std::uint64_t rays = 1;    // at least, through a cell
  std::uint64_t votes = 1;   // of so many scans, or slices of a carried one
  double share = 0.5;        // of the scans or slices that saw the cell
  double slice_s = 1;        // of a carried scan
};
MadeFilter makeSeenThroughFilter(const SeenThroughOptions& options);

struct GateOptions {
  std::optional<double> from, to;  // m, degrees, or as intensities are stored in the file
};
MadeFilter makeRangeGate(const GateOptions& options);
MadeFilter makeIntensityGate(const GateOptions& options);
MadeFilter makeIncidenceGate(const GateOptions& options);

struct VoxelOptions {
  double cell_m = 0;
};
MadeFilter makeVoxelFilter(const VoxelOptions& options);

struct FractionOptions {
  double keep = 1;  // 0..1
  std::uint64_t seed = 1;
};
MadeFilter makeFractionFilter(const FractionOptions& options);

struct EveryOptions {
  std::uint64_t n = 1;
};
MadeFilter makeEveryFilter(const EveryOptions& options);

struct BoxOptions {
  Eigen::Vector3d from{0, 0, 0}, to{0, 0, 0};  // file frame
  Side keep = Side::inside;
};
MadeFilter makeBoxFilter(const BoxOptions& options);

struct SphereOptions {
  double radius_m = 0;
  std::optional<std::string> station;  // name of a scan in the file
  std::optional<Eigen::Vector3d> at;   // file frame
  Side keep = Side::inside;
};
MadeFilter makeSphereFilter(const SphereOptions& options);

}  // namespace standpoint
