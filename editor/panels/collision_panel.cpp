// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <imgui.h>

#include "editor/editor.h"
#include "editor/panels/panels_list.h"
#include "editor/shell/icons.h"
#include "editor/shell/theme.h"
#include "editor/shell/widgets.h"

namespace standpoint {

namespace {

void numberRow(const char* label, const char* id, double& value, float low, float high) {
  ui::propertyLabel(label);
  auto shown = static_cast<float>(value);
  if (ImGui::SliderFloat(id, &shown, low, high, "%.2f m", ImGuiSliderFlags_AlwaysClamp)) value = shown;
}

void drawDoors(Editor& editor, const CollideResult& result) {
  ui::heading(editor, "Doors");
  if (result.doors.empty()) {
    ui::dimText("The model has no doors.");
    return;
  }
  if (!ImGui::BeginTable("doors", 2, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg)) return;
  ImGui::TableSetupColumn("Door", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("State", ImGuiTableColumnFlags_WidthFixed, editor.px(110));
  for (std::size_t i = 0; i < result.doors.size(); ++i) {
    const auto& door = result.doors[i];
    ImGui::PushID(static_cast<int>(i));
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (ImGui::Selectable("###door", editor.selection.contains(door.product), ImGuiSelectableFlags_SpanAllColumns)) {
      editor.select(door.product, true);
      editor.frameSelection();
    }
    ImGui::SameLine(0, 0);
    ui::fitted(productLabel(editor.environment()->products[door.product]), ImGui::GetContentRegionAvail().x);
    ImGui::TableNextColumn();
    const auto tone = door.passable ? tone::kGood : door.floor ? tone::kBad : tone::kDim;
    const char* text = door.passable ? ICON_CHECK "  passable" : door.floor ? ICON_BAN "  blocked" : ICON_INFO "  no floor";
    ImGui::TextColored(colour(tone), "%s", text);
    ImGui::PopID();
  }
  ImGui::EndTable();
}

}  // namespace

void drawCollisionPanel(Editor& editor) {
  const auto& document = editor.session.document();
  if (!document.imported) {
    ui::emptyState(editor, ICON_WALK, "Nothing to walk on", "Import a model first.");
    return;
  }
  auto& state = editor.panels.collision;
  if (ui::beginProperties("agent", 0.42F)) {
    numberRow("Walker's radius", "###radius", state.agent_radius_m, 0.05F, 1.0F);
    numberRow("Walker's height", "###height", state.agent_height_m, 0.3F, 2.5F);
    ui::endProperties();
  }
  if (ui::primaryButton(ICON_CUBES "  Compute collision shapes###collide", editor.session.whyNot("collide"), {-FLT_MIN, 0})) {
    editor.session.start("collide", {{"agent-radius", state.agent_radius_m}, {"agent-height", state.agent_height_m}}, "Collision shapes");
    editor.view.walkable = true;
  }
  if (!document.collision) {
    ui::gap(editor);
    ui::emptyState(editor, ICON_WALK, "Not computed yet", "Shapes that a physics engine can use, the area that a person can reach, and which doors let one through.");
    return;
  }
  const auto& result = *document.collision;
  ui::heading(editor, "Result");
  std::size_t passable = 0;
  std::uint64_t triangles = 0;
  for (const auto& d : result.doors) passable += d.passable ? 1 : 0;
  for (const auto& s : result.shapes) triangles += s.mesh.triangles.size();
  if (ui::beginProperties("result", 0.5F)) {
    ui::property("Walkable area", fmt::format("{:.1f} m²", result.walkable_area_m2));
    ui::property("Doors passable", fmt::format("{} of {}", passable, result.doors.size()));
    ui::property("Shapes", fmt::format("{}, {} triangles", groupedDigits(result.shapes.size()), groupedDigits(triangles)));
    ui::endProperties();
  }
  ImGui::Checkbox("Show the walkable area", &editor.view.walkable);
  ImGui::Checkbox("Show the shapes instead of the model", &editor.view.shapes);
  drawDoors(editor, result);
}

}  // namespace standpoint
