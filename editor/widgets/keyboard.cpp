// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/widgets/keyboard.h"

#include <algorithm>
#include <iterator>

#include <imgui.h>

namespace standpoint::keyboard {

namespace {

#if IMGUI_VERSION_NUM >= 18700
using Named = ImGuiKey;
constexpr Named kPadEnterNamed = ImGuiKey_KeypadEnter;
#else
using Named = ImGuiKey_;
constexpr Named kPadEnterNamed = ImGuiKey_KeyPadEnter;
#endif

// The keys that edit text and walk through lists.
constexpr struct {
  Named named;
  int key;
} kEditing[] = {{ImGuiKey_Tab, 258},
                {ImGuiKey_LeftArrow, kKeyLeft},
                {ImGuiKey_RightArrow, kKeyRight},
                {ImGuiKey_UpArrow, kKeyUp},
                {ImGuiKey_DownArrow, kKeyDown},
                {ImGuiKey_PageUp, 266},
                {ImGuiKey_PageDown, 267},
                {ImGuiKey_Home, kKeyHome},
                {ImGuiKey_End, kKeyEnd},
                {ImGuiKey_Insert, 260},
                {ImGuiKey_Delete, kKeyDelete},
                {ImGuiKey_Backspace, kKeyBackspace},
                {ImGuiKey_Space, ' '},
                {ImGuiKey_Enter, kKeyEnter},
                {ImGuiKey_Escape, kKeyEscape},
                {kPadEnterNamed, kKeyPadEnter},
                {ImGuiKey_A, 'A'},
                {ImGuiKey_C, 'C'},
                {ImGuiKey_V, 'V'},
                {ImGuiKey_X, 'X'},
                {ImGuiKey_Y, 'Y'},
                {ImGuiKey_Z, 'Z'}};

// Two keys that do the same.
constexpr int kShifts[] = {kKeyShift, 344}, kControls[] = {kKeyControl, 345}, kAlts[] = {kKeyAlt, 346},
              kSupers[] = {343, 347};

#if IMGUI_VERSION_NUM >= 18700
ImGuiKey numbered(ImGuiKey first, int offset) { return static_cast<ImGuiKey>(first + offset); }

ImGuiKey named(int key) {
  for (const auto& editing : kEditing)
    if (editing.key == key) return editing.named;
  if (key >= 'A' && key <= 'Z') return numbered(ImGuiKey_A, key - 'A');
  if (key >= '0' && key <= '9') return numbered(ImGuiKey_0, key - '0');
  if (key >= kKeyF1 && key < kKeyF1 + 12) return numbered(ImGuiKey_F1, key - kKeyF1);
  switch (key) {
    case kKeyPlus: return ImGuiKey_Equal;
    case kKeyMinus: return ImGuiKey_Minus;
    case kShifts[0]: return ImGuiKey_LeftShift;
    case kShifts[1]: return ImGuiKey_RightShift;
    case kControls[0]: return ImGuiKey_LeftCtrl;
    case kControls[1]: return ImGuiKey_RightCtrl;
    case kAlts[0]: return ImGuiKey_LeftAlt;
    case kAlts[1]: return ImGuiKey_RightAlt;
    case kSupers[0]: return ImGuiKey_LeftSuper;
    case kSupers[1]: return ImGuiKey_RightSuper;
    default: return ImGuiKey_None;
  }
}

void changeModifier(ImGuiKey modifier, const int (&pair)[2], int key, bool down) {
  if (key != pair[0] && key != pair[1]) return;
  ImGui::GetIO().AddKeyEvent(modifier, down || held(key == pair[0] ? pair[1] : pair[0]));
}
#endif

}  // namespace

#if IMGUI_VERSION_NUM >= 18700
// InputQueue sees to it that no press is lost.
void connect() { ImGui::GetIO().ConfigInputTrickleEventQueue = false; }

void change(int key, bool down) {
  if (named(key) == ImGuiKey_None) return;
  ImGui::GetIO().AddKeyEvent(named(key), down);
  changeModifier(ImGuiMod_Shift, kShifts, key, down);
  changeModifier(ImGuiMod_Ctrl, kControls, key, down);
  changeModifier(ImGuiMod_Alt, kAlts, key, down);
  changeModifier(ImGuiMod_Super, kSupers, key, down);
}

void releaseAll() { ImGui::GetIO().ClearInputKeys(); }

bool anyHeld() {
  for (int key = ImGuiKey_NamedKey_BEGIN; key < ImGuiKey_GamepadStart; ++key)
    if (ImGui::IsKeyDown(static_cast<ImGuiKey>(key))) return true;
  return false;
}

bool held(int key) { return ImGui::IsKeyDown(named(key)); }
bool pressed(int key) { return ImGui::IsKeyPressed(named(key), false); }
bool pressedOrRepeated(int key) { return ImGui::IsKeyPressed(named(key)); }
#else
void connect() {
  for (const auto& editing : kEditing) ImGui::GetIO().KeyMap[editing.named] = editing.key;
}

void change(int key, bool down) {
  auto& io = ImGui::GetIO();
  if (key < 0 || key >= static_cast<int>(std::size(io.KeysDown))) return;
  io.KeysDown[key] = down;
  const auto either = [&](const int(&pair)[2]) { return io.KeysDown[pair[0]] || io.KeysDown[pair[1]]; };
  io.KeyShift = either(kShifts);
  io.KeyCtrl = either(kControls);
  io.KeyAlt = either(kAlts);
  io.KeySuper = either(kSupers);
}

void releaseAll() {
  auto& io = ImGui::GetIO();
  std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
  io.KeyCtrl = io.KeyShift = io.KeyAlt = io.KeySuper = false;
}

bool anyHeld() {
  const auto& io = ImGui::GetIO();
  return std::find(std::begin(io.KeysDown), std::end(io.KeysDown), true) != std::end(io.KeysDown);
}

bool held(int key) { return ImGui::IsKeyDown(key); }
bool pressed(int key) { return ImGui::IsKeyPressed(key, false); }
bool pressedOrRepeated(int key) { return ImGui::IsKeyPressed(key); }
#endif

}  // namespace standpoint::keyboard
