// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/waypoint_drag.h"

#include <cmath>
#include <optional>
#include <utility>

#include "editor/model/trajectory_steps.h"
#include "editor/shell/editor.h"
#include "editor/widgets/widgets.h"

namespace standpoint {

namespace {

constexpr float kWaypointGrip_pt = 8;
constexpr float kDragSlack_pt = 4;  // less than this is a click

// Trajectory and waypoint under the pointer that nothing hides; the chosen one first.
std::optional<std::pair<int, int>> waypointAt(const Editor& editor, ImVec2 origin) {
  const auto& job = editor.session.document().job;
  const ImVec2 p = ImGui::GetIO().MousePos;
  std::optional<std::pair<int, int>> found;
  if (!job) return found;
  const ViewState state = editor.viewState();
  for (int t = 0; t < static_cast<int>(job->trajectories.size()); ++t) {
    const auto& waypoints = job->trajectories[static_cast<std::size_t>(t)].waypoints;
    for (int i = 0; i < static_cast<int>(waypoints.size()); ++i) {
      const Eigen::Vector3d place = waypoints[static_cast<std::size_t>(i)].floor_m + Eigen::Vector3d(0, 0, 0.03);
      const auto pixel = project(editor.view.camera, place, editor.view.size);
      if (!pixel) continue;
      const float away =
          std::hypot(p.x - origin.x - static_cast<float>(pixel->x()), p.y - origin.y - static_cast<float>(pixel->y()));
      if (away > editor.px(kWaypointGrip_pt) || (found && editor.survey.trajectory != t) ||
          !editor.picker.isInSight(place, state))
        continue;
      found = {t, i};
    }
  }
  return found;
}

void followWithPointer(Editor& editor, ImVec2 origin) {
  auto& view = editor.view;
  const ImVec2 p = ImGui::GetIO().MousePos;
  view.hover =
      editor.picker.pick(rayThrough(view.camera, {p.x - origin.x, p.y - origin.y}, view.size), editor.viewState());
}

}  // namespace

bool dragWaypoint(Editor& editor, ImVec2 origin, bool hovered) {
  auto& view = editor.view;
  auto& dragged = view.dragged_waypoint;
  if (view.tool != Tool::select || chosenTrajectory(editor) == nullptr || !editor.session.whyNot("trajectory").empty())
    dragged = -1;
  if (dragged >= 0) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    followWithPointer(editor, origin);
    const ImVec2 way = ImGui::GetMouseDragDelta(0, 0);
    view.waypoint_drag_begun = view.waypoint_drag_begun || std::hypot(way.x, way.y) > editor.px(kDragSlack_pt);
    if (ImGui::IsMouseDown(0)) return true;
    if (view.waypoint_drag_begun) dropWaypoint(editor);
    dragged = -1;
    return true;
  }
  if (!hovered || view.dragging || view.tool != Tool::select || !ImGui::IsMouseClicked(0)) return false;
  const auto found = waypointAt(editor, origin);
  if (!found) return false;
  view.waypoint_drag_begun = false;
  view.refused_place.reset();
  editor.choose({.trajectory = found->first, .waypoint = found->second});
  dragged = found->second;
  return true;
}

}  // namespace standpoint
