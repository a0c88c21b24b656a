// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/inspect/point_painter.h"

#include "editor/inspect/model_deviation.h"

namespace standpoint {

namespace {

bool same(const PaintRequest& a, const PaintRequest& b) {
  return a.cloud == b.cloud && a.by == b.by && (a.by != ColourBy::deviation || a.environment == b.environment);
}

Result<PaintedPoints> painted(const PaintRequest& request, Progress& progress) {
  progress.stage("Colour points");
  std::vector<float> deviations_m;
  if (request.by == ColourBy::deviation && request.environment) {
    TRY_ASSIGN(deviations_m,
               deviationsFrom(*request.environment, request.shift_m, request.points, *request.header, progress));
  }
  PaintedPoints result{request.cloud, request.by, nullptr, {}};
  result.legend = legendOf(request.points, *request.header, request.by, deviations_m);
  result.colours = std::make_shared<const std::vector<Rgba8>>(
      paintPoints(request.points, *request.header, request.by, result.legend, deviations_m));
  return result;
}

}  // namespace

void PointPainter::follow(const PaintRequest& request, const std::function<void()>& wake) {
  if (task_ && task_->done()) {
    if (auto done = std::exchange(task_, nullptr)->take())
      painted_ = std::make_unique<const PaintedPoints>(*std::move(done));
  }
  if (!request.cloud) {
    task_.reset();
    painted_.reset();
    wanted_ = {};
    return;
  }
  if (same(request, wanted_)) return;
  wanted_ = request;
  task_.reset();
  task_ = std::make_unique<Task<PaintedPoints>>(
      "Colour points", [request](Progress& progress) { return painted(request, progress); }, wake);
}

}  // namespace standpoint
