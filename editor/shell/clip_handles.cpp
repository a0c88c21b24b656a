// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/clip_handles.h"

#include <array>
#include <cmath>

#include "editor/shell/editor.h"
#include "editor/shell/view_pen.h"
#include "editor/widgets/theme.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr float kClipGrip_pt = 10;

ViewRay rayAt(const Editor& editor, ImVec2 origin) {
  const ImVec2 p = ImGui::GetIO().MousePos;
  return rayThrough(editor.view.camera, {p.x - origin.x, p.y - origin.y}, editor.view.size);
}

// Where along the line through `point` the ray passes nearest; nothing where they are parallel.
std::optional<double> along(const Vector3d& point, const Vector3d& axis, const ViewRay& ray) {
  const double cosine = axis.dot(ray.direction), squared = 1 - cosine * cosine;
  if (squared < 1e-4) return std::nullopt;
  const Vector3d between = ray.origin - point;
  return (between.dot(axis) - between.dot(ray.direction) * cosine) / squared;
}

bool handlesShown(const Editor& editor) {
  return editor.view.clip.box && editor.view.clip.handles && editor.view.tool == Tool::select;
}

}  // namespace

bool dragClip(Editor& editor, ImVec2 origin, bool hovered) {
  auto& clip = editor.view.clip;
  if (!handlesShown(editor)) {
    clip.face = clip.hovered = -1;
    return false;
  }
  if (clip.face < 0) {
    clip.hovered = -1;
    const ViewPen pen(editor, origin);
    const ImVec2 p = ImGui::GetIO().MousePos;
    for (int face = 0; face < kClipFaces && hovered && !editor.view.dragging; ++face)
      if (const auto at = pen.at(planeOf(*clip.box, face).point);
          at && std::hypot(p.x - at->x, p.y - at->y) < editor.px(kClipGrip_pt))
        clip.hovered = face;
    if (clip.hovered >= 0 && ImGui::IsMouseClicked(0)) {
      clip.face = clip.hovered;
      clip.before = *clip.box;
      const auto plane = planeOf(clip.before, clip.face);
      clip.grip_m = along(plane.point, clip.before.axis(clip.face / 2), rayAt(editor, origin)).value_or(0);
    }
  }
  if (clip.face < 0) return clip.hovered >= 0;
  if (!ImGui::IsMouseDown(0)) {
    clip.face = -1;
    return true;
  }
  const auto plane = planeOf(clip.before, clip.face);
  if (const auto now = along(plane.point, clip.before.axis(clip.face / 2), rayAt(editor, origin)))
    clip.box = withFaceMoved(clip.before, clip.face, *now - clip.grip_m);
  return true;
}

void drawClip(Editor& editor, ImVec2 origin) {
  const auto& clip = editor.view.clip;
  if (!clip.box) return;
  const ViewPen pen(editor, origin);
  auto& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(
      origin,
      {origin.x + static_cast<float>(editor.view.size.x()), origin.y + static_cast<float>(editor.view.size.y())}, true);
  const auto corners = clip.box->corners();
  for (std::size_t c = 0; c < corners.size(); ++c)
    for (std::size_t i = 0; i < 3; ++i)
      if ((c >> i & 1U) == 0) pen.line(corners[c], corners[c | std::size_t{1} << i], IM_COL32(90, 170, 255, 150), 1.2F);
  for (int face = 0; handlesShown(editor) && face < kClipFaces; ++face)
    if (const auto at = pen.at(planeOf(*clip.box, face).point)) {
      const bool lit = clip.face == face || (clip.face < 0 && clip.hovered == face);
      list.AddCircleFilled(*at, editor.px(lit ? 7 : 5), IM_COL32(16, 18, 22, 200));
      list.AddCircleFilled(*at, editor.px(lit ? 5.5F : 3.5F), lit ? tone::kAccent : tone::kText);
    }
  list.PopClipRect();
}

void clickSection(Editor& editor) {
  auto& view = editor.view;
  if (!view.measured) return;
  // On a cloud, by the face of the model that lies there; without one across the line of sight.
  constexpr double kSameWall_m = 0.15;
  Vector3d normal = view.camera.forward();
  normal.z() = 0;
  if (normal.norm() < 1e-6) normal = Vector3d::UnitX();
  if (view.hover && (view.hover->position - view.measured->position).norm() < kSameWall_m) normal = view.hover->normal;
  editor.clipSection(view.measured->position, normal.normalized());
  view.tool = Tool::select;
}

}  // namespace standpoint
