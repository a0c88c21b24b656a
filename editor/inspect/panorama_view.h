// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/survey.h"
#include "editor/colours/colour_scale.h"
#include "pointclouds/inspection/panorama.h"
#include "project/latest_task.h"
#include "project/task.h"

namespace standpoint {

struct PanoramaRequest {
  std::string cloud;  // its label
  std::filesystem::path file;
  std::optional<std::size_t> scan;  // its place in the file; nothing: the first that has a station
  Pose local_from_cloud;
};

struct PanoramaRead {
  PanoramaRequest request;
  Panorama panorama;
};

// Rows from the top; what nothing came back from is dark.
std::vector<Rgba8> paintPanorama(const Panorama& panorama, PanoramaChannel channel, const PanoramaShades& shades);

// Which part of a panorama is shown, in fractions of it; `zoom` 1 shows all of its height. It is a ring: x wraps, and
// never more than once around it is shown.
struct PanoramaWindow {
  double x = 0.5, y = 0.5, zoom = 1;  // the middle
};
PanoramaWindow fillingWidth(const PanoramaWindow& window, double aspect);  // zoomed in until it is so
// Keeps what is under `at` (0..1 of the shown part) where it is; `aspect` is width over height of the widget.
PanoramaWindow zoomed(const PanoramaWindow& window, double factor, double at_x, double at_y, double aspect);
PanoramaWindow panned(const PanoramaWindow& window, double by_x, double by_y,
                      double aspect);  // fractions of the widget
// Of the panorama, 0..1 each, at a place of the widget, 0..1 each.
std::pair<double, double> panoramaAt(const PanoramaWindow& window, double at_x, double at_y, double aspect);

// Reads in the background; a newer request ends an older one.
class PanoramaView {
 public:
  explicit PanoramaView(std::function<void()> wake) : latest_("Panorama", std::move(wake)) {}
  void start(PanoramaRequest request);
  bool busy() const { return latest_.busy() && latest_.wanted(); }
  Task<std::shared_ptr<const PanoramaRead>>* task() const { return latest_.task(); }  // while it is busy
  void wait() { latest_.wait(); }
  void poll() { latest_.poll(); }  // once a frame
  // Of the last start; null until it is done, and where there is none, or see problem().
  std::shared_ptr<const PanoramaRead> result() const;
  std::string problem() const;
  void clear() { latest_.drop(); }

 private:
  std::uint64_t started_ = 0;
  LatestTask<std::uint64_t, std::shared_ptr<const PanoramaRead>> latest_;  // by the number of its start
};

}  // namespace standpoint
