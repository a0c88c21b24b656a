// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/report.h"
#include "editor/film/shot.h"
#include "editor/model/model.h"

namespace standpoint {

// Where a shot is made from. Nothing said: from where the view looks.
struct ShotPlace {
  std::string station;                 // name
  std::optional<Eigen::Vector3d> eye;  // in the file's frame; wins over the station
};

// What a walk leads through, in this order.
struct WalkStops {
  bool rooms = false;                 // each room that is reached on foot, the nearest next; else stations
  std::vector<std::string> stations;  // names; empty: all, in the order of the survey
};

// Of what the model shows. Films and panoramas leave out the selection; a walk shows the whole storeys.
ShotRequest shotOf(const Model& model, ShotKind kind);
// Moves the camera of the request. Errors name the station.
Result<void> lookFrom(const Model& model, const ShotPlace& place, ShotRequest& request);
// The way between the stops over the walkable surface. What cannot be reached is left out, and in the report.
Result<std::vector<Eigen::Vector3d>> wayThrough(const Document& document, const WalkedGround& ground,
                                                const WalkStops& stops, Report& report, Progress& progress);

}  // namespace standpoint
