// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clouds/place_points.h"

#include <utility>

namespace standpoint {

void PlacePoints::start(PlaceRequest request, const std::function<void()>& wake) {
  drop();
  if (request.scans.empty()) return;
  task_ = std::make_unique<Task<Cloud>>(
      "Points around the worst place",
      [request = std::move(request)](Progress& progress) {
        constexpr std::uint64_t kMost = 400'000;  // as many as a picture tells apart
        const CropShape ball{.centre = request.centre, .radius_m = request.radius_m};
        return croppedCloud(request.scans, ball, request.shift_m, kMost, progress);
      },
      wake);
}

void PlacePoints::poll() {
  if (!task_ || !task_->done()) return;
  auto read = std::exchange(task_, nullptr)->take();
  if (!read || read->points.empty()) return;
  ShownUnderlay shown{std::make_shared<const Cloud>(*std::move(read))};
  shown.local_from_cloud.topRightCorner<3, 1>() = shown.cloud->pointsOrigin_m();
  shown_ = std::move(shown);
}

void PlacePoints::drop() {
  task_.reset();
  shown_.reset();
}

}  // namespace standpoint
