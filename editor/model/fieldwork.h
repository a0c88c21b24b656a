// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/survey.h"
#include "editor/walking/tripods_in_way.h"

namespace standpoint {

struct Model;

// What somebody who walks through the model does with the desk's instrument and with targets.
struct Fieldwork {
  bool at_screen = false;  // the camera looks at what one works with on the instrument
  std::string waits_for;   // the instrument is put down at this station, as soon as that is there
  // Of the desk: carries its instrument to a station, and lets time pass on its clock. Empty: there is no desk.
  std::function<void(const std::string& station)> carry;
  std::function<void(double seconds)> spend;
  // Of the desk: somebody stands at `feet`, local frame, in the view of its instrument; nothing: out of its sight.
  std::function<void(const std::optional<Eigen::Vector3d>& feet)> stand;
};

constexpr double kPutUpTarget_s = 40;  // our own estimate: a magnet or a small tripod

// Of all stations, but for the one whose instrument somebody carries.
std::vector<Tripod> tripodsOf(const Model& model);
// Whoever walks could put a hand on it.
bool instrumentInReach(const Model& model);
// The eyes go before its display, else its key, as that is turned now; lookUp() goes back to where one stood.
void lookAtInstrument(Model& model);
void lookUp(Model& model);
// "" or why the instrument cannot be taken along.
std::string whyNotPickUp(const Model& model);
void pickUpInstrument(Model& model);
// A step ahead: at the station there, else at a new one. A place where it cannot stand is refused by the verb, and it
// is still carried.
void putDownInstrument(Model& model);
// On what is looked at, not farther than an arm's reach and two steps; false where there is nothing.
bool putUpSphere(Model& model);
// Walks to the nearest place that the instrument does not see, and back within reach of it; both take their time on its
// clock. "" or why nobody went.
std::string whyNotStepOutOfSight(const Model& model);
std::string stepOutOfSight(Model& model);
std::string whyNotReturn(const Model& model);
std::string returnToInstrument(Model& model);
std::string freeTargetName(const Job* job);  // "T1", "T2", …; null: there is no job
// To be called once a frame.
void followFieldwork(Model& model);

}  // namespace standpoint
