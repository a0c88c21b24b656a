// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/progress.h"
#include "core/report.h"
#include "core/result.h"
#include "pointclouds/statistics/cloud_distances.h"
#include "pointclouds/statistics/distribution.h"

namespace standpoint {

// What two clouds are compared by. All lengths in metres, all positions in the frame of the cloud's file.
struct StatisticsOptions {
  double radius_m = 0.05;        // of a neighbourhood, for plane noise and roughness
  double cell_m = 0.05;          // of the coverage grid
  std::uint32_t samples = 8192;  // neighbourhoods, drawn evenly among the points by a hash of their index
};

struct MaterialIntensity {
  std::string material;
  std::uint64_t points = 0;
  double mean = 0, sigma = 0;  // raw, see ScanHeader::intensity_min
};

struct CloudStatistics {
  std::uint64_t scans = 0, points = 0;
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = Eigen::Vector3d::Zero();
  // 1 sigma along the beam of the points of one scan around a sample, from the residuals of their plane; only where
  // they are one plane (see statistics.cpp). It is the range noise of the instrument, plus what relief the surface has.
  Distribution plane_noise_m;
  // CloudCompare's roughness: distance of the sample to the plane through its neighbours, itself excluded. Edges and
  // clutter weigh in it: it is no noise measure (of pure plane noise the mean is 0.8 sigma).
  Distribution roughness_m;
  Distribution intensity;                    // percentiles of the samples; samples, mean and sigma of all points
  std::vector<MaterialIntensity> materials;  // by name; empty without labels
  std::uint64_t occupied_cells = 0;          // exact up to 4 million, an estimate to 0.1 % beyond
};

// A cloud, or one scan of it.
struct CloudPart {
  std::filesystem::path file;
  std::string scan = {};  // its name in the file; "": all of them
};

struct CloudComparison {
  CloudStatistics a, b;
  double a_covered_by_b = 0, b_covered_by_a = 0;  // share of the occupied cells
  CloudDistances a_from_b, b_from_a;
  Report report;  // of reading both
};

// Reads the file twice; memory does not grow with it. The same file gives the same figures.
Result<CloudStatistics> measureCloud(const std::filesystem::path& file, const StatisticsOptions& options,
                                     Report& report, Progress& progress);
// Errors: no scan of that name.
Result<CloudComparison> compareClouds(const CloudPart& a, const CloudPart& b, const StatisticsOptions& options,
                                      Progress& progress);

}  // namespace standpoint
