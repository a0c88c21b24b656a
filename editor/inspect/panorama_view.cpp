// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/inspect/panorama_view.h"

#include <algorithm>
#include <cmath>

#include "editor/words/sentences.h"

namespace standpoint {

namespace {

constexpr Rgba8 kNothing = {20, 22, 27, 255};
constexpr double kMostZoom = 40;

// Of the panorama's width and height.
std::pair<double, double> shownSize(const PanoramaWindow& window, double aspect) {
  const double height = 1 / window.zoom;
  return {std::min(1.0, height * aspect / 2), height};
}

double leastZoom(double aspect) { return std::clamp(aspect / 2, 1.0, kMostZoom); }

PanoramaWindow kept(PanoramaWindow window, double aspect) {
  window.zoom = std::clamp(window.zoom, leastZoom(aspect), kMostZoom);
  const double half = shownSize(window, aspect).second / 2;
  window.x -= std::floor(window.x);
  window.y = std::clamp(window.y, half, 1 - half);
  return window;
}

Result<PanoramaRead> readWith(const PanoramaRequest& request, Progress& progress) {
  progress.stage("Panorama of " + request.cloud);
  TRY_ASSIGN(auto panorama, readPanorama(request.file, {.scan = request.scan}, progress));
  return PanoramaRead{request, std::move(panorama)};
}

}  // namespace

std::vector<Rgba8> paintPanorama(const Panorama& panorama, PanoramaChannel channel, const PanoramaShades& shades) {
  std::vector<Rgba8> pixels(panorama.range_m.size(), kNothing);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (panorama.range_m[i] <= 0) continue;
    if (channel == PanoramaChannel::colour && !panorama.colour.empty()) {
      const auto& c = panorama.colour[i];
      pixels[i] = {c[0], c[1], c[2], 255};
    } else if (channel == PanoramaChannel::range) {
      pixels[i] = viridis(shades.shade[i]);
    } else if (!std::isnan(shades.shade[i])) {
      const auto grey = static_cast<std::uint8_t>(std::lround(32 + 223 * shades.shade[i]));
      pixels[i] = {grey, grey, grey, 255};
    }
  }
  return pixels;
}

std::pair<double, double> panoramaAt(const PanoramaWindow& window, double at_x, double at_y, double aspect) {
  const auto [width, height] = shownSize(window, aspect);
  const double x = window.x + (at_x - 0.5) * width;
  return {x - std::floor(x), window.y + (at_y - 0.5) * height};
}

PanoramaWindow fillingWidth(const PanoramaWindow& window, double aspect) { return kept(window, aspect); }

PanoramaWindow panned(const PanoramaWindow& window, double by_x, double by_y, double aspect) {
  const auto [width, height] = shownSize(window, aspect);
  PanoramaWindow moved = window;
  moved.x -= by_x * width;
  moved.y -= by_y * height;
  return kept(moved, aspect);
}

PanoramaWindow zoomed(const PanoramaWindow& window, double factor, double at_x, double at_y, double aspect) {
  const auto before = shownSize(window, aspect);
  PanoramaWindow nearer = window;
  nearer.zoom = std::clamp(window.zoom * factor, leastZoom(aspect), kMostZoom);
  const auto after = shownSize(nearer, aspect);
  nearer.x += (at_x - 0.5) * (before.first - after.first);
  nearer.y += (at_y - 0.5) * (before.second - after.second);
  return kept(nearer, aspect);
}

void PanoramaView::start(PanoramaRequest request) {
  latest_.want(++started_,
               [request = std::move(request)](Progress& progress) -> Result<std::shared_ptr<const PanoramaRead>> {
                 TRY_ASSIGN(auto made, readWith(request, progress));
                 return std::make_shared<const PanoramaRead>(std::move(made));
               });
}

std::shared_ptr<const PanoramaRead> PanoramaView::result() const {
  const auto* answer = latest_.answer();
  return answer != nullptr && *answer ? **answer : nullptr;
}

std::string PanoramaView::problem() const {
  const auto* answer = latest_.answer();
  return answer == nullptr || *answer ? std::string() : trError(answer->error());
}

}  // namespace standpoint
