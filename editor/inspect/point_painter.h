// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/environment.h"
#include "editor/inspect/point_colour.h"
#include "project/task.h"

namespace standpoint {

// What shall be coloured by what.
struct PaintRequest {
  std::shared_ptr<const void> cloud;  // keeps the points and the header alive
  std::span<const CloudPoint> points;
  const CloudHeader* header = nullptr;
  ColourBy by = ColourBy::natural;
  std::shared_ptr<const Environment> environment;  // of ColourBy::deviation; local frame
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();
};

struct PaintedPoints {
  std::shared_ptr<const void> cloud;
  ColourBy by = ColourBy::natural;
  std::shared_ptr<const CloudPaint> paint;
  PointLegend legend;
};

// Colours in the background, once for what is asked for; the last result stays until another is there.
class PointPainter {
 public:
  // Once a frame; a request without a cloud drops everything.
  void follow(const PaintRequest& request, const std::function<void()>& wake);
  bool busy() const { return task_ && !task_->done(); }
  void wait() {
    if (task_) task_->wait();
  }
  // Of this cloud; null until it is there.
  const PaintedPoints* of(const std::shared_ptr<const void>& cloud) const {
    return painted_ && painted_->cloud == cloud ? painted_.get() : nullptr;
  }

 private:
  PaintRequest wanted_;
  std::unique_ptr<Task<PaintedPoints>> task_;
  std::unique_ptr<const PaintedPoints> painted_;
};

}  // namespace standpoint
