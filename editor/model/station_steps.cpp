// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/station_steps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/units.h"
#include "editor/model/model.h"
#include "editor/words/words.h"
#include "project/survey/station_row.h"
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

double nearestRange_m(const Model& model) {
  const auto* instrument = model.instrument(model.scan_choice.instrument);
  return instrument != nullptr ? instrument->min_range_m : 0;
}

const PlaceVerdict* verdictOfStation(const Model& model, const Eigen::Vector3d& centre, bool on_tripod) {
  const auto* placement = model.placement.placement();
  const auto scene = model.picker.scene();
  if (placement == nullptr || &placement->scene() != scene.get()) return nullptr;
  return model.placement.judgeStation(centre, on_tripod, nearestRange_m(model));
}

std::string freeStationName(const Job& job) { return nextStationName(job, "S0"); }

void duplicateStation(Model& model) {
  const auto* station = chosenStation(model);
  const auto* placement = model.placement.placement();
  if (station == nullptr || placement == nullptr) return;
  const auto& job = *model.session.document().job;
  const auto place = placeBeside(job, *placement, *station);
  const auto name = freeStationName(job);
  if (!place) {
    model.view.refused_place =
        RefusedPlace{station->name, trf("No room beside {}", station->name),
                     "There is no place within 5 m and in sight where a tripod can stand.",
                     station->true_pose.translation - Eigen::Vector3d(0, 0, station->instrument_height_m)};
    return;
  }
  StationOptions options{.add = name, .at = *place + model.shift_m()};
  options.yaw_deg = yawOf(station->true_pose.rotation) / kRadPerDeg;
  model.session.start(options, trf("Duplicate station {} as {}", station->name, name));
  model.survey_wanted = name;
}

std::vector<Eigen::Vector3d> rowUnderPointer(const Model& model) {
  const auto& view = model.view;
  if (view.tool != Tool::placeRow || !view.row_from || !view.hover) return {};
  return rowPlaces(*view.row_from, view.hover->position, view.row);
}

void addRow(Model& model, const Eigen::Vector3d& to) {
  const auto& view = model.view;
  const Eigen::Vector3d a = *view.row_from + model.shift_m(), b = to + model.shift_m();
  StationOptions options{.add = freeStationName(*model.session.document().job), .on = FloorPlace{a.x(), a.y(), a.z()}};
  options.row_to = FloorPlace{b.x(), b.y(), b.z()};
  options.row_count = view.row.count;
  options.row_spacing_m = view.row.spacing_m;
  model.session.start(options, "Add row of stations");
}

void lookFromStation(Model& model) {
  const auto* station = chosenStation(model);
  auto& camera = model.view.camera;
  auto& before = model.view.before_station;
  if (station == nullptr || (before && (station->true_pose.translation - camera.eye()).norm() < kSameEye_m)) return;
  model.views.push({camera, model.walk.active() ? std::optional(model.walk.feet()) : std::nullopt});
  stopWalking(model);
  if (!before) before = {camera.view_angle_rad, model.visibility.cut_height_m};
  model.visibility.cut_height_m.reset();  // an instrument sees all
  camera.orthographic = false;
  camera.view_angle_rad = kStationViewAngle_rad;
  camera.azimuth_rad = yawOf(station->true_pose.rotation) - std::numbers::pi / 2;
  camera.elevation_rad = 0;
  camera.distance_m = kAhead_m;
  camera.target = station->true_pose.translation + camera.forward() * kAhead_m;
}

bool looksFromStation(const Model& model) {
  const auto& job = model.session.document().job;
  if (!model.view.before_station || !job) return false;
  const Eigen::Vector3d eye = model.view.camera.eye();
  return std::any_of(job->stations.begin(), job->stations.end(),
                     [&](const Station& s) { return (s.true_pose.translation - eye).norm() < kSameEye_m; });
}

void followStationView(Model& model) {
  auto& before = model.view.before_station;
  if (!before || model.flight.flies() || looksFromStation(model)) return;  // on its way there it is elsewhere
  model.view.camera.view_angle_rad = before->view_angle_rad;
  if (!model.visibility.cut_height_m) model.visibility.cut_height_m = before->cut_height_m;
  before.reset();
}

}  // namespace standpoint
