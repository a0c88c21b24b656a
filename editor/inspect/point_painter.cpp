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
  std::shared_ptr<const ModelDeviation> deviation;
  if (request.by == ColourBy::deviation && request.environment) {
    deviation = std::make_shared<const ModelDeviation>(*request.environment, request.shift_m);
    TRY_ASSIGN(deviations_m, deviation->of(request.points, *request.header, progress));
  }
  PaintedPoints result{request.cloud, request.by, nullptr, {}};
  result.legend = legendOf(request.points, *request.header, request.by, deviations_m);
  CloudPaint paint{paintPoints(request.points, *request.header, request.by, result.legend, deviations_m), {}};
  paint.others = [request, deviation, legend = result.legend](std::span<const CloudPoint> points) {
    Progress unseen;
    const auto deviations =
        deviation ? deviation->of(points, *request.header, unseen) : Result<std::vector<float>>(std::vector<float>());
    return paintPoints(points, *request.header, request.by, legend, *deviations);
  };
  result.paint = std::make_shared<const CloudPaint>(std::move(paint));
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
