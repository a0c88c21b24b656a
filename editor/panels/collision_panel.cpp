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

void selectable(Editor& editor, std::uint32_t product) {
  if (ImGui::Selectable("###row", editor.selection.contains(product),
                        ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap)) {
    editor.select(product, true);
    editor.frameSelection();
  }
  ImGui::SameLine(0, 0);
  ui::fitted(productLabel(editor.environment()->products[product]), ImGui::GetContentRegionAvail().x);
}

bool beginRows(Editor& editor, const char* id, const char* title, std::size_t rows) {
  const float height = ImGui::GetTextLineHeightWithSpacing() * static_cast<float>(std::min<std::size_t>(rows, 8) + 1);
  if (!ImGui::BeginTable(id, 2, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg, {0, height})) return false;
  ImGui::TableSetupColumn(title, ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("State", ImGuiTableColumnFlags_WidthFixed, editor.px(128));
  return true;
}

void beginRow(int id) {
  ImGui::PushID(id);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
}

void drawDoors(Editor& editor, const CollideResult& result) {
  ui::heading(editor, "Doors");
  if (result.doors.empty()) {
    ui::dimText("The model has no doors.");
    return;
  }
  auto& state = editor.panels.collision;
  if (!beginRows(editor, "doors", "Door", result.doors.size())) return;
  for (std::size_t i = 0; i < result.doors.size(); ++i) {
    const auto& door = result.doors[i];
    const auto& id = editor.environment()->products[door.product].id;
    beginRow(static_cast<int>(i));
    if (state.doors == 2) {
      bool closed = state.closed.contains(id);
      if (ImGui::Checkbox("###closed", &closed)) closed ? void(state.closed.insert(id)) : void(state.closed.erase(id));
      ui::tooltip("Treat as closed when collision shapes are next computed");
      ImGui::SameLine();
    }
    selectable(editor, door.product);
    ImGui::TableNextColumn();
    const auto tone = door.closed                                           ? tone::kDim
                      : !door.floor || (door.passable && !door.led_through) ? tone::kWarning
                      : door.passable                                       ? tone::kGood
                                                                            : tone::kBad;
    const auto text = door.closed                          ? std::string(ICON_STOP "  closed")
                      : !door.floor                        ? std::string(ICON_INFO "  no floor")
                      : door.passable && !door.led_through ? std::string(ICON_INFO "  not connected")
                      : door.passable ? fmt::format("{}  {:.2f} m clear", ICON_CHECK, door.clear_width_m)
                                      : fmt::format("{}  {:.2f} m clear", ICON_BAN, door.clear_width_m);
    ImGui::TextColored(colour(tone), "%s", text.c_str());
    ImGui::PopID();
  }
  ImGui::EndTable();
}

void drawRooms(Editor& editor, const CollideResult& result) {
  if (result.rooms.empty()) return;
  ui::heading(editor, "Rooms");
  if (!beginRows(editor, "rooms", "Room", result.rooms.size())) return;
  for (std::size_t i = 0; i < result.rooms.size(); ++i) {
    const auto& room = result.rooms[i];
    beginRow(static_cast<int>(i));
    selectable(editor, room.product);
    ImGui::TableNextColumn();
    const char* text = room.reached           ? ICON_CHECK "  reached"
                       : room.walkable_m2 > 0 ? ICON_BAN "  not reachable"
                                              : ICON_INFO "  no floor";
    ImGui::TextColored(colour(room.reached           ? tone::kGood
                              : room.walkable_m2 > 0 ? tone::kBad
                                                     : tone::kWarning),
                       "%s", text);
    ImGui::PopID();
  }
  ImGui::EndTable();
}

// The options of the verb that the panel's fields stand for.
nlohmann::json options(const CollisionPanelState& state) {
  constexpr const char* kDoors[] = {"open", "closed", "as-set"};
  nlohmann::json result = {
      {"agent-radius", state.agent_radius_m}, {"agent-height", state.agent_height_m}, {"doors", kDoors[state.doors]}};
  if (state.doors == 2) result["closed"] = state.closed;
  return result;
}

}  // namespace

void drawCollisionPanel(Editor& editor) {
  const auto& document = editor.session.document();
  if (!document.imported) {
    ui::emptyState(editor, ICON_WALK, "No walkable surface", "Import a model first.");
    return;
  }
  auto& state = editor.panels.collision;
  if (ui::beginProperties("agent", 0.42F)) {
    numberRow("Agent radius", "###radius", state.agent_radius_m, 0.05F, 1.0F);
    numberRow("Agent height", "###height", state.agent_height_m, 0.3F, 2.5F);
    ui::propertyLabel("Doors");
    ImGui::Combo("###doors", &state.doors, "open\0closed\0individual\0");
    ui::endProperties();
  }
  if (ui::primaryButton(ICON_CUBES "  Compute collision shapes###collide", editor.session.whyNot("collide"),
                        {-FLT_MIN, 0})) {
    editor.session.start("collide", options(state), "Collision shapes");
    editor.view.walkable = true;
  }
  if (!document.collision) {
    ui::gap(editor);
    ui::emptyState(editor, ICON_WALK, "Not computed yet",
                   "Compute shapes for physics engines, the area a person can reach, and passable doors.");
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
    ui::property("Shapes",
                 fmt::format("{}, {} triangles", groupedDigits(result.shapes.size()), groupedDigits(triangles)));
    ui::endProperties();
  }
  ImGui::Checkbox("Show the walkable area", &editor.view.walkable);
  ImGui::Checkbox("Show the shapes instead of the model", &editor.view.shapes);
  drawDoors(editor, result);
  drawRooms(editor, result);
}

}  // namespace standpoint
