// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/panels/survey_edit.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"
#include "project/survey/register_verb.h"

namespace standpoint {

namespace {

struct TargetsState {
  bool copies_of_registered = true;  // registering writes the scans with their solved poses
};

std::string whyNotRegister(const Model& model, const std::vector<TargetRow>& rows) {
  if (auto why = model.session.whyNot("register"); !why.empty()) return why;
  std::vector<std::size_t> scanned;
  for (const auto& row : rows)
    if (row.scanned && std::find(scanned.begin(), scanned.end(), row.station) == scanned.end())
      scanned.push_back(row.station);
  if (model.session.document().job->targets.size() < 3)
    return "At least three targets are required. Add targets, then scan.";
  return scanned.size() < 2 ? "Scan from at least two stations first" : "";
}

void drawRegister(const Model& model, TargetsState& state, Actions& actions, const std::vector<TargetRow>& rows) {
  auto& copies = state.copies_of_registered;
  if (ui::button(ICON_TARGET "  Register###register", whyNotRegister(model, rows), {model.px(100), 0},
                 "Solves station poses from the targets")) {
    const auto files = lastScanFiles(*model.session.document().job);
    RegisterOptions options{.files = files};
    if (copies) options.output = files.front().parent_path() / "registered";
    actions.start(options, "Register stations");
  }
  ImGui::SameLine();
  ui::checkbox(ui::Label("Write registered copies of the scans###copies"), &copies);
  ui::tooltip("Writes copies with solved poses to the folder \"registered\" next to the scans");
  if (model.target_list.busy()) {
    ImGui::SameLine();
    ui::dimText("Measuring …");
  } else if (const auto problem = model.target_list.problem(); !problem.empty()) {
    ImGui::SameLine();
    ImGui::TextColored(colour(tone::kWarning), "%s", ICON_WARNING);
    ImGui::SameLine();
    ui::fitted(problem, ImGui::GetContentRegionAvail().x - 2 * ImGui::GetFrameHeight());
  }
}

struct Standing {
  const char* icon;
  ImU32 tone;
  std::string text;
};

Standing standingOf(const TargetRow& row) {
  if (row.fit) return {ICON_CHECK, tone::kGood, tr("found")};
  if (row.scanned) return {ICON_BAN, row.sight.why_not.empty() ? tone::kBad : tone::kDim, trSentence(row.why_not)};
  if (row.sight.why_not.empty()) return {ICON_CIRCLE, tone::kAccent, tr("measurable")};
  return {ICON_EYE_OFF, tone::kDim, trSentence(row.sight.why_not)};
}

void choose(const Model& model, Actions& actions, std::size_t index) {
  actions.inspect(SurveyChoice{.target = static_cast<int>(index)});
  bringNear(actions, model.session.document().job->targets[index].centre);
}

void drawRow(const Model& model, Actions& actions, const TargetRow& row, int index) {
  const auto& job = *model.session.document().job;
  const auto& target = job.targets[row.target];
  ImGui::PushID(index);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  if (ImGui::Selectable("###target-row", model.survey.target == static_cast<int>(row.target),
                        ImGuiSelectableFlags_SpanAllColumns))
    choose(model, actions, row.target);
  ImGui::SameLine(0, 0);
  ui::fitted(target.name, ImGui::GetContentRegionAvail().x);
  const auto cell = [](const std::string& text) {
    ImGui::TableNextColumn();
    ui::fitted(text, ImGui::GetContentRegionAvail().x);
  };
  cell(target.kind == TargetKind::sphere ? trf("sphere {:.0f} mm", target.size_m * 1000)
                                         : trf("plate {:.0f} mm", target.size_m * 1000));
  cell(job.stations[row.station].name);
  cell(figures("{:.2f} m", row.sight.distance_m));
  cell(row.fit ? groupedDigits(row.fit->points) : row.sight.points ? fmt::format("~ {:.0f}", *row.sight.points) : "–");
  cell(row.fit ? figures("{:.2f} mm", row.fit->residual_m * 1000) : "");
  cell(row.fit ? figures("{:.2f} mm", row.fit->sigma_m().norm() * 1000) : "");
  const auto standing = standingOf(row);
  ImGui::TableNextColumn();
  ImGui::TextColored(colour(standing.tone), "%s", standing.icon);
  ImGui::SameLine();
  ui::fitted(standing.text, ImGui::GetContentRegionAvail().x);
  ImGui::PopID();
}

TableRows tableOf(const Job& job, const std::vector<TargetRow>& rows) {
  TableRows table = {{tr("Target"), tr("Kind"), tr("From"), tr("Distance") + ", m", tr("Points"),
                      tr("Residual") + ", mm", "σ, mm", tr("State")}};
  for (const auto& row : rows) {
    if (row.target >= job.targets.size() || row.station >= job.stations.size()) continue;
    const auto& target = job.targets[row.target];
    const auto millimetres = [](double value_m) { return figures("{:.3f}", value_m * 1000); };
    table.push_back({target.name,
                     target.kind == TargetKind::sphere ? trf("sphere {:.0f} mm", target.size_m * 1000)
                                                       : trf("plate {:.0f} mm", target.size_m * 1000),
                     job.stations[row.station].name, figures("{:.3f}", row.sight.distance_m),
                     row.fit            ? std::to_string(row.fit->points)
                     : row.sight.points ? fmt::format("~ {:.0f}", *row.sight.points)
                                        : std::string(),
                     row.fit ? millimetres(row.fit->residual_m) : "",
                     row.fit ? millimetres(row.fit->sigma_m().norm()) : "", standingOf(row).text});
  }
  return table;
}

void drawTable(const Model& model, Actions& actions, const std::vector<TargetRow>& rows) {
  ui::copyTable("targets", [&] { return tableOf(*model.session.document().job, rows); });
  const auto flags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_PadOuterX;
  if (!ImGui::BeginTable("targets", 8, flags)) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  struct Column {
    const char* title;
    float fraction;
  };
  for (const auto& [title, fraction] : {Column{"Target", 1},
                                        {"Kind", 1.5F},
                                        {"From", 0.8F},
                                        {"Distance", 1.1F},
                                        {"Points", 1},
                                        {"Residual", 1.1F},
                                        {"σ", 1},
                                        {"State", 3}})
    ImGui::TableSetupColumn(ui::Label(title), ImGuiTableColumnFlags_WidthStretch, fraction);
  ImGui::TableHeadersRow();
  const auto& job = *model.session.document().job;
  int index = 0;
  for (const auto& row : rows)
    if (row.target < job.targets.size() && row.station < job.stations.size())
      drawRow(model, actions, row, index++);  // the list follows a moment later
  ImGui::EndTable();
}

void draw(const Model& model, TargetsState& state, Actions& actions) {
  const auto& job = model.session.document().job;
  if (!model.environment() || !job || job->targets.empty()) {
    ui::dimWrapped("No targets. Add at least three targets that two stations can see.");
    return;
  }
  actions.wantTargets();
  const auto rows = model.target_list.rows();
  drawRegister(model, state, actions, rows);
  if (job->stations.empty()) return ui::dimText("No stations to measure the targets from");
  drawTable(model, actions, rows);
}

}  // namespace

void drawTargetsPanel(const Model& model, PanelStates& states, Actions& actions) {
  draw(model, states.of<TargetsState>(), actions);
}

}  // namespace standpoint
