// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "editor/editor.h"
#include "editor/panels/panels_list.h"
#include "editor/shell/dialogs.h"
#include "editor/shell/icons.h"
#include "editor/shell/material_brush.h"
#include "editor/shell/theme.h"
#include "editor/shell/widgets.h"

namespace standpoint {

namespace {

const PhysicalMaterial* materialById(const MaterialAssignment& assignment, const std::string& id) {
  const auto found = std::find_if(assignment.materials.begin(), assignment.materials.end(),
                                  [&](const PhysicalMaterial& m) { return m.id == id; });
  return found == assignment.materials.end() ? nullptr : &*found;
}

void drawCoverage(Editor& editor, const MaterialReport& report) {
  const auto tone = report.coverage >= 0.95 ? tone::kGood : tone::kWarning;
  if (editor.fonts.bold != nullptr) ImGui::PushFont(editor.fonts.bold);
  ImGui::Text("%.1f %% of the area assigned", report.coverage * 100);
  if (editor.fonts.bold != nullptr) ImGui::PopFont();
  ui::meter(editor, report.coverage, tone);
  double weak = 0;
  for (const auto& row : report.by_class) weak += row.weak_m2;
  ui::dimText(fmt::format("{:.0f} m² total, {:.0f} m² unassigned, {:.0f} m² low confidence", report.area_m2,
                          report.area_m2 * (1 - report.coverage), weak));
}

void drawMaterialButtons(Editor& editor) {
  const auto why = editor.session.whyNot("materials");
  const float width = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
  if (ui::primaryButton(ICON_MAGIC "  Assign by rules###assign-rules", why, {width, 0}))
    editor.session.start("materials", nlohmann::json::object(), "Assign materials by rules");
  ImGui::SameLine();
  if (ui::button(ICON_FILE "  Rules file…###rules-file", why, {width, 0}, "Use custom assignment rules"))
    askForFile(editor, FileDialogState::Purpose::openFile, "Assignment rules", "Use", {".json"}, "",
               [&editor](const std::filesystem::path& file) {
                 editor.session.start("materials", {{"rules", file.string()}},
                                      "Assign materials by " + file.filename().string());
               });
}

// What one row of either list shows, and that it can be dragged onto a surface.
bool drawMaterial(Editor& editor, const PhysicalMaterial* material, const std::string& id) {
  const bool unassigned = id.empty();
  auto& state = editor.panels.materials;
  const bool chosen = unassigned ? state.chosen_unassigned : state.chosen == id && !state.chosen_unassigned;
  const bool pressed = ImGui::Selectable("###material", chosen, ImGuiSelectableFlags_SpanAllColumns);
  if (pressed) {
    state.chosen = id;
    state.chosen_unassigned = unassigned;
  }
  if (material != nullptr) dragMaterial(*material);
  if (material != nullptr) ui::tooltip(material->id + "\nDrag onto a surface to assign");
  ImGui::SameLine(0, 0);
  ui::swatch(editor, materialColour(material));
  ImGui::SameLine();
  if (unassigned) ImGui::PushStyleColor(ImGuiCol_Text, tone::kUnassigned);
  ui::fitted(unassigned ? "Unassigned" : material != nullptr ? material->label : id, ImGui::GetContentRegionAvail().x);
  if (unassigned) ImGui::PopStyleColor();
  return pressed;
}

std::string reflectanceText(const Editor& editor, const PhysicalMaterial& material) {
  return isGap(material) ? "–"
                         : fmt::format("{:.0f} %", atWavelength(material.reflectance, editor.view.wavelength_nm) * 100);
}

void drawUses(Editor& editor, const MaterialResult& result, float height) {
  const auto flags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_PadOuterX;
  if (!ImGui::BeginTable("uses", 4, flags, {0, height})) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("Material", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("m²", ImGuiTableColumnFlags_WidthFixed, editor.px(52));
  ImGui::TableSetupColumn(fmt::format("{:.0f}", editor.view.wavelength_nm).c_str(), ImGuiTableColumnFlags_WidthFixed,
                          editor.px(40));
  ImGui::TableSetupColumn("n", ImGuiTableColumnFlags_WidthFixed, editor.px(30));
  ImGui::TableHeadersRow();
  auto uses = result.report.uses;
  std::stable_partition(uses.begin(), uses.end(), [](const MaterialUse& u) { return u.material.empty(); });
  for (const auto& use : uses) {
    const auto* material = use.material.empty() ? nullptr : materialById(result.assignment, use.material);
    ImGui::PushID(use.material.c_str());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (drawMaterial(editor, material, use.material)) {
      editor.selection.set(use.products);
      if (editor.view.colour == ColourMode::model) editor.view.colour = ColourMode::material;
    }
    ImGui::TableNextColumn();
    ui::textRightAligned(fmt::format("{:.1f}", use.area_m2));
    ImGui::TableNextColumn();
    if (material != nullptr) ui::textRightAligned(reflectanceText(editor, *material));
    ImGui::TableNextColumn();
    ui::textRightAligned(std::to_string(use.products.size()));
    ImGui::PopID();
  }
  ImGui::EndTable();
}

// All there are, the user's own among them.
void drawLibrary(Editor& editor, float height) {
  auto& state = editor.panels.materials;
  ui::searchField("library-filter", "Brick, glass, steel …", state.filter);
  const float left = height - ImGui::GetFrameHeightWithSpacing();
  const auto& catalogue = readCatalogue(editor.panels.catalogue);
  if (catalogue.materials.empty())
    return ui::wrapped(catalogue.problem.empty() ? "The material library is empty." : catalogue.problem);
  if (!ImGui::BeginTable("library", 2, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_PadOuterX,
                         {0, left}))
    return;
  ImGui::TableSetupColumn("Material", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("share", ImGuiTableColumnFlags_WidthFixed, editor.px(40));
  for (const auto& material : offeredMaterials(editor.panels.catalogue, editor.session.document().materials)) {
    Product searched;
    searched.name = material.label + " " + material.id;
    if (!matchesFilter(searched, state.filter)) continue;
    ImGui::PushID(material.id.c_str());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    drawMaterial(editor, &material, material.id);
    ImGui::TableNextColumn();
    ui::textRightAligned(reflectanceText(editor, material));
    ImGui::PopID();
  }
  ImGui::EndTable();
}

// Many at once: what a selector means gets the chosen material.
void drawBulk(Editor& editor) {
  auto& state = editor.panels.materials;
  ImGui::SetNextItemWidth(-FLT_MIN);
  ImGui::InputTextWithHint("###bulk", "class:IfcWall & storey:EG & name:*außen*", &state.bulk);
  if (state.bulk.empty()) return;
  const auto meant = select(*editor.environment(), state.bulk);
  const auto* material = knownMaterial(editor, state.chosen);
  const float width = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
  const std::string none = meant.empty() ? "No products match" : "";
  if (ui::button(fmt::format("{}  Select {}###bulk-select", ICON_POINTER, meant.size()).c_str(), none, {width, 0}))
    editor.selection.set(meant);
  ImGui::SameLine();
  const auto why = !none.empty()         ? none
                   : material == nullptr ? "Select a material in the list first"
                                         : editor.session.whyNot("materials");
  if (ui::button(ICON_PAINT "  Assign selected###bulk-assign", why, {width, 0}))
    editor.session.start("materials", {{"assign", {state.bulk + "=" + material->id}}},
                         fmt::format("Assign {} to {} products", material->label, meant.size()));
}

void drawListSwitch(Editor& editor) {
  auto& whole = editor.panels.materials.whole_library;
  if (ui::iconButton(ICON_LIST "  In use###in-use", "Materials used in this model", {}, !whole)) whole = false;
  ImGui::SameLine();
  if (ui::iconButton(ICON_PAINT "  Library###library", "All materials in the library", {}, whole)) whole = true;
}

}  // namespace

void drawMaterialsPanel(Editor& editor) {
  const auto& choice = editor.session.document().materials;
  if (!editor.environment() || !choice) {
    ui::emptyState(editor, ICON_PAINT, "No physical materials yet",
                   "Scans require a physical material for every surface. Assign materials by rule from classes, names "
                   "and model materials, then assign the rest by hand.");
    drawMaterialButtons(editor);
    return;
  }
  drawCoverage(editor, choice->result.report);
  ui::gap(editor, 2);
  drawMaterialButtons(editor);
  ui::gap(editor, 2);
  drawListSwitch(editor);
  const float bulk = ImGui::GetFrameHeightWithSpacing() * (editor.panels.materials.bulk.empty() ? 1 : 2) + editor.px(2);
  const float height = ImGui::GetContentRegionAvail().y - bulk;
  if (editor.panels.materials.whole_library)
    drawLibrary(editor, height);
  else
    drawUses(editor, choice->result, height);
  drawBulk(editor);
}

}  // namespace standpoint
