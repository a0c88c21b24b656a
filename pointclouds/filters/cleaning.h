// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/report.h"
#include "core/result.h"
#include "pointclouds/filters/point_filter.h"

namespace standpoint {

constexpr double kPlainly_m = 0.01;
// What is not where a surface is, or was gone when others were measured: a cleaning should take it.
constexpr std::uint8_t kFlawed =
    point_flag::kMixed | point_flag::kMirrored | point_flag::kWeather | point_flag::kMoving | point_flag::kNoise;

// Whether a point of a scan with truth is flagged as mixed and is, along its beam, off by more than kPlainly_m. Along a
// trajectory points are about no scanner, so that none is known to be.
class PlainlyMixed {
 public:
  PlainlyMixed() = default;
  explicit PlainlyMixed(const ScanHeader& header);
  bool operator()(const PointBlock& block, std::size_t i) const;

 private:
  bool from_scanner_ = false;
};

// How many points of a kind a filter saw, and how many of them it took.
struct Taken {
  std::uint64_t in = 0, taken = 0;
};

// What one filter did. Truth: of the points that are not where a surface is (the flags mixed, mirrored, weather, moving
// and noise) a filter should take many; all others are good, and what it takes of them is its cost.
struct FilterFigures {
  std::string filter;  // as it was written
  Taken points;
  bool has_truth = false, has_labels = false;  // of any scan; the figures below are of those scans
  Taken with_truth;
  std::array<Taken, 8> flags{};  // by bit of point_flag
  Taken plainly_mixed;  // of those flagged as mixed: off by more than kPlainly_m; most are off by less than noise
  Taken good;           // of the scans with truth
  std::map<std::string, Taken> good_of_class;  // by IFC class: of good points, without truth of all
};

struct Cleaning {
  std::vector<std::filesystem::path> files;
  std::vector<FilterFigures> filters;
  std::uint64_t points_in = 0, points_out = 0;
  Report report;
};

// Copies IN to OUT (formats as convertCloud) without the points that the filters take, one after the other. Reads IN
// once for each pass of a filter and once more to write. Memory: one byte for each point of the file, and what a filter
// holds.
Result<Cleaning> cleanCloud(const std::filesystem::path& in, const std::filesystem::path& out,
                            std::span<const ChosenFilter> filters, Progress& progress);

const std::array<const char*, 8>& flagNames();  // "mixed", …

}  // namespace standpoint
