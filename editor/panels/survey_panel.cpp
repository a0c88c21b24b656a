// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <imgui.h>

#include "editor/panels/actions.h"
#include "editor/panels/new_station.h"
#include "editor/panels/panel.h"
#include "editor/panels/survey_inspector.h"
#include "editor/panels/trajectory_inspector.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"
#include "project/survey/survey_verbs.h"
#include "survey/scanning/scan_age.h"

namespace standpoint {

namespace {

void lookAt(Actions& actions, const Eigen::Vector3d& place) {
  Bounds around;
  around.extend(place - Eigen::Vector3d(3, 3, 2));
  around.extend(place + Eigen::Vector3d(3, 3, 2));
  actions.bringIntoView(around);
}

// Before the number of scans: a sign with the reason.
void drawOlder(const Station& station, const std::string& age) {
  const ImVec2 at = ImGui::GetCursorScreenPos(), size = ImGui::CalcTextSize(ICON_WARNING);
  ImGui::InvisibleButton(("###older-" + station.name).c_str(), size);
  ui::tooltip(trf("Scan is {}", trSentence(age)));
  ImGui::GetWindowDrawList()->AddText(at, tone::kWarning, ICON_WARNING);
  ImGui::SameLine();
}

std::string placeText(const Eigen::Vector3d& p, int decimals) {
  return figures("{:.{}f}  {:.{}f}  {:.{}f}", p.x(), decimals, p.y(), decimals, p.z(), decimals);
}

// Of all places of a list: as many as tell what was typed, but no more than there is room for.
int decimalsOf(const std::vector<Eigen::Vector3d>& places, float width) {
  const auto inCentimetres = [](double x) { return std::abs(100 * x - std::round(100 * x)) < 0.05; };
  const auto coarse = [&](const Eigen::Vector3d& p) { return std::all_of(p.begin(), p.end(), inCentimetres); };
  const auto fits = [&](const Eigen::Vector3d& p) { return ImGui::CalcTextSize(placeText(p, 3).c_str()).x <= width; };
  return !std::all_of(places.begin(), places.end(), coarse) && std::all_of(places.begin(), places.end(), fits) ? 3 : 2;
}

void drawStationRow(const Model& model, Actions& actions, const Station& station, int i, int decimals) {
  ImGui::PushID(i);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  if (ImGui::Selectable("###station", model.survey.station == i,
                        ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap |
                            ImGuiSelectableFlags_AllowDoubleClick)) {
    actions.inspect(SurveyChoice{.station = i});
    if (ImGui::IsMouseDoubleClicked(0)) lookAt(actions, station.true_pose.translation);
  }
  ImGui::SameLine(0, 0);
  ImGui::TextColored(colour(tone::kStation), "%s", ICON_STATION);
  ImGui::SameLine();
  ui::fitted(station.name, ImGui::GetContentRegionAvail().x);
  ImGui::TableNextColumn();
  ui::fitted(placeText(station.true_pose.translation + model.shift_m(), decimals), ImGui::GetContentRegionAvail().x);
  ImGui::TableNextColumn();
  const auto age = ageText(station, model.session.document().job->targets);
  if (!age.empty()) drawOlder(station, age);
  ui::textRightAligned(station.scans.empty() ? "–" : std::to_string(station.scans.size()));
  ImGui::PopID();
}

std::vector<std::string> placeRow(const std::string& name, const Eigen::Vector3d& p) {
  return {name, figures("{:.4f}", p.x()), figures("{:.4f}", p.y()), figures("{:.4f}", p.z())};
}

void drawStations(const Model& model, Actions& actions, const Job& job) {
  ui::heading(model, trf("Stations  {}", job.stations.size()).c_str());
  if (job.stations.empty()) {
    ui::dimWrapped("No stations. Choose Add station, then click the floor or type coordinates.");
    return;
  }
  ui::copyTable("stations", [&] {
    TableRows table = {{tr("Name"), "X", "Y", "Z", tr("Scans")}};
    for (const auto& s : job.stations) table.push_back(placeRow(s.name, s.true_pose.translation + model.shift_m()));
    for (std::size_t i = 0; i < job.stations.size(); ++i)
      table[i + 1].push_back(std::to_string(job.stations[i].scans.size()));
    return table;
  });
  const float height = std::min(
      model.px(26) + ImGui::GetTextLineHeightWithSpacing() * static_cast<float>(job.stations.size()), model.px(260));
  const float name = model.px(70), scans = model.px(38);
  const auto& style = ImGui::GetStyle();
  std::vector<Eigen::Vector3d> places;
  for (const auto& s : job.stations) places.emplace_back(s.true_pose.translation + model.shift_m());
  const int decimals = decimalsOf(
      places, ImGui::GetContentRegionAvail().x - name - scans - 6 * style.CellPadding.x - style.ScrollbarSize);
  if (!ImGui::BeginTable("stations", 3, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg, {0, height})) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn(ui::Label("Name"), ImGuiTableColumnFlags_WidthFixed, name);
  ImGui::TableSetupColumn("X  Y  Z", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn(ui::Label("Scans"), ImGuiTableColumnFlags_WidthFixed, scans);
  ui::tableHead({2});
  for (int i = 0; i < static_cast<int>(job.stations.size()); ++i)
    drawStationRow(model, actions, job.stations[static_cast<std::size_t>(i)], i, decimals);
  ImGui::EndTable();
}

void drawTargets(const Model& model, Actions& actions, const Job& job) {
  ui::heading(model, trf("Targets  {}", job.targets.size()).c_str());
  if (!job.targets.empty())
    ui::copyTable("survey-targets", [&] {
      TableRows table = {{tr("Name"), "X", "Y", "Z", tr("Kind")}};
      for (const auto& t : job.targets) {
        table.push_back(placeRow(t.name, t.centre + model.shift_m()));
        table.back().push_back(tr(t.kind == TargetKind::sphere ? "sphere" : "checkerboard"));
      }
      return table;
    });
  for (int i = 0; i < static_cast<int>(job.targets.size()); ++i) {
    const auto& target = job.targets[static_cast<std::size_t>(i)];
    ImGui::PushID(i);
    const float button = ImGui::GetFrameHeight();
    if (ImGui::Selectable("###target", model.survey.target == i, ImGuiSelectableFlags_AllowItemOverlap,
                          {ImGui::GetContentRegionAvail().x - button, 0})) {
      actions.inspect(SurveyChoice{.target = i});
      lookAt(actions, target.centre);
    }
    ImGui::SameLine(model.px(10));
    ImGui::TextColored(colour(tone::kGood), "%s", ICON_TARGET);
    ImGui::SameLine();
    const Eigen::Vector3d p = target.centre + model.shift_m();
    ui::fitted(figures("{}   {}   {:.2f}  {:.2f}  {:.2f}", target.name,
                       tr(target.kind == TargetKind::sphere ? "sphere" : "checkerboard"), p.x(), p.y(), p.z()),
               ImGui::GetContentRegionAvail().x - button - model.px(4));
    ImGui::SameLine(ImGui::GetContentRegionMax().x - button);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(model.px(4), 0));
    if (ui::iconButton(ICON_TRASH "###remove-target", "Remove", model.session.whyNot("target")))
      actions.start(TargetOptions{.remove = target.name}, trf("Remove target {}", target.name));
    ImGui::PopStyleVar();
    ImGui::PopID();
  }
  if (job.targets.empty()) ui::dimText("None.");
}

void draw(const Model& model, PanelStates& states, Actions& actions) {
  const auto& job = model.session.document().job;
  if (!model.environment() || !job) {
    ui::emptyState(model, ICON_STATION, "No stations", "Import a model, then place stations on its floors.");
    return;
  }
  // Beside one another where both have room.
  const auto wanted = [](const char* label) {
    return ImGui::CalcTextSize(tr(label).c_str()).x + 2 * ImGui::GetStyle().FramePadding.x;
  };
  const float gap = ImGui::GetStyle().ItemSpacing.x, row = wanted("Add row"),
              half = (ImGui::GetContentRegionAvail().x - row - 2 * gap) / 2;
  const bool beside = half >= std::max(wanted(ICON_STATION "  Add station"), wanted(ICON_TARGET "  Add target"));
  const float width = beside ? half : ImGui::GetContentRegionAvail().x - row - gap;
  const auto why = model.session.whyNot("station");
  if (ui::primaryButton(ICON_STATION "  Add station###add-station", why, {width, 0})) actions.run("add-station");
  ImGui::SameLine();
  if (ui::button("Add row###add-row", why, {row, 0}, "Several stations at even distances: click both ends"))
    actions.run("add-row");
  if (beside) ImGui::SameLine();
  if (ui::button(ICON_TARGET "  Add target###add-target", why, {beside ? half : -FLT_MIN, 0},
                 "Click in the view to place the target"))
    actions.run("add-target");
  drawNewStation(model, states, actions);
  drawStations(model, actions, *job);
  if (model.survey.station >= static_cast<int>(job->stations.size()))
    actions.choose(SurveyChoice{-1, model.survey.target, model.survey.underlay});
  drawTargets(model, actions, *job);
  drawTrajectories(model, actions);
  if (!actions.offers("inspector")) drawSurveyInspector(model, states, actions);  // else its fields are there
}

}  // namespace

void drawSurveyPanel(const Model& model, PanelStates& states, Actions& actions) { draw(model, states, actions); }

}  // namespace standpoint
