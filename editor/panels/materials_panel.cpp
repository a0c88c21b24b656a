// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "editor/model/material_scope.h"
#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/material_drag.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/words.h"
#include "project/materials/materials_verb.h"

namespace standpoint {

namespace {

struct MaterialsState {
  std::string filter;
  bool whole_library = false;  // listed, not only what is in use
  std::string bulk;            // selector of what gets the chosen material
  // What a click on a material in use selected, and what had been selected before: a wall whose new material is being
  // looked for stays the one that gets it.
  std::vector<std::uint32_t> listed, before_listed;
};

const PhysicalMaterial* materialById(const MaterialAssignment& assignment, const std::string& id) {
  const auto found = std::find_if(assignment.materials.begin(), assignment.materials.end(),
                                  [&](const PhysicalMaterial& m) { return m.id == id; });
  return found == assignment.materials.end() ? nullptr : &*found;
}

void drawCoverage(const Model& model, const MaterialReport& report) {
  const auto tone = report.coverage >= 0.95 ? tone::kGood : tone::kWarning;
  if (model.fonts.bold != nullptr) ImGui::PushFont(model.fonts.bold);
  ImGui::TextUnformatted(trf("{:.1f} % of the area assigned", report.coverage * 100).c_str());
  if (model.fonts.bold != nullptr) ImGui::PopFont();
  ui::meter(model, report.coverage, tone);
  double weak = 0;
  for (const auto& row : report.by_class) weak += row.weak_m2;
  ui::dimWrapped(trf("{:.0f} m² total, {:.0f} m² unassigned, {:.0f} m² low confidence", report.area_m2,
                     report.area_m2 * (1 - report.coverage), weak));
}

void drawMaterialButtons(const Model& model, Actions& actions) {
  const auto why = model.session.whyNot("materials");
  const float width = ui::shareOfRow(2);
  if (ui::primaryButton(ICON_MAGIC "  Assign by rules###assign-rules", why, {width, 0})) actions.run("assign-by-rules");
  ImGui::SameLine();
  if (ui::button(ICON_FILE "  Rules file…###rules-file", why, {width, 0}, "Use custom assignment rules"))
    actions.askForFile(FileDialogState::Purpose::openFile, "Assignment rules", "Use", {".json"}, "",
                       [](Actions& later, const std::filesystem::path& file) {
                         later.start(MaterialsOptions{{.rules = file}},
                                     trf("Assign materials by {}", file.filename().string()));
                       });
}

// What one row of either list shows, and that it can be dragged onto a surface.
bool drawMaterial(const Model& model, Actions& actions, const PhysicalMaterial* material, const std::string& id) {
  const bool unassigned = id.empty();
  const bool chosen = unassigned ? model.material.unassigned : model.material.id == id && !model.material.unassigned;
  const bool pressed = ImGui::Selectable("###material", chosen, ImGuiSelectableFlags_SpanAllColumns);
  if (pressed) {
    actions.choose(ChosenMaterial{id, unassigned});
  }
  if (material != nullptr) dragMaterial(*material);
  if (material != nullptr) ui::tooltip(material->id + "\n" + tr("Drag onto a surface to assign"));
  ImGui::SameLine(0, 0);
  ui::swatch(model, materialColour(material));
  ImGui::SameLine();
  if (unassigned) ImGui::PushStyleColor(ImGuiCol_Text, tone::kUnassigned);
  ui::fittedMiddle(unassigned            ? tr("Unassigned")
                   : material != nullptr ? tr(material->label)
                                         : id,
                   ImGui::GetContentRegionAvail().x);
  if (unassigned) ImGui::PopStyleColor();
  return pressed;
}

std::string reflectanceText(const Model& model, const PhysicalMaterial& material) {
  return isGap(material) ? "–"
                         : fmt::format("{:.0f} %", atWavelength(material.reflectance, model.view.wavelength_nm) * 100);
}

TableRows usesTable(const Model& model, const MaterialResult& result) {
  TableRows table = {{tr("Material"), "m²", fmt::format("{:.0f} nm", model.view.wavelength_nm), tr("Products")}};
  for (const auto& use : result.report.uses) {
    const auto* material = use.material.empty() ? nullptr : materialById(result.assignment, use.material);
    table.push_back({use.material.empty()  ? tr("Unassigned")
                     : material != nullptr ? tr(material->label)
                                           : use.material,
                     figures("{:.3f}", use.area_m2),
                     material != nullptr ? reflectanceText(model, *material) : std::string(),
                     std::to_string(use.products.size())});
  }
  return table;
}

bool isSearched(const MaterialsState& state, const PhysicalMaterial& material) {
  Product searched;
  searched.name = material.label + " " + tr(material.label) + " " + material.id;
  return matchesFilter(searched, state.filter);
}

TableRows libraryTable(const Model& model, const MaterialsState& state) {
  TableRows table = {{tr("Material"), "id", fmt::format("{:.0f} nm", model.view.wavelength_nm)}};
  for (const auto& material : model.offeredMaterials())
    if (isSearched(state, material))
      table.push_back({tr(material.label), material.id, reflectanceText(model, material)});
  return table;
}

void drawUses(const Model& model, MaterialsState& state, Actions& actions, const MaterialResult& result, float height) {
  const auto flags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_PadOuterX;
  if (!ImGui::BeginTable("uses", 4, flags, {0, height})) return;
  auto uses = result.report.uses;
  // Figures take the room that they need; a name has what is left.
  const auto wide = [](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; };
  const auto wavelength = fmt::format("{:.0f}", model.view.wavelength_nm);
  float area = wide("m²"), share = std::max(wide("100 %"), wide(wavelength)), count = wide("n");
  for (const auto& use : uses) {
    area = std::max(area, wide(figures("{:.1f}", use.area_m2)));
    count = std::max(count, wide(std::to_string(use.products.size())));
  }
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn(ui::Label("Material"), ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("m²", ImGuiTableColumnFlags_WidthFixed, area);
  ImGui::TableSetupColumn(wavelength.c_str(), ImGuiTableColumnFlags_WidthFixed, share);
  ImGui::TableSetupColumn("n", ImGuiTableColumnFlags_WidthFixed, count);
  ui::tableHead({1, 2, 3});
  std::stable_partition(uses.begin(), uses.end(), [](const MaterialUse& u) { return u.material.empty(); });
  for (const auto& use : uses) {
    const auto* material = use.material.empty() ? nullptr : materialById(result.assignment, use.material);
    ImGui::PushID(use.material.c_str());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (drawMaterial(model, actions, material, use.material)) {
      if (model.selection.products() != state.listed) state.before_listed = model.selection.products();
      actions.select(use.products);
      state.listed = model.selection.products();
      if (model.view.colour == ColourMode::model) actions.colourBy(ColourMode::material);
    }
    ImGui::TableNextColumn();
    ui::textRightAligned(figures("{:.1f}", use.area_m2));
    ImGui::TableNextColumn();
    if (material != nullptr) ui::textRightAligned(reflectanceText(model, *material));
    ImGui::TableNextColumn();
    ui::textRightAligned(std::to_string(use.products.size()));
    ImGui::PopID();
  }
  ImGui::EndTable();
}

// All there are, the user's own among them.
void drawLibrary(const Model& model, MaterialsState& state, Actions& actions, float height) {
  ui::searchField("library-filter", "Brick, glass, steel …", state.filter);
  const float left = height - ImGui::GetFrameHeightWithSpacing();
  const auto& catalogue = model.catalogue();
  if (catalogue.materials.empty())
    return ui::wrapped(catalogue.problem.empty() ? "The material library is empty." : catalogue.problem);
  if (!ImGui::BeginTable("library", 2, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_PadOuterX,
                         {0, left}))
    return;
  ImGui::TableSetupColumn(ui::Label("Material"), ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("share", ImGuiTableColumnFlags_WidthFixed, model.px(40));
  for (const auto* material : model.offeredByName()) {
    if (!isSearched(state, *material)) continue;
    ImGui::PushID(material->id.c_str());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    drawMaterial(model, actions, material, material->id);
    ImGui::TableNextColumn();
    ui::textRightAligned(reflectanceText(model, *material));
    ImGui::PopID();
  }
  ImGui::EndTable();
}

// The chosen material to what is selected.
void drawAssign(const Model& model, const MaterialsState& state, Actions& actions) {
  const auto& selected = model.selection.products();
  const auto& wanted = selected == state.listed ? state.before_listed : selected;
  const auto& products = model.environment()->products;
  const auto* material = model.offeredMaterial(model.material.id);
  const auto why = material == nullptr ? std::string("Select a material in the list first")
                   : wanted.empty()    ? std::string("Select products in the view first")
                                       : model.session.whyNot("materials");
  const auto what = wanted.size() == 1 && wanted[0] < products.size()
                        ? productLabel(products[wanted[0]])
                        : trn("{} product", "{} products", wanted.size(), groupedDigits(wanted.size()));
  const auto text = wanted.empty() ? tr("Assign to selection") : trf("Assign to {}", what);
  const float width = ImGui::GetContentRegionAvail().x;
  const auto label = ui::fittingText(ICON_PAINT "  " + text, width - 2 * ImGui::GetStyle().FramePadding.x);
  const auto tip = material == nullptr ? text : trf("{}: {}", tr(material->label), text);
  if (!ui::button((label + "###assign-selected").c_str(), why, {width, 0}, tip.c_str())) return;
  MaterialsOptions options;
  for (const auto p : wanted)
    if (p < products.size()) options.assign.push_back({selectorOf(products[p]), material->id});
  const auto assigned = wanted;
  if (!actions.start(options, trf("Assign {} to {}", tr(material->label), what))) return;
  actions.select(assigned);
  if (model.view.colour == ColourMode::model) actions.colourBy(ColourMode::material);
}

// Many at once: what a selector means gets the chosen material.
void drawBulk(const Model& model, MaterialsState& state, Actions& actions) {
  ImGui::AlignTextToFramePadding();
  ui::dimText("Selector");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-FLT_MIN);
  ImGui::InputTextWithHint("###bulk", "class:IfcWall & storey:EG & name:*außen*", &state.bulk);
  ui::tooltip("The products that get the chosen material, by class, storey, name, type or material");
  if (state.bulk.empty()) return;
  const auto meant = select(*model.environment(), state.bulk);
  const auto* material = model.offeredMaterial(model.material.id);
  const float width = ui::shareOfRow(2);
  const std::string none = meant.empty() ? "No products match" : "";
  if (ui::button(trf("{}  Select {}###bulk-select", ICON_POINTER, meant.size()).c_str(), none, {width, 0}))
    actions.select(meant);
  ImGui::SameLine();
  const auto why = !none.empty()         ? none
                   : material == nullptr ? "Select a material in the list first"
                                         : model.session.whyNot("materials");
  if (ui::button(ICON_PAINT "  Assign selected###bulk-assign", why, {width, 0}))
    actions.start(MaterialsOptions{{.assign = {{state.bulk, material->id}}}},
                  trf("Assign {} to {} products", tr(material->label), groupedDigits(meant.size())));
}

void drawListSwitch(MaterialsState& state) {
  auto& whole = state.whole_library;
  if (ui::iconButton(ICON_LIST "  In use###in-use", "Materials used in this model", {}, !whole)) whole = false;
  ImGui::SameLine();
  if (ui::iconButton(ICON_PAINT "  Library###library", "All materials in the library", {}, whole)) whole = true;
}

void draw(const Model& model, MaterialsState& state, Actions& actions) {
  const auto& choice = model.session.document().materials;
  if (!model.environment() || !choice) {
    ui::emptyState(model, ICON_PAINT, "No physical materials yet",
                   "Scans require a physical material for every surface. Assign materials by rule from classes, names "
                   "and model materials, then assign the rest by hand.");
    drawMaterialButtons(model, actions);
    return;
  }
  drawCoverage(model, choice->result.report);
  ui::gap(model, 2);
  drawMaterialButtons(model, actions);
  ui::gap(model, 2);
  drawListSwitch(state);
  ui::copyTable("materials",
                [&] { return state.whole_library ? libraryTable(model, state) : usesTable(model, choice->result); });
  const float bulk = ImGui::GetFrameHeightWithSpacing() * (state.bulk.empty() ? 2 : 3) + model.px(2);
  const float height = ImGui::GetContentRegionAvail().y - bulk;
  if (state.whole_library)
    drawLibrary(model, state, actions, height);
  else
    drawUses(model, state, actions, choice->result, height);
  drawAssign(model, state, actions);
  drawBulk(model, state, actions);
}

}  // namespace

void drawMaterialsPanel(const Model& model, PanelStates& states, Actions& actions) {
  draw(model, states.of<MaterialsState>(), actions);
}

}  // namespace standpoint
