// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/fieldwork.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "editor/model/model.h"
#include "editor/model/station_steps.h"
#include "editor/model/walking.h"
#include "editor/walking/hiding.h"
#include "editor/words/words.h"
#include "project/survey/survey_verbs.h"

namespace standpoint {

namespace {

constexpr double kReach_m = 1.6;                  // of a hand, from the middle of the body
constexpr double kToDisplay_m = 0.5;              // of the eyes
constexpr double kReading_rad = 32 * kRadPerDeg;  // who reads a display hardly sees what is around it
constexpr double kAhead_m = 0.9;                  // where one puts down what one carries
constexpr double kSamePlace_m = 1.0;              // of a station that is there already
constexpr double kSphereReach_m = 3;
constexpr double kLookDown_rad = 0.3;

const Station* heldStation(const Model& model) {
  const auto& job = model.session.document().job;
  if (!job || model.held.instrument.empty() || model.held.carried) return nullptr;
  const auto found = std::find_if(job->stations.begin(), job->stations.end(),
                                  [&](const Station& s) { return s.name == model.held.station; });
  return found == job->stations.end() ? nullptr : &*found;
}

Eigen::Vector3d ahead(const Model& model) {
  Eigen::Vector3d way = model.view.camera.forward();
  way.z() = 0;
  return way.norm() > 1e-6 ? Eigen::Vector3d(way.normalized()) : Eigen::Vector3d(0, 1, 0);
}

Eigen::Vector3d footOf(const Station& station) {
  return station.true_pose.translation - Eigen::Vector3d(0, 0, station.instrument_height_m);
}

const Station* stationNear(const Model& model, const Eigen::Vector3d& floor) {
  const auto& job = model.session.document().job;
  if (!job) return nullptr;
  const Station* nearest = nullptr;
  double least = kSamePlace_m;
  for (const auto& s : job->stations) {
    if (const double away = (footOf(s) - floor).norm(); away < least) least = away, nearest = &s;
  }
  return nearest;
}

}  // namespace

std::vector<Tripod> tripodsOf(const Model& model) {
  std::vector<Tripod> tripods;
  const auto& job = model.session.document().job;
  if (!job) return tripods;
  for (const auto& station : job->stations)
    if (!model.held.carried || station.name != model.held.station)
      tripods.push_back({footOf(station), station.instrument_height_m});
  return tripods;
}

bool instrumentInReach(const Model& model) {
  const auto* station = heldStation(model);
  if (station == nullptr || !model.walk.active()) return false;
  const Eigen::Vector3d away = footOf(*station) - model.walk.feet();
  return away.head<2>().norm() < kReach_m && std::abs(away.z()) < 1;
}

void lookAtInstrument(Model& model) {
  const auto* station = heldStation(model);
  if (station == nullptr || model.fieldwork.at_screen) return;
  const auto stands = standing(*station, model.held.instrument);
  const Eigen::Matrix3d local_from_head =
      (stands.rotation * Eigen::AngleAxisd(-model.held.motion.head_rad, Eigen::Vector3d::UnitZ())).toRotationMatrix();
  const Eigen::Vector3d way = -(local_from_head * stands.body->face_faces);
  rememberView(model);
  stopWalking(model);
  model.fieldwork.at_screen = true;
  auto& camera = model.view.camera;
  camera.orthographic = false;
  camera.view_angle_rad = kReading_rad;
  camera.target = stands.centre_m + local_from_head * stands.body->face_m;
  camera.distance_m = kToDisplay_m;
  camera.azimuth_rad = std::atan2(-way.x(), way.y());
  camera.elevation_rad = kLookDown_rad;
}

void lookUp(Model& model) {
  if (!std::exchange(model.fieldwork.at_screen, false)) return;
  goBackInViews(model);
}

std::string whyNotPickUp(const Model& model) {
  if (!instrumentInReach(model)) return "The instrument is out of reach";
  return model.held.motion.fans.empty() ? "" : "The instrument is scanning: moving it now would spoil the scan";
}

void pickUpInstrument(Model& model) {
  if (whyNotPickUp(model).empty()) model.held.carried = true;
}

void putDownInstrument(Model& model) {
  if (!model.held.carried || !model.walk.active() || !model.fieldwork.waits_for.empty()) return;
  const Eigen::Vector3d floor = model.walk.feet() + kAhead_m * ahead(model);
  if (const auto* station = stationNear(model, floor)) {
    model.fieldwork.waits_for = station->name;
    return followFieldwork(model);
  }
  const auto& job = model.session.document().job;
  const auto name = freeStationName(job ? *job : Job());
  const Eigen::Vector3d p = floor + model.shift_m();
  if (model.session.start(StationOptions{.add = name, .on = FloorPlace{p.x(), p.y(), p.z()}},
                          trf("Add station {}", name)))
    model.fieldwork.waits_for = name;
}

bool putUpSphere(Model& model) {
  const auto ray = rayThrough(model.view.camera, model.view.size / 2, model.view.size);
  const auto hit = model.picker.pick(ray, model.viewState());
  if (!hit || hit->range_m > kSphereReach_m) return false;
  constexpr double kBefore_m = 0.05;  // says on which side of what was looked at it stands
  const auto name = freeTargetName(model.session.document().job.get());
  TargetOptions options{.add = name, .kind = TargetKind::sphere};
  options.on_surface = hit->position + hit->normal * kBefore_m + model.shift_m();
  if (!model.session.start(options, trf("Add target {}", name))) return false;
  if (model.fieldwork.spend) model.fieldwork.spend(kPutUpTarget_s);
  return true;
}

namespace {

std::string whyNotWalkBy(const Model& model) {
  if (!model.walk.active()) return "Walk in the model first: W";
  if (model.held.carried) return "Put the instrument down first: G";
  if (heldStation(model) == nullptr) return "The instrument stands at no station";
  return {};
}

Body bodyOfWalker(const Model& model) {
  return {model.walker.radius_m, model.walk.uprightEyes_m() + Walker::kCrownAboveEyes_m};
}

// There at once in the picture, and after the time of the way on the device's clock; looks that way.
bool walkTo(Model& model, const WalkAim& aim, const Eigen::Vector3d& looks) {
  const auto ground = model.walk_ground.of(model.session.document(), model.walker);
  StartPlace place{aim.feet, {}};
  if (looks.head<2>().norm() > 1e-6) place.facing = looks.head<2>().normalized();
  rememberView(model);
  if (!model.walk.start(ground, model.walker, place, model.view.camera)) return false;
  if (model.fieldwork.spend) model.fieldwork.spend(walkingTime_s(aim.way_m));
  return true;
}

}  // namespace

std::string whyNotStepOutOfSight(const Model& model) {
  if (auto why = whyNotWalkBy(model); !why.empty()) return why;
  return model.picker.ready() ? "" : "Preparing the model for ray tracing …";
}

std::string stepOutOfSight(Model& model) {
  if (auto why = whyNotStepOutOfSight(model); !why.empty()) return why;
  const auto& centre = heldStation(model)->true_pose.translation;
  const auto aim =
      nearestHiding(model.walk.ground().map, *model.picker.scene(), centre, model.walk.feet(), bodyOfWalker(model));
  if (!aim) return "The instrument sees every place that can be walked to";
  if (!walkTo(model, *aim, aim->feet - centre)) return "Not enough room to stand";
  if (model.fieldwork.stand) model.fieldwork.stand({});
  return {};
}

std::string whyNotReturn(const Model& model) {
  if (auto why = whyNotWalkBy(model); !why.empty()) return why;
  return instrumentInReach(model) ? "The instrument is within reach" : "";
}

std::string returnToInstrument(Model& model) {
  if (auto why = whyNotReturn(model); !why.empty()) return why;
  const auto& station = *heldStation(model);
  const auto aim = nearestBeside(model.walk.ground().map, footOf(station), model.walk.feet());
  if (!aim) return "No way leads to the instrument";
  if (!walkTo(model, *aim, station.true_pose.translation - aim->feet)) return "Not enough room to stand";
  if (model.fieldwork.stand) model.fieldwork.stand(model.walk.feet());
  return {};
}

std::string freeTargetName(const Job* job) {
  for (int i = 1;; ++i) {
    const auto name = fmt::format("T{}", i);
    const auto has_name = [&](const Target& t) { return t.name == name; };
    if (job == nullptr || std::none_of(job->targets.begin(), job->targets.end(), has_name)) return name;
  }
}

void followFieldwork(Model& model) {
  auto& work = model.fieldwork;
  if (work.at_screen && (model.walk.active() || heldStation(model) == nullptr)) work.at_screen = false;
  if (work.waits_for.empty()) return;
  const auto& job = model.session.document().job;
  const bool there = job && std::any_of(job->stations.begin(), job->stations.end(),
                                        [&](const Station& s) { return s.name == work.waits_for; });
  if (!there && !model.session.running().empty()) return;
  const auto station = std::exchange(work.waits_for, {});
  if (!there) return;  // refused: the message says why
  model.held.carried = false;
  model.held.station = station;
  if (work.carry) work.carry(station);
}

}  // namespace standpoint
