// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/number_text.h"
#include "emulated-ui/device/numbers.h"
#include "emulated-ui/draw/pen.h"

namespace standpoint {

ImVec2 screenAt(const Pen& pen) {
  ImGui::SetCursorPosX(pen.left);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  return at;
}

bool area(const char* id, ImVec2 at, ImVec2 size) {
  ImGui::SetCursorScreenPos(at);
  return ImGui::InvisibleButton(id, size);
}

namespace {

constexpr float kHold_s = 0.5F, kShowsRing_s = 0.12F;

void holdRing(const Pen& pen, float share) {
  ImDrawList* list = ImGui::GetForegroundDrawList();
  const ImVec2 at = ImGui::GetIO().MousePos;
  constexpr float kTop = -std::numbers::pi_v<float> / 2;
  const float r = 1.9F * pen.unit;
  list->AddCircle(at, r, IM_COL32(0, 0, 0, 90), 40, pen.hair(5));
  list->PathArcTo(at, r, kTop, kTop + share * 2 * std::numbers::pi_v<float>);
  list->PathStroke(IM_COL32(255, 178, 0, 255), 0, pen.hair(4));
}

}  // namespace

bool isHeldAtOnce() {
  if (!ImGui::IsItemHovered()) return false;
  const bool by_keys = ImGui::GetIO().KeyShift && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false);
  return by_keys || ImGui::IsMouseClicked(ImGuiMouseButton_Right);
}

bool isHeld(Pen& pen) {
  auto& view = pen.view;
  const auto& io = ImGui::GetIO();
  if (isHeldAtOnce()) return true;
  if (view.held || !ImGui::IsItemActive() || !ImGui::IsItemHovered() || !io.MouseDown[ImGuiMouseButton_Left])
    return false;
  const float moved = 0.6F * pen.unit, down_s = io.MouseDownDuration[ImGuiMouseButton_Left];
  if (io.MouseDragMaxDistanceSqr[ImGuiMouseButton_Left] > moved * moved) return false;
  if (down_s < kHold_s) {
    if (down_s > kShowsRing_s) holdRing(pen, (down_s - kShowsRing_s) / (kHold_s - kShowsRing_s));
    return false;
  }
  return true;
}

void touch(Pen& pen, const Widget& w, const char* id, ImVec2 at, ImVec2 size, const std::string& value) {
  if (area(id, at, size)) pen.pressed(w.id, value);
  if (!w.takes(Gesture::hold) || !isHeld(pen)) return;
  pen.pressed(w.id, value, Gesture::hold);
  pen.view.held = true;
}

void tip(const std::string& text) {
  if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  const float pad = 0.5F * ImGui::GetFontSize();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {pad, pad});
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(20 * ImGui::GetFontSize());
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
  ImGui::PopStyleVar();
}

void centred(ImDrawList* list, ImVec2 at, ImVec2 size, ImU32 colour, const std::string& text) {
  const ImVec2 text_size = ImGui::CalcTextSize(text.c_str());
  list->PushClipRect(at, {at.x + size.x, at.y + size.y}, true);
  list->AddText({at.x + std::max(2.0F, (size.x - text_size.x) / 2), at.y + (size.y - text_size.y) / 2}, colour,
                text.c_str());
  list->PopClipRect();
}

ImU32 faded(ImU32 colour, bool enabled) { return enabled ? colour : (colour & 0x00FFFFFFU) | 0x60000000U; }

void frame(const Pen& pen, const Widget& w, ImVec2 at, ImVec2 size) {
  if (pen.view.pointed != w.id) return;
  const float off = pen.hair(3);
  ImGui::GetWindowDrawList()->AddRect({at.x - off, at.y - off}, {at.x + size.x + off, at.y + size.y + off},
                                      IM_COL32(255, 178, 0, 255), pen.skin.rounding * pen.unit, 0, off);
}

float wrappedHeight(const std::string& text, float width) {
  return ImGui::CalcTextSize(text.c_str(), nullptr, false, std::max(1.0F, width)).y;
}

void wrapped(ImVec2 at, float width, ImU32 colour, const std::string& text) {
  ImGui::GetWindowDrawList()->AddText(nullptr, 0, at, colour, text.c_str(), nullptr, std::max(1.0F, width));
}

void caption(const Pen& pen, const std::string& text) {
  const ImVec2 at = screenAt(pen);
  const float inset = 0.4F * pen.unit;
  wrapped({at.x + inset, at.y}, pen.width - 2 * inset, pen.skin.dim, text);
  ImGui::Dummy({0, wrappedHeight(text, pen.width - 2 * inset)});
}

