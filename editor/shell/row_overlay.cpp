// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/row_overlay.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "editor/model/station_steps.h"
#include "editor/shell/editor.h"
#include "editor/shell/overlay.h"
#include "editor/shell/place_ghost.h"
#include "editor/shell/view_pen.h"
#include "editor/widgets/number_field.h"
#include "editor/words/words.h"
#include "survey/stations/station_places.h"

namespace standpoint {

namespace {

constexpr double kAboveFloor_m = 0.3;  // from where the floor is looked for

// Of a place of the row, as the pointer would find it there.
PlaceVerdict verdictOfFloor(const Editor& editor, const Eigen::Vector3d& floor) {
  const auto* placement = editor.placement.placement();
  if (placement == nullptr) return {Verdict::unknown, {}, {}};
  const auto hit = placement->scene().intersect(floor + Eigen::Vector3d(0, 0, kAboveFloor_m), -Eigen::Vector3d::UnitZ(),
                                                2 * kAboveFloor_m);
  if (!hit) return {Verdict::bad, "No floor", {}};
  return judgePlace(*placement, *hit, kUsualHeight_m, nearestRange_m(editor));
}

std::string rowText(const std::vector<Eigen::Vector3d>& floors, std::size_t bad) {
  std::string text = trn("{} station", "{} stations", floors.size() - bad, floors.size() - bad);
  if (floors.size() > 1) text += trf(", every {:.2f} m", (floors[1] - floors[0]).head<2>().norm());
  if (bad > 0) text += trf("; no room for {}", bad);
  return text;
}

}  // namespace

void rowChips(Editor& editor) {
  if (editor.view.tool != Tool::placeRow) return;
  auto& row = editor.view.row;
  double count = row.count.value_or(0), spacing = row.spacing_m.value_or(0);
  nextRow();
  ImGui::SetNextItemWidth(editor.px(150));
  if (ui::numberField(
          "###row-count", count,
          {.kind = {.unit = "stations", .least = 2, .most = kMostInRow}, .decimals = 0, .zero = "by spacing"},
          "Number of stations, both ends included"))
    row = {.count = static_cast<std::uint32_t>(std::lround(count)), .spacing_m = {}};
  ImGui::SameLine();
  ImGui::SetNextItemWidth(editor.px(120));
  if (ui::numberField("###row-spacing", spacing,
                      {.kind = {.unit = "m", .least = 0.5, .most = 1000}, .decimals = 2, .zero = "even spacing"},
                      "Distance between stations, instead of their number"))
    row = {.count = {}, .spacing_m = spacing};
}

void drawRow(Editor& editor, ImVec2 origin) {
  const auto floors = rowUnderPointer(editor);
  if (floors.empty()) return;
  const ViewPen pen(editor, origin);
  std::size_t bad = 0;
  pen.line(floors.front(), editor.view.hover->position, IM_COL32(236, 239, 244, 130), 1.5F);
  for (const auto& floor : floors) {
    const auto verdict = verdictOfFloor(editor, floor).verdict;
    bad += static_cast<std::size_t>(verdict == Verdict::bad);
    drawHeldStation(editor, pen, {"", kUsualHeight_m, Eigen::Quaterniond::Identity()}, floor, verdict);
  }
  const ImVec2 pointer = ImGui::GetIO().MousePos;
  const auto verdict = bad == floors.size() ? Verdict::bad : bad > 0 ? Verdict::warn : Verdict::good;
  pen.verdict({pointer.x + editor.px(20), pointer.y + editor.px(16)}, verdict, rowText(floors, bad));
}

}  // namespace standpoint
