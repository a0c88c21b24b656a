// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/station_drag.h"

#include <cmath>

#include "core/units.h"
#include "editor/shell/actions.h"
#include "editor/shell/editor.h"
#include "editor/shell/place_ghost.h"
#include "editor/widgets/widgets.h"
#include "editor/words/words.h"
#include "project/survey/survey_verbs.h"
#include "survey/stations/levelling.h"

namespace standpoint {

namespace {

constexpr float kStationGrip_pt = 9;
constexpr float kSlack_pt = 4;  // less than this is a click

// The station whose instrument is under the pointer and not behind something.
int stationAt(Editor& editor, ImVec2 origin) {
  const auto& job = editor.session.document().job;
  const ImVec2 p = ImGui::GetIO().MousePos;
  for (int i = 0; job && i < static_cast<int>(job->stations.size()); ++i) {
    const auto& centre = job->stations[static_cast<std::size_t>(i)].true_pose.translation;
    const auto pixel = project(editor.view.camera, centre, editor.view.size);
    if (!pixel) continue;
    const float away =
        std::hypot(p.x - origin.x - static_cast<float>(pixel->x()), p.y - origin.y - static_cast<float>(pixel->y()));
    if (away < editor.px(kStationGrip_pt) && editor.picker.isInSight(centre, editor.viewState())) return i;
  }
  return -1;
}

void followPointer(Editor& editor, ImVec2 origin) {
  auto& view = editor.view;
  const ImVec2 p = ImGui::GetIO().MousePos;
  view.hover =
      editor.picker.pick(rayThrough(view.camera, {p.x - origin.x, p.y - origin.y}, view.size), editor.viewState());
}

void drop(Editor& editor, const Station& station) {
  const auto& hit = editor.view.hover;
  const auto held = heldStation(editor);
  if (!hit || !held) return;
  if (const auto verdict = verdictUnderPointer(editor, *held); verdict.verdict == Verdict::bad)
    return refusePlace(editor, *held, verdict);
  const Eigen::Vector3d p = hit->position + editor.shift_m();
  const Tilt tilt = tiltOf(station.true_pose.rotation);
  StationOptions options{.move = station.name,
                         .on = FloorPlace{p.x(), p.y(), p.z()},
                         .height_m = station.instrument_height_m,
                         .yaw_deg = yawOf(station.true_pose.rotation) / kRadPerDeg};
  if (tilt.angle_rad > 0) {
    options.tilt_deg = tilt.angle_rad / kRadPerDeg;
    options.tilt_towards_deg = tilt.towards_rad / kRadPerDeg;
  }
  editor.session.start(options, trf("Move station {}", station.name));
}

}  // namespace

bool openStationMenu(Editor& editor, ImVec2 origin) {
  const int station = editor.view.tool == Tool::select ? stationAt(editor, origin) : -1;
  if (station < 0) return false;
  editor.choose({.station = station});
  ImGui::OpenPopup("###station-menu");
  return true;
}

void drawStationMenu(Editor& editor) {
  if (!ImGui::BeginPopup("###station-menu")) return;
  const auto& job = editor.session.document().job;
  const auto chosen = static_cast<std::size_t>(editor.survey.station);
  if (job && chosen < job->stations.size()) ui::dimText(job->stations[chosen].name);
  for (const char* id : {"look-from-station", "rename", "duplicate-station", "remove"}) actionMenuItem(editor, id);
  ImGui::EndPopup();
}

bool dragStation(Editor& editor, ImVec2 origin, bool hovered) {
  auto& dragged = editor.view.dragged_station;
  const auto& job = editor.session.document().job;
  if (editor.view.tool != Tool::select || !job || !editor.session.whyNot("station").empty()) dragged = -1;
  if (dragged >= 0 && dragged < static_cast<int>(job->stations.size())) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    followPointer(editor, origin);
    const ImVec2 way = ImGui::GetMouseDragDelta(0, 0);
    auto& begun = editor.view.station_drag_begun;
    begun = begun || std::hypot(way.x, way.y) > editor.px(kSlack_pt);
    if (ImGui::IsMouseDown(0)) return true;
    if (begun) drop(editor, job->stations[static_cast<std::size_t>(dragged)]);
    dragged = -1;
    return true;
  }
  dragged = -1;
  if (!hovered || editor.view.dragging || editor.view.tool != Tool::select || !ImGui::IsMouseClicked(0)) return false;
  dragged = stationAt(editor, origin);
  if (dragged < 0) return false;
  editor.view.station_drag_begun = false;
  editor.view.refused_place.reset();
  editor.choose({.station = dragged});
  return true;
}

}  // namespace standpoint
