// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "emulated-ui/draw/pen.h"

namespace standpoint {

ImVec2 screenAt(const Pen& pen) {
  ImGui::SetCursorPosX(pen.left);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  return at;
}

bool area(Pen& pen, const char* id, ImVec2 at, ImVec2 size, bool enabled) {
  ImGui::SetCursorScreenPos(at);
  ImGui::BeginDisabled(!enabled && !pen.view.asking);
  const bool pressed = ImGui::InvisibleButton(id, size);
  ImGui::EndDisabled();
  return pressed;
}

void reasonOf(const Widget& w) {
  if (!w.why_not.empty() && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) ImGui::SetTooltip("%s", w.why_not.c_str());
}

void centred(ImDrawList* list, ImVec2 at, ImVec2 size, ImU32 colour, const std::string& text) {
  const ImVec2 text_size = ImGui::CalcTextSize(text.c_str());
  list->PushClipRect(at, {at.x + size.x, at.y + size.y}, true);
  list->AddText({at.x + std::max(2.0F, (size.x - text_size.x) / 2), at.y + (size.y - text_size.y) / 2}, colour, text.c_str());
  list->PopClipRect();
}

namespace {

ImU32 faded(ImU32 colour, bool enabled) { return enabled ? colour : (colour & 0x00FFFFFFU) | 0x60000000U; }

void frame(const Pen& pen, const Widget& w, ImVec2 at, ImVec2 size) {
  if (pen.view.pointed == w.id)
    ImGui::GetWindowDrawList()->AddRect({at.x - 3, at.y - 3}, {at.x + size.x + 3, at.y + size.y + 3}, IM_COL32(255, 178, 0, 255), pen.skin.rounding * pen.unit, 0, 3);
}

// Label on the left, value on the right, a mark where it opens a screen.
void tile(Pen& pen, const Widget& w, const std::string& id, const std::string& value, const std::string& label, const std::string& shown, bool enabled, bool opens) {
  const ImVec2 size{pen.width, pen.touch()};
  const ImVec2 at = screenAt(pen);
  ImDrawList* list = ImGui::GetWindowDrawList();
  if (area(pen, id.c_str(), at, size, enabled)) pen.pressed(w.id, value);
  const bool hovered = ImGui::IsItemHovered() && enabled;
  reasonOf(w);
  const float rounding = pen.skin.rounding * pen.unit;
  list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, hovered ? pen.skin.tile_hover : pen.skin.tile, rounding);
  list->AddRect(at, {at.x + size.x, at.y + size.y}, pen.skin.line, rounding);
  const float line = ImGui::GetTextLineHeight(), y = at.y + (size.y - line) / 2, inset = 0.8F * pen.unit;
  float right = at.x + size.x - inset;
  if (opens) {
    const float s = 0.35F * pen.unit;
    list->AddPolyline(std::array<ImVec2, 3>{ImVec2{right - s, at.y + size.y / 2 - s}, ImVec2{right, at.y + size.y / 2}, ImVec2{right - s, at.y + size.y / 2 + s}}.data(), 3,
                      faded(pen.skin.dim, enabled), 0, 1.5F);
    right -= 1.2F * pen.unit;
  }
  const float value_width = ImGui::CalcTextSize(shown.c_str()).x;
  const float label_width = ImGui::CalcTextSize(label.c_str()).x;
  const float room = right - at.x - 2 * inset;
  const float value_at = std::max(at.x + inset + std::min(label_width, 0.45F * room) + inset, right - value_width);
  list->PushClipRect(at, {shown.empty() ? right : value_at - 0.3F * inset, at.y + size.y}, true);
  list->AddText({at.x + inset, y}, faded(pen.skin.tile_text, enabled), label.c_str());
  list->PopClipRect();
  list->PushClipRect({value_at, at.y}, {right, at.y + size.y}, true);
  list->AddText({value_at, y}, faded(pen.skin.dim, enabled), shown.c_str());
  list->PopClipRect();
  frame(pen, w, at, size);
}

void readout(Pen& pen, const Widget& w) {
  const float height = ImGui::GetTextLineHeight() + 0.4F * pen.unit;
  const ImVec2 at = screenAt(pen);
  if (area(pen, ("##" + w.id).c_str(), at, {pen.width, height}, true) && pen.view.asking) pen.pressed(w.id);
  reasonOf(w);
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float inset = 0.4F * pen.unit;
  const ImU32 value_colour = w.why_not.empty() ? pen.skin.text : IM_COL32(214, 60, 40, 255);
  const float width = ImGui::CalcTextSize(w.value.c_str()).x;
  list->PushClipRect(at, {at.x + pen.width - 2 * inset - width, at.y + height}, true);
  list->AddText({at.x + inset, at.y}, pen.skin.dim, w.label.c_str());
  list->PopClipRect();
  list->AddText({at.x + pen.width - inset - width, at.y}, value_colour, w.value.c_str());
  frame(pen, w, at, {pen.width, height});
}

void bigKey(Pen& pen, const Widget& w) {
  const ImVec2 size{pen.width, 1.35F * pen.touch()};
  const ImVec2 at = screenAt(pen);
  if (area(pen, ("##" + w.id).c_str(), at, size, w.enabled)) pen.pressed(w.id);
  const bool hovered = ImGui::IsItemHovered() && w.enabled;
  reasonOf(w);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, faded(pen.skin.key, w.enabled), pen.skin.rounding * pen.unit);
  if (hovered) list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, IM_COL32(255, 255, 255, 28), pen.skin.rounding * pen.unit);
  centred(list, at, size, IM_COL32_WHITE, w.label);
  frame(pen, w, at, size);
}

