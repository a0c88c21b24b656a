// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "editor/editor.h"
#include "editor/panels/panels_list.h"
#include "editor/shell/dialogs.h"
#include "editor/shell/icons.h"
#include "editor/shell/theme.h"
#include "editor/shell/widgets.h"

namespace standpoint {

namespace {

const PhysicalMaterial* materialById(const MaterialAssignment& assignment, const std::string& id) {
  const auto found = std::find_if(assignment.materials.begin(), assignment.materials.end(), [&](const PhysicalMaterial& m) { return m.id == id; });
  return found == assignment.materials.end() ? nullptr : &*found;
}

void drawCoverage(Editor& editor, const MaterialReport& report) {
  const auto tone = report.coverage >= 0.95 ? tone::kGood : tone::kWarning;
  if (editor.fonts.bold != nullptr) ImGui::PushFont(editor.fonts.bold);
  ImGui::Text("%.1f %% of the area has a material", report.coverage * 100);
  if (editor.fonts.bold != nullptr) ImGui::PopFont();
  ui::meter(editor, report.coverage, tone);
  ui::dimText(fmt::format("{:.0f} m² in all, {:.0f} m² without", report.area_m2, report.area_m2 * (1 - report.coverage)));
}

void drawButtons(Editor& editor) {
  const auto why = editor.session.whyNot("materials");
  const float width = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
  if (ui::primaryButton(ICON_MAGIC "  Assign by rules###assign-rules", why, {width, 0}))
    editor.session.start("materials", nlohmann::json::object(), "Assign materials by rules");
  ImGui::SameLine();
  if (ui::button(ICON_FILE "  Rules file…###rules-file", why, {width, 0}, "Use other rules than the default ones"))
    askForFile(editor, FileDialogState::Purpose::openFile, "Assignment rules", "Use", {".json"}, "", [&editor](const std::filesystem::path& file) {
      editor.session.start("materials", {{"rules", file.string()}}, "Assign materials by " + file.filename().string());
    });
}

void drawUse(Editor& editor, const MaterialResult& result, const MaterialUse& use) {
  const bool unassigned = use.material.empty();
  const auto* material = unassigned ? nullptr : materialById(result.assignment, use.material);
  const std::string label = unassigned ? "Unassigned" : material != nullptr ? material->label : use.material;
  auto& state = editor.panels.materials;
  const bool chosen = unassigned ? state.chosen_unassigned : state.chosen == use.material && !state.chosen_unassigned;
  ImGui::PushID(use.material.c_str());
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  if (ImGui::Selectable("###use", chosen, ImGuiSelectableFlags_SpanAllColumns)) {
    state.chosen = use.material;
    state.chosen_unassigned = unassigned;
    editor.selection.set(use.products);
    editor.view.colour = ColourMode::material;
  }
  if (material != nullptr && !material->sources.empty()) ui::tooltip(fmt::format("{}\n{}", material->id, material->sources.front().text));
  ImGui::SameLine(0, 0);
  ui::swatch(editor, materialColour(material));
  ImGui::SameLine();
  if (unassigned) ImGui::PushStyleColor(ImGuiCol_Text, tone::kUnassigned);
  ui::fitted(label, ImGui::GetContentRegionAvail().x);
  if (unassigned) ImGui::PopStyleColor();
  ImGui::TableNextColumn();
  ui::textRightAligned(fmt::format("{:.1f}", use.area_m2));
  ImGui::TableNextColumn();
  if (material != nullptr) ui::textRightAligned(fmt::format("{:.0f} %", atWavelength(material->reflectance, kReflectanceWavelength_nm) * 100));
  ImGui::TableNextColumn();
  ui::textRightAligned(std::to_string(use.products.size()));
  ImGui::PopID();
}

void drawUses(Editor& editor, const MaterialResult& result, float height) {
  const auto flags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_PadOuterX;
  if (!ImGui::BeginTable("uses", 4, flags, {0, height})) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("Material", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("m²", ImGuiTableColumnFlags_WidthFixed, editor.px(52));
  ImGui::TableSetupColumn("1550", ImGuiTableColumnFlags_WidthFixed, editor.px(40));
  ImGui::TableSetupColumn("n", ImGuiTableColumnFlags_WidthFixed, editor.px(30));
  ImGui::TableHeadersRow();
  auto uses = result.report.uses;
  std::stable_partition(uses.begin(), uses.end(), [](const MaterialUse& u) { return u.material.empty(); });
  for (const auto& use : uses) drawUse(editor, result, use);
  ImGui::EndTable();
}

void drawFindings(Editor& editor, const MaterialReport& report) {
  ui::heading(editor, fmt::format("Findings  {}", report.findings.size()).c_str());
  ImGui::BeginChild("findings");
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(report.findings.size()));
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const auto& finding = report.findings[static_cast<std::size_t>(i)];
      ImGui::PushID(i);
      if (ImGui::Selectable("###finding"))
        if (const auto product = productOf(*editor.environment(), finding.source)) {
          editor.select(*product, true);
          editor.frameSelection();
        }
      ui::tooltip(finding.message);
      ImGui::SameLine(0, 0);
      const bool warning = finding.severity == "warning";
      ImGui::TextColored(colour(warning ? tone::kWarning : tone::kDim), "%s", warning ? ICON_WARNING : ICON_INFO);
      ImGui::SameLine();
      ui::dimText(finding.source);
      ImGui::SameLine();
      ui::fitted(finding.message, ImGui::GetContentRegionAvail().x);
      ImGui::PopID();
    }
  ImGui::EndChild();
}

}  // namespace

void drawMaterialsPanel(Editor& editor) {
  const auto& choice = editor.session.document().materials;
  if (!editor.environment() || !choice) {
    ui::emptyState(editor, ICON_PAINT, "No physical materials yet", "A scan needs to know how each surface reflects. Rules read it from the classes, names and materials of the model; what they miss can be assigned by hand.");
    drawButtons(editor);
    return;
  }
  const auto& result = choice->result;
  drawCoverage(editor, result.report);
  ui::gap(editor, 2);
  drawButtons(editor);
  ui::gap(editor, 2);
  const float findings = result.report.findings.empty() ? 0 : std::min(editor.px(180), ImGui::GetContentRegionAvail().y * 0.4F);
  drawUses(editor, result, ImGui::GetContentRegionAvail().y - findings);
  if (findings > 0) drawFindings(editor, result.report);
}

}  // namespace standpoint