namespace {

// In as many columns as the widest option allows, so that nine resolutions do not become nine rows.
void choice(Pen& pen, const Widget& w) {
  caption(pen, w.label);
  const float gap = 0.3F * pen.unit;
  float widest = 1;
  for (const auto& option : w.options)
    widest = std::max(widest, ImGui::CalcTextSize(option.label.c_str()).x + 1.6F * pen.unit);
  const int count = static_cast<int>(w.options.size());
  int columns = std::clamp(static_cast<int>((pen.width + gap) / (widest + gap)), 1, std::max(1, count));
  if (count > columns)
    columns = (count + (count + columns - 1) / columns - 1) /
              ((count + columns - 1) / columns);  // rows of about the same length
  const float width = (pen.width - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns),
              height = 0.9F * pen.touch();
  const ImVec2 at = screenAt(pen);
  ImDrawList* list = ImGui::GetWindowDrawList();
  ImGui::PushID(w.id.c_str());
  for (int i = 0; i < count; ++i) {
    const auto& option = w.options[i];
    const ImVec2 from{at.x + static_cast<float>(i % columns) * (width + gap),
                      at.y + static_cast<float>(i / columns) * (height + gap)};
    const bool enabled = w.enabled && option.enabled;
    if (area(option.value.c_str(), from, {width, height})) pen.pressed(w.id, option.value);
    const bool hovered = ImGui::IsItemHovered() && enabled;
    tip(option.why_not);
    const bool chosen = option.label == w.value;
    list->AddRectFilled(from, {from.x + width, from.y + height},
                        chosen    ? pen.skin.accent
                        : hovered ? pen.skin.tile_hover
                                  : pen.skin.tile,
                        pen.skin.rounding * pen.unit);
    if (!chosen)
      list->AddRect(from, {from.x + width, from.y + height}, pen.skin.line, pen.skin.rounding * pen.unit, 0,
                    pen.hair());
    centred(list, from, {width, height}, chosen ? pen.skin.accent_text : faded(pen.skin.tile_text, enabled),
            option.label);
  }
  ImGui::PopID();
  const auto rows = static_cast<float>((count + columns - 1) / columns);
  frame(pen, w, at, {pen.width, rows * (height + gap) - gap});
  ImGui::SetCursorScreenPos({at.x, at.y + rows * (height + gap)});
  ImGui::Dummy({0, 0});
}

// What was pressed on the keyboard of the screen, as if it were typed.
int takeKeys(ImGuiInputTextCallbackData* data) {
  auto& typed = *static_cast<std::string*>(data->UserData);
  for (const char key : typed) {
    const bool replaces = data->HasSelection();
    if (replaces) {
      const int from = std::min(data->SelectionStart, data->SelectionEnd);
      data->DeleteChars(from, std::max(data->SelectionStart, data->SelectionEnd) - from);
    }
    if (key != '\b') {
      data->InsertChars(data->CursorPos, &key, &key + 1);
    } else if (!replaces && data->CursorPos > 0) {
      int bytes = 1;
      while (bytes < data->CursorPos && (data->Buf[data->CursorPos - bytes] & 0xC0) == 0x80) ++bytes;  // of one letter
      data->DeleteChars(data->CursorPos - bytes, bytes);
    }
  }
  typed.clear();
  return 0;
}

// The field, and the keyboard below it while it is edited. A press on the keyboard is not one beside the field.
bool typedField(Pen& pen, const Widget& w, std::string& text, bool number) {
  auto& keyboard = pen.view.keyboard;
  auto& io = ImGui::GetIO();
  bool &clicked = io.MouseClicked[ImGuiMouseButton_Left], &down = io.MouseDown[ImGuiMouseButton_Left];
  const bool edited = keyboard.field == w.id, was_clicked = clicked, was_down = down;
  if (edited && keyboardIsPressed(pen)) clicked = down = false;
  const auto flags =
      ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll | ImGuiInputTextFlags_CallbackAlways;
  const bool entered = ImGui::InputText(("###" + w.id).c_str(), &text, flags, takeKeys, &keyboard.typed);
  clicked = was_clicked, down = was_down;
  if (edited && keyboard.fresh) ImGui::SetScrollHereY();
  if (edited) keyboard.fresh = false;
  if (!ImGui::IsItemActive()) return entered;
  pen.editing = true;
  if (!edited && !ImGui::IsMouseDown(ImGuiMouseButton_Left))  // else it would come up below the finger
    keyboard = {w.id, number ? KeyPage::figures : KeyPage::letters, true, {}};
  return entered;
}

// The device reads plain figures: "2,5" and "1+1,5" are brought into that form, and what is no number stays as it is.
std::string plainFigures(const std::string& text, const std::string& unit) {
  if (numberIn(text)) return text;
  const auto number = numberFromText(text, {.unit = unit});
  return number ? exactText(*number) : text;
}

// What is typed is taken over when the field is left or Enter is pressed.
void entry(Pen& pen, const Widget& w, bool number) {
  caption(pen, w.unit.empty() ? w.label : w.label + " (" + w.unit + ")");
  const ImVec2 at = screenAt(pen);
  const float buttons = number ? 2 * (pen.touch() + 0.3F * pen.unit) : 0;
  ImGui::SetNextItemWidth(pen.width - buttons);
  ImGui::PushStyleColor(ImGuiCol_FrameBg, pen.skin.tile);
  ImGui::PushStyleColor(ImGuiCol_Text, pen.skin.tile_text);
  ImGui::PushStyleColor(ImGuiCol_Border, pen.skin.line);
  ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, pen.hair());
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.8F * pen.unit, (pen.touch() - ImGui::GetTextLineHeight()) / 2});
  const auto typing = pen.view.typing.find(w.id);
  std::string text = typing == pen.view.typing.end() ? w.value : typing->second;
  const bool entered = typedField(pen, w, text, number);
  if (ImGui::IsItemActive()) pen.view.typing[w.id] = text;
  if (entered || ImGui::IsItemDeactivated()) {
    if (text != w.value) pen.pressed(w.id, number ? plainFigures(text, w.unit) : text);
    pen.view.typing.erase(w.id);
  }
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor(3);
  if (number) {
    for (int i = 0; i < 2; ++i) {
      const ImVec2 from{
          at.x + pen.width - buttons + 0.3F * pen.unit + static_cast<float>(i) * (pen.touch() + 0.3F * pen.unit), at.y};
      const auto next = stepped(w.value, i == 0 ? -1 : 1, w.minimum, w.maximum);
      if (area((w.id + (i == 0 ? "-" : "+")).c_str(), from, {pen.touch(), pen.touch()})) pen.pressed(w.id, next);
      ImDrawList* list = ImGui::GetWindowDrawList();
      list->AddRectFilled(from, {from.x + pen.touch(), from.y + pen.touch()},
                          ImGui::IsItemHovered() ? pen.skin.tile_hover : pen.skin.tile, pen.skin.rounding * pen.unit);
      list->AddRect(from, {from.x + pen.touch(), from.y + pen.touch()}, pen.skin.line, pen.skin.rounding * pen.unit, 0,
                    pen.hair());
      centred(list, from, {pen.touch(), pen.touch()}, pen.skin.tile_text, i == 0 ? "−" : "+");
    }
  }
  frame(pen, w, at, {pen.width, pen.touch()});
  ImGui::SetCursorScreenPos({at.x, at.y + pen.touch() + 0.4F * pen.unit});
  ImGui::Dummy({0, 0});
}

