// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/coverage_overlay.h"

#include <cmath>

#include <fmt/format.h>

#include "core/units.h"
#include "editor/shell/editor.h"
#include "editor/shell/expected_overlay.h"
#include "editor/shell/overlay.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"

namespace standpoint {

namespace {

// Empty with the reason why there is no map.
const std::vector<SeenFrom>* scansOf(Editor& editor, std::string& why) {
  const auto& document = editor.session.document();
  const auto scene = editor.picker.scene();
  if (!scene) return why = "Preparing the model for ray tracing …", nullptr;
  if (!document.job || document.job->stations.empty())
    return why = "Add a station first: press Shift+T and click the floor", nullptr;
  const auto& catalogue = editor.catalogue();
  const auto& asked = editor.scan_choice;
  const auto* instrument = instrumentIn(catalogue, asked.instrument);
  if (!editor.view.coverage_made && instrument == nullptr)
    return why = "Choose an instrument in the Scan panel", nullptr;
  const auto& scans = editor.view.coverage_made ? editor.coverage.made(document, scene, catalogue.instruments)
                                                : editor.coverage.planned(document, scene, *instrument, asked.settings);
  if (scans.empty()) why = editor.view.coverage_made ? "No scans yet" : "These settings do not allow scanning";
  return scans.empty() ? nullptr : &scans;
}

SeenWhen wishesOf(const Editor& editor) {
  SeenWhen wanted;
  if (editor.seen.spacing_mm > 0) wanted.max_spacing_m = editor.seen.spacing_mm / 1000;
  if (editor.seen.max_incidence_deg < 90) wanted.max_incidence_rad = editor.seen.max_incidence_deg * kRadPerDeg;
  return wanted;
}

void drawReading(Editor& editor, const std::vector<SeenFrom>& scans) {
  const auto& hit = editor.view.hover;
  if (!hit || editor.view.dragging) return;
  const auto coverage = coverageAt(scans, {hit->position, hit->normal, hit->instance, hit->triangle}, wishesOf(editor));
  if (coverage.stations == 0) return ui::tooltip("Not visible from any station");
  std::string names;
  for (const auto i : coverage.from) names += (names.empty() ? "" : ", ") + scans[i].station;
  ui::tooltip(trf("Visible from {}\nsmallest point spacing {:.1f} mm\nsmallest incidence {:.0f}°", names,
                  coverage.spacing_m * 1000, coverage.incidence_rad / kRadPerDeg));
}

float swatch(Editor& editor, ImVec2 at, const std::array<std::uint8_t, 4>& colour, const char* text) {
  auto& list = *ImGui::GetWindowDrawList();
  const float side = editor.px(10);
  list.AddRectFilled({at.x, at.y + editor.px(2)}, {at.x + side, at.y + editor.px(2) + side}, packed(colour));
  list.AddText({at.x + side + editor.px(5), at.y}, tone::kText, text);
  return side + editor.px(19) + ImGui::CalcTextSize(text).x;
}

void drawScale(Editor& editor, ImVec2 at, float width, CoverageQuantity quantity) {
  auto& list = *ImGui::GetWindowDrawList();
  constexpr int kParts = 48;
  const float height = editor.px(8);
  for (int i = 0; i < kParts; ++i)
    list.AddRectFilled({at.x + width * static_cast<float>(i) / kParts, at.y},
                       {at.x + width * static_cast<float>(i + 1) / kParts, at.y + height},
                       packed(coverageScale((i + 0.5) / kParts)));
  const bool spacing = quantity == CoverageQuantity::spacing;
  const std::array<const char*, 3> marks = spacing ? std::array{"1 mm", "10", "100"} : std::array{"0°", "45°", "90°"};
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const float text = ImGui::CalcTextSize(marks[i]).x;
    list.AddText({at.x + static_cast<float>(i) / 2 * (width - text), at.y + height + editor.px(2)}, tone::kText,
                 marks[i]);
  }
}

}  // namespace

