// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/escape.h"

#include <imgui.h>
#include <imgui_internal.h>

#include "editor/model/walking.h"
#include "editor/shell/editor.h"
#include "editor/shell/import_preview.h"
#include "editor/widgets/keyboard.h"
#include "editor/widgets/modal.h"

namespace standpoint {

namespace {

const ImGuiPopupData* topPopup() {
  const auto& stack = ImGui::GetCurrentContext()->OpenPopupStack;
  return stack.empty() ? nullptr : &stack.back();
}

bool isModal(const ImGuiPopupData& popup) {
  return popup.Window != nullptr && (popup.Window->Flags & ImGuiWindowFlags_Modal) != 0;
}

bool isSubmenu(const ImGuiPopupData& popup) {
  return popup.Window != nullptr && (popup.Window->Flags & ImGuiWindowFlags_ChildMenu) != 0;
}

// The palette's own field is what the palette is, not an edit inside it.
bool inPalette(const Editor& editor) {
  const auto* top = topPopup();
  return editor.dialogs.palette.open && top != nullptr && !isModal(*top);
}

bool editsText(const Editor& editor) {
  const auto& g = *ImGui::GetCurrentContext();
  return g.ActiveId != 0 && g.InputTextState.ID == g.ActiveId && !inPalette(editor);
}

// A bar or a button that is held: the widget itself sees Esc, and puts back what it moved.
bool holdsWidget() { return ImGui::GetCurrentContext()->ActiveId != 0 && ImGui::IsAnyMouseDown(); }

bool dragsInView(const Editor& editor) {
  const auto& view = editor.view;
  return view.teleport.active() || view.dragged_station >= 0 || view.dragged_waypoint >= 0 ||
         view.handle != StationHandle::none || view.probe.dragged || view.clip.face >= 0 ||
         (view.dragging && view.dragged);
}

void endDrag(Editor& editor) {
  auto& view = editor.view;
  if (ImGui::GetCurrentContext()->DragDropActive) {
    ImGui::ClearDragDrop();
    ImGui::ClearActiveID();
  } else if (view.teleport.active()) {
    view.teleport = {};
  } else if (view.dragged_station >= 0) {
    view.dragged_station = -1;
  } else if (view.dragged_waypoint >= 0) {
    view.dragged_waypoint = -1;
  } else if (view.handle != StationHandle::none) {
    view.handle = StationHandle::none;
  } else if (view.probe.dragged) {
    view.probe.dragged = false;
    view.probe.position = view.probe.dragged_from;
  } else if (view.clip.face >= 0) {
    view.clip.box = view.clip.before;
    view.clip.face = -1;
  } else if (view.dragging && view.dragged) {
    view.dragging = false;
    if (view.tool != Tool::walk && view.tool != Tool::fly) view.camera = view.camera_before_drag;
  }
}

// A menu goes as a whole: the pointer rests on it, and would open what was closed again.
void closePopup(Editor& editor) {
  const auto& stack = ImGui::GetCurrentContext()->OpenPopupStack;
  int level = stack.Size - 1;
  while (level > 0 && isSubmenu(stack[level])) --level;
  ImGui::ClosePopupToLevel(level, true);
  editor.dialogs.palette.open = false;
}

void askForClick() {
  const auto* top = topPopup();
  if (top == nullptr || !isModal(*top) || !ImGui::IsMouseClicked(0) || !top->Window->WasActive) return;
  const ImVec2 p = ImGui::GetIO().MousePos;
  ImRect box = top->Window->Rect();
  box.Expand(6);  // where its edges can be pulled
  if (!box.Contains(p)) ui::askModalToGo(top->PopupId, true);
}

}  // namespace

EscapeLayer escapeLayer(const Editor& editor) {
  if (editsText(editor)) return EscapeLayer::text;
  if (ImGui::GetCurrentContext()->DragDropActive) return EscapeLayer::drag;
  if (const auto* top = topPopup()) return isModal(*top) ? EscapeLayer::modal : EscapeLayer::popup;
  if (dragsInView(editor) || holdsWidget()) return EscapeLayer::drag;
  if (editor.preview.isOpen()) return EscapeLayer::preview;
  if (editor.proof) return EscapeLayer::proof;
  if (editor.bearer_view.active()) return EscapeLayer::play;
  const auto tool = editor.view.tool;
  if (tool == Tool::walk || tool == Tool::fly || editor.walk_ground.preparing() || editor.fieldwork.at_screen)
    return EscapeLayer::walk;
  if (editor.view.tool != Tool::select) return EscapeLayer::tool;
  const auto& survey = editor.survey;
  const bool chosen = !editor.selection.empty() || survey.station >= 0 || survey.target >= 0 || survey.underlay >= 0 ||
                      survey.measurement >= 0 || survey.trajectory >= 0;
  return chosen ? EscapeLayer::selection : EscapeLayer::none;
}

void closeTopmost(Editor& editor) {
  askForClick();
  if (!keyboard::pressed(kKeyEscape)) return;
  switch (escapeLayer(editor)) {
    case EscapeLayer::text: return;  // the field sees the key itself
    case EscapeLayer::drag: return endDrag(editor);
    case EscapeLayer::popup: return closePopup(editor);
    case EscapeLayer::modal: return ui::askModalToGo(topPopup()->PopupId, false);
    case EscapeLayer::preview: return closePreview(editor);
    case EscapeLayer::proof: return editor.endProof();
    case EscapeLayer::play: editor.path_moment.plays = false; return;
    case EscapeLayer::tool:
    case EscapeLayer::walk:
    case EscapeLayer::selection:
    case EscapeLayer::none: return leaveTool(editor);
  }
}

void leaveTool(Editor& editor) {
  if (editor.walk_ground.preparing()) return giveUpWalk(editor);
  editor.view.refused_place.reset();
  editor.view.worst_place.reset();
  editor.visibility.endCutForSight();
  if (editor.fieldwork.at_screen) return lookUp(editor);
  if (editor.view.row_from) return editor.view.row_from.reset();  // the first end is chosen anew
  if (editor.view.tool == Tool::measure && !editor.view.measuring.points.empty())
    return editor.view.measuring.points.clear();  // begun anew
  if (editor.view.tool != Tool::select) {
    stopFlying(editor);
    stopWalking(editor);
    editor.view.tool = Tool::select;
    return;
  }
  editor.selection.clear();
  editor.survey = {};
}

}  // namespace standpoint
