// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include <imgui.h>

namespace standpoint {

struct Editor;

// Whoever walks or flies goes on by the keys that are held.
void handleMoving(Editor& editor);
// A wheel, or two fingers on a touchpad: up and down comes closer to what is under the pointer, to the sides turns;
// with Shift it pans, with Ctrl it comes closer to the middle. While one walks or flies up and down changes the speed.
void handleWheel(Editor& editor, ImVec2 origin);
// Keys that move whoever walks or flies mean nothing else then.
bool movesByKey(const Editor& editor, int key);

// While one walks: how high the eyes are, and how wide they see.
void movingChips(Editor& editor);
// What whoever walks clicks on.
void clickWalking(Editor& editor);
std::optional<std::string> movingHint(const Editor& editor);  // the keys; nothing when nobody does
// Where whoever walks or flies is, in the frame of the file, and what stops them; "" while nobody does.
std::string movingLine(const Editor& editor);
// What keeps the agent out of rooms, as long as the walkable area is shown or one of them was flown to.
void drawTightPlaces(const Editor& editor, ImVec2 origin);

}  // namespace standpoint
