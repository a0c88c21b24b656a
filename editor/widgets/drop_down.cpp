// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/widgets/drop_down.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include <imgui_internal.h>

#include "editor/labels/alphabetical.h"
#include "editor/widgets/keyboard.h"
#include "editor/widgets/theme.h"

namespace standpoint::ui {

namespace {

struct Entry {
  std::string text;  // as a search compares it
  bool disabled = false;
};

// The one that is open. Keys go through what was drawn in the frame before.
struct OpenList {
  ImGuiID box = 0;  // 0: none, or the pointer closed it
  int frame = -1;   // that it was drawn in last
  std::vector<Entry> before, entries;
  int current = -1;      // that a key takes; -1: none
  int taken = -1;        // by a key, in this frame
  bool appears = false;  // in this frame
  bool lit = false;      // a key has moved to the current one
  bool moved = false;    // in this frame
} open_list;

// A closed one that has the keyboard.
struct KeyedBox {
  ImGuiID id = 0;
  int frame = -1;  // that it was drawn in last
} keyed;

bool pressedEnter() { return keyboard::pressed(kKeyEnter) || keyboard::pressed(kKeyPadEnter); }

bool disabledHere() { return (ImGui::GetCurrentContext()->CurrentItemFlags & ImGuiItemFlags_Disabled) != 0; }

bool clicked() { return ImGui::IsMouseClicked(0) || ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2); }

// In this frame, or in the one before.
bool drawnLately(int frame) {
  const int now = ImGui::GetFrameCount();
  return frame == now || frame + 1 == now;
}

// Nothing stays when Dear ImGui's context goes: another one counts its frames anew.
void followContext() {
  static ImGuiContext* of = nullptr;
  if (of == ImGui::GetCurrentContext()) return;
  of = ImGui::GetCurrentContext();
  ImGuiContextHook hook;
  hook.Type = ImGuiContextHookType_Shutdown;
  hook.Callback = [](ImGuiContext*, ImGuiContextHook*) {
    of = nullptr;
    open_list = {};
    keyed = {};
  };
  ImGui::AddContextHook(of, &hook);
}

bool keepsKeys(const KeyedBox& box) {
  const auto& typed = ImGui::GetIO().InputQueueCharacters;
  const bool other = clicked() || ImGui::IsAnyItemActive() || keyboard::pressed(kKeyEscape) ||
                     std::any_of(typed.begin(), typed.end(), [](ImWchar c) { return c != ' '; });
  return box.id != 0 && drawnLately(box.frame) && !other && !ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId);
}

bool pressedToOpen() { return keyboard::pressed(' ') || keyboard::pressed(kKeyDown); }

// Of a label, without its id and the icons before its words.
std::string searched(const char* label) {
  const std::string text = forSearch(std::string(label, ImGui::FindRenderedTextEnd(label)));
  const auto isIcon = [&](std::size_t i) {  // of the private use area, U+E000 to U+F8FF
    return i + 1 < text.size() &&
           (text[i] == '\xEE' || (text[i] == '\xEF' && static_cast<unsigned char>(text[i + 1]) < 0xA4));
  };
  std::size_t begin = 0;
  while (begin < text.size() && (text[begin] == ' ' || isIcon(begin))) begin += text[begin] == ' ' ? 1 : 3;
  return text.substr(std::min(begin, text.size()));
}

void goTo(OpenList& list, int index) {
  list.current = index;
  list.lit = list.moved = true;
}

// The next one in this direction that can be chosen.
void step(OpenList& list, int from, int by) {
  const auto count = static_cast<int>(list.before.size());
  for (int i = from; i >= 0 && i < count; i += by)
    if (!list.before[static_cast<std::size_t>(i)].disabled) return goTo(list, i);
}

