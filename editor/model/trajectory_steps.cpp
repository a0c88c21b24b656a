// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/trajectory_steps.h"

#include <algorithm>
#include <cmath>

#include "core/motion/carriers.h"
#include "editor/model/model.h"
#include "editor/words/words.h"
#include "project/survey/error_profile.h"
#include "survey/stations/station_places.h"

namespace standpoint {

namespace {

constexpr double kOnFloor_m = 0.05;    // a floor there is the one that was pointed at
constexpr double kSteepest = 0.7;      // upward part of the normal of a floor
constexpr double kSamePlace_m = 0.05;  // two waypoints are not nearer than that

CarriedTrajectory laid(const TrajectoryDraft& draft) {
  CarriedTrajectory trajectory;
  trajectory.name = "draft";
  trajectory.carrier = draft.carrier;
  trajectory.waypoints = draft.waypoints;
  trajectory.height_m = draft.height_m, trajectory.speed_mps = draft.speed_mps;
  return trajectory;
}

}  // namespace

const CarriedTrajectory* chosenTrajectory(const Model& model) {
  const auto& job = model.session.document().job;
  const auto chosen = static_cast<std::size_t>(model.survey.trajectory);
  return job && model.survey.trajectory >= 0 && chosen < job->trajectories.size() ? &job->trajectories[chosen]
                                                                                  : nullptr;
}

std::string whyNoTrajectory(const Model& model) {
  return chosenTrajectory(model) != nullptr ? "" : "Select a trajectory in the Survey panel first";
}

std::string freeTrajectoryName(const Job& job) {
  for (int i = 1;; ++i) {
    auto name = "W" + std::to_string(i);
    if (std::none_of(job.trajectories.begin(), job.trajectories.end(), [&](const auto& t) { return t.name == name; }))
      return name;
  }
}

std::string carrierName(const std::string& id) {
  const Carrier* known = carrierOf(id);
  return known == nullptr ? id : tr(std::string(known->name));
}

TrajectoryOptions changeTo(const CarriedTrajectory& changed, const Georeference& georeference) {
  TrajectoryOptions options;
  options.change = changed.name;
  options.carrier = changed.carrier;
  options.height_m = changed.height_m, options.speed_mps = changed.speed_mps;
  options.seed = changed.seed;
  for (const auto& waypoint : changed.waypoints) options.through.push_back(waypointText(waypoint, georeference));
  return options;
}

std::optional<RefusedPlace> whyNoWaypoint(const RayScene& scene, const RayHit& hit, double height_m) {
  const auto& p = hit.position;
  const auto refuse = [&](std::string brief, std::string reason) {
    return RefusedPlace{"", std::move(brief), std::move(reason), p};
  };
  if (std::abs(hit.normal.z()) < kSteepest)
    return refuse("Too steep to walk on", "A waypoint lies on a floor, a stair or the ground.");
  const auto floors = floorsAt(scene, p.x(), p.y(), height_m);
  if (std::any_of(floors.begin(), floors.end(), [&](double z) { return std::abs(z - p.z()) < kOnFloor_m; }))
    return std::nullopt;
  if (const auto blocked = blockedFloorAt(scene, p.x(), p.y(), height_m, p.z()))
    return refuse(trf("{:.2f} m free, {:.2f} m needed", blocked->free_m, height_m + kRoomAbove_m),
                  "Choose another place, or carry the scanner lower.");
  return refuse("No floor to walk on", "A waypoint lies on a floor, a stair or the ground.");
}

void beginTrajectory(Model& model) {
  model.view.draft.waypoints.clear();
  model.view.tool = Tool::layTrajectory;
}

void addWaypoint(Model& model, const RayHit& hit) {
  auto& draft = model.view.draft;
  const auto scene = model.picker.scene();
  if (!scene) return;
  if (auto refused = whyNoWaypoint(*scene, hit, carriedHeight_m(draft.carrier, draft.height_m))) {
    model.view.refused_place = std::move(refused);
    return;
  }
  if (!draft.waypoints.empty() && (draft.waypoints.back().floor_m - hit.position).norm() < kSamePlace_m) return;
  draft.waypoints.push_back({hit.position, 0, {}});
}

std::string whyNotTakeBack(const Model& model) {
  if (model.view.tool != Tool::layTrajectory) return "No trajectory is being added";
  return model.view.draft.waypoints.empty() ? "There are no waypoints yet" : "";
}

void takeBackWaypoint(Model& model) { model.view.draft.waypoints.pop_back(); }

std::string whyNotEndTrajectory(const Model& model) {
  if (model.view.tool != Tool::layTrajectory) return "No trajectory is being added";
  if (auto why = model.session.whyNot("trajectory"); !why.empty()) return why;
  if (model.view.draft.waypoints.size() < 2) return "A trajectory has at least two waypoints";
  const auto* way = model.trajectory_ways.draft();
  return way == nullptr || model.trajectory_ways.draftIsOld() ? "" : way->problem;
}

void endTrajectory(Model& model) {
  auto& draft = model.view.draft;
  auto trajectory = laid(draft);
  trajectory.name = freeTrajectoryName(*model.session.document().job);
  auto options = changeTo(trajectory, *model.session.document().georeference);
  options.add = std::exchange(options.change, std::nullopt);
  if (!model.session.start(options, trf("Add trajectory {}", trajectory.name))) return;
  model.trajectory_wanted = trajectory.name;
  model.view.tool = Tool::select;
  draft.waypoints.clear();
}

std::optional<CarriedTrajectory> draggedTrajectory(const Model& model) {
  const auto* chosen = chosenTrajectory(model);
  const auto& view = model.view;
  if (chosen == nullptr || view.dragged_waypoint < 0 || !view.waypoint_drag_begun || !view.hover ||
      view.dragged_waypoint >= static_cast<int>(chosen->waypoints.size()))
    return std::nullopt;
  CarriedTrajectory moved = *chosen;
  moved.scans.clear();
  moved.waypoints[static_cast<std::size_t>(view.dragged_waypoint)].floor_m = view.hover->position;
  return moved;
}

void dropWaypoint(Model& model) {
  const auto moved = draggedTrajectory(model);
  const auto scene = model.picker.scene();
  if (!moved || !scene) return;
  if (auto refused = whyNoWaypoint(*scene, *model.view.hover, carriedHeight_m(moved->carrier, moved->height_m))) {
    model.view.refused_place = std::move(refused);
    return;
  }
  model.session.start(changeTo(*moved, *model.session.document().georeference),
                      trf("Move waypoint {} of {}", model.view.dragged_waypoint + 1, moved->name));
}

namespace {

// As the next scan along a trajectory would find it; exactly where nobody looks at errors, which take rays.
WayKnowledge knowledgeOf(const Model& model) {
  WayKnowledge known;
  if (!model.trajectory_ways.expectsErrors()) return known;
  const CarriedScan& scan = model.carried_scan;
  const Instrument* const instrument = model.instrument(scan.choice.instrument);
  if (instrument == nullptr || !instrument->moving) return known;
  known.profile = errorProfile(scan.error, instrument->moving->mount);
  known.closures = scan.closures;
  known.max_range_m = instrument->max_range_m;
  const auto& job = model.session.document().job;
  if (!scan.anchors || !job) return known;
  for (const Station& station : job->stations)
    if (!station.scans.empty()) known.anchors.push_back(station.true_pose.translation);
  return known;
}

}  // namespace

void followDraft(Model& model) {
  const auto& document = model.session.document();
  const auto scene = model.picker.scene();
  const auto knowledge = knowledgeOf(model);
  model.trajectory_ways.follow(document, scene, knowledge);
  std::optional<CarriedTrajectory> draft;
  if (model.view.tool == Tool::layTrajectory && model.view.draft.waypoints.size() >= 2)
    draft = laid(model.view.draft);
  else
    draft = draggedTrajectory(model);
  if (draft && scene && document.georeference && document.job)
    model.trajectory_ways.wantDraft(
        {*std::move(draft), document.georeference, scene, {}, knowledge, openedDoors(document.job->movers)});
  else
    model.trajectory_ways.dropDraft();
}

double shownMoment_s(const Model& model) {
  const auto* chosen = chosenTrajectory(model);
  if (chosen == nullptr || chosen->name != model.path_moment.trajectory) return 0;
  const auto* way = model.trajectory_ways.of(static_cast<std::size_t>(model.survey.trajectory));
  return std::clamp(model.path_moment.after_s, 0.0, way == nullptr ? 0.0 : way->seconds);
}

std::string whyNoMoment(const Model& model) {
  if (chosenTrajectory(model) == nullptr) return whyNoTrajectory(model);
  const auto* way = model.trajectory_ways.of(static_cast<std::size_t>(model.survey.trajectory));
  if (way == nullptr) return "Its way is still being worked out";
  return way->problem;
}

void showMoment(Model& model, const std::string& trajectory, double after_s) {
  model.path_moment.trajectory = trajectory;
  model.path_moment.after_s = after_s;
  model.path_moment.plays = false;
}

void moveMoment(Model& model, double by_s) {
  const double seconds = model.trajectory_ways.of(static_cast<std::size_t>(model.survey.trajectory))->seconds;
  showMoment(model, chosenTrajectory(model)->name, std::clamp(shownMoment_s(model) + by_s, 0.0, seconds));
}

void playMoments(Model& model) {
  const auto& name = chosenTrajectory(model)->name;
  const bool plays = model.path_moment.plays && model.path_moment.trajectory == name;
  const double seconds = model.trajectory_ways.of(static_cast<std::size_t>(model.survey.trajectory))->seconds;
  const double from_s = shownMoment_s(model);
  showMoment(model, name, !plays && from_s >= seconds ? 0 : from_s);
  model.path_moment.plays = !plays;
}

void stepMoment(Model& model, double passed_s) {
  PathMoment& moment = model.path_moment;
  if (!moment.plays) return;
  const auto* chosen = chosenTrajectory(model);
  const auto* way =
      chosen == nullptr ? nullptr : model.trajectory_ways.of(static_cast<std::size_t>(model.survey.trajectory));
  moment.plays = way != nullptr && chosen->name == moment.trajectory;
  if (!moment.plays) return;
  moment.after_s = std::min(shownMoment_s(model) + passed_s, way->seconds);
  moment.plays = moment.after_s < way->seconds;
}

void followBearer(Model& model, double passed_s) {
  const PathMoment& moment = model.path_moment;
  auto& view = model.bearer_view;
  auto& camera = model.view.camera;
  if (!moment.plays || !moment.follows) model.left_bearer = false;
  if (view.active() && view.isMoved(camera)) {
    view.end();
    model.left_bearer = moment.plays && moment.follows;
  }
  const bool wanted = moment.plays && moment.follows && !model.left_bearer;
  if (view.active() && !wanted) {
    view.end();
    goBackInViews(model);
  }
  if (!wanted) return;
  if (!view.active()) {
    rememberView(model);
    stopWalking(model);
    stopFlying(model);
    model.visibility.cut_height_m.reset();  // it may go upstairs
    view.begin(camera);
  }
  const auto* way = model.trajectory_ways.of(static_cast<std::size_t>(model.survey.trajectory));
  view.follow(
      *way, chosenTrajectory(model)->carrier, moment.after_s, passed_s,
      [&model, state = model.viewState()](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
        return model.picker.sees(from, to, state);
      },
      camera);
}

namespace {

// Of the floor that it leads over, as far as that is known; else of the instrument.
std::vector<Eigen::Vector3d> placesOf(const CarriedTrajectory& trajectory, const TrajectoryWay* way) {
  std::vector<Eigen::Vector3d> places;
  for (const auto& waypoint : trajectory.waypoints) places.push_back(waypoint.floor_m);
  if (way == nullptr) return places;
  const double lift_m = trajectory.carrier == "uav" ? 0 : carriedHeight_m(trajectory.carrier, trajectory.height_m);
  for (const auto& sample : way->samples) places.push_back(sample.position_m - Eigen::Vector3d(0, 0, lift_m));
  return places;
}

bool isMostlySeen(const Model& model, const std::vector<Eigen::Vector3d>& places) {
  constexpr double kMostly = 0.8;
  const Eigen::Vector3d above(0, 0, kOnFloor_m);
  const auto state = model.viewState();
  const auto seen = std::count_if(places.begin(), places.end(),
                                  [&](const Eigen::Vector3d& p) { return model.picker.isInSight(p + above, state); });
  return static_cast<double>(seen) >= kMostly * static_cast<double>(places.size());
}

}  // namespace

void showTrajectory(Model& model, std::size_t trajectory) {
  constexpr double kFromAbove_rad = 1.1;
  const auto places =
      placesOf(model.session.document().job->trajectories[trajectory], model.trajectory_ways.of(trajectory));
  if (places.empty()) return;
  rememberView(model);
  stopWalking(model);
  stopFlying(model);
  Bounds around;
  for (const auto& place : places) around.extend(place);
  const double highest_m = around.max.z();
  const Eigen::Vector3d rim(1.5, 1.5, 1);
  around.extend(Eigen::Vector3d(around.min - rim));
  around.extend(Eigen::Vector3d(around.max + rim));
  auto& camera = model.view.camera;
  camera.elevation_rad = std::max(camera.elevation_rad, kFromAbove_rad);
  model.bringIntoView(around);
  auto& cut = model.visibility.cut_height_m;
  if (cut && *cut < highest_m) cut.reset();
  if (!isMostlySeen(model, places)) cut = highest_m + kCutAboveFloor_m;
}

namespace {

constexpr double kInsideWalker_m = 0.4;  // of the upright axis of who carries something
constexpr double kInOneAnother_m = 0.6;

// Within what bears it, as far as that stands on the floor, or within the instrument.
bool isInside(const Eigen::Vector3d& eye, const CarriedInstrument& instrument) {
  const Eigen::Vector3d off = eye - instrument.pose.translation;
  if (off.norm() < kInsideInstrument_m) return true;
  if (instrument.limbs.empty()) return false;
  const Eigen::Vector3d from_walker = eye - instrument.limbs.front().translation;
  return std::hypot(from_walker.x(), from_walker.y()) < kInsideWalker_m && from_walker.z() > 0 && off.z() < 1;
}

}  // namespace

std::vector<CarriedInstrument> carriedInstruments(
    const Model& model, const std::function<bool(const Eigen::Vector3d& centre, double height_m)>& kept) {
  std::vector<CarriedInstrument> all;
  const auto& trajectories = model.session.document().job->trajectories;
  const auto add = [&](std::size_t i, double after_s) {
    const auto& trajectory = trajectories[i];
    const auto* way = model.trajectory_ways.of(i);
    if (way == nullptr || !way->motion.truth || all.size() >= kMostInstruments) return;
    const double time_s = way->motion.truth->first_s() + after_s;
    CarriedInstrument made;
    made.body = &carriedBodyOf(trajectory.scans.empty() ? model.carried_scan.choice.instrument
                                                        : trajectory.scans.back().instrument);
    made.pose = way->motion.truth->pose(time_s);
    made.carrier = trajectory.carrier;
    made.height_m = carriedHeight_m(trajectory.carrier, trajectory.height_m);
    for (const auto& limb : way->limbs) made.limbs.push_back(limb->pose(time_s));
    const auto in_it = [&](const CarriedInstrument& other) {
      return (other.pose.translation - made.pose.translation).norm() < kInOneAnother_m;
    };
    if (kept(made.pose.translation, made.height_m) && !isInside(model.view.camera.eye(), made) &&
        std::none_of(all.begin(), all.end(), in_it))
      all.push_back(std::move(made));
  };
  const int chosen = model.survey.trajectory;
  const bool dragged = model.view.dragged_waypoint >= 0 && model.view.waypoint_drag_begun;
  if (chosenTrajectory(model) != nullptr && !dragged) add(static_cast<std::size_t>(chosen), shownMoment_s(model));
  for (std::size_t i = 0; i < trajectories.size(); ++i)
    if (static_cast<int>(i) != chosen) add(i, 0);
  return all;
}

}  // namespace standpoint
