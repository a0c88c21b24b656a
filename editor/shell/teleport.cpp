// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/teleport.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "editor/shell/editor.h"
#include "editor/widgets/keyboard.h"
#include "editor/words/sentences.h"

namespace standpoint {

namespace {

constexpr double kTick_m = 0.35, kPole_m = 1.6;
constexpr double kTap_s = 0.35, kGoesOn_s = 4;
constexpr int kRingCorners = 40;
constexpr ImU32 kCanStand = IM_COL32(0, 158, 115, 255), kCannot = IM_COL32(213, 94, 0, 255);

bool startsAiming(const Editor& editor) {
  const auto& io = ImGui::GetIO();
  return editor.environment() && !io.WantTextInput && !editor.device_has_keys && !io.KeyCtrl && !io.KeyShift &&
         !io.KeyAlt && !ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId) && keyboard::pressed('T');
}

// Nothing until the ground is there.
std::optional<Landing> landingUnderPointer(const Editor& editor) {
  const auto& hit = editor.view.hover;
  const auto ground = editor.walk_ground.of(editor.session.document(), editor.walker);
  if (!hit || !ground) return std::nullopt;
  auto landing = landingOn(*ground, editor.walker, hit->position, hit->normal);
  landing.why_not = whyNoLanding(landing, editor);
  return landing;
}

bool teleportToPointer(Editor& editor) {
  const auto& hit = editor.view.hover;
  const auto landing = landingUnderPointer(editor);
  if (!hit || (landing && !landing->why_not.empty())) return false;
  teleport(editor, *hit);
  return true;
}

struct AimPen {
  const Editor& editor;
  ImVec2 origin;
  ImU32 tone;

  std::optional<ImVec2> at(const Eigen::Vector3d& p) const {
    const auto pixel = project(editor.view.camera, p, editor.view.size);
    if (!pixel) return std::nullopt;
    return ImVec2(origin.x + static_cast<float>(pixel->x()), origin.y + static_cast<float>(pixel->y()));
  }
  void line(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    const auto from = at(a), to = at(b);
    if (from && to) ImGui::GetWindowDrawList()->AddLine(*from, *to, tone, editor.px(2.5F));
  }
  void text(const Eigen::Vector3d& p, const std::string& words) const {
    if (const auto place = at(p)) text(*place, words);
  }
  void text(ImVec2 p, const std::string& words) const {
    const ImVec2 size = ImGui::CalcTextSize(words.c_str());
    const float pad = editor.px(4);
    const float room = static_cast<float>(editor.view.size.x()) - size.x - 3 * pad;  // all of it is in the view
    const ImVec2 low(origin.x + std::clamp(p.x - origin.x - size.x / 2 - pad, pad, std::max(room, pad)),
                     p.y + editor.px(14));
    auto& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(low, {low.x + size.x + 2 * pad, low.y + size.y + 2 * pad}, IM_COL32(24, 26, 30, 230), pad);
    list.AddText({low.x + pad, low.y + pad}, IM_COL32(255, 255, 255, 255), words.c_str());
  }
};

void drawAimRing(const AimPen& pen, const Eigen::Vector3d& feet, double radius) {
  const auto corner = [&](int i) {
    const double angle = 2 * std::numbers::pi * i / kRingCorners;
    return Eigen::Vector3d(feet + radius * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0));
  };
  for (int i = 0; i < kRingCorners; ++i) pen.line(corner(i), corner(i + 1));
}

void drawAimCross(const AimPen& pen, const Eigen::Vector3d& feet, double radius) {
  const Eigen::Vector3d a(radius, radius, 0), b(radius, -radius, 0);
  pen.line(feet - 0.7 * a, feet + 0.7 * a);
  pen.line(feet - 0.7 * b, feet + 0.7 * b);
}

}  // namespace

bool aimTeleport(Editor& editor, bool hovered) {
  auto& aim = editor.view.teleport;
  if (!aim.active() && startsAiming(editor)) aim = {.by_key = true, .begun_s = ImGui::GetTime()};
  if (!aim.active()) return false;
  editor.walk_ground.prepare(editor.session.document(), editor.walker, editor.wake);
  if (ImGui::IsMouseClicked(1)) {
    aim = {};
    return true;
  }
  const bool released = aim.by_key && !keyboard::held('T');
  if (!released && !(hovered && ImGui::IsMouseClicked(0))) return true;
  const bool tapped = released && ImGui::GetTime() - aim.begun_s < kTap_s;
  const bool went = teleportToPointer(editor);
  // Where nobody can stand a tap leaves the ring, with the reason, for a click.
  aim = {.by_click = tapped && !went, .goes_on_to_s = tapped && went ? ImGui::GetTime() + kGoesOn_s : 0};
  return true;
}

bool goesOnByClick(const Editor& editor) {
  return editor.view.tool == Tool::walk && ImGui::GetTime() < editor.view.teleport.goes_on_to_s;
}

bool clickAfterTap(Editor& editor) {
  if (!goesOnByClick(editor) || !teleportToPointer(editor)) return false;
  editor.view.teleport.goes_on_to_s = ImGui::GetTime() + kGoesOn_s;
  return true;
}

void drawTeleport(const Editor& editor, ImVec2 origin, bool over_view) {
  if (!editor.view.teleport.active()) return;
  const auto landing = landingUnderPointer(editor);
  const bool possible = landing && landing->why_not.empty();
  const AimPen pen{editor, origin, possible ? kCanStand : kCannot};
  if (!landing) {
    const bool ready = editor.walk_ground.of(editor.session.document(), editor.walker) != nullptr;
    if (ready && over_view) pen.text(ImGui::GetIO().MousePos, tr("no surface under the pointer"));
    return;
  }
  const double radius = editor.walker.radius_m;
  const Eigen::Vector3d& feet = landing->feet;
  drawAimRing(pen, feet, radius);
  if (!possible) {
    drawAimCross(pen, feet, radius);
    pen.text(feet, trSentence(landing->why_not));
    return;
  }
  const double azimuth = editor.view.camera.azimuth_rad;
  const Eigen::Vector3d ahead(-std::sin(azimuth), std::cos(azimuth), 0);
  pen.line(feet + radius * ahead, feet + (radius + kTick_m) * ahead);
  pen.line(feet, feet + Eigen::Vector3d(0, 0, kPole_m));
}

}  // namespace standpoint
