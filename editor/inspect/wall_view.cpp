// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/inspect/wall_view.h"

#include <fmt/format.h>

#include "core/units.h"

namespace standpoint {

namespace {

std::string millimetres(double value_m) { return fmt::format("{:.2f} mm", value_m * 1000); }

Result<WallResult> measured(const WallRequest& request, Progress& progress) {
  progress.stage("Measure a wall in " + request.file.filename().string());
  TRY_ASSIGN(const auto region, readRegion(request.file, request.ball, progress));
  TRY_ASSIGN(const auto fit, fitWall(region.points, request.options));
  return WallResult{request, region.inside, fit};
}

}  // namespace

std::array<Eigen::Vector3d, 4> cornersOf(const WallResult& wall) {
  const auto& fit = wall.fit;
  const double left = fit.across.low_m, right = left + fit.width_m, low = fit.upward.low_m, high = low + fit.height_m;
  const auto at = [&](double u, double v) {
    return wall.request.local_from_cloud * (fit.centre + u * fit.along + v * fit.up);
  };
  return {at(left, low), at(right, low), at(right, high), at(left, high)};
}

std::string wallNote(const WallResult& wall) {
  const auto& fit = wall.fit;
  auto text = fmt::format("Plane in {}: {} points, sigma {}, largest {}, ", wall.request.cloud, fit.fitted,
                          millimetres(fit.sigma_m), millimetres(fit.max_m));
  text += fmt::format("tilt from {} {:.3f}°", fit.level ? "level" : "plumb", fit.tilt_rad / kRadPerDeg);
  if (fit.beam_sigma_m) text += fmt::format(", sigma along the beam {}", millimetres(*fit.beam_sigma_m));
  text +=
      fmt::format(", roughness {} (radius {})", millimetres(fit.roughness.mean_m), millimetres(fit.roughness.radius_m));
  return text;
}

std::string wallText(const WallResult& wall) {
  const auto& fit = wall.fit;
  std::string text = fmt::format("Cloud\t{}\nPoints in radius {:.3f} m\t{}\nFitted points\t{}\n", wall.request.cloud,
                                 wall.request.ball.radius_m, wall.inside, fit.fitted);
  text += fmt::format("Sigma\t{}\nLargest residual\t{}\n", millimetres(fit.sigma_m), millimetres(fit.max_m));
  if (fit.beam_sigma_m) text += fmt::format("Sigma along the beam\t{}\n", millimetres(*fit.beam_sigma_m));
  if (fit.incidence_rad) text += fmt::format("Mean incidence\t{:.1f}°\n", *fit.incidence_rad / kRadPerDeg);
  text += fmt::format("Tilt from {}\t{:.3f}°\n", fit.level ? "level" : "plumb", fit.tilt_rad / kRadPerDeg);
  text += fmt::format("Roughness (radius {})\t{}\n", millimetres(fit.roughness.radius_m),
                      millimetres(fit.roughness.mean_m));
  text += fmt::format("Width\t{:.3f} m\nHeight\t{:.3f} m\n", fit.width_m, fit.height_m);
  return text;
}

void WallView::start(WallRequest request, const std::function<void()>& wake) {
  clear();
  task_ = std::make_unique<Task<WallResult>>(
      "Measure a wall", [request = std::move(request)](Progress& progress) { return measured(request, progress); },
      wake);
}

void WallView::poll() {
  if (!task_ || !task_->done()) return;
  auto done = task_->take();
  task_.reset();
  if (done)
    result_ = std::make_shared<const WallResult>(*std::move(done));
  else if (done.error().kind != ErrorKind::cancelled)
    problem_ = describe(done.error());
}

void WallView::clear() {
  task_.reset();
  result_.reset();
  problem_.clear();
}

}  // namespace standpoint
