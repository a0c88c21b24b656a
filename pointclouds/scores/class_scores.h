// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pointclouds/datasets/class_map.h"

namespace standpoint {

// How well points of one class were found. A fraction that has no denominator is nothing.
struct ClassScore {
  std::string name;
  std::uint32_t id = 0;
  std::uint64_t truth = 0, predicted = 0, both = 0;  // points
  std::optional<double> iou() const;                 // both / (truth + predicted - both)
  std::optional<double> precision() const;           // both / predicted
  std::optional<double> recall() const;              // both / truth
};

// Of all points together, never the mean over files.
struct ClassScores {
  std::vector<ClassScore> classes;                      // that are scored, in the order of the map
  std::vector<std::vector<std::uint64_t>> confusion;    // [truth][predicted]; the last column is `given_up`
  std::uint64_t points = 0, ignored = 0, given_up = 0;  // scored; of an ignored truth; predicted as an ignored class
  std::size_t counted = 0;                              // classes in truth or prediction: those that mean_iou is of
  std::optional<double> mean_iou, mean_accuracy, accuracy;  // mean of IoU, mean of recall, share of right points
};

// A label that is none of the classes.
struct UnknownLabel {
  bool predicted = false;  // or of the truth
  std::size_t at = 0;      // from 0
  std::uint32_t id = 0;
};

// Counts pairs of truth and prediction. A point whose truth is an ignored class does not count; a point of a scored
// class that was predicted to be an ignored one is missed there and is nobody else's mistake.
class ClassTally {
 public:
  explicit ClassTally(const ClassMap& map);  // its ids differ
  // Ids of the map; the two have the same size. Where one is not in the map, also beside an ignored truth: the first
  // such, and what has been added is not to be used.
  [[nodiscard]] std::optional<UnknownLabel> add(std::span<const std::uint32_t> truth,
                                                std::span<const std::uint32_t> predicted);
  ClassScores scores() const;
  std::uint64_t wrong() const;  // points that count and are not right, so far

 private:
  static constexpr std::size_t kIgnored = ~std::size_t{0}, kUnknown = kIgnored - 1;
  std::vector<ClassMap::Class> scored_;
  std::vector<std::size_t> slot_of_id_;  // of a scored class; kIgnored; kUnknown
  std::vector<std::uint64_t> counts_;    // scored × (scored + 1)
  std::uint64_t ignored_ = 0;
};

}  // namespace standpoint
