// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "editor/model/station_steps.h"
#include "editor/model/trajectory_steps.h"
#include "editor/shell/actions.h"
#include "editor/shell/clip_handles.h"
#include "editor/shell/coverage_overlay.h"
#include "editor/shell/editor.h"
#include "editor/shell/expected_overlay.h"
#include "editor/shell/holes_overlay.h"
#include "editor/shell/inspect_tools.h"
#include "editor/shell/label_board.h"
#include "editor/shell/material_brush.h"
#include "editor/shell/moving.h"
#include "editor/shell/overlay.h"
#include "editor/shell/place_ghost.h"
#include "editor/shell/proof_view.h"
#include "editor/shell/row_overlay.h"
#include "editor/shell/scene_picture.h"
#include "editor/shell/shell.h"
#include "editor/shell/station_drag.h"
#include "editor/shell/station_handles.h"
#include "editor/shell/teleport.h"
#include "editor/shell/tour_card.h"
#include "editor/shell/trajectory_overlay.h"
#include "editor/shell/waypoint_drag.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/keyboard.h"
#include "editor/widgets/overlap.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "project/survey/survey_verbs.h"
#include "survey/stations/station_places.h"

namespace standpoint {

namespace {

constexpr float kClickSlack_px = 4;

Eigen::Vector2d pointer(ImVec2 origin) {
  const ImVec2 p = ImGui::GetIO().MousePos;
  return {p.x - origin.x, p.y - origin.y};
}

// The point that a drag turns around: what is under the pointer, else the camera's target.
void startDrag(Editor& editor, ImVec2 origin) {
  auto& view = editor.view;
  view.dragging = true;
  view.camera_before_drag = view.camera;
  view.dragged = false;
  constexpr double kReach_px = 6;
  std::optional<Eigen::Vector3d> under;
  if (view.hover)
    under = view.hover->position;
  else if (editor.cloud() || !editor.session.document().hasModel())
    if (const auto place = editor.measurableAt(pointer(origin), kReach_px)) under = place->position;
  view.pivot = under.value_or(view.camera.target);
  view.pivot_depth_m = std::max(0.1, (view.pivot - view.camera.eye()).dot(view.camera.forward()));
}

void continueDrag(Editor& editor) {
  auto& view = editor.view;
  const auto& io = ImGui::GetIO();
  const ImVec2 total0 = ImGui::GetMouseDragDelta(0, 0), total1 = ImGui::GetMouseDragDelta(1, 0),
               total2 = ImGui::GetMouseDragDelta(2, 0);
  const float moved =
      std::max({std::hypot(total0.x, total0.y), std::hypot(total1.x, total1.y), std::hypot(total2.x, total2.y)});
  if (moved > kClickSlack_px * editor.scale) view.dragged = true;
  if (!view.dragged || (io.MouseDelta.x == 0 && io.MouseDelta.y == 0)) return;
  const Eigen::Vector2d drag(io.MouseDelta.x, io.MouseDelta.y);
  if (view.tool == Tool::walk || view.tool == Tool::fly || looksFromStation(editor))
    return orbit(view.camera, (editor.settings.drag_turns_head ? drag : -drag) / editor.scale, view.camera.eye());
  if (io.MouseDown[0] && !io.KeyShift && !io.KeyAlt)  // Alt: for whoever has no middle button
    orbit(view.camera, drag / editor.scale, view.pivot);
  else
    pan(view.camera, drag, view.size, view.pivot_depth_m);
}

void placeStation(Editor& editor, const RayHit& hit) {
  const HeldStation held{"", kUsualHeight_m, Eigen::Quaterniond::Identity()};
  if (const auto verdict = verdictUnderPointer(editor, held); verdict.verdict == Verdict::bad)
    return refusePlace(editor, held, verdict);
  editor.view.typed_station.reset();
  const auto name = freeStationName(*editor.session.document().job);
  const Eigen::Vector3d p = hit.position + editor.shift_m();
  editor.session.start(StationOptions{.add = name, .on = FloorPlace{p.x(), p.y(), p.z()}}, trf("Add station {}", name));
  editor.survey_wanted = name;  // its numbers stand ready to be typed
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  editor.view.placed_at = Eigen::Vector2d(mouse.x, mouse.y);
}

// The first click is one end, the second the other.
void layRow(Editor& editor, const RayHit& hit) {
  auto& from = editor.view.row_from;
  if (from) {
    addRow(editor, hit.position);
    from.reset();
    return;
  }
  const HeldStation held{"", kUsualHeight_m, Eigen::Quaterniond::Identity()};
  if (const auto verdict = verdictUnderPointer(editor, held); verdict.verdict == Verdict::bad)
    return refusePlace(editor, held, verdict);
  from = hit.position;
}

void placeTarget(Editor& editor, const RayHit& hit) {
  const auto name = freeTargetName(editor.session.document().job.get());
  constexpr double kBefore_m = 0.05;  // says on which side of what was clicked it sticks
  const Eigen::Vector3d p = hit.position + hit.normal * kBefore_m + editor.shift_m();
  TargetOptions options{.add = name};
  options.on_surface = p;
  if (const auto* kinds = editor.target_list.kinds())
    options.type = kinds->articles[std::min(editor.view.target_article, kinds->articles.size() - 1)].id;
  editor.session.start(options, trf("Add target {}", name));
}

void layWay(Editor& editor, const RayHit& hit) {
  if (editor.on_way) editor.on_way(hit.position + editor.shift_m());
}

void addTrajectoryPlace(Editor& editor, const RayHit& hit) { addWaypoint(editor, hit); }

void click(Editor& editor) {
  const auto& hit = editor.view.hover;
  const bool add = ImGui::GetIO().KeyCtrl;
  void (*act)(Editor&, const RayHit&) = nullptr;
  switch (editor.view.tool) {
    case Tool::placeStation: act = placeStation; break;
    case Tool::placeRow: act = layRow; break;
    case Tool::placeTarget: act = placeTarget; break;
    case Tool::measure: return clickMeasure(editor);
    case Tool::pickWall: return clickWall(editor);
    case Tool::pickSection: return clickSection(editor);
    case Tool::takeMaterial: act = takeMaterial; break;
    case Tool::paintMaterial: act = paintMaterial; break;
    case Tool::layWay: act = layWay; break;
    case Tool::layTrajectory: act = addTrajectoryPlace; break;
    case Tool::walk: return clickWalking(editor);
    case Tool::fly: return;
    case Tool::select: break;
  }
  if (act != nullptr) {
    if (hit) act(editor, *hit);
    return;
  }
  if (hit && add)
    editor.selection.toggle(hit->product);
  else if (hit)
    editor.survey = {}, editor.select(hit->product, true);
  else if (!add)
    editor.selection.clear();
}

void contextMenu(Editor& editor) {
  if (!ImGui::BeginPopup("###viewport-menu")) return;
  const auto& hit = editor.view.hover;
  if (!editor.selection.empty() && editor.environment() &&
      editor.selection.primary() < editor.environment()->products.size())
    ui::dimText(productLabel(editor.environment()->products[editor.selection.primary()]));
  for (const char* id : {"frame", "hide", "isolate", "show-all"}) actionMenuItem(editor, id);
  ImGui::Separator();
  for (const char* id : {"assign-material", "exclude", "keep", "by-rules"}) actionMenuItem(editor, id);
  ImGui::Separator();
  const auto why = hit ? editor.session.whyNot("station") : "No surface under the pointer";
  if (ImGui::MenuItem(ui::Label(ICON_STATION "  Add station here###station-here"), nullptr, false, why.empty()))
    placeStation(editor, *hit);
  ui::tooltip(why);
  if (hit && ImGui::MenuItem(ui::Label(ICON_WALK "  Stand here###stand-here"))) teleport(editor, *hit);
  if (hit && expectedQuantity(editor.view.colour) &&
      ImGui::MenuItem(ui::Label(ICON_EYE "  Probe from here###probe-here")))
    putProbeOn(editor, hit->position);
  if (ImGui::MenuItem(ui::Label(ICON_TARGET "  Add target here###target-here"), nullptr, false, why.empty()))
    placeTarget(editor, *hit);
  ImGui::EndPopup();
}

void handleMouse(Editor& editor, ImVec2 origin, bool hovered) {
  auto& view = editor.view;
  const auto& io = ImGui::GetIO();
  if (!view.dragging && !ImGui::IsPopupOpen("###viewport-menu")) {
    view.hover.reset();
    view.door_hover.reset();
    const bool hidden = editor.cloud() && view.tool == Tool::select;  // what is not seen is not chosen
    if (hovered && !hidden && !editor.preview.isOpen() && !editor.proof) {
      const auto ray = rayThrough(view.camera, pointer(origin), view.size);
      const auto state = editor.viewState();
      view.hover = editor.picker.pick(ray, state);
      if (state.doors)
        view.door_hover =
            firstDoor(*state.doors, ray, view.hover ? view.hover->range_m : std::numeric_limits<double>::infinity());
    }
  }
  followInspectTools(editor, origin, hovered && !editor.preview.isOpen() && !editor.proof);
  if (!view.dragging && !editor.proof && aimTeleport(editor, hovered)) return;
  if (hovered && ImGui::IsMouseClicked(0)) view.refused_place.reset();
  if (view.dragging && !view.dragged && ImGui::IsMouseReleased(0) && !measures(editor)) view.worst_place.reset();
  if (hovered && !view.dragging && (ImGui::IsMouseClicked(0) || ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2)))
    startDrag(editor, origin);
  if (view.dragging) continueDrag(editor);
  const bool previewed = editor.preview.isOpen() || editor.proof;  // it can be turned and nothing else
  if (view.dragging && !view.dragged && ImGui::IsMouseReleased(0) && !previewed && !clickAfterTap(editor))
    click(editor);
  if (view.dragging && !view.dragged && ImGui::IsMouseReleased(1) && !previewed && !openStationMenu(editor, origin)) {
    if (view.hover && !editor.selection.contains(view.hover->product)) editor.select(view.hover->product, true);
    ImGui::OpenPopup("###viewport-menu");
  }
  if (hovered && ImGui::IsMouseDoubleClicked(0) && view.tool == Tool::select && !editor.proof) editor.frameSelection();
  if (view.dragging && !io.MouseDown[0] && !io.MouseDown[1] && !io.MouseDown[2]) view.dragging = false;
  if (hovered) handleWheel(editor, origin);
}

// What each level costs, one in each frame while somebody reads it.
void measureGraphics(Editor& editor, ImVec2 size) {
  if (!std::exchange(editor.costs_wanted, false) || editor.scene == nullptr || !editor.shown()) return;
  const auto level = editor.graphics.notMeasured();
  if (!level || !editor.graphics.means()) return;
  ViewState state = editor.viewState();
  state.graphics.level = *level;
  state.graphics.motion_size = 1;
  const ScreenPixels pixels = screenPixels(size);
  editor.graphics.measured(*level, editor.scene->cost_s(state, pixels.width, pixels.height));
}

// The original on the left, what was made of it on the right, through one camera. The half under the pointer is turned.
void drawBothModels(Editor& editor, ImVec2 origin, ImVec2 half) {
  const ImVec2 right(origin.x + half.x, origin.y);
  drawScene(editor.scene_beside, editor.originalState(), origin, half, editor.fine_picture);
  drawScene(editor.scene, editor.viewState(), right, half, editor.fine_picture);
  ImGui::GetWindowDrawList()->AddLine(right, {right.x, right.y + half.y}, IM_COL32(12, 14, 17, 255), editor.px(2));
  const auto& document = editor.session.document();
  drawCaption(editor, origin, half,
              trf("Original  {} triangles", groupedDigits(document.simplified->all.triangles_before)));
  drawCaption(editor, right, half,
              trf("Simplified  {} triangles", groupedDigits(document.simplified->all.triangles_after)));
}

}  // namespace

