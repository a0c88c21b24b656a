// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/survey.h"
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
// Of the scanner above the floor: as stated, or the carrier's own.
double carriedHeight_m(const std::string& carrier, double stated_m);
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
// Keeps the way of what is laid, or of the chosen one as a waypoint of it is dragged, up to date. Once a frame.
void followDraft(Model& model);
// The chosen trajectory with the dragged waypoint at the pointer; nothing: none is dragged, or nothing is there.
std::optional<CarriedTrajectory> draggedTrajectory(const Model& model);
void dropWaypoint(Model& model);  // where the pointer is, or says why not

}  // namespace standpoint
