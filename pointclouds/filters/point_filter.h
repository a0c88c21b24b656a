// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/motion/pose_function.h"
#include "core/points.h"
#include "core/progress.h"
#include "core/result.h"

namespace standpoint {

// What became of each point of a file, by its number there: 0 = it is still there, else which filter took it, from 1.
using Fates = std::vector<std::uint8_t>;

// The points that the filters before have left, and what this one takes of them.
class Remaining {
 public:
  Remaining(Fates& fates, std::uint8_t filter) : fates_(fates), filter_(filter) {}
  bool has(std::uint64_t point) const { return fates_[point] == 0; }
  void take(std::uint64_t point) { fates_[point] = filter_; }

 private:
  Fates& fates_;
  std::uint8_t filter_;
};

struct FilterScan {
  std::string name;
  std::optional<Eigen::Vector3d> station;  // where its scanner stood, file frame, if the file says so
};

// What is known of a cloud before its first point.
struct FilterCloud {
  std::vector<FilterScan> scans;
  PoseFunctionPtr carrier;       // ChosenFilter::carrier
  Progress* progress = nullptr;  // for other files that a filter reads
};

// One filter at work: it sees the file's points as often as it asks for, and takes what it does not want. What it takes
// it must not look at again; points keep their numbers in every pass.
class PointFilter {
 public:
  virtual ~PointFilter() = default;
  virtual Result<void> know(const FilterCloud&) { return {}; }
  virtual Result<void> beginScan(const ScanHeader&) { return {}; }  // an error where the filter does not apply
  virtual Result<void> see(const PointBlock& block, std::uint64_t first, Remaining& remaining) = 0;
  virtual Result<void> endScan(Remaining&) { return {}; }
  virtual Result<bool> endPass(Remaining&) { return false; }  // true: another pass, please
};

using MadeFilter = Result<std::unique_ptr<PointFilter>>;

std::string filterList();  // of point_filters.cpp: names and keys, for help

// "mixed" or "range:from=0.5,to=30" with its options read; an error says what there is instead.
struct ChosenFilter {
  std::string text;
  std::function<MadeFilter()> make;
  // The file that its key `trajectory` names; and what it says, file frame, from whoever can read it.
  std::filesystem::path trajectory = {};
  PoseFunctionPtr carrier = {};
};
Result<ChosenFilter> filterFrom(const std::string& text);

}  // namespace standpoint
