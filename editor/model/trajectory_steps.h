// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/survey.h"
#include "editor/bodies/under_way.h"
#include "project/survey/survey_verbs.h"
#include "scanners/engine/ray_engine.h"

namespace standpoint {

struct Model;
struct RefusedPlace;

// What is done with the trajectory that is chosen.
const CarriedTrajectory* chosenTrajectory(const Model& model);  // null: none is
std::string whyNoTrajectory(const Model& model);
// A name that no trajectory has yet: "W1", "W2", …
std::string freeTrajectoryName(const Job& job);
// "Hand" of "hand".
std::string carrierName(const std::string& id);
// The options that make the trajectory of this name what `changed` is.
TrajectoryOptions changeTo(const CarriedTrajectory& changed, const Georeference& georeference);

// Why the carrier cannot pass a place that was pointed at; nothing: it can.
std::optional<RefusedPlace> whyNoWaypoint(const RayScene& scene, const RayHit& hit, double height_m);

// Laying one: the tool Tool::layTrajectory. A click adds the place under the pointer, or says why not.
void beginTrajectory(Model& model);
void addWaypoint(Model& model, const RayHit& hit);
std::string whyNotTakeBack(const Model& model);
void takeBackWaypoint(Model& model);
std::string whyNotEndTrajectory(const Model& model);
void endTrajectory(Model& model);  // adds it to the job
// The moment of the chosen trajectory at which its instrument is drawn; 0 where it begins.
double shownMoment_s(const Model& model);
std::string whyNoMoment(const Model& model);                                   // why there is none to be chosen
void showMoment(Model& model, const std::string& trajectory, double after_s);  // and plays no more
void moveMoment(Model& model, double by_s);
void playMoments(Model& model);                  // from there on, at the end from the beginning, or stops
void stepMoment(Model& model, double passed_s);  // while they are played; once a frame
// After that: the camera goes along behind who bears it, until it is moved by hand; and goes back when it has played.
void followBearer(Model& model, double passed_s);
// All of a trajectory from above, and cut above its floor where that would be hidden; the view before comes back with
// Alt+Left.
void showTrajectory(Model& model, std::size_t trajectory);
// What is carried along the trajectories as it is drawn, the nearest ones; nothing that the camera is inside of, nor
// where another one is. `kept`: whether what is so high above its floor is in the picture there.
std::vector<CarriedInstrument> carriedInstruments(
    const Model& model, const std::function<bool(const Eigen::Vector3d& centre, double height_m)>& kept);
// Keeps the way of what is laid, or of the chosen one as a waypoint of it is dragged, up to date. Once a frame.
void followDraft(Model& model);
// The chosen trajectory with the dragged waypoint at the pointer; nothing: none is dragged, or nothing is there.
std::optional<CarriedTrajectory> draggedTrajectory(const Model& model);
void dropWaypoint(Model& model);  // where the pointer is, or says why not

}  // namespace standpoint
