// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/proof_view.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "editor/shell/editor.h"
#include "editor/shell/scene_picture.h"

namespace standpoint {

namespace {

constexpr ImU32 kPlaceColour = IM_COL32(255, 214, 64, 255);

void drawSide(Editor& editor, SceneView* scene, const std::shared_ptr<const Cloud>& cloud, ImVec2 origin, ImVec2 half) {
  auto* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(origin, {origin.x + half.x, origin.y + half.y}, IM_COL32(30, 33, 38, 255));
  if (cloud) drawScene(scene, editor.proofState(cloud), origin, half, editor.fine_picture);
}

// A circle on the surface; of a place without one, a circle that faces the camera.
void drawRing(const Editor& editor, ImVec2 origin, ImVec2 half) {
  const auto& look = editor.proof->look;
  const auto& camera = editor.view.camera;
  const Eigen::Vector3d normal = look.normal.value_or(-camera.forward());
  const Eigen::Vector3d any = std::abs(normal.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d u = normal.cross(any).normalized(), v = normal.cross(u);
  auto* list = ImGui::GetWindowDrawList();
  list->PushClipRect(origin, {origin.x + half.x, origin.y + half.y}, true);
  constexpr int kCorners = 48;
  std::optional<ImVec2> before;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    const Eigen::Vector3d p =
        editor.proof->ring_centre + editor.proof->ring_m * (std::cos(angle) * u + std::sin(angle) * v);
    const auto at = project(camera, p, {half.x, half.y});
    const auto now =
        at ? std::optional(ImVec2(origin.x + static_cast<float>(at->x()), origin.y + static_cast<float>(at->y())))
           : std::nullopt;
    if (before && now) list->AddLine(*before, *now, kPlaceColour, editor.px(1.5F));
    before = now;
  }
  list->PopClipRect();
}

}  // namespace

bool showsTwoClouds(const Editor& editor) { return editor.proof && editor.proof->points && !editor.preview.isOpen(); }

void drawTwoClouds(Editor& editor, ImVec2 origin, ImVec2 half) {
  const auto& proof = *editor.proof;
  const ImVec2 right(origin.x + half.x, origin.y);
  drawSide(editor, editor.scene_beside, proof.yours, origin, half);
  drawSide(editor, editor.scene, proof.good, right, half);
  ImGui::GetWindowDrawList()->AddLine(right, {right.x, right.y + half.y}, IM_COL32(12, 14, 17, 255), editor.px(2));
}

void drawProofPlace(const Editor& editor, ImVec2 origin, ImVec2 size) {
  const auto& proof = *editor.proof;
  if (!proof.points) {
    drawRing(editor, origin, size);
    drawCaption(editor, origin, size, proof.yours_text);
    return;
  }
  const ImVec2 half(size.x / 2, size.y), right(origin.x + half.x, origin.y);
  if (proof.yours) drawRing(editor, origin, half);
  if (proof.good) drawRing(editor, right, half);
  drawCaption(editor, origin, half, proof.yours_text);
  drawCaption(editor, right, half, proof.good_text);
}

}  // namespace standpoint
