// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include <imgui.h>

#include "editor/model/option_form.h"
#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/figures.h"
#include "editor/words/words.h"
#include "project/survey/measure_verb.h"

namespace standpoint {

namespace {

struct MeasureState {
  std::string of, name;        // the name that the field was filled from
  std::string asked, problem;  // the title of the last task, and why it was refused
};

// As the buttons have it.
std::string kindWord(MeasurementKind kind) { return tr(readableOption(rowOf(kind).name)); }

void drawTools(Actions& actions) {
  const float width = ui::shareOfRow(2);
  actions.button("measure", "Distance", width);
  ImGui::SameLine();
  actions.button("measure-height", "Height", width);
  actions.button("measure-angle", "Angle", width);
  ImGui::SameLine();
  actions.button("measure-area", "Area", width);
  actions.button("measure-plane", "Plane", width);
  ImGui::SameLine();
  actions.button("pick-wall", "Wall", width);
}

void lookAt(Actions& actions, const Measurement& m) {
  Bounds around;
  for (const auto& p : m.points) around.extend(p);
  around.min -= Eigen::Vector3d::Constant(1);
  around.max += Eigen::Vector3d::Constant(1);
  actions.bringIntoView(around);
}

void drawList(const Model& model, Actions& actions, const Measurements& measurements) {
  ui::heading(model, trf("Measurements  {}", measurements.size()).c_str());
  if (measurements.empty()) {
    ui::dimWrapped("Choose what to measure, then click in the view: on the model, or on points of a scan.");
    return;
  }
  ui::copyTable("measured", [&] {
    TableRows table = {{tr("Name"), tr("Kind"), tr("Result")}};
    for (const auto& m : measurements)
      table.push_back({m.name, kindWord(m.kind), figuresIn(figureText(figuresOf(m)[0]))});
    return table;
  });
  if (!ImGui::BeginTable("measurements", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_PadOuterX)) return;
  ImGui::TableSetupColumn(ui::Label("Name"), ImGuiTableColumnFlags_WidthStretch, 1.2F);
  ImGui::TableSetupColumn(ui::Label("Kind"), ImGuiTableColumnFlags_WidthStretch, 0.8F);
  ImGui::TableSetupColumn(ui::Label("Result"), ImGuiTableColumnFlags_WidthStretch, 1);
  ui::tableHead({2});
  for (int i = 0; i < static_cast<int>(measurements.size()); ++i) {
    const auto& m = measurements[static_cast<std::size_t>(i)];
    ImGui::PushID(i);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (ImGui::Selectable("###measurement", model.survey.measurement == i,
                          ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick)) {
      actions.choose(SurveyChoice{.measurement = i});
      if (ImGui::IsMouseDoubleClicked(0)) lookAt(actions, m);
    }
    ImGui::SameLine(0, 0);
    ui::fitted(m.name, ImGui::GetContentRegionAvail().x);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(kindWord(m.kind).c_str());
    ImGui::TableNextColumn();
    ui::textRightAligned(figuresIn(figureText(figuresOf(m)[0])));
    ImGui::PopID();
  }
  ImGui::EndTable();
}

void drawName(const Model& model, MeasureState& state, Actions& actions, const Measurement& m) {
  if (!state.asked.empty())
    if (auto why = actions.refused(state.asked); !why.empty()) state.problem = std::move(why), state.asked.clear();
  if (state.of != m.name) state = {m.name, m.name, {}, {}};
  ui::propertyLabel("Name");
  if (model.rename_wanted) {
    ui::focusNext();
    actions.renameBegun();
  }
  if (!ui::textField("###measurement-name", state.name) || state.name == m.name) return;
  MeasureOptions options{.rename = m.name};
  options.name = state.name;
  state.problem.clear();
  state.asked = "Rename measurement " + m.name;
  actions.start(options, state.asked);
}

void drawChosen(const Model& model, MeasureState& state, Actions& actions, const Measurement& m) {
  ui::heading(model, trf("Measurement {}", m.name).c_str());
  if (ui::beginProperties("measurement", 0.42F)) {
    drawName(model, state, actions, m);
    for (const auto& figure : figuresOf(m)) ui::property(figure.label, figuresIn(figureText(figure)));
    for (std::size_t i = 0; i < m.points.size() && i < 12; ++i)
      ui::property(trf("Point {}", i + 1).c_str(), coordinates(m.points[i] + model.shift_m()));
    ui::endProperties();
  }
  if (!m.note.empty()) ui::dimWrapped(m.note);
  if (!state.problem.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, tone::kBad);
    ui::wrapped(state.problem);
    ImGui::PopStyleColor();
  }
  const float width = ui::shareOfRow(3);
  if (ui::button(ui::fittingLabel(ICON_CROSSHAIRS, "Look", "look-measurement", width).c_str(), {}, {width, 0},
                 "Frame in view"))
    lookAt(actions, m);
  ImGui::SameLine();
  if (ui::button(ui::fittingLabel(ICON_COPY, "Copy", "copy-measurement", width).c_str(), {}, {width, 0},
                 "Copy its figures and points as text"))
    ImGui::SetClipboardText(figuresIn(measurementText(m, model.shift_m())).c_str());
  ImGui::SameLine();
  actions.button("remove", "Remove", width);
}

void draw(const Model& model, MeasureState& state, Actions& actions) {
  if (!model.environment()) {
    ui::emptyState(model, ICON_MEASURE, "Nothing to measure", "Import a model (Ctrl+I).");
    return;
  }
  drawTools(actions);
  const Measurements none;
  const auto kept = model.session.document().measurements;  // a copy: a button may change it
  const Measurements& measurements = kept ? *kept : none;
  drawList(model, actions, measurements);
  if (measurements.empty()) return;
  bool shown = model.view.measurements;
  if (ui::checkbox(ui::Label("Show in view"), &shown)) actions.showMeasurements(shown);
  ImGui::SameLine();
  if (ui::button(ICON_COPY "  Copy all###copy-measurements", {}, {-FLT_MIN, 0}, "Copy all measurements as text")) {
    std::string text;
    for (const auto& m : measurements) text += measurementText(m, model.shift_m()) + "\n";
    ImGui::SetClipboardText(figuresIn(text).c_str());
  }
  const int chosen = model.survey.measurement;
  if (chosen >= 0 && chosen < static_cast<int>(measurements.size()))
    drawChosen(model, state, actions, measurements[static_cast<std::size_t>(chosen)]);
}

}  // namespace

void drawMeasurePanel(const Model& model, PanelStates& states, Actions& actions) {
  draw(model, states.of<MeasureState>(), actions);
}

}  // namespace standpoint