std::optional<CoverageQuantity> coverageQuantity(ColourMode mode) {
  switch (mode) {
    case ColourMode::coverage: return CoverageQuantity::stations;
    case ColourMode::coverage_spacing: return CoverageQuantity::spacing;
    case ColourMode::coverage_incidence: return CoverageQuantity::incidence;
    default: return std::nullopt;
  }
}

void drawCoverage(Editor& editor, ImVec2 origin, ImVec2 size) {
  const auto quantity = coverageQuantity(editor.view.colour);
  if (!quantity || editor.cloud()) return;
  std::string why;
  const auto* scans = scansOf(editor, why);
  if (scans == nullptr) return;
  ExpectedRequest request;
  request.coverage = quantity;
  request.scans = *scans;
  request.wanted = wishesOf(editor);
  drawRequested(editor, std::move(request), origin, size);
}

void drawCoverageLegend(Editor& editor, ImVec2 origin, ImVec2 size) {
  const auto quantity = coverageQuantity(editor.view.colour);
  if (!quantity || editor.cloud()) return;
  auto& list = *ImGui::GetWindowDrawList();
  const float line = ImGui::GetTextLineHeight(), x = origin.x + editor.px(10),
              bottom = origin.y + size.y - line - editor.px(8);
  std::string why;
  const auto* scans = scansOf(editor, why);
  if (scans == nullptr) {
    const std::string said = tr(why);
    list.AddRectFilled({x - editor.px(6), bottom - editor.px(4)},
                       {x + ImGui::CalcTextSize(said.c_str()).x + editor.px(6), origin.y + size.y - editor.px(4)},
                       tone::kOverlay, editor.px(4));
    list.AddText({x, bottom}, tone::kText, said.c_str());
    return;
  }
  const bool counts = *quantity == CoverageQuantity::stations;
  const char* title = counts                                   ? "Number of stations"
                      : *quantity == CoverageQuantity::spacing ? "Point spacing of the densest scan"
                                                               : "Smallest incidence";
  const float high = counts ? 2 * line + editor.px(16) : 3 * line + editor.px(26);
  const float top = origin.y + size.y - high - editor.px(4);
  list.AddRectFilled({x - editor.px(6), top}, {x + editor.px(346), origin.y + size.y - editor.px(4)}, tone::kOverlay,
                     editor.px(4));
  list.AddText({x, top + editor.px(4)}, tone::kText, tr(title).c_str());
  ImVec2 at(x, bottom);
  at.x += swatch(editor, at, kHoleColour, tr("not covered").c_str());
  if (counts) {
    for (int n = 1; n <= kMostCounted; ++n)
      at.x +=
          swatch(editor, at, countColour(n), (n < kMostCounted ? std::to_string(n) : trf("{} and more", n)).c_str());
  } else {
    drawScale(editor, {x, top + line + editor.px(8)}, editor.px(240), *quantity);
  }
  if (ImGui::IsItemHovered()) drawReading(editor, *scans);
}

void coverageChips(Editor& editor) {
  if (!coverageQuantity(editor.view.colour)) return;
  nextRow();
  const std::string planned = tr("Stations as planned");
  const std::string made = tr("Completed scans");
  const auto label = fmt::format("{}  {}", ICON_STATION, editor.view.coverage_made ? made : planned);
  ImGui::SetNextItemWidth(chipWidth(editor, label, 166));
  if (!ui::beginDropDown("###coverage-of", label.c_str(), ImGuiComboFlags_NoArrowButton)) return;
  if (ui::choice(planned.c_str(), !editor.view.coverage_made)) editor.view.coverage_made = false;
  ui::tooltip("All stations, with the instrument and settings of the Scan panel");
  if (ui::choice(made.c_str(), editor.view.coverage_made)) editor.view.coverage_made = true;
  ui::tooltip("Stations that have been scanned, with the instrument and settings of the last scan");
  ui::endDropDown();
}

}  // namespace standpoint
