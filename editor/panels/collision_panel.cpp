// SPDX-License-Identifier: GPL-3.0-or-later
#include <set>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/words.h"
#include "project/model/model_verbs.h"

namespace standpoint {

namespace {

struct CollisionState {
  DoorState doors = DoorState::open;
  std::set<std::string> closed;  // ids of the doors that stand closed, where each is set
};

void numberRow(const char* label, const char* id, double& value, double low, double high) {
  ui::propertyLabel(label);
  ui::numberSlider(id, value, low, high, {.kind = {.unit = "m", .least = low, .most = high}, .decimals = 2});
}

void selectable(const Model& model, Actions& actions, std::uint32_t product) {
  if (ImGui::Selectable("###row", model.selection.contains(product),
                        ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap)) {
    actions.reveal(product);
    actions.showSelection();
  }
  ImGui::SameLine(0, 0);
  ui::fitted(productLabel(model.environment()->products[product]), ImGui::GetContentRegionAvail().x);
}

bool beginRows(const Model& model, const char* id, const char* title, std::size_t rows) {
  const float height = ImGui::GetTextLineHeightWithSpacing() * static_cast<float>(std::min<std::size_t>(rows, 8) + 1);
  if (!ImGui::BeginTable(id, 2, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg, {0, height})) return false;
  ImGui::TableSetupColumn(ui::Label(title), ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn(ui::Label("State"), ImGuiTableColumnFlags_WidthFixed, model.px(150));
  return true;
}

void beginRow(int id) {
  ImGui::PushID(id);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
}

std::string stateOf(const Door& door) {
  if (door.closed) return tr("closed");
  if (!door.floor) return tr("no floor");
  return door.passable && !door.led_through ? tr("not connected") : trf("{:.2f} m clear", door.clear_width_m);
}

std::string stateOf(const Model& model, const Room& room) {
  if (room.tight_place) return tightPlaceName(*room.tight_place, model.walker);
  return room.reached ? tr("reached") : room.walkable_m2 > 0 ? tr("not reachable") : tr("no floor");
}

template <class Row, class State>
TableRows tableOf(const Model& model, const char* title, const std::vector<Row>& rows, const State& state) {
  TableRows table = {{tr(title), tr("State")}};
  for (const auto& row : rows) table.push_back({productLabel(model.environment()->products[row.product]), state(row)});
  return table;
}

void drawDoors(const Model& model, CollisionState& state, Actions& actions, const CollideResult& result) {
  ui::heading(model, "Doors");
  if (result.doors.empty()) {
    ui::dimText("The model has no doors.");
    return;
  }
  ui::copyTable("doors",
                [&] { return tableOf(model, "Door", result.doors, [](const auto& d) { return stateOf(d); }); });
  if (!beginRows(model, "doors", "Door", result.doors.size())) return;
  for (std::size_t i = 0; i < result.doors.size(); ++i) {
    const auto& door = result.doors[i];
    const auto& id = model.environment()->products[door.product].id;
    beginRow(static_cast<int>(i));
    if (state.doors == DoorState::as_set) {
      bool closed = state.closed.contains(id);
      if (ui::checkbox("###closed", &closed)) closed ? void(state.closed.insert(id)) : void(state.closed.erase(id));
      ui::tooltip("Treat as closed when collision shapes are next computed");
      ImGui::SameLine();
    }
    selectable(model, actions, door.product);
    ImGui::TableNextColumn();
    const auto tone = door.closed                                           ? tone::kDim
                      : !door.floor || (door.passable && !door.led_through) ? tone::kWarning
                      : door.passable                                       ? tone::kGood
                                                                            : tone::kBad;
    const auto text = door.closed                          ? tr(ICON_STOP "  closed")
                      : !door.floor                        ? tr(ICON_INFO "  no floor")
                      : door.passable && !door.led_through ? tr(ICON_INFO "  not connected")
                      : door.passable                      ? trf("{}  {:.2f} m clear", ICON_CHECK, door.clear_width_m)
                                                           : trf("{}  {:.2f} m clear", ICON_BAN, door.clear_width_m);
    ImGui::TextColored(colour(tone), "%s", text.c_str());
    ImGui::PopID();
  }
  ImGui::EndTable();
}

// What is in the way, and the way to it.
void drawTightPlace(const Model& model, Actions& actions, const TightPlace& place) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour(tone::kBad));
  const auto name = tightPlaceName(place, model.walker);
  if (ImGui::SmallButton(fmt::format("{}  {}###tight-place", ICON_CROSSHAIRS, name).c_str()))
    actions.flyTo(place.position);
  ImGui::PopStyleColor();
  ui::tooltip(trf("Not reachable: {} on the way; {}. Click to see the place", name, whoPasses(place)));
}

void drawRooms(const Model& model, Actions& actions, const CollideResult& result) {
  if (result.rooms.empty()) return;
  ui::heading(model, "Rooms");
  ui::copyTable("rooms",
                [&] { return tableOf(model, "Room", result.rooms, [&](const auto& r) { return stateOf(model, r); }); });
  if (!beginRows(model, "rooms", "Room", result.rooms.size())) return;
  for (std::size_t i = 0; i < result.rooms.size(); ++i) {
    const auto& room = result.rooms[i];
    beginRow(static_cast<int>(i));
    selectable(model, actions, room.product);
    ImGui::TableNextColumn();
    if (room.tight_place) {
      drawTightPlace(model, actions, *room.tight_place);
      ImGui::PopID();
      continue;
    }
    const char* text = room.reached           ? ICON_CHECK "  reached"
                       : room.walkable_m2 > 0 ? ICON_BAN "  not reachable"
                                              : ICON_INFO "  no floor";
    ImGui::TextColored(colour(room.reached           ? tone::kGood
                              : room.walkable_m2 > 0 ? tone::kBad
                                                     : tone::kWarning),
                       "%s", tr(text).c_str());
    ImGui::PopID();
  }
  ImGui::EndTable();
}

// The options of the verb that the panel's fields stand for.
CollideVerbOptions options(const Model& model, const CollisionState& state) {
  CollideVerbOptions result{
      .agent_radius_m = model.walker.radius_m, .agent_height_m = model.walker.height_m, .doors = state.doors};
  if (state.doors == DoorState::as_set) result.closed.assign(state.closed.begin(), state.closed.end());
  return result;
}

void draw(const Model& model, CollisionState& state, Actions& actions) {
  const auto& document = model.session.document();
  if (!document.imported) {
    ui::emptyState(model, ICON_WALK, "No walkable surface", "Import a model first.");
    return;
  }
  if (ui::beginProperties("agent", 0.42F)) {
    Body walker = model.walker;
    numberRow("Agent radius", "###radius", walker.radius_m, 0.05, 1);
    numberRow("Agent height", "###height", walker.height_m, 0.3, 2.5);
    actions.set(walker);
    ui::propertyLabel("Doors");
    auto doors = static_cast<int>(state.doors);
    const std::array<std::string, 3> states = {tr("open"), tr("closed"), tr("individual")};
    if (ui::beginDropDown("###doors", states[static_cast<std::size_t>(doors)].c_str())) {
      for (int i = 0; i < 3; ++i)
        if (ui::choice(states[static_cast<std::size_t>(i)].c_str(), i == doors))
          state.doors = static_cast<DoorState>(i);
      ui::endDropDown();
    }
    ui::endProperties();
  }
  if (ui::primaryButton(ICON_CUBES "  Compute collision shapes###collide", model.session.whyNot("collide"),
                        {-FLT_MIN, 0})) {
    actions.start(options(model, state), "Collision shapes");
    actions.showWalkable(true);
  }
  if (!document.collision) {
    ui::gap(model);
    ui::emptyState(model, ICON_WALK, "Not computed yet",
                   "Compute shapes for physics engines, the area a person can reach, and passable doors.");
    return;
  }
  const auto& result = *document.collision;
  ui::heading(model, "Result");
  std::size_t passable = 0;
  std::uint64_t triangles = 0;
  for (const auto& d : result.doors) passable += d.passable ? 1 : 0;
  for (const auto& s : result.shapes) triangles += s.mesh.triangles.size();
  if (ui::beginProperties("result", 0.5F)) {
    ui::property("Walkable area", figures("{:.1f} m²", result.walkable_area_m2));
    ui::property("Doors passable", trf("{} of {}", passable, result.doors.size()));
    ui::property("Shapes", trf("{}, {} triangles", groupedDigits(result.shapes.size()), groupedDigits(triangles)));
    ui::endProperties();
  }
  bool walkable = model.view.walkable, shapes = model.view.shapes;
  if (ui::checkbox(ui::Label("Show the walkable area"), &walkable)) actions.showWalkable(walkable);
  if (ui::checkbox(ui::Label("Show the shapes instead of the model"), &shapes)) actions.showShapes(shapes);
  drawDoors(model, state, actions, result);
  drawRooms(model, actions, result);
}

}  // namespace

void drawCollisionPanel(const Model& model, PanelStates& states, Actions& actions) {
  draw(model, states.of<CollisionState>(), actions);
}

}  // namespace standpoint
