// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/tour.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "editor/model/model.h"

namespace standpoint {

namespace {

std::size_t stationsOf(const Model& model) {
  const auto& job = model.session.document().job;
  return job ? job->stations.size() : 0;
}

bool anyScan(const Model& model) {
  const auto& job = model.session.document().job;
  return job &&
         std::any_of(job->stations.begin(), job->stations.end(), [](const Station& s) { return !s.scans.empty(); });
}

constexpr double kTurned_rad = 0.2;

constexpr std::array kSteps = {
    Tour::Step{
        "Look around",
        "Drag with the left button to turn the view, with the right button to pan; the wheel zooms to the pointer.",
        [](const Tour& tour, const Model& model) {
          return std::abs(model.view.camera.azimuth_rad - tour.camera().azimuth_rad) > kTurned_rad;
        }},
    Tour::Step{"See the floor plan", "Press 9. Press 9 again for the upper floor, and 0 for the isometric view.",
               [](const Tour&, const Model& model) { return model.visibility.cut_height_m.has_value(); }},
    Tour::Step{"Walk through the house",
               "Press W, then walk with W A S D and look around by dragging. Walk up to stairs to climb them. Press "
               "Esc to stop.",
               [](const Tour& tour, const Model& model) { return tour.walked() && !model.walk.active(); }},
    Tour::Step{"Add a station",
               "Press Shift+T and click a floor to set up the instrument there. Red means that it cannot stand there, "
               "and why.",
               [](const Tour& tour, const Model& model) { return stationsOf(model) > tour.stations(); }},
    Tour::Step{"Scan",
               "Press Scan… at the top right, choose a coarse resolution, then press Scan all stations. The points "
               "appear as they are measured.",
               [](const Tour&, const Model& model) { return anyScan(model); }},
    Tour::Step{"Judge the result",
               "Return to the model, go to Inspect (Alt+7) and assess the scans: coverage, noise and the worst places.",
               [](const Tour&, const Model& model) { return model.session.lastOf("assess") != nullptr; }}};

}  // namespace

std::span<const Tour::Step> Tour::steps() { return kSteps; }

void Tour::follow(const Model& model) {
  if (!active_ || step_ >= kSteps.size() || !model.environment()) return;
  if (fresh_) {
    fresh_ = walked_ = false;
    camera_ = model.view.camera;
    stations_ = stationsOf(model);
  }
  walked_ |= model.walk.active();
  if (kSteps[step_].done(*this, model)) skip();
}

}  // namespace standpoint
