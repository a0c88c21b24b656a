// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/widgets/modal.h"

#include <algorithm>
#include <cmath>

#include <imgui_internal.h>

#include "editor/model/style.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/keyboard.h"
#include "editor/widgets/widgets.h"

namespace standpoint::ui {

namespace {

constexpr double kShake_s = 0.15;

struct Request {
  ImGuiID popup = 0;
  int frame = -1;
  bool click = false;
};
Request asked_to_go;

struct Shake {
  ImGuiID popup = 0;
  double since_s = -1;
};
Shake shaken;

bool anyModal() {
  for (const auto& popup : ImGui::GetCurrentContext()->OpenPopupStack)
    if (popup.Window != nullptr && (popup.Window->Flags & ImGuiWindowFlags_Modal) != 0) return true;
  return false;
}

float shakeOffset(const Style& style, ImGuiID popup) {
  const double t = ImGui::GetTime() - shaken.since_s;
  if (shaken.popup != popup || t < 0 || t > kShake_s) return 0;
  return style.px(6) * static_cast<float>(std::sin(t / kShake_s * 4 * IM_PI));
}

}  // namespace

bool beginModal(const Style& style, const char* english, bool wanted, float width, float height) {
  const Label title(english);
  if (wanted && !ImGui::IsPopupOpen(title) && !anyModal()) ImGui::OpenPopup(title);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float shift = shakeOffset(style, ImGui::GetID(title));
  const bool fixed = height == 0;
  const auto when = fixed ? ImGuiCond_Always : ImGuiCond_Appearing;
  ImGui::SetNextWindowPos({display.x / 2 + (fixed ? shift : 0), display.y * (fixed ? 0.42F : 0.5F)}, when,
                          {0.5F, 0.5F});
  ImGui::SetNextWindowSize(
      {std::min(style.px(width), display.x * 0.95F), std::min(style.px(height), display.y * 0.95F)}, when);
  const auto flags = ImGuiWindowFlags_NoSavedSettings |
                     (fixed ? ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove : ImGuiWindowFlags_None);
  if (!ImGui::BeginPopupModal(title, nullptr, flags)) return false;
  if (wanted) return true;
  ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  return false;
}

bool modalCancelled(bool keeps_at_click) {
  const ImGuiID own = ImGui::GetCurrentWindow()->PopupId;
  if (asked_to_go.frame != ImGui::GetFrameCount() || asked_to_go.popup != own) return false;
  if (!asked_to_go.click || !keeps_at_click) return true;
  shaken = {own, ImGui::GetTime()};
  return false;
}

bool modalAccepted() {
  return (keyboard::pressed(kKeyEnter) || keyboard::pressed(kKeyPadEnter)) && !ImGui::GetIO().WantTextInput &&
         !dropDownIsOpen() &&
         ImGui::IsWindowFocused(ImGuiFocusedFlags_ChildWindows | ImGuiFocusedFlags_NoPopupHierarchy);
}

void askModalToGo(ImGuiID popup, bool click) { asked_to_go = {popup, ImGui::GetFrameCount(), click}; }

}  // namespace standpoint::ui
