// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/station_handles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "core/units.h"
#include "editor/model/station_steps.h"
#include "editor/shell/editor.h"
#include "editor/shell/place_ghost.h"
#include "editor/shell/view_pen.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/words/words.h"
#include "project/survey/survey_verbs.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kRing_m = 0.75, kHeightKnob_m = 0.42, kTiltKnob_m = 0.8;
constexpr double kMostTilt_rad = 30 * kRadPerDeg;
constexpr float kHandleGrip_pt = 10;
constexpr std::array kHandles = {StationHandle::heading, StationHandle::height, StationHandle::tilt};

HandledStation asItStands(const Station& station) {
  return {station.true_pose.translation, station.instrument_height_m, yawOf(station.true_pose.rotation),
          tiltOf(station.true_pose.rotation)};
}

Vector3d floorOf(const HandledStation& s) { return s.centre - Vector3d(0, 0, s.height_m); }

Vector3d knobOf(const HandledStation& s, StationHandle handle) {
  switch (handle) {
    case StationHandle::heading: return floorOf(s) + kRing_m * Vector3d(std::cos(s.yaw_rad), std::sin(s.yaw_rad), 0);
    case StationHandle::height: return s.centre + Vector3d(0, 0, kHeightKnob_m);
    case StationHandle::tilt: return s.centre + rotationOf(s.yaw_rad, s.tilt) * Vector3d(0, 0, kTiltKnob_m);
    case StationHandle::none: break;
  }
  return s.centre;
}

// Not where it would lie on the instrument, as those above it do when one looks from above.
std::optional<ImVec2> knobOnScreen(const Editor& editor, const ViewPen& pen, const HandledStation& s,
                                   StationHandle handle) {
  const auto knob = pen.at(knobOf(s, handle)), centre = pen.at(s.centre);
  if (!knob || !centre || std::hypot(knob->x - centre->x, knob->y - centre->y) < editor.px(1.5F * kHandleGrip_pt))
    return std::nullopt;
  return knob;
}

ViewRay pointerRay(const Editor& editor, ImVec2 origin) {
  const ImVec2 p = ImGui::GetIO().MousePos;
  return rayThrough(editor.view.camera, {p.x - origin.x, p.y - origin.y}, editor.view.size);
}

std::optional<Vector3d> atHeight(const ViewRay& ray, double z) {
  const double travel = (z - ray.origin.z()) / ray.direction.z();
  if (!std::isfinite(travel) || travel <= 0) return std::nullopt;
  return Vector3d(ray.origin + travel * ray.direction);
}

// Of the plumb line through a place, how far above it the ray passes nearest.
double alongPlumbLine(const ViewRay& ray, const Vector3d& place) {
  const Vector3d to = place - ray.origin;
  const double slant = ray.direction.z();
  return (slant * ray.direction.dot(to) - to.z()) / std::max(1e-6, 1 - slant * slant);
}

double rounded(double value, double step) { return std::round(value / step) * step; }

void follow(Editor& editor, ImVec2 origin) {
  auto& s = *editor.view.handled_station;
  const auto ray = pointerRay(editor, origin);
  const double step = ImGui::GetIO().KeyCtrl ? 15 * kRadPerDeg : kRadPerDeg;
  if (editor.view.handle == StationHandle::height) {
    const Vector3d floor = floorOf(s);
    const auto* placement = editor.placement.placement();
    const double low = placement != nullptr ? placement->lowest_m() : 0.1,
                 high = placement != nullptr ? placement->highest_m() : 10;
    s.height_m = std::clamp(rounded(alongPlumbLine(ray, floor) - kHeightKnob_m, 0.01), low, high);
    s.centre.z() = floor.z() + s.height_m;
  } else if (editor.view.handle == StationHandle::heading) {
    if (const auto at = atHeight(ray, floorOf(s).z()))
      s.yaw_rad = rounded(std::atan2(at->y() - s.centre.y(), at->x() - s.centre.x()), step);
  } else if (const auto at = atHeight(ray, s.centre.z() + kTiltKnob_m)) {
    const Eigen::Vector2d aside = (*at - s.centre).head<2>();
    const double angle = rounded(std::atan(aside.norm() / kTiltKnob_m), 0.1 * kRadPerDeg);
    s.tilt = {std::min(angle, kMostTilt_rad), std::atan2(aside.y(), aside.x())};
  }
}

void setUp(Editor& editor, const Station& station, const HandledStation& s) {
  StationOptions options{.move = station.name, .at = s.centre + editor.shift_m(), .yaw_deg = s.yaw_rad / kRadPerDeg};
  if (s.tilt.angle_rad > 0) {
    options.tilt_deg = s.tilt.angle_rad / kRadPerDeg;
    options.tilt_towards_deg = s.tilt.towards_rad / kRadPerDeg;
  }
  const auto* placement = editor.placement.placement();
  if (const auto why = placement != nullptr ? placement->whyNot(s.centre) : std::nullopt) {
    editor.view.refused_place = RefusedPlace{station.name, why->brief, sentenceOf(*why), floorOf(s)};
    return;
  }
  editor.session.start(options, trf("Move station {}", station.name));
}

