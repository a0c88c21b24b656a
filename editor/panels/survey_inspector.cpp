// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/panels/survey_inspector.h"

#include <cmath>
#include <memory>
#include <set>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include "core/units.h"
#include "editor/model/station_steps.h"
#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/panels/place_verdict_row.h"
#include "editor/panels/scan_panel.h"
#include "editor/panels/survey_edit.h"
#include "editor/panels/trajectory_inspector.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/verdict_sign.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"
#include "project/survey/underlays.h"
#include "survey/quality/place_verdict.h"
#include "survey/scanning/scan_age.h"
#include "survey/stations/levelling.h"

namespace standpoint {

namespace {

struct SurveyInspectorState {
  SurveyEdit station, target, underlay;
  std::set<std::string> free_stations;  // that are held or hang: their places are checked so
};

const NumberFormat kHeading{.kind = {.unit = "°", .least = -360, .most = 360}, .decimals = 2, .drag = 0.5};

bool headingRow(SurveyEdit& edit, const char* help) {
  ui::propertyLabel("Heading from X");
  return ui::numberField("###inspected-heading", edit.heading_deg, kHeading, help);
}

// It was let go where it cannot stand.
void drawRefusal(const Model& model, const Station& station) {
  const auto& refused = model.view.refused_place;
  if (!refused || refused->station != station.name) return;
  ui::verdict(Verdict::bad);
  ui::wrapped(withVerdictWord(Verdict::bad, trSentence(refused->brief)) + trf(". {} stays where it was", station.name));
  ui::dimWrapped(trSentence(refused->reason));
}

StationOptions movedStation(const Station& station, const SurveyEdit& edit, StationStand stand) {
  StationOptions options{.move = station.name, .at = edit.at, .stand = stand, .yaw_deg = edit.heading_deg};
  if (edit.tilt_deg > 0) {
    options.tilt_deg = edit.tilt_deg;
    options.tilt_towards_deg = edit.tilt_towards_deg;
  }
  return options;
}

bool tiltRows(SurveyEdit& edit) {
  ui::propertyLabel("Tilt");
  bool changed = ui::numberField("###inspected-tilt", edit.tilt_deg,
                                 {.kind = {.unit = "°", .least = 0, .most = 60}, .decimals = 3, .drag = 0.05},
                                 "Angle between the standing axis and the vertical");
  if (edit.tilt_deg <= 0) return changed;
  ui::propertyLabel("Tilt towards");
  return ui::numberField("###inspected-tilt-towards", edit.tilt_towards_deg, kHeading,
                         "Direction of the tilt, counter-clockwise from the file's X") ||
         changed;
}

// What refusals advise where no tripod can stand; the place in the fields is then tried again.
bool standRow(std::set<std::string>& free_stations, const std::string& station) {
  static constexpr const char* kStands[] = {"Tripod", "Free"};
  const bool free = free_stations.contains(station);
  bool changed = false;
  ui::propertyLabel("Stand");
  if (ui::beginDropDown("###inspected-stand", tr(kStands[static_cast<int>(free)]).c_str())) {
    for (const bool offered : {false, true})
      if (ui::choice(ui::Label(kStands[static_cast<int>(offered)]), offered == free) && offered != free) {
        changed = true;
        offered ? void(free_stations.insert(station)) : void(free_stations.erase(station));
      }
    ui::endDropDown();
  }
  ui::tooltip("Free: suspended or handheld. Only its clearance is checked.");
  return changed;
}

void stationFieldRows(const Model& model, SurveyInspectorState& state, Actions& actions, const Station& station) {
  SurveyEdit& edit = state.station;
  if (!ui::beginProperties("station", 0.36F)) return;
  const auto why = model.session.whyNot("station");
  ImGui::BeginDisabled(!why.empty());
  if (nameRow(model, actions, edit))
    startEdit(actions, edit, StationOptions{.rename = station.name, .name = edit.name},
              trf("Rename station {}", station.name));
  bool moved = placeRows(edit, "###inspected");
  ui::propertyLabel("Above floor");
  const double before = edit.height_m;
  if (ui::numberField("###inspected-height", edit.height_m,
                      {.kind = {.unit = "m", .least = 0.1, .most = 10}, .decimals = 3},
                      "Height of the instrument's centre above the floor")) {
    edit.at.z() += edit.height_m - before;
    moved = true;
  }
  moved = standRow(state.free_stations, station.name) || moved;
  moved = headingRow(edit, "Direction of the instrument's X axis, counter-clockwise from the file's X") || moved;
  moved = tiltRows(edit) || moved;
  const auto stand = state.free_stations.contains(station.name) ? StationStand::free : StationStand::tripod;
  if (moved) startEdit(actions, edit, movedStation(station, edit, stand), trf("Move station {}", station.name));
  ImGui::EndDisabled();
  if (station.solved_pose) {
    const Pose& solved = *station.solved_pose;
    ui::property("Registered",
                 trf("off by {:.1f} mm and {:.4f}°", (solved.translation - station.true_pose.translation).norm() * 1000,
                     solved.rotation.angularDistance(station.true_pose.rotation) / kRadPerDeg));
  }
  ui::endProperties();
}

// Of where it stands; while a place that was typed is refused, of that place, and why stands below the fields.
void drawVerdict(const Model& model, const SurveyEdit& edit, const Station& station, bool on_tripod) {
  if (edit.refused) return;
  if (edit.problem.empty()) return drawPlaceVerdict(model, station.true_pose.translation, on_tripod);
  const auto* typed = verdictOfStation(model, edit.at - model.shift_m(), on_tripod);
  if (typed == nullptr || typed->verdict != Verdict::bad) return;
  ui::verdict(Verdict::bad);
  ui::wrapped(withVerdictWord(Verdict::bad, trSentence(typed->brief)));
}

void drawStation(const Model& model, PanelStates& states, Actions& actions, const Station& station) {
  auto& state = states.of<SurveyInspectorState>();
  SurveyEdit& edit = state.station;
  if (begins(edit, &station, actions)) {
    edit.name = station.name;
    edit.at = station.true_pose.translation + model.shift_m();
    edit.heading_deg = yawOf(station.true_pose.rotation) / kRadPerDeg;
    edit.height_m = station.instrument_height_m;
    const Tilt tilt = tiltOf(station.true_pose.rotation);
    edit.tilt_deg = tilt.angle_rad > 1e-9 ? tilt.angle_rad / kRadPerDeg : 0;
    edit.tilt_towards_deg = edit.tilt_deg > 0 ? tilt.towards_rad / kRadPerDeg : 0;
  }
  ui::heading(model, (trf("Station {}", station.name)).c_str());
  drawVerdict(model, edit, station, !state.free_stations.contains(station.name));
  stationFieldRows(model, state, actions, station);
  drawProblem(edit);
  drawRefusal(model, station);
  const float width = columnWidth(3);
  if (smallButton(ICON_CROSSHAIRS, "Look", "look-station", width, {}, "Frame in view"))
    bringNear(actions, station.true_pose.translation);
  ImGui::SameLine();
  if (smallButton(ICON_PLAY, "Scan…", "scan-station", width, model.session.whyNot("scan"),
                  "Open the Scan panel for this station")) {
    states.of<ScanState>().all_stations = false;
    CarriedScan carried = model.carried_scan;
    carried.wanted = false;
    actions.set(carried);
    actions.run("scan");
  }
  ImGui::SameLine();
  if (smallButton(ICON_TRASH, "Remove", "remove-station", width, model.session.whyNot("station"), "Remove station"))
    actions.start(StationOptions{.remove = station.name}, trf("Remove station {}", station.name));
  const float half = columnWidth(2);
  actions.button("look-from-station", "Look from here", half);
  ImGui::SameLine();
  actions.button("duplicate-station", "Duplicate", half);
  const auto& targets = model.session.document().job->targets;
  drawScans(model, actions, station.scans, [&](const Scan& scan) { return ageText(scan, station, targets); });
}

double headingOf(const Eigen::Vector3d& direction) { return std::atan2(direction.y(), direction.x()) / kRadPerDeg; }

// Turned about the plumb line.
Eigen::Vector3d turnedTo(const Eigen::Vector3d& direction, double heading_deg) {
  const double level = direction.head<2>().norm(), angle = heading_deg * kRadPerDeg;
  return {level * std::cos(angle), level * std::sin(angle), direction.z()};
}

void drawTarget(const Model& model, SurveyEdit& edit, Actions& actions, const Target& target) {
  if (begins(edit, &target, actions)) {
    edit.name = target.name;
    edit.at = target.centre + model.shift_m();
    edit.heading_deg = headingOf(target.normal);
  }
  const bool plate = target.kind == TargetKind::checkerboard;
  ui::heading(model, (trf("Target {}", target.name)).c_str());
  const auto why = model.session.whyNot("target");
  if (ui::beginProperties("target", 0.36F)) {
    ImGui::BeginDisabled(!why.empty());
    if (nameRow(model, actions, edit))
      startEdit(actions, edit, TargetOptions{.rename = target.name, .name = edit.name},
                trf("Rename target {}", target.name));
    bool moved = placeRows(edit, "###inspected");
    if (plate) moved = headingRow(edit, "Direction that it faces, counter-clockwise from the file's X") || moved;
    if (moved) {
      TargetOptions options{.move = target.name};
      options.at = edit.at;
      if (plate) options.normal = turnedTo(target.normal, edit.heading_deg);
      startEdit(actions, edit, options, trf("Move target {}", target.name));
    }
    ImGui::EndDisabled();
    ui::property("Kind", plate ? "checkerboard" : "sphere");
    ui::property(plate ? "Side" : "Diameter", figures("{:.4g} mm", target.size_m * 1000));
    ui::endProperties();
  }
  drawProblem(edit);
  const float width = columnWidth(2);
  if (smallButton(ICON_CROSSHAIRS, "Look", "look-target", width, {}, "Frame in view"))
    bringNear(actions, target.centre);
  ImGui::SameLine();
  if (smallButton(ICON_TRASH, "Remove", "remove-target", width, why, "Remove target"))
    actions.start(TargetOptions{.remove = target.name}, trf("Remove target {}", target.name));
}

void underlayButtons(const Model& model, Actions& actions, const Underlay& underlay, const std::string& why) {
  const float width = columnWidth(2);
  if (smallButton(ICON_EXPAND, "Frame", "frame-underlay", width, {}, "Frame in view"))
    if (const Bounds b = underlayBounds(underlay, *model.session.document().georeference); !b.empty())
      actions.bringIntoView(b);
  ImGui::SameLine();
  const bool shown = underlay.visible;
  if (smallButton(shown ? ICON_EYE_OFF : ICON_EYE, shown ? "Hide" : "Show", "show-underlay", width, why,
                  shown ? "Hide its points" : "Show its points"))
    shown ? actions.start(UnderlayOptions{.hide = underlay.name}, trf("Hide {}", underlay.name))
          : actions.start(UnderlayOptions{.show = underlay.name}, trf("Show {}", underlay.name));
  if (smallButton(ICON_MOVE, "Register…", "register-underlay", width, why, "Fit it to the model")) {
    UnderlayOptions options{.fit = underlay.name};
    options.to_surface = true;
    actions.openForm(options);
  }
  ImGui::SameLine();
  if (smallButton(ICON_TRASH, "Remove", "remove-underlay", width, why, "Remove underlay; its file stays"))
    actions.start(UnderlayOptions{.remove = underlay.name}, trf("Remove underlay {}", underlay.name));
}

void drawUnderlay(const Model& model, SurveyEdit& edit, Actions& actions, const Underlay& underlay) {
  if (begins(edit, &underlay, actions)) {
    edit.name = underlay.name;
    edit.at = underlay.file_from_cloud.translation;
    edit.heading_deg = yawOf(underlay.file_from_cloud.rotation) / kRadPerDeg;
  }
  ui::heading(model, (trf("Underlay {}", underlay.name)).c_str());
  const auto why = model.session.whyNot("underlay");
  if (ui::beginProperties("underlay", 0.36F)) {
    ImGui::BeginDisabled(!why.empty());
    if (nameRow(model, actions, edit)) {
      UnderlayOptions options{.name = edit.name};
      options.rename = underlay.name;
      startEdit(actions, edit, options, trf("Rename underlay {}", underlay.name));
    }
    bool moved = placeRows(edit, "###inspected");
    moved = headingRow(edit, "Angle from the file's X axis to the cloud's, counter-clockwise") || moved;
    if (moved) {
      UnderlayOptions options{.move = underlay.name};
      options.at = edit.at;
      options.yaw_deg = edit.heading_deg;
      startEdit(actions, edit, options, trf("Move underlay {}", underlay.name));
    }
    ImGui::EndDisabled();
    ui::property("Points", groupedDigits(underlay.points));
    ui::property("Format", underlay.format);
    ui::property("CRS", underlay.crs);
    ui::property("File", underlay.file);
    ui::endProperties();
  }
  drawProblem(edit);
  if (std::error_code ignored; !std::filesystem::is_regular_file(underlay.file, ignored)) {
    ImGui::PushStyleColor(ImGuiCol_Text, tone::kWarning);
    ui::wrapped(trf("The file is missing: {}", underlay.file));
    ImGui::PopStyleColor();
    drawLocate(model, actions, underlay.file);
  }
  underlayButtons(model, actions, underlay, why);
}

template <class Things>
auto* chosenOf(const Things& things, int index) {
  return index >= 0 && index < static_cast<int>(things.size()) ? &things[static_cast<std::size_t>(index)] : nullptr;
}

// Each thing has fields of its own: what cannot be read in one's is not what the next one chosen holds.
template <class Draw>
bool inFieldsOf(int index, const Draw& draw) {
  ImGui::PushID(index);
  draw();
  ImGui::PopID();
  return true;
}

}  // namespace

bool drawSurveyInspector(const Model& model, PanelStates& states, Actions& actions) {
  auto& state = states.of<SurveyInspectorState>();
  bool any = false;
  const auto job = model.session.document().job;  // a copy: a button may change it
  const auto underlays = model.session.document().underlays;
  const auto chosen = model.survey;
  if (job)
    if (const auto* station = chosenOf(job->stations, chosen.station))
      any = inFieldsOf(chosen.station, [&] { drawStation(model, states, actions, *station); });
  if (job)
    if (const auto* target = chosenOf(job->targets, chosen.target))
      any = inFieldsOf(chosen.target, [&] { drawTarget(model, state.target, actions, *target); });
  if (job)
    if (const auto* trajectory = chosenOf(job->trajectories, chosen.trajectory))
      any = inFieldsOf(chosen.trajectory, [&] { drawTrajectory(model, states, actions, *trajectory); });
  if (const auto* underlay = chosenOf(underlays, chosen.underlay))
    any = inFieldsOf(chosen.underlay, [&] { drawUnderlay(model, state.underlay, actions, **underlay); });
  return any;
}

}  // namespace standpoint