ScreenPixels screenPixels(ImVec2 size) {
  const float each = ImGui::GetIO().DisplayFramebufferScale.x > 0 ? ImGui::GetIO().DisplayFramebufferScale.x : 1;
  return {static_cast<int>(size.x * each), static_cast<int>(size.y * each)};
}

void drawScene(SceneView* scene, const ViewState& state, ImVec2 origin, ImVec2 size, bool fine) {
  const ScreenPixels pixels = screenPixels(size);
  const std::uint64_t texture = scene == nullptr ? 0 : scene->texture(state, pixels.width, pixels.height, fine);
  if (texture == 0) return;
  ImGui::GetWindowDrawList()->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture)), origin,
                                       {origin.x + size.x, origin.y + size.y}, {0, 1}, {1, 0});
}

void drawCaption(const Editor& editor, ImVec2 origin, ImVec2 size, const std::string& text) {
  const float room = size.x - editor.px(16);
  const ImVec2 extent = ImGui::CalcTextSize(text.c_str(), nullptr, false, room);
  const ImVec2 at(origin.x + (size.x - extent.x) / 2, origin.y + size.y - extent.y - editor.px(8));
  drawPlate(editor, at, extent);
  ImGui::GetWindowDrawList()->AddText(nullptr, 0, at, ImGui::GetColorU32(ImGuiCol_Text), text.c_str(), nullptr, room);
}

