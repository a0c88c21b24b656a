// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "optimizer/surface/vertex_deviation.h"
#include "project/document.h"
#include "project/task.h"

namespace standpoint {

// How far each vertex of one of the two models is from the other.
struct DeviationField {
  std::shared_ptr<const Environment> environment;
  std::vector<std::shared_ptr<const InstanceDeviation>> of_instance;  // empty ones for what is not in the scene
  double full_scale_m = 0;                                            // the distance that has the last colour
};

// The area of both models by its distance from the other one.
struct DeviationHistogram {
  static constexpr std::array<double, 8> kLimits_m = {1e-4, 3e-4, 1e-3, 3e-3,
                                                      1e-2, 3e-2, 1e-1, 1e300};  // the upper ends
  std::array<double, 8> area_m2 = {};
};

struct Comparison {
  std::shared_ptr<const DeviationField> original, lighter;
  DeviationHistogram histogram;
};

// From grey, where nothing moved, over yellow to dark red at the full scale.
std::array<std::uint8_t, 4> deviationColour(double distance_m, double full_scale_m);

// Compares the lighter model with the original in the background, once for each pair.
class DeviationView {
 public:
  // To be called when the document may have changed and the comparison is asked for.
  void follow(const Document& document, const std::function<void()>& wake);
  // Of this document; null until it is there.
  std::shared_ptr<const Comparison> of(const Document& document) const;
  bool busy() const { return task_ && !task_->done(); }
  void wait() {
    if (task_) task_->wait();
  }

 private:
  std::shared_ptr<const Environment> original_, lighter_;  // of what is computed or there
  std::unique_ptr<Task<std::shared_ptr<const Comparison>>> task_;
};

}  // namespace standpoint
