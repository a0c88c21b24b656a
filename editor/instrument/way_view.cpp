// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "editor/instrument/desk.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/widgets.h"
#include "emulated-ui/device/format.h"

namespace standpoint {

namespace {

using Kind = RehearsalAction::Kind;

constexpr double kSlowest_m_s = 0.05, kFastest_m_s = 5;

void number(const char* id, double& value, const NumberKind& kind = {}) {
  ImGui::TableNextColumn();
  ImGui::SetNextItemWidth(-FLT_MIN);
  ui::numberField(id, value, {.kind = kind, .decimals = 2});
}

// One row for each place; the number of the one to be taken out, or -1.
int places(std::vector<WayPoint>& way) {
  int removed = -1;
  if (!ImGui::BeginTable("way", 4, ImGuiTableFlags_SizingStretchSame)) return removed;
  ImGui::TableSetupColumn("X m");
  ImGui::TableSetupColumn("Y m");
  ImGui::TableSetupColumn("m/s");
  ImGui::TableSetupColumn("###remove", ImGuiTableColumnFlags_WidthFixed);
  ImGui::TableHeadersRow();
  for (std::size_t i = 0; i < way.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    ImGui::TableNextRow();
    number("###x", way[i].x_m);
    number("###y", way[i].y_m);
    if (i == 0)
      ImGui::TableNextColumn();
    else
      number("###speed", way[i].speed_m_s, {.least = kSlowest_m_s, .most = kFastest_m_s});
    ImGui::TableNextColumn();
    if (ui::iconButton(ICON_TRASH "###remove", "Remove waypoint")) removed = static_cast<int>(i);
    ImGui::PopID();
  }
  ImGui::EndTable();
  return removed;
}

// Two places at one spot have no way between them, and no time.
std::string whyNoWay(const std::vector<WayPoint>& way) {
  if (way.size() < 2) return "A path needs at least two waypoints.";
  for (std::size_t i = 1; i < way.size(); ++i)
    if (std::hypot(way[i].x_m - way[i - 1].x_m, way[i].y_m - way[i - 1].y_m) < 1e-3)
      return trf("Waypoints {} and {} coincide. Remove one of them.", i + 1, i);
  return {};
}

}  // namespace

// The way of a handheld scanner: laid by clicks into the view, or typed.
void drawWay(InstrumentDesk& desk, Editor& editor) {
  ui::gap(editor);
  ui::dimText("Path");
  if (!desk.way.empty())
    if (const int removed = places(desk.way); removed >= 0) desk.way.erase(desk.way.begin() + removed);
  const auto timed = timedWay(desk.way);
  if (!timed.empty()) ui::dimText(trf("Duration: {}", clockText(timed.back()[2].get<double>())));
  const bool laying = editor.view.tool == Tool::layWay;
  if (ui::button(laying ? "Done###lay-way" : "Draw in the view###lay-way"))
    editor.view.tool = laying ? Tool::select : Tool::layWay;
  ImGui::SameLine();
  if (ui::button(ICON_ADD "###add-place")) desk.way.push_back(desk.way.empty() ? WayPoint() : desk.way.back());
  ui::tooltip("Add a waypoint by coordinates");
  if (ui::primaryButton("Apply path###plan-way", whyNoWay(desk.way))) act(desk, {Kind::walk, "", "", 0, timed});
  editor.on_way = [&way = desk.way](const Eigen::Vector3d& place) {
    auto next = way.empty() ? WayPoint() : way.back();
    next.x_m = place.x(), next.y_m = place.y(), next.z_m = place.z();
    way.push_back(next);
  };
  editor.way.clear();
  for (const auto& place : desk.way) editor.way.emplace_back(place.x_m, place.y_m, place.z_m);
}

}  // namespace standpoint
