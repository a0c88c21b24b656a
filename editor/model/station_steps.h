// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/survey.h"
#include "survey/quality/place_verdict.h"

namespace standpoint {

struct Model;

// What is done with the station that is chosen.
const Station* chosenStation(const Model& model);  // null: none is
std::string whyNoStation(const Model& model);

// The shortest range of the instrument that the next scan is set to; 0 where there is none.
double nearestRange_m(const Model& model);
// Whether it could stand there: `centre` of the instrument, local frame. Null while the scene is prepared. It is valid
// until others are asked for.
const PlaceVerdict* verdictOfStation(const Model& model, const Eigen::Vector3d& centre, bool on_tripod);
// A name that no station has yet: "S1", "S2", …
std::string freeStationName(const Job& job);
// Another one of its height and heading, on the nearest place beside it where one can stand.
void duplicateStation(Model& model);

// The floor under each station of the row that is laid, from its first end to the pointer; empty while there is none.
std::vector<Eigen::Vector3d> rowUnderPointer(const Model& model);
void addRow(Model& model, const Eigen::Vector3d& to);

// The camera goes where the instrument is, and looks where that does. The view before can be gone back to.
void lookFromStation(Model& model);
bool looksFromStation(const Model& model);
// To be called once a frame: away from the instrument the view is as wide, and cut, as before.
void followStationView(Model& model);

}  // namespace standpoint