void progress(Pen& pen, const Widget& w) {
  const float height = 0.9F * pen.unit;
  const ImVec2 at = screenAt(pen);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(at, {at.x + pen.width, at.y + height}, pen.skin.line, height / 2);
  const float fraction = std::clamp(static_cast<float>(w.number), 0.0F, 1.0F);
  if (fraction > 0)
    list->AddRectFilled(at, {at.x + std::max(height, fraction * pen.width), at.y + height}, pen.skin.accent,
                        height / 2);
  const float width = ImGui::CalcTextSize(w.value.c_str()).x;
  list->AddText({at.x + pen.width - width, at.y + height + 0.2F * pen.unit}, pen.skin.text, w.value.c_str());
  ImGui::Dummy({0, height + ImGui::GetTextLineHeight() + 0.4F * pen.unit});
}

void paragraph(const Pen& pen, const std::string& text) {
  ImGui::SetCursorPosX(pen.left + 0.4F * pen.unit);
  ImGui::PushTextWrapPos(pen.left + pen.width - 0.4F * pen.unit);
  ImGui::PushStyleColor(ImGuiCol_Text, pen.skin.text);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
  ImGui::PopTextWrapPos();
  ImGui::Dummy({0, 0.3F * pen.unit});
}

}  // namespace

void drawWidget(Pen& pen, const Widget& w) {
  switch (w.kind) {
    case WidgetKind::status:
    case WidgetKind::lamp: return;  // the title bar and the body have them
    case WidgetKind::readout: return drawReadout(pen, w);
    case WidgetKind::button: return drawTile(pen, w);
    case WidgetKind::key: return drawBigKey(pen, w);
    case WidgetKind::choice: return choice(pen, w);
    case WidgetKind::toggle: return drawToggle(pen, w);
    case WidgetKind::text: return entry(pen, w, false);
    case WidgetKind::number: return entry(pen, w, true);
    case WidgetKind::list: return drawRows(pen, w);
    case WidgetKind::progress: return progress(pen, w);
    case WidgetKind::note: return paragraph(pen, w.label);
    case WidgetKind::level: return drawLevel(pen, w);
    case WidgetKind::area: return drawArea(pen, w);
    case WidgetKind::preview: return drawPreview(pen, w);
    case WidgetKind::plan: return drawPlan(pen, w);
    case WidgetKind::seen: return drawSeen(pen, w);
  }
}

}  // namespace standpoint
