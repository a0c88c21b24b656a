// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pointclouds/datasets/class_map.h"

namespace standpoint {

// Average precision of the instances of one class; nothing where the truth has none.
struct InstanceScore {
  std::string name;
  std::uint32_t id = 0;
  std::uint64_t truth = 0, predicted = 0;  // instances of 100 points or more
  std::optional<double> ap, ap_50, ap_25;  // mean over IoU of 0.5, 0.55 … 0.9; at 0.5; at 0.25
};
struct InstanceScores {
  std::vector<InstanceScore> classes;  // that are scored, in the order of the map
  std::size_t counted = 0;             // classes with figures: those that the means are of
  std::optional<double> ap, ap_50, ap_25;
};

// A true instance that no prediction of its class matches with an IoU of more than 0.5.
struct MissedInstance {
  std::size_t scene = 0;       // in the order of add()
  std::uint32_t id = 0;        // of its class
  std::uint32_t instance = 0;  // its number in the scene
  std::uint64_t points = 0;
  double iou = 0;                // with the prediction of its class that matches it best; 0 where there is none
  std::uint32_t prediction = 0;  // the number of that one
};

// Instances in each scene by themselves, as ScanNet's benchmark counts them (Dai et al. 2017 and its
// evaluate_semantic_instance): an instance is the points with the same class and number. Of two predictions of one true
// instance the one of higher confidence is right. Instances under 100 points are no truth and no prediction, and a
// prediction that matches nothing is left out where more of it than the threshold lies on such ones and on points
// without a true instance or of an ignored class; else it is wrong.
class InstanceTally {
 public:
  static constexpr std::uint64_t kLeastPoints = 100;

  explicit InstanceTally(const ClassMap& map);  // its ids differ
  struct Labels {
    std::span<const std::uint32_t> ids, instances;  // of the map; 0: of none
  };
  // One scene, its spans of the same size and its ids those of the map. `confidence` of predicted instances by number;
  // one that is not in it has 1.
  void add(const Labels& truth, const Labels& predicted, const std::map<std::uint32_t, double>& confidence);
  InstanceScores scores() const;
  // At most so many: those with the most points, of equal ones the first. Scenes that `of` refuses are left out.
  std::vector<MissedInstance> missed(std::size_t most, const std::function<bool(std::size_t scene)>& of) const;

 private:
  struct Truth {
    std::uint32_t instance = 0;
    std::uint64_t points = 0;
  };
  struct Prediction {
    std::uint32_t instance = 0;
    std::uint64_t points = 0, left_out = 0;  // of these on nothing that counts
    double confidence = 1;
  };
  struct Overlap {
    std::size_t truth = 0, prediction = 0;
    std::uint64_t points = 0;
  };
  struct Scene {  // of one class
    std::vector<Truth> truth;
    std::vector<Prediction> predictions;
    std::vector<Overlap> overlaps;
  };
  static std::optional<double> averagePrecision(const std::vector<Scene>& scenes, double least_iou);

  std::vector<ClassMap::Class> scored_;
  std::map<std::uint32_t, std::size_t> slot_of_id_;
  std::vector<std::vector<Scene>> scenes_;  // of each class
};

}  // namespace standpoint
