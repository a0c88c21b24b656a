// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/station_steps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/units.h"
#include "editor/model/model.h"
#include "project/survey/survey_verbs.h"
#include "survey/stations/levelling.h"
#include "survey/stations/station_places.h"

namespace standpoint {

namespace {

constexpr double kStationViewAngle_rad = 65 * kRadPerDeg;  // vertical: a room from inside
constexpr double kAhead_m = 1;                             // the camera's target before its eye
constexpr double kSameEye_m = 1e-3;

}  // namespace

const Station* chosenStation(const Model& model) {
  const auto& job = model.session.document().job;
  const auto chosen = static_cast<std::size_t>(model.survey.station);
  return job && model.survey.station >= 0 && chosen < job->stations.size() ? &job->stations[chosen] : nullptr;
}

std::string whyNoStation(const Model& model) {
  return chosenStation(model) != nullptr ? "" : "Select a station in the Survey panel or the view first";
}

std::string freeStationName(const Job& job) {
  for (int i = 1;; ++i) {
    auto name = fmt::format("S{}", i);
    if (std::none_of(job.stations.begin(), job.stations.end(), [&](const Station& s) { return s.name == name; }))
      return name;
  }
}

void duplicateStation(Model& model) {
  const auto* station = chosenStation(model);
  const auto* placement = model.placement.placement();
  if (station == nullptr || placement == nullptr) return;
  const auto& job = *model.session.document().job;
  const auto place = placeBeside(job, *placement, *station);
  const auto name = freeStationName(job);
  if (!place) {
    model.view.refused_place =
        RefusedPlace{station->name, "No room beside " + station->name,
                     "Within 5 m in its sight there is no place where a tripod can stand.",
                     station->true_pose.translation - Eigen::Vector3d(0, 0, station->instrument_height_m)};
    return;
  }
  StationOptions options{.add = name, .at = *place + model.shift_m()};
  options.yaw_deg = yawOf(station->true_pose.rotation) / kRadPerDeg;
  model.session.start(options, fmt::format("Duplicate station {} as {}", station->name, name));
  model.survey_wanted = name;
}

void lookFromStation(Model& model) {
  const auto* station = chosenStation(model);
  if (station == nullptr || looksFromStation(model)) return;
  auto& camera = model.view.camera;
  model.views.push({camera, model.walk.active() ? std::optional(model.walk.feet()) : std::nullopt});
  stopWalking(model);
  model.view.angle_before_station_rad = camera.view_angle_rad;
  camera.orthographic = false;
  camera.view_angle_rad = kStationViewAngle_rad;
  camera.azimuth_rad = yawOf(station->true_pose.rotation) - std::numbers::pi / 2;
  camera.elevation_rad = 0;
  camera.distance_m = kAhead_m;
  camera.target = station->true_pose.translation + camera.forward() * kAhead_m;
}

bool looksFromStation(const Model& model) {
  const auto& job = model.session.document().job;
  if (!model.view.angle_before_station_rad || !job) return false;
  const Eigen::Vector3d eye = model.view.camera.eye();
  return std::any_of(job->stations.begin(), job->stations.end(),
                     [&](const Station& s) { return (s.true_pose.translation - eye).norm() < kSameEye_m; });
}

void followStationView(Model& model) {
  auto& before = model.view.angle_before_station_rad;
  if (!before || looksFromStation(model)) return;
  model.view.camera.view_angle_rad = *before;
  before.reset();
}

}  // namespace standpoint
