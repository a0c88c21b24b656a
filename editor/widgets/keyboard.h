// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace standpoint {

// Keys are GLFW's numbers: letters and digits are their ASCII capitals.
constexpr int kKeyPlus = '=', kKeyMinus = '-';  // wherever the keyboard has them
constexpr int kKeyEscape = 256, kKeyEnter = 257, kKeyTab = 258, kKeyBackspace = 259, kKeyDelete = 261, kKeyRight = 262,
              kKeyLeft = 263, kKeyDown = 264, kKeyUp = 265, kKeyHome = 268, kKeyEnd = 269, kKeyF1 = 290, kKeyF2 = 291,
              kKeyPadEnter = 335, kKeyShift = 340, kKeyControl = 341, kKeyAlt = 342;

// The keyboard of Dear ImGui's current context. Up to 1.86 (Debian 12) Dear ImGui counts keys as its window does, from
// 1.87 on (Debian 13) it has names of its own and wants events: what differs is in keyboard.cpp alone.
namespace keyboard {

void connect();  // once for each context
void change(int key, bool down);
void releaseAll();

bool anyHeld();
bool held(int key);
bool pressed(int key);            // since the last frame
bool pressedOrRepeated(int key);  // again and again while it is held

}  // namespace keyboard
}  // namespace standpoint