void drawViewport(Editor& editor) {
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const ImVec2 whole = ImGui::GetContentRegionAvail();
  if (whole.x < 16 || whole.y < 8) return;
  const bool proves = showsTwoClouds(editor);
  const bool both = proves || (editor.view.side == ModelSide::both && editor.session.document().simplified &&
                               !editor.preview.isOpen());
  const ImVec2 size = both ? ImVec2(whole.x / 2, whole.y) : whole;
  auto& view = editor.view;
  view.size = {size.x, size.y};
  if (view.frame_wanted) {
    frame(view.camera, editor.buildingBounds(), size.x / size.y);
    view.frame_wanted = false;
    editor.flight.settle(view.camera);
  }
  stepMoment(editor, ImGui::GetIO().DeltaTime);
  followBearer(editor, ImGui::GetIO().DeltaTime);
  if (editor.walk.active() || view.tool == Tool::fly || editor.bearer_view.active())
    editor.flight.settle(view.camera);
  else
    editor.flight.step(view.camera, ImGui::GetIO().DeltaTime);
  measureGraphics(editor, size);
  if (proves)
    drawTwoClouds(editor, origin, size);
  else if (both)
    drawBothModels(editor, origin, size);
  else
    drawScene(editor.scene, view.side == ModelSide::original ? editor.originalState() : editor.viewState(), origin,
              size, editor.fine_picture);
  const bool previewed = editor.preview.isOpen() || editor.proof;  // it can be turned and nothing else
  if (!previewed) drawExpected(editor, origin, size);
  if (!previewed) drawCoverage(editor, origin, size);
  if (!editor.shown()) {
    if (editor.preview.isOpen()) return;
    ui::emptyState(editor, ICON_CUBE, "No model yet", "Choose an exercise, or import a model (Ctrl+I).");
    return;
  }
  ImGui::SetCursorScreenPos(origin);
  ui::overlappable([&] {
    return ImGui::InvisibleButton(
        "###scene", whole,
        ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
  });
  if (!previewed) acceptMaterial(editor, origin);
  const bool hovered = ImGui::IsItemHovered() && !overOverlay(editor, origin, whole);
  const ImVec2 right(origin.x + size.x, origin.y);
  if (!view.dragging) view.in_right_half = both && ImGui::GetIO().MousePos.x >= right.x;
  const bool on_probe = !previewed && !view.dragging && dragProbe(editor, origin, hovered);
  editor.placement.follow(editor.picker.scene());
  const bool on_handle =
      !previewed && !on_probe && dragStationHandle(editor, view.in_right_half ? right : origin, hovered);
  const bool on_station =
      !previewed && !on_probe && !on_handle && dragStation(editor, view.in_right_half ? right : origin, hovered);
  const bool on_waypoint = !previewed && !on_probe && !on_handle && !on_station &&
                           dragWaypoint(editor, view.in_right_half ? right : origin, hovered);
  const bool on_clip = !previewed && !on_probe && !on_handle && !on_station && !on_waypoint &&
                       dragClip(editor, view.in_right_half ? right : origin, hovered);
  if (!on_probe && !on_handle && !on_station && !on_waypoint && !on_clip)
    handleMouse(editor, view.in_right_half ? right : origin, hovered);
  handleMoving(editor);
  if (view.dragging || ImGui::GetIO().MouseWheel != 0 || ImGui::GetIO().MouseWheelH != 0)
    editor.flight.settle(view.camera);
  if (editor.proof && !editor.preview.isOpen()) {
    drawProofPlace(editor, origin, whole);
    drawOverlay(editor, origin, whole);
  }
  if (previewed) return;
  drawExpectedLegend(editor, origin, size);
  drawCoverageLegend(editor, origin, size);
  LabelBoard labels(both ? right : origin, size, editor.scale);
  drawMarkers(editor, both ? right : origin, labels);
  drawHolesLegend(editor, both ? right : origin, size, hovered);
  drawClip(editor, both ? right : origin);
  drawInspectMarks(editor, both ? right : origin, labels);
  labels.keepFree(origin, controlsCorner(editor, origin));
  const auto& legend = editor.legend_size;
  if (legend.y() > 0)
    labels.keepFree({origin.x, origin.y + size.y - legend.y()}, {origin.x + legend.x(), origin.y + size.y});
  const auto pointer = hovered ? std::optional(ImGui::GetIO().MousePos) : std::nullopt;
  editor.pointed_label = labels.draw(*ImGui::GetWindowDrawList(), editor.label_layout, pointer);
  if (editor.pointed_label && !view.dragging) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  drawOverlay(editor, origin, whole);
  drawStationHandles(editor, both ? right : origin);
  drawRow(editor, both ? right : origin);
  drawNextWaypoint(editor, both ? right : origin);
  drawPlaceGhost(editor, both ? right : origin, size);
  drawTeleport(editor, both ? right : origin, hovered);
  drawTightPlaces(editor, both ? right : origin);
  drawTour(editor, origin, whole);
  contextMenu(editor);
  drawStationMenu(editor);
  drawMaterialMenu(editor);
}

}  // namespace standpoint
