// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "editor/editor.h"
#include "editor/panels/panels_list.h"
#include "editor/shell/icons.h"
#include "editor/shell/material_brush.h"
#include "editor/shell/theme.h"
#include "editor/shell/widgets.h"
#include "project/material_findings.h"

namespace standpoint {

namespace {

void choose(Editor& editor, const MaterialFinding& finding) {
  auto& state = editor.panels.findings;
  state.chosen = finding.id;
  state.because = finding.because;
  editor.selection.set(finding.products);
}

// Alone, as what is doubtful often stands in a room.
void look(Editor& editor, const MaterialFinding& finding) {
  editor.selection.set(finding.products);
  editor.visibility.isolate(finding.products);
  editor.visibility.cut_height_m.reset();  // some of it may stand above
  editor.frameSelection();
}

void drawMark(const MaterialFinding& finding) {
  if (!finding.because.empty()) return ImGui::TextColored(colour(tone::kGood), "%s", ICON_CHECK);
  const bool warning = finding.severity == "warning";
  ImGui::TextColored(colour(warning ? tone::kWarning : tone::kDim), "%s", warning ? ICON_WARNING : ICON_INFO);
}

void drawList(Editor& editor, const std::vector<MaterialFinding>& findings) {
  auto& state = editor.panels.findings;
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(findings.size()));
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const auto& finding = findings[static_cast<std::size_t>(i)];
      ImGui::PushID(i);
      if (ImGui::Selectable("###finding", state.chosen == finding.id)) choose(editor, finding);
      ImGui::SameLine(0, 0);
      drawMark(finding);
      ImGui::SameLine();
      const auto area = fmt::format("{:.1f} m²", finding.area_m2);
      const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(area.c_str()).x - editor.px(14);
      ui::fitted(finding.message, room);
      ImGui::SameLine();
      ui::textRightAligned(area);
      ImGui::PopID();
    }
}

// A remedy whose material is the user's to choose takes the one that is chosen in the lists.
void drawRemedy(Editor& editor, const Remedy& remedy, const std::string& why) {
  const bool open = remedy.material.empty();
  const auto& material = open ? editor.panels.materials.chosen : remedy.material;
  const auto* known = knownMaterial(editor, material);
  const std::string blocked = !why.empty() ? why : known == nullptr ? "Select a material in the list first" : "";
  const std::string text =
      open ? fmt::format("{}: {}", remedy.text, known == nullptr ? "Select a material" : known->label) : remedy.text;
  if (ui::button(fmt::format("{}  {}###{}{}", ICON_MAGIC, text, remedy.selector, remedy.material).c_str(), blocked,
                 {-FLT_MIN, 0}))
    editor.session.start("materials", {{"assign", assignWords(remedy, material)}}, remedy.text);
}

void drawAcceptance(Editor& editor, const MaterialFinding& finding, const std::string& why) {
  auto& state = editor.panels.findings;
  if (!finding.because.empty()) {
    ui::wrapped("Accepted: " + finding.because);
    if (ui::button(ICON_UNDO "  Reopen###reopen", why, {-FLT_MIN, 0}))
      editor.session.start("materials", {{"reopen", {finding.id}}}, "Reopen finding");
    return;
  }
  const float button = editor.px(84);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - ImGui::GetStyle().ItemSpacing.x);
  ImGui::InputTextWithHint("###because", "Reason for accepting", &state.because);
  ImGui::SameLine();
  const std::string blocked = !why.empty() ? why : state.because.empty() ? "Enter a reason" : "";
  if (ui::button(ICON_CHECK "  Accept###accept", blocked, {button, 0}))
    editor.session.start("materials", {{"accept", {finding.id}}, {"because", state.because}}, "Accept finding");
}

void drawFinding(Editor& editor, const MaterialFinding& finding) {
  ui::wrapped(finding.message);
  ImGui::PushStyleColor(ImGuiCol_Text, tone::kDim);
  ui::wrapped(finding.why);
  ImGui::PopStyleColor();
  if (ui::iconButton(ICON_CROSSHAIRS "  Isolate###look", "Hides everything else and frames the products",
                     finding.products.empty() ? "This finding has no products" : ""))
    look(editor, finding);
  ImGui::SameLine();
  if (ui::iconButton(ICON_EYE "  Show all###show-all", "Shows all products")) editor.visibility.showAll();
  const auto why = editor.session.whyNot("materials");
  for (const auto& remedy : finding.remedies) drawRemedy(editor, remedy, why);
  drawAcceptance(editor, finding, why);
}

}  // namespace

void drawFindingsPanel(Editor& editor) {
  const auto& choice = editor.session.document().materials;
  if (!choice) return ui::dimText("Assign materials to get findings.");
  auto& state = editor.panels.findings;
  if (state.seen_revision != editor.session.revision()) {
    state.seen_revision = editor.session.revision();
    state.all = materialFindings(editor.session.document());
  }
  const auto& findings = state.all;
  const auto open =
      std::count_if(findings.begin(), findings.end(), [](const MaterialFinding& f) { return f.because.empty(); });
  if (findings.empty()) {
    ImGui::TextColored(colour(tone::kGood), "%s", ICON_CHECK);
    ImGui::SameLine();
    return ImGui::TextUnformatted("No findings");
  }
  const auto chosen =
      std::find_if(findings.begin(), findings.end(), [&](const MaterialFinding& f) { return f.id == state.chosen; });
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::BeginChild("list", {chosen == findings.end() ? width : width * 0.52F, 0});
  ui::dimText(open == 0 ? fmt::format("All {} accepted", findings.size())
                        : fmt::format("{} open of {}", open, findings.size()));
  drawList(editor, findings);
  ImGui::EndChild();
  if (chosen == findings.end()) return;
  ImGui::SameLine();
  ImGui::BeginChild("finding");
  drawFinding(editor, *chosen);
  ImGui::EndChild();
}

}  // namespace standpoint