void goToLetter(OpenList& list, ImWchar letter) {
  char utf8[5] = {};
  ImTextCharToUtf8(utf8, letter);
  const std::string wanted = forSearch(utf8);
  const auto count = static_cast<int>(list.before.size());
  if (wanted.empty() || wanted == " ") return;
  for (int i = 1; i <= count; ++i) {
    const int index = (list.current + i) % count;
    const auto& entry = list.before[static_cast<std::size_t>(index)];
    if (!entry.disabled && entry.text.starts_with(wanted)) return goTo(list, index);
  }
}

// A field in the list keeps the letters and what goes through its text; what is typed there leaves other entries.
void followKeys(OpenList& list) {
  const auto count = static_cast<int>(list.before.size());
  const auto& typed = ImGui::GetIO().InputQueueCharacters;
  list.current = std::min(list.current, count - 1);
  if (keyboard::pressedOrRepeated(kKeyDown)) step(list, list.current + 1, 1);
  if (keyboard::pressedOrRepeated(kKeyUp)) step(list, list.current < 0 ? count - 1 : list.current - 1, -1);
  if (ImGui::GetIO().WantTextInput) {
    if (!typed.empty()) step(list, 0, 1);
  } else {
    if (keyboard::pressed(kKeyHome)) step(list, 0, 1);
    if (keyboard::pressed(kKeyEnd)) step(list, count - 1, -1);
    for (const ImWchar letter : typed) goToLetter(list, letter);
  }
  if (pressedEnter()) list.taken = list.current;
}

void drawEdge() {
  ImGui::GetWindowDrawList()->AddRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), tone::kAccent,
                                      ImGui::GetStyle().FrameRounding);
}

void beginOpen(OpenList& list, ImGuiID box, bool by_key) {
  const bool again = list.box == box && drawnLately(list.frame);
  if (!again) list = {};
  list.before = std::move(list.entries);
  list.entries.clear();
  list.box = box;
  list.frame = ImGui::GetFrameCount();
  list.appears = !again;
  list.lit |= by_key;
  list.taken = -1;
  list.moved = false;
  if (again) followKeys(list);
}

}  // namespace

bool beginDropDown(const char* id, const char* shown, ImGuiComboFlags flags) {
  followContext();
  const ImGuiID box = ImGui::GetID(id);
  const int frame = ImGui::GetFrameCount();
  const bool has_keys = keyed.id == box && keepsKeys(keyed) && !disabledHere();
  const bool by_key = has_keys && pressedToOpen();
  if (by_key) ImGui::OpenPopupEx(ImHashStr("##ComboPopup", 0, box));
  if (ImGui::BeginCombo(id, shown, flags)) {
    beginOpen(open_list, box, by_key);
    return true;
  }
  const bool closed = open_list.box == box && open_list.frame + 1 == frame;  // by a key
  if (closed || has_keys) {
    keyed = {box, frame};
    drawEdge();
  }
  return false;
}

bool choice(const char* label, bool chosen) {
  auto& list = open_list;
  const auto index = static_cast<int>(list.entries.size());
  list.entries.push_back({searched(label), disabledHere()});
  if (list.appears && chosen) list.current = index;
  const bool clicked_on = ImGui::Selectable(label, chosen);
  const ImVec2 moved = ImGui::GetIO().MouseDelta;
  if (ImGui::IsItemHovered() && (moved.x != 0 || moved.y != 0)) {
    list.current = index;
    list.lit = false;
  }
  if (clicked_on) list.box = 0;
  if (list.lit && list.current == index) {
    drawEdge();
    if (list.moved) ImGui::ScrollToItem(ImGuiScrollFlags_KeepVisibleEdgeY);
  }
  if (list.taken != index) return clicked_on;
  ImGui::CloseCurrentPopup();
  return true;
}

void endDropDown() {
  if (clicked()) open_list.box = 0;
  ImGui::EndCombo();
}

bool dropDownIsOpen() { return open_list.frame == ImGui::GetFrameCount(); }

}  // namespace standpoint::ui
