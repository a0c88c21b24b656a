// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/units.h"
#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "project/survey/survey_verbs.h"

namespace standpoint {

namespace {

struct SurveyState {
  Eigen::Vector3d move_to = Eigen::Vector3d::Zero();
  int move_of = -1;  // station that `move_to` was filled from
  Eigen::Vector3d move_from = Eigen::Vector3d::Zero();
};

void lookAt(Actions& actions, const Eigen::Vector3d& place) {
  Bounds around;
  around.extend(place - Eigen::Vector3d(3, 3, 2));
  around.extend(place + Eigen::Vector3d(3, 3, 2));
  actions.bringIntoView(around);
}

void drawStationRow(const Model& model, Actions& actions, const Station& station, int i) {
  ImGui::PushID(i);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  if (ImGui::Selectable("###station", model.survey.station == i,
                        ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap |
                            ImGuiSelectableFlags_AllowDoubleClick)) {
    actions.choose(SurveyChoice{.station = i});
    if (ImGui::IsMouseDoubleClicked(0)) lookAt(actions, station.true_pose.translation);
  }
  ImGui::SameLine(0, 0);
  ImGui::TextColored(colour(tone::kStation), "%s", ICON_STATION);
  ImGui::SameLine();
  ui::fitted(station.name, ImGui::GetContentRegionAvail().x);
  const Eigen::Vector3d p = station.true_pose.translation + model.shift_m();
  ImGui::TableNextColumn();
  ui::fitted(fmt::format("{:.1f}  {:.1f}  {:.1f}", p.x(), p.y(), p.z()), ImGui::GetContentRegionAvail().x);
  ImGui::TableNextColumn();
  ui::textRightAligned(station.scans.empty() ? "–" : std::to_string(station.scans.size()));
  ImGui::PopID();
}

void drawStations(const Model& model, Actions& actions, const Job& job) {
  ui::heading(model, fmt::format("Stations  {}", job.stations.size()).c_str());
  if (job.stations.empty()) {
    ui::dimWrapped("No stations. Choose Add station, then click the floor.");
    return;
  }
  const float height = std::min(
      model.px(26) + ImGui::GetTextLineHeightWithSpacing() * static_cast<float>(job.stations.size()), model.px(260));
  if (!ImGui::BeginTable("stations", 3, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg, {0, height})) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("Name", ImGuiTableColumnFlags_WidthFixed, model.px(70));
  ImGui::TableSetupColumn("X  Y  Z", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("Scans", ImGuiTableColumnFlags_WidthFixed, model.px(38));
  ImGui::TableHeadersRow();
  for (int i = 0; i < static_cast<int>(job.stations.size()); ++i)
    drawStationRow(model, actions, job.stations[static_cast<std::size_t>(i)], i);
  ImGui::EndTable();
}

void fillMove(const Model& model, SurveyState& state, const Station& station) {
  if (state.move_of == model.survey.station && state.move_from == station.true_pose.translation) return;
  state.move_of = model.survey.station;
  state.move_from = station.true_pose.translation;
  state.move_to = station.true_pose.translation + model.shift_m();
}

void drawChosenStation(const Model& model, SurveyState& state, Actions& actions, const Station& station) {
  fillMove(model, state, station);
  ui::heading(model, station.name.c_str());
  const auto why = model.session.whyNot("station");
  if (ui::beginProperties("move", 0.3F)) {
    static constexpr const char* kAxes[] = {"X", "Y", "Z"};
    for (std::size_t i = 0; i < 3; ++i) {
      ui::propertyLabel(kAxes[i]);
      ui::numberField(fmt::format("###move{}", i).c_str(), state.move_to[static_cast<Eigen::Index>(i)],
                      {.kind = {.unit = "m"}, .decimals = 3});
    }
    ui::property("Above floor", metres(station.instrument_height_m));
    if (station.solved_pose) {
      const Pose& solved = *station.solved_pose;
      ui::property("Registered", fmt::format("off by {:.1f} mm and {:.4f}°",
                                             (solved.translation - station.true_pose.translation).norm() * 1000,
                                             solved.rotation.angularDistance(station.true_pose.rotation) / kRadPerDeg));
    }
    ui::endProperties();
  }
  const float width = (ImGui::GetContentRegionAvail().x - 2 * ImGui::GetStyle().ItemSpacing.x) / 3;
  if (ui::button(ui::fittingLabel(ICON_MOVE, "Move", "move-station", width).c_str(), why, {width, 0},
                 "Move to these coordinates"))
    actions.start(StationOptions{.move = station.name, .at = state.move_to, .height_m = station.instrument_height_m},
                  "Move station " + station.name);
  ImGui::SameLine();
  if (ui::button(ui::fittingLabel(ICON_CROSSHAIRS, "Look", "look-station", width).c_str(), {}, {width, 0},
                 "Frame in view"))
    lookAt(actions, station.true_pose.translation);
  ImGui::SameLine();
  if (ui::button(ui::fittingLabel(ICON_TRASH, "Remove", "remove-station", width).c_str(), why, {width, 0},
                 "Remove station"))
    actions.start(StationOptions{.remove = station.name}, "Remove station " + station.name);
  for (const auto& scan : station.scans) {
    ImGui::TextColored(colour(tone::kGood), "%s", ICON_CHECK);
    ImGui::SameLine();
    ui::fitted(fmt::format("{}   {} points   {}", scan.instrument, groupedDigits(scan.points),
                           std::filesystem::path(scan.file).filename().string()),
               ImGui::GetContentRegionAvail().x);
  }
}

void drawTargets(const Model& model, Actions& actions, const Job& job) {
  ui::heading(model, fmt::format("Targets  {}", job.targets.size()).c_str());
  for (int i = 0; i < static_cast<int>(job.targets.size()); ++i) {
    const auto& target = job.targets[static_cast<std::size_t>(i)];
    ImGui::PushID(i);
    const float button = ImGui::GetFrameHeight();
    if (ImGui::Selectable("###target", model.survey.target == i, ImGuiSelectableFlags_AllowItemOverlap,
                          {ImGui::GetContentRegionAvail().x - button, 0})) {
      actions.choose(SurveyChoice{.target = i});
      lookAt(actions, target.centre);
    }
    ImGui::SameLine(model.px(10));
    ImGui::TextColored(colour(tone::kGood), "%s", ICON_TARGET);
    ImGui::SameLine();
    const Eigen::Vector3d p = target.centre + model.shift_m();
    ui::fitted(fmt::format("{}   {}   {:.2f}  {:.2f}  {:.2f}", target.name,
                           target.kind == TargetKind::sphere ? "sphere" : "checkerboard", p.x(), p.y(), p.z()),
               ImGui::GetContentRegionAvail().x - button - model.px(4));
    ImGui::SameLine(ImGui::GetContentRegionMax().x - button);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(model.px(4), 0));
    if (ui::iconButton(ICON_TRASH "###remove-target", "Remove", model.session.whyNot("target")))
      actions.start(TargetOptions{.remove = target.name}, "Remove target " + target.name);
    ImGui::PopStyleVar();
    ImGui::PopID();
  }
  if (job.targets.empty()) ui::dimText("None.");
}

void draw(const Model& model, SurveyState& state, Actions& actions) {
  const auto& job = model.session.document().job;
  if (!model.environment() || !job) {
    ui::emptyState(model, ICON_STATION, "No stations", "Import a model, then place stations on its floors.");
    return;
  }
  // Beside one another where both have room.
  const float half = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
  const float wanted = ImGui::CalcTextSize(ICON_STATION "  Add station").x + 2 * ImGui::GetStyle().FramePadding.x;
  const bool beside = half >= wanted;
  const float width = beside ? half : ImGui::GetContentRegionAvail().x;
  const auto why = model.session.whyNot("station");
  if (ui::primaryButton(ICON_STATION "  Add station###add-station", why, {width, 0})) actions.run("add-station");
  if (beside) ImGui::SameLine();
  if (ui::button(ICON_TARGET "  Add target###add-target", why, {width, 0}, "Click in the view to place the target"))
    actions.run("add-target");
  drawStations(model, actions, *job);
  if (model.survey.station >= static_cast<int>(job->stations.size()))
    actions.choose(SurveyChoice{-1, model.survey.target});
  if (model.survey.station >= 0)
    drawChosenStation(model, state, actions, job->stations[static_cast<std::size_t>(model.survey.station)]);
  drawTargets(model, actions, *job);
}

}  // namespace

void drawSurveyPanel(const Model& model, PanelStates& states, Actions& actions) {
  draw(model, states.of<SurveyState>(), actions);
}

}  // namespace standpoint
