// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <optional>
#include <unistd.h>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/part_file.h"
#include "editor/panels/actions.h"
#include "editor/panels/material_card_panel.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/widgets.h"
#include "project/materials/materials_verb.h"

namespace standpoint {

namespace {

void text(const char* label, const char* id, const char* hint, std::string& value) {
  ui::propertyLabel(label);
  ImGui::SetNextItemWidth(-FLT_MIN);
  ImGui::InputTextWithHint(id, hint, &value);
}

void number(const char* label, const char* id, double& value, double most, const char* unit, int decimals) {
  ui::propertyLabel(label);
  ui::numberSlider(id, value, 0, most, {.kind = {.unit = unit, .least = 0, .most = most}, .decimals = decimals});
}

void spectrum(const char* title, const char* id, std::array<double, 7>& percent) {
  for (std::size_t i = 0; i < percent.size(); ++i)
    number(fmt::format("{}{:.0f} nm", i == 0 ? tr(title) + ", " : "", MaterialEdit::kWavelengths_nm[i]).c_str(),
           fmt::format("###{}{}", id, i).c_str(), percent[i], 100, "%", 1);
}

void cell(const char* id, double& value, int decimals) {
  ImGui::TableNextColumn();
  ImGui::SetNextItemWidth(-FLT_MIN);
  ui::numberField(id, value, {.kind = {.least = 0}, .decimals = decimals});
}

// A row for each wavelength; what is added or taken away is so only when all are drawn.
void drawComplexIndex(MaterialEdit& edit) {
  std::optional<std::size_t> add, take;
  if (edit.complex_index.empty() && ui::button(ICON_ADD "  Row###add-first")) add = 0;
  if (ImGui::BeginTable("complex-index", 4, ImGuiTableFlags_RowBg)) {
    for (const char* title : {"nm", "n", "k"}) ImGui::TableSetupColumn(title, ImGuiTableColumnFlags_WidthStretch, 1);
    ImGui::TableSetupColumn("###rows", ImGuiTableColumnFlags_WidthFixed, 2.6F * ImGui::GetFrameHeight());
    ImGui::TableHeadersRow();
    for (std::size_t i = 0; i < edit.complex_index.size(); ++i) {
      auto& [wavelength, n, k] = edit.complex_index[i];
      ImGui::TableNextRow();
      cell(fmt::format("###wavelength{}", i).c_str(), wavelength, 0);
      cell(fmt::format("###n{}", i).c_str(), n, 3);
      cell(fmt::format("###k{}", i).c_str(), k, 3);
      ImGui::TableNextColumn();
      if (ui::iconButton(fmt::format("{}###add{}", ICON_ADD, i).c_str(), "Insert row below")) add = i;
      ImGui::SameLine(0, 0);
      if (ui::iconButton(fmt::format("{}###take{}", ICON_TRASH, i).c_str(), "Remove row")) take = i;
    }
    ImGui::EndTable();
  }
  if (add) addIndexRow(edit, *add);
  if (take) takeIndexRow(edit, *take);
}

void drawFields(MaterialEdit& edit) {
  if (!ui::beginProperties("material-fields", 0.42F)) return;
  text("Name", "###label", "Hall plaster", edit.label);
  text("Id", "###id", "plaster_of_the_hall", edit.id);
  spectrum("Reflectance", "reflectance", edit.reflectance_percent);
  number("Roughness σ", "###roughness", edit.roughness_deg, 60, "°", 1);
  number("Gloss slope", "###gloss", edit.gloss_slope, 1, "", 3);
  ui::propertyLabel("Metal");
  ui::checkbox("###metal", &edit.metal);
  ui::tooltip("Use n and k by wavelength instead of a single index of refraction");
  if (!edit.metal) {
    number("Index n", "###index", edit.index_of_refraction, 3, "", 3);
    ui::propertyLabel("Transparent");
    ui::checkbox("###pane", &edit.pane);
  }
  if (edit.pane && !edit.metal) {
    spectrum("Transmittance", "transmittance", edit.transmittance_percent);
    number("Thickness", "###thickness", edit.thickness_mm, 50, "mm", 1);
    ui::propertyLabel("Panes");
    double panes = edit.panes;
    if (ui::numberField("###panes", panes, {.kind = {.least = 1, .most = 4, .whole = true}, .step = 1}))
      edit.panes = static_cast<int>(panes);
    if (edit.panes > 1) number("Gap", "###gap", edit.gap_mm, 100, "mm", 0);
  }
  text("Source", "###source", "Source of the measurement; leave empty if unknown", edit.source);
  ui::endProperties();
  if (edit.metal) drawComplexIndex(edit);
}

// By a file, as every material comes: the verb's reader is the one judge of its figures.
void keep(MaterialCardState& state, Actions& actions, const MaterialEdit& edit) {
  const auto file = std::filesystem::temp_directory_path() / fmt::format("standpoint-{}-{}.json", getpid(), edit.id);
  if (const auto written = writeWholeText(file, libraryFileOf(edit).dump(1)); !written) {
    actions.report("Cannot save the material", written.error());
    return;
  }
  if (!actions.start(MaterialsOptions{{.libraries = {file}}}, trf("Save material {}", edit.label))) return;
  actions.choose(ChosenMaterial{edit.id});
  state.edit.reset();
}

}  // namespace

void drawMaterialForm(const Model& model, MaterialCardState& state, Actions& actions) {
  MaterialEdit& edit = *state.edit;
  const auto flaw = flawOf(edit);
  const auto why = flaw.empty() ? model.session.whyNot("materials") : flaw;
  const float width = ui::shareOfRow(2);
  const bool kept = ui::primaryButton(ICON_CHECK "  Keep###keep-material", why, {width, 0});
  ImGui::SameLine();
  const bool given_up = ui::button(ICON_CLOSE "  Cancel###cancel-material", {}, {width, 0});
  ImGui::BeginChild("fields");
  drawFields(edit);
  ImGui::EndChild();
  if (kept)
    keep(state, actions, edit);
  else if (given_up)
    state.edit.reset();
}

}  // namespace standpoint