std::string handleText(const HandledStation& s, StationHandle handle) {
  switch (handle) {
    case StationHandle::heading: return trf("Heading {:.0f}° from X", s.yaw_rad / kRadPerDeg);
    case StationHandle::height: return trf("Instrument height {:.2f} m", s.height_m);
    case StationHandle::tilt:
      return s.tilt.angle_rad > 0
                 ? trf("Tilt {:.1f}° towards {:.0f}°", s.tilt.angle_rad / kRadPerDeg, s.tilt.towards_rad / kRadPerDeg)
                 : tr("Tilt 0°");
    case StationHandle::none: break;
  }
  return {};
}

// The chosen station, where handles of it are wanted.
const Station* handledStation(const Editor& editor) {
  if (editor.view.tool != Tool::select || editor.view.dragged_station >= 0 || looksFromStation(editor) ||
      editor.cloud() || !editor.session.whyNot("station").empty())
    return nullptr;
  const auto* station = chosenStation(editor);
  const bool held = editor.view.handle != StationHandle::none;
  if (station == nullptr) return nullptr;
  return held || editor.picker.isInSight(station->true_pose.translation, editor.viewState()) ? station : nullptr;
}

StationHandle handleUnderPointer(const Editor& editor, const ViewPen& pen, const HandledStation& s) {
  const ImVec2 p = ImGui::GetIO().MousePos;
  for (const auto handle : kHandles)
    if (const auto knob = knobOnScreen(editor, pen, s, handle);
        knob && std::hypot(p.x - knob->x, p.y - knob->y) < editor.px(kHandleGrip_pt))
      return handle;
  return StationHandle::none;
}

void drawKnob(const Editor& editor, ImVec2 at, bool lit) {
  auto& list = *ImGui::GetWindowDrawList();
  list.AddCircleFilled(at, editor.px(lit ? 7 : 5.5F), IM_COL32(16, 18, 22, 220));
  list.AddCircleFilled(at, editor.px(lit ? 5.5F : 4), lit ? IM_COL32(255, 255, 255, 255) : tone::kAccent);
}

}  // namespace

bool dragStationHandle(Editor& editor, ImVec2 origin, bool hovered) {
  auto& view = editor.view;
  const auto* station = handledStation(editor);
  if (station == nullptr || view.dragging) {
    view.handle = StationHandle::none;
    return false;
  }
  const ViewPen pen(editor, origin);
  if (view.handle == StationHandle::none) {
    view.handled_station = asItStands(*station);
    view.hovered_handle = hovered ? handleUnderPointer(editor, pen, *view.handled_station) : StationHandle::none;
    if (view.hovered_handle == StationHandle::none) return false;
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    if (ImGui::IsMouseClicked(0)) view.handle = view.hovered_handle;
    return true;
  }
  ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  if (ImGui::IsMouseDragging(0, editor.px(3))) follow(editor, origin);
  if (ImGui::IsMouseDown(0)) return true;
  view.handle = StationHandle::none;
  if (*view.handled_station != asItStands(*station)) setUp(editor, *station, *view.handled_station);
  return true;
}

void drawStationHandles(Editor& editor, ImVec2 origin) {
  const auto& view = editor.view;
  if (handledStation(editor) == nullptr || !view.handled_station) return;
  const auto& s = *view.handled_station;
  const ViewPen pen(editor, origin);
  const auto held = view.handle != StationHandle::none ? view.handle : view.hovered_handle;
  std::vector<Vector3d> ring;
  for (int i = 0; i < 48; ++i) {
    const double azimuth = 2 * std::numbers::pi * i / 48;
    ring.push_back(floorOf(s) + kRing_m * Vector3d(std::cos(azimuth), std::sin(azimuth), 0));
  }
  pen.ring(ring, IM_COL32(64, 144, 247, 150), 1.5F);
  pen.line(floorOf(s), knobOf(s, StationHandle::heading), tone::kAccent, 2);
  pen.line(s.centre, knobOf(s, StationHandle::height), tone::kAccent, 2);
  pen.line(s.centre, knobOf(s, StationHandle::tilt), IM_COL32(64, 144, 247, 150), 1.5F);
  for (const auto handle : kHandles)
    if (const auto knob = knobOnScreen(editor, pen, s, handle)) drawKnob(editor, *knob, handle == held);
  if (held == StationHandle::none) return;
  const ImVec2 p = ImGui::GetIO().MousePos;
  pen.plate({p.x + editor.px(18), p.y + editor.px(12)}, ICON_MOVE, tone::kAccent, handleText(s, held));
}

}  // namespace standpoint