void caption(const Pen& pen, const std::string& text) {
  const ImVec2 at = screenAt(pen);
  ImGui::GetWindowDrawList()->AddText({at.x + 0.4F * pen.unit, at.y}, pen.skin.dim, text.c_str());
  ImGui::Dummy({0, ImGui::GetTextLineHeight()});
}

// In as many columns as the widest option allows, so that nine resolutions do not become nine rows.
void choice(Pen& pen, const Widget& w) {
  caption(pen, w.label);
  const float gap = 0.3F * pen.unit;
  float widest = 1;
  for (const auto& option : w.options) widest = std::max(widest, ImGui::CalcTextSize(option.label.c_str()).x + 1.6F * pen.unit);
  const int count = static_cast<int>(w.options.size());
  int columns = std::clamp(static_cast<int>((pen.width + gap) / (widest + gap)), 1, std::max(1, count));
  if (count > columns) columns = (count + (count + columns - 1) / columns - 1) / ((count + columns - 1) / columns);   // rows of about the same length
  const float width = (pen.width - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns), height = 0.9F * pen.touch();
  const ImVec2 at = screenAt(pen);
  ImDrawList* list = ImGui::GetWindowDrawList();
  ImGui::PushID(w.id.c_str());
  for (int i = 0; i < count; ++i) {
    const auto& option = w.options[i];
    const ImVec2 from{at.x + static_cast<float>(i % columns) * (width + gap), at.y + static_cast<float>(i / columns) * (height + gap)};
    const bool enabled = w.enabled && option.enabled;
    if (area(pen, option.value.c_str(), from, {width, height}, enabled)) pen.pressed(w.id, option.value);
    const bool hovered = ImGui::IsItemHovered() && enabled;
    if (!option.why_not.empty() && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) ImGui::SetTooltip("%s", option.why_not.c_str());
    const bool chosen = option.label == w.value;
    list->AddRectFilled(from, {from.x + width, from.y + height}, chosen ? pen.skin.accent : hovered ? pen.skin.tile_hover : pen.skin.tile, pen.skin.rounding * pen.unit);
    if (!chosen) list->AddRect(from, {from.x + width, from.y + height}, pen.skin.line, pen.skin.rounding * pen.unit);
    centred(list, from, {width, height}, chosen ? pen.skin.accent_text : faded(pen.skin.tile_text, enabled), option.label);
  }
  ImGui::PopID();
  const auto rows = static_cast<float>((count + columns - 1) / columns);
  frame(pen, w, at, {pen.width, rows * (height + gap) - gap});
  ImGui::SetCursorScreenPos({at.x, at.y + rows * (height + gap)});
  ImGui::Dummy({0, 0});
}

