// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include <imgui.h>

#include "survey/quality/place_verdict.h"

namespace standpoint {

struct Editor;
class ViewPen;

// A station that the pointer holds over the scene.
struct HeldStation {
  std::string name;  // of one that is moved; "": a new one
  double height_m = 0;
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};
std::optional<HeldStation> heldStation(const Editor& editor);

// Of the place under the pointer, without what is expected to be seen from there; there must be one.
PlaceVerdict verdictUnderPointer(Editor& editor, const HeldStation& held);
// Keeps in mind, and shows, that a station was not put where the pointer is.
void refusePlace(Editor& editor, const HeldStation& held, const PlaceVerdict& verdict);
// What the verb `station` refused, which no panel has said yet, is said in the view instead of in a dialog.
void takePlaceRefusals(Editor& editor);

// Tripod and instrument on a floor, with what they cannot see of it, in a verdict.
void drawHeldStation(const Editor& editor, const ViewPen& pen, const HeldStation& held, const Eigen::Vector3d& floor,
                     Verdict verdict);
// Asks for the figures of the place under the pointer, and draws tripod, instrument, what it cannot see of the floor,
// verdict and figures.
void drawPlaceGhost(Editor& editor, ImVec2 origin, ImVec2 size);

}  // namespace standpoint
