// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <imgui.h>

#include "editor/editor.h"
#include "editor/panels/panels_list.h"
#include "editor/shell/icons.h"
#include "editor/shell/theme.h"
#include "editor/shell/widgets.h"

namespace standpoint {

namespace {

std::string whyNotRegister(const Editor& editor, const std::vector<TargetRow>& rows) {
  if (auto why = editor.session.whyNot("register"); !why.empty()) return why;
  std::vector<std::size_t> scanned;
  for (const auto& row : rows)
    if (row.scanned && std::find(scanned.begin(), scanned.end(), row.station) == scanned.end())
      scanned.push_back(row.station);
  if (editor.session.document().job->targets.size() < 3)
    return "At least three targets are required. Add targets, then scan.";
  return scanned.size() < 2 ? "Scan from at least two stations first" : "";
}

void drawRegister(Editor& editor, const std::vector<TargetRow>& rows) {
  auto& copies = editor.panels.survey.copies_of_registered;
  if (ui::button(ICON_TARGET "  Register###register", whyNotRegister(editor, rows), {editor.px(100), 0},
                 "Solves station poses from the targets")) {
    const auto files = lastScanFiles(*editor.session.document().job);
    nlohmann::json options = {{"files", nlohmann::json::array()}};
    for (const auto& file : files) options["files"].push_back(file.string());
    if (copies) options["output"] = (files.front().parent_path() / "registered").string();
    editor.session.start("register", std::move(options), "Register stations");
  }
  ImGui::SameLine();
  ImGui::Checkbox("Write registered copies of the scans###copies", &copies);
  ui::tooltip("Writes copies with solved poses to the folder \"registered\" next to the scans");
  if (editor.target_list.busy()) {
    ImGui::SameLine();
    ui::dimText("Measuring …");
  } else if (const auto problem = editor.target_list.problem(); !problem.empty()) {
    ImGui::SameLine();
    ImGui::TextColored(colour(tone::kWarning), "%s", ICON_WARNING);
    ImGui::SameLine();
    ui::fitted(problem, ImGui::GetContentRegionAvail().x);
  }
}

struct State {
  const char* icon;
  ImU32 tone;
  std::string text;
};

State stateOf(const TargetRow& row) {
  if (row.fit) return {ICON_CHECK, tone::kGood, "found"};
  if (row.scanned) return {ICON_BAN, row.sight.why_not.empty() ? tone::kBad : tone::kDim, row.why_not};
  if (row.sight.why_not.empty()) return {ICON_CIRCLE, tone::kAccent, "measurable"};
  return {ICON_EYE_OFF, tone::kDim, row.sight.why_not};
}

void choose(Editor& editor, std::size_t index) {
  editor.panels.survey.target = static_cast<int>(index);
  editor.panels.survey.station = -1;
  const auto& target = editor.session.document().job->targets[index];
  Bounds around;
  around.extend(target.centre - Eigen::Vector3d(3, 3, 2));
  around.extend(target.centre + Eigen::Vector3d(3, 3, 2));
  frame(editor.view.camera, around, editor.view.size.x() / std::max(editor.view.size.y(), 1.0));
}

void drawRow(Editor& editor, const TargetRow& row, int index) {
  const auto& job = *editor.session.document().job;
  const auto& target = job.targets[row.target];
  ImGui::PushID(index);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  if (ImGui::Selectable("###target-row", editor.panels.survey.target == static_cast<int>(row.target),
                        ImGuiSelectableFlags_SpanAllColumns))
    choose(editor, row.target);
  ImGui::SameLine(0, 0);
  ui::fitted(target.name, ImGui::GetContentRegionAvail().x);
  const auto cell = [](const std::string& text) {
    ImGui::TableNextColumn();
    ui::fitted(text, ImGui::GetContentRegionAvail().x);
  };
  cell(target.kind == TargetKind::sphere ? fmt::format("sphere {:.0f} mm", target.size_m * 1000)
                                         : fmt::format("plate {:.0f} mm", target.size_m * 1000));
  cell(job.stations[row.station].name);
  cell(fmt::format("{:.2f} m", row.sight.distance_m));
  cell(row.fit ? groupedDigits(row.fit->points) : row.sight.points ? fmt::format("~ {:.0f}", *row.sight.points) : "–");
  cell(row.fit ? fmt::format("{:.2f} mm", row.fit->residual_m * 1000) : "");
  cell(row.fit ? fmt::format("{:.2f} mm", row.fit->sigma_m().norm() * 1000) : "");
  const auto state = stateOf(row);
  ImGui::TableNextColumn();
  ImGui::TextColored(colour(state.tone), "%s", state.icon);
  ImGui::SameLine();
  ui::fitted(state.text, ImGui::GetContentRegionAvail().x);
  ImGui::PopID();
}

void drawTable(Editor& editor, const std::vector<TargetRow>& rows) {
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
    ImGui::TableSetupColumn(title, ImGuiTableColumnFlags_WidthStretch, fraction);
  ImGui::TableHeadersRow();
  const auto& job = *editor.session.document().job;
  int index = 0;
  for (const auto& row : rows)
    if (row.target < job.targets.size() && row.station < job.stations.size())
      drawRow(editor, row, index++);  // the list follows a moment later
  ImGui::EndTable();
}

}  // namespace

std::optional<ScanSettings> plannedSettings(Editor& editor) {
  const auto& asked = editor.panels.scan.asked;
  const auto* instrument = instrumentIn(readCatalogue(editor.panels.catalogue), asked.instrument);
  if (instrument == nullptr) return std::nullopt;
  auto settings = resolveSettings(*instrument, asked.settings);
  if (!settings) return std::nullopt;
  return *std::move(settings);
}

void drawTargetsPanel(Editor& editor) {
  const auto& job = editor.session.document().job;
  if (!editor.environment() || !job || job->targets.empty()) {
    ui::dimWrapped("No targets. Add at least three targets that two stations can see.");
    return;
  }
  editor.target_list.follow(editor.session.document(), editor.picker.scene(), plannedSettings(editor));
  const auto rows = editor.target_list.rows();
  drawRegister(editor, rows);
  if (job->stations.empty()) return ui::dimText("No stations to measure the targets from");
  drawTable(editor, rows);
}

}  // namespace standpoint