void toggle(Pen& pen, const Widget& w) {
  const ImVec2 size{pen.width, pen.touch()};
  const ImVec2 at = screenAt(pen);
  if (area(pen, ("##" + w.id).c_str(), at, size, w.enabled)) pen.pressed(w.id, w.value == "on" ? "off" : "on");
  reasonOf(w);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, pen.skin.tile, pen.skin.rounding * pen.unit);
  list->AddRect(at, {at.x + size.x, at.y + size.y}, pen.skin.line, pen.skin.rounding * pen.unit);
  const float line = ImGui::GetTextLineHeight();
  list->AddText({at.x + 0.8F * pen.unit, at.y + (size.y - line) / 2}, faded(pen.skin.tile_text, w.enabled), w.label.c_str());
  const bool on = w.value == "on";
  const float h = 1.4F * pen.unit, length = 2.6F * pen.unit, x = at.x + size.x - length - 0.8F * pen.unit, y = at.y + (size.y - h) / 2;
  list->AddRectFilled({x, y}, {x + length, y + h}, on ? pen.skin.accent : pen.skin.line, h / 2);
  list->AddCircleFilled({on ? x + length - h / 2 : x + h / 2, y + h / 2}, 0.42F * h, IM_COL32_WHITE, 20);
  frame(pen, w, at, size);
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
  ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.8F * pen.unit, (pen.touch() - ImGui::GetTextLineHeight()) / 2});
  const auto typing = pen.view.typing.find(w.id);
  std::string text = typing == pen.view.typing.end() ? w.value : typing->second;
  const bool entered = ImGui::InputText(("###" + w.id).c_str(), &text, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll | (number ? ImGuiInputTextFlags_CharsDecimal : 0));
  if (ImGui::IsItemActive()) pen.view.typing[w.id] = text;
  if (entered || ImGui::IsItemDeactivated()) {
    if (text != w.value) pen.pressed(w.id, text);
    pen.view.typing.erase(w.id);
  }
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor(3);
  if (number) {
    const double value = std::strtod(w.value.c_str(), nullptr);
    for (int i = 0; i < 2; ++i) {
      const ImVec2 from{at.x + pen.width - buttons + 0.3F * pen.unit + static_cast<float>(i) * (pen.touch() + 0.3F * pen.unit), at.y};
      const double next = std::clamp(value + (i == 0 ? -1 : 1), w.minimum, std::max(w.minimum, w.maximum));
      if (area(pen, (w.id + (i == 0 ? "-" : "+")).c_str(), from, {pen.touch(), pen.touch()}, w.enabled)) pen.pressed(w.id, fmt::format("{:g}", next));
      ImDrawList* list = ImGui::GetWindowDrawList();
      list->AddRectFilled(from, {from.x + pen.touch(), from.y + pen.touch()}, ImGui::IsItemHovered() ? pen.skin.tile_hover : pen.skin.tile, pen.skin.rounding * pen.unit);
      list->AddRect(from, {from.x + pen.touch(), from.y + pen.touch()}, pen.skin.line, pen.skin.rounding * pen.unit);
      centred(list, from, {pen.touch(), pen.touch()}, pen.skin.tile_text, i == 0 ? "−" : "+");
    }
  }
  frame(pen, w, at, {pen.width, pen.touch()});
  ImGui::SetCursorScreenPos({at.x, at.y + pen.touch() + 0.4F * pen.unit});
  ImGui::Dummy({0, 0});
}

void rows(Pen& pen, const Widget& w) {
  if (w.options.empty()) {
    caption(pen, w.label + ": –");
    return;
  }
  ImGui::PushID(w.id.c_str());
  for (const auto& option : w.options) tile(pen, w, option.value, option.value, option.label, "", w.enabled && option.enabled, true);
  ImGui::PopID();
}

void progress(Pen& pen, const Widget& w) {
  const float height = 0.9F * pen.unit;
  const ImVec2 at = screenAt(pen);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(at, {at.x + pen.width, at.y + height}, pen.skin.line, height / 2);
  const float share = std::clamp(static_cast<float>(w.number), 0.0F, 1.0F);
  if (share > 0) list->AddRectFilled(at, {at.x + std::max(height, share * pen.width), at.y + height}, pen.skin.accent, height / 2);
  const float width = ImGui::CalcTextSize(w.value.c_str()).x;
  list->AddText({at.x + pen.width - width, at.y + height + 0.2F * pen.unit}, pen.skin.text, w.value.c_str());
  ImGui::Dummy({0, height + ImGui::GetTextLineHeight() + 0.4F * pen.unit});
}

void paragraph(const Pen& pen, const std::string& text) {
  ImGui::SetCursorPosX(pen.left);
  ImGui::PushTextWrapPos(pen.left + pen.width);
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
    case WidgetKind::lamp: return;   // the title bar and the body have them
    case WidgetKind::readout: return readout(pen, w);
    case WidgetKind::button: return tile(pen, w, "##" + w.id, "", w.label, w.value, w.enabled, true);
    case WidgetKind::key: return bigKey(pen, w);
    case WidgetKind::choice: return choice(pen, w);
    case WidgetKind::toggle: return toggle(pen, w);
    case WidgetKind::text: return entry(pen, w, false);
    case WidgetKind::number: return entry(pen, w, true);
    case WidgetKind::list: return rows(pen, w);
    case WidgetKind::progress: return progress(pen, w);
    case WidgetKind::note: return paragraph(pen, w.label);
    case WidgetKind::level: return drawLevel(pen, w);
    case WidgetKind::area: return drawArea(pen, w);
    case WidgetKind::preview: return drawPreview(pen, w);
    case WidgetKind::plan: return drawPlan(pen, w);
  }
}

}  // namespace standpoint
