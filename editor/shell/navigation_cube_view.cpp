// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/navigation_cube_view.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "editor/camera/navigation_cube.h"
#include "editor/shell/editor.h"
#include "editor/widgets/theme.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

constexpr float kHalfEdge = 23;  // pt; its corners reach out to 1.74 times as far
constexpr float kCubeReach = 40, kCubeMargin = 10;
constexpr double kFaceNamed = 0.8;  // of a face's cosine, from where its name has room on it
constexpr ImU32 kCubeLine = IM_COL32(20, 22, 26, 170);

ImVec2 cubeCentre(const Editor& editor, ImVec2 origin, ImVec2 size) {
  const float inset = editor.px(kCubeMargin + kCubeReach);
  return {origin.x + size.x - inset, origin.y + inset + ImGui::GetFrameHeight()};
}

std::array<ImVec2, 4> onScreenOfCube(const Editor& editor, ImVec2 centre,
                                     const std::array<Eigen::Vector2d, 4>& corners) {
  std::array<ImVec2, 4> points;
  for (std::size_t i = 0; i < 4; ++i)
    points[i] = {centre.x + editor.px(kHalfEdge) * static_cast<float>(corners[i].x()),
                 centre.y + editor.px(kHalfEdge) * static_cast<float>(corners[i].y())};
  return points;
}

// Lighter where it is turned towards whoever looks, and a little in the colour of its axis.
ImU32 faceTone(const CubeFace& face) {
  const auto light = static_cast<float>(0.45 + 0.4 * face.turned_here);
  const Eigen::Vector3d n = face.normal.cwiseAbs();
  const auto part = [&](double tint) { return std::clamp(light + 0.12F * static_cast<float>(tint), 0.0F, 1.0F); };
  return ImGui::ColorConvertFloat4ToU32({part(n.x()), part(0.6 * n.y()), part(n.z()), 0.92F});
}

void turnToPart(Editor& editor, const Eigen::Vector3i& part) {
  stopFlying(editor);
  stopWalking(editor);
  lookFromCubePart(editor.view.camera, part);
  frame(editor.view.camera, editor.buildingBounds(), editor.view.size.x() / std::max(editor.view.size.y(), 1.0));
}

}  // namespace

bool overNavigationCube(const Editor& editor, ImVec2 origin, ImVec2 size) {
  const ImVec2 p = ImGui::GetIO().MousePos, c = cubeCentre(editor, origin, size);
  return std::hypot(p.x - c.x, p.y - c.y) < editor.px(kCubeReach);
}

ImVec2 navigationCubeCorner(const Editor& editor, ImVec2 origin, ImVec2 size) {
  const ImVec2 centre = cubeCentre(editor, origin, size);
  return {centre.x - editor.px(kCubeReach), centre.y + editor.px(kCubeReach)};
}

void drawNavigationCube(Editor& editor, ImVec2 origin, ImVec2 size) {
  const ImVec2 centre = cubeCentre(editor, origin, size);
  const auto& camera = editor.view.camera;
  auto& list = *ImGui::GetWindowDrawList();
  const float reach = editor.px(kCubeReach);
  ImGui::SetCursorScreenPos({centre.x - reach, centre.y - reach});
  const bool pressed = ImGui::InvisibleButton("###navigation-cube", {2 * reach, 2 * reach});
  std::optional<Eigen::Vector3i> part;
  if (ImGui::IsItemHovered()) {
    const ImVec2 p = ImGui::GetIO().MousePos;
    part = cubePartAt(camera, Eigen::Vector2d(p.x - centre.x, p.y - centre.y) / editor.px(kHalfEdge));
  }
  const auto faces = cubeFaces(camera);
  for (const auto& face : faces) {
    const auto p = onScreenOfCube(editor, centre, face.corners);
    list.AddQuadFilled(p[0], p[1], p[2], p[3], faceTone(face));
    list.AddQuad(p[0], p[1], p[2], p[3], kCubeLine, editor.px(1));
  }
  if (part)
    for (const auto& outline : cubePartOutline(camera, *part)) {
      const auto p = onScreenOfCube(editor, centre, outline);
      list.AddQuadFilled(p[0], p[1], p[2], p[3], tone::kAccent);
    }
  for (const auto& face : faces) {
    if (face.turned_here < kFaceNamed) continue;
    const auto p = onScreenOfCube(editor, centre, face.corners);
    const std::string name = tr(face.name);
    const ImVec2 text = ImGui::CalcTextSize(name.c_str());
    list.AddText({(p[0].x + p[2].x - text.x) / 2, (p[0].y + p[2].y - text.y) / 2}, IM_COL32(20, 22, 26, 255),
                 name.c_str());
  }
  if (pressed && part) turnToPart(editor, *part);
}

}  // namespace standpoint
