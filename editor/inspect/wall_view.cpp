// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/inspect/wall_view.h"

#include <fmt/format.h>

#include "core/units.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

std::string millimetres(double value_m) { return figures("{:.2f} mm", value_m * 1000); }

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
  auto text = trf("Plane in {}: {} points, sigma {}, largest {}", wall.request.cloud, fit.fitted,
                  millimetres(fit.sigma_m), millimetres(fit.max_m));
  text += fit.level ? trf(", tilt from level {:.3f}°", fit.tilt_rad / kRadPerDeg)
                    : trf(", tilt from plumb {:.3f}°", fit.tilt_rad / kRadPerDeg);
  if (fit.beam_sigma_m) text += trf(", sigma along the beam {}", millimetres(*fit.beam_sigma_m));
  text += trf(", roughness {} (radius {})", millimetres(fit.roughness.mean_m), millimetres(fit.roughness.radius_m));
  return text;
}

std::string wallText(const WallResult& wall) {
  const auto& fit = wall.fit;
  std::string text;
  const auto row = [&](const std::string& name, const std::string& value) { text += name + "\t" + value + "\n"; };
  row(tr("Cloud"), wall.request.cloud);
  row(tr("Radius"), millimetres(wall.request.ball.radius_m));
  row(tr("Points in region"), fmt::format("{}", wall.inside));
  row(tr("Fitted points"), fmt::format("{}", fit.fitted));
  row(tr("Sigma"), millimetres(fit.sigma_m));
  row(tr("Largest residual"), millimetres(fit.max_m));
  if (fit.beam_sigma_m) row(tr("Sigma along the beam"), millimetres(*fit.beam_sigma_m));
  if (fit.incidence_rad) row(tr("Mean incidence"), figures("{:.1f}°", *fit.incidence_rad / kRadPerDeg));
  row(fit.level ? tr("Tilt from level") : tr("Tilt from plumb"), figures("{:.3f}°", fit.tilt_rad / kRadPerDeg));
  row(trf("Roughness (r {:.3g} m)", fit.roughness.radius_m), millimetres(fit.roughness.mean_m));
  row(tr("Width"), figures("{:.3f} m", fit.width_m));
  row(tr("Height"), figures("{:.3f} m", fit.height_m));
  return text;
}

void WallView::start(WallRequest request) {
  latest_.want(++started_,
               [request = std::move(request)](Progress& progress) -> Result<std::shared_ptr<const WallResult>> {
                 TRY_ASSIGN(auto made, measured(request, progress));
                 return std::make_shared<const WallResult>(std::move(made));
               });
}

std::shared_ptr<const WallResult> WallView::result() const {
  const auto* answer = latest_.answer();
  return answer != nullptr && *answer ? **answer : nullptr;
}

std::string WallView::problem() const {
  const auto* answer = latest_.answer();
  return answer == nullptr || *answer ? std::string() : trError(answer->error());
}

}  // namespace standpoint
