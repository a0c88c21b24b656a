// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/draw/device_view.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "emulated-ui/draw/pen.h"

namespace standpoint {

namespace {

ImU32 lampColour(const std::string& word, double seconds) {
  const bool flashing = word.ends_with("flashing") || word.ends_with("pulsating") || word.ends_with("spinning") ||
                        word.ends_with("blinking");
  if (flashing && std::fmod(seconds, 1.0) > 0.5) return IM_COL32(70, 72, 75, 255);
  constexpr std::pair<const char*, ImU32> kColours[] = {
      {"green", IM_COL32(60, 200, 90, 255)},   {"red", IM_COL32(235, 60, 50, 255)},
      {"yellow", IM_COL32(250, 200, 50, 255)}, {"blue", IM_COL32(70, 150, 250, 255)},
      {"orange", IM_COL32(250, 140, 40, 255)}, {"white", IM_COL32(240, 244, 248, 255)}};
  for (const auto& [name, colour] : kColours)
    if (word.starts_with(name)) return colour;
  return IM_COL32(70, 72, 75, 255);
}

// A title with the way back on its left, so that nobody has to look for it at the end of a long screen.
void titleBar(Pen& pen, const Screen& screen, float width, float height) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  list->AddRectFilled(at, {at.x + width, at.y + height}, pen.skin.title_bar);
  const auto back = std::find_if(screen.widgets.begin(), screen.widgets.end(),
                                 [](const Widget& w) { return w.id == "back" && w.enabled; });
  const bool leads_back = back != screen.widgets.end() && !screen.has_dialog;
  float left = at.x + 0.8F * pen.unit;
  if (leads_back) {
    if (area("title_back", at,
             {std::max(pen.touch(), 2 * pen.unit + ImGui::CalcTextSize(screen.title.c_str()).x), height}))
      pen.pressed(back->id);
    if (ImGui::IsItemHovered())
      list->AddRectFilled(at, {at.x + 2 * pen.unit + ImGui::CalcTextSize(screen.title.c_str()).x, at.y + height},
                          IM_COL32(255, 255, 255, 24));
    chevron(pen, {at.x + 0.7F * pen.unit, at.y + height / 2}, false, pen.skin.title_text);
    left += 0.8F * pen.unit;
  }
  const float line = ImGui::GetTextLineHeight(), y = at.y + (height - line) / 2;
  const float title = left - at.x + ImGui::CalcTextSize(screen.title.c_str()).x + 0.8F * pen.unit;
  const auto drawn = [&](bool labels, bool draw) {
    float right = at.x + width - 0.8F * pen.unit;
    for (const auto& w : screen.widgets) {
      if (w.kind != WidgetKind::status) continue;
      // A state that holds is its own word: "WLAN".
      const std::string text = w.value.empty() ? w.label : labels ? w.label + " " + w.value : w.value;
      right -= ImGui::CalcTextSize(text.c_str()).x;
      if (draw)
        list->AddText({right, y}, w.why_not.empty() ? pen.skin.title_text : IM_COL32(255, 190, 120, 255), text.c_str());
      right -= pen.unit;
    }
    return right;
  };
  const bool labels = drawn(true, false) - at.x > title;  // else the figures alone
  const float right = drawn(labels, true);
  list->PushClipRect(at, {std::max(at.x, right), at.y + height}, true);
  list->AddText({left, y}, pen.skin.title_text, screen.title.c_str());
  list->PopClipRect();
  ImGui::SetCursorScreenPos(at);
  ImGui::Dummy({width, height});
}

// A display that is not lit fully, over what was drawn before.
void dim(double light, ImVec2 at, ImVec2 size) {
  const auto dark = static_cast<ImU32>(150 * (1 - light) * (1 - light));
  if (dark == 0) return;
  ImGui::SetCursorScreenPos(at);
  if (ImGui::BeginChild("light", size, false, ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoInputs))
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + size.x, at.y + size.y}, dark << IM_COL32_A_SHIFT);
  ImGui::EndChild();
}

void dialogButton(Pen& pen, const Widget& w, ImVec2 at, ImVec2 size) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  if (area(("##" + w.id).c_str(), at, size)) pen.pressed(w.id);
  const bool hovered = ImGui::IsItemHovered() && w.enabled;
  const float rounding = pen.skin.rounding * pen.unit;
  list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, hovered ? pen.skin.tile_hover : pen.skin.tile, rounding);
  list->AddRect(at, {at.x + size.x, at.y + size.y}, pen.skin.off, rounding, 0, pen.hair());
  centred(list, at, size, pen.skin.tile_text, w.label);
  frame(pen, w, at, size);
}

// A card over the dimmed screen.
void dialogCard(Pen& pen, const Dialog& dialog, ImVec2 at, ImVec2 size) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, IM_COL32(0, 0, 0, 110));
  const float margin = 1.2F * pen.unit, inner = size.x - 4 * margin;
  const float text_height = ImGui::CalcTextSize(dialog.text.c_str(), nullptr, false, inner).y;
  const float height = text_height + 3 * margin +
                       static_cast<float>(dialog.buttons.size()) * (pen.touch() + 0.5F * pen.unit) - 0.5F * pen.unit;
  const ImVec2 card{at.x + margin, at.y + std::max(margin, (size.y - height) / 2)};
  list->AddRectFilled(card, {card.x + size.x - 2 * margin, card.y + height}, pen.skin.display, 0.5F * pen.unit);
  list->AddRect(card, {card.x + size.x - 2 * margin, card.y + height}, pen.skin.accent, 0.5F * pen.unit, 0,
                pen.hair(1.5F));
  wrapped({card.x + margin, card.y + margin}, inner, pen.skin.text, dialog.text);
  ImVec2 next{card.x + margin, card.y + 2 * margin + text_height};
  for (const auto& button : dialog.buttons) {
    dialogButton(pen, button, next, {inner, pen.touch()});
    next.y += pen.touch() + 0.5F * pen.unit;
  }
}

void body(Pen& pen, const Screen& screen, ImVec2 at, ImVec2 size) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  float x = at.x + 1.2F * pen.unit;
  const float y = at.y + size.y / 2;
  for (const auto& w : screen.body) {
    ImGui::PushID(w.id.c_str());
    if (w.kind == WidgetKind::lamp) {
      const ImU32 colour = lampColour(w.value, pen.view.still ? 0 : ImGui::GetTime());
      list->AddCircleFilled({x + 0.7F * pen.unit, y}, 0.95F * pen.unit, (colour & 0x00FFFFFFU) | 0x40000000U, 24);
      list->AddCircleFilled({x + 0.7F * pen.unit, y}, 0.6F * pen.unit, colour, 24);
      list->AddCircle({x + 0.7F * pen.unit, y}, 0.6F * pen.unit, IM_COL32(40, 42, 45, 255), 24, pen.hair());
      if (area("lamp", {x - 0.3F * pen.unit, y - pen.unit}, {2 * pen.unit, 2 * pen.unit}) && pen.view.asking)
        pen.pressed(w.id);
      tip(w.label + ": " + w.value);
      x += 3 * pen.unit;
    } else {
      const float width = std::max(pen.touch(), ImGui::CalcTextSize(w.label.c_str()).x + 1.6F * pen.unit),
                  h = pen.touch();
      if (area("key", {x, y - h / 2}, {width, h})) pen.pressed(w.id);
      const bool hovered = ImGui::IsItemHovered();
      tip(w.why_not);
      list->AddRectFilled({x, y - h / 2}, {x + width, y + h / 2},
                          hovered ? IM_COL32(112, 116, 122, 255) : IM_COL32(88, 92, 98, 255), h / 2);
      list->AddRect({x, y - h / 2}, {x + width, y + h / 2}, IM_COL32(30, 31, 33, 160), h / 2, 0, pen.hair());
      centred(list, {x, y - h / 2}, {width, h}, IM_COL32_WHITE, w.label);
      frame(pen, w, {x, y - h / 2}, {width, h});
      x += width + 0.8F * pen.unit;
    }
    ImGui::PopID();
  }
}

// A finger that lies on the screen moves it; what it lay on is not pressed then.
void scrollByFinger(const Pen& pen) {
  DeviceView& view = pen.view;
  const auto& io = ImGui::GetIO();
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    view.scrolling = false;
    view.grabbed = ImGui::GetScrollMaxY() > 0 &&
                   ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) &&
                   io.MousePos.x < ImGui::GetWindowPos().x + pen.left + pen.width;
  }
  if (!view.grabbed) return;
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) view.grabbed = false;
  const bool elsewhere = view.dragged_edge >= 0 || io.WantTextInput;  // the finger does something else
  if (!elsewhere && std::abs(ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 0).y) > 0.6F * pen.unit)
    view.scrolling = true;
  if (view.scrolling && view.grabbed) ImGui::SetScrollY(ImGui::GetScrollY() - io.MouseDelta.y);
}

// A card that ends at `bottom`; gives its upper edge.
float strip(const Pen& pen, float left, float bottom, float width, const std::string& text, ImU32 ink, ImU32 edge) {
  const float margin = 0.6F * pen.unit, inner = width - 4 * margin, height = wrappedHeight(text, inner) + 2 * margin;
  const ImVec2 from{left + margin, bottom - height - margin}, to{left + width - margin, bottom - margin};
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(from, to, IM_COL32(20, 22, 26, 235), 0.4F * pen.unit);
  list->AddRect(from, to, edge, 0.4F * pen.unit, 0, pen.hair());
  wrapped({from.x + margin, from.y + margin}, inner, ink, text);
  return from.y;
}

// What only the simulation is waited for, and why the last press did nothing, at the display's lower edge.
void overlay(const Pen& pen, ImVec2 at, ImVec2 size) {
  const DeviceView& view = pen.view;
  if (view.said.empty() && view.waits.empty()) return;
  ImGui::SetCursorScreenPos(at);
  if (ImGui::BeginChild("saying", size, false, ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoInputs)) {
    float bottom = at.y + size.y;
    constexpr ImU32 kCalm = IM_COL32(214, 220, 228, 255), kCalmEdge = IM_COL32(110, 118, 128, 255);
    constexpr ImU32 kTold = IM_COL32(255, 232, 205, 255), kToldEdge = IM_COL32(255, 190, 120, 255);
    if (!view.waits.empty()) bottom = strip(pen, at.x, bottom, size.x, view.waits, kCalm, kCalmEdge);
    if (!view.said.empty()) strip(pen, at.x, bottom, size.x, view.said, kTold, kToldEdge);
  }
  ImGui::EndChild();
}

// What the device reads or computes, as a line below its title.
void workingLine(const Pen& pen, ImVec2 at, float width) {
  if (!pen.view.working) return;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float height = 0.3F * pen.unit, fraction = std::clamp(static_cast<float>(*pen.view.working), 0.02F, 1.0F);
  list->AddRectFilled(at, {at.x + width, at.y + height}, pen.skin.line);
  list->AddRectFilled(at, {at.x + fraction * width, at.y + height}, pen.skin.accent);
}

}  // namespace

namespace {

// Of its parts, in pixels. The display is as large as the room lets it be, and its proportions.
struct Proportions {
  float unit, bezel, keys, display_width, display_height;
};

Proportions proportionsOf(const BodyRow& body, float width, float height) {
  Proportions p{};
  p.unit = ImGui::GetFontSize() * 0.8F;
  p.bezel = (body.tablet ? 1.4F : 1.1F) * p.unit;
  p.keys = 3.6F * p.unit;
  const float aspect = body.display_aspect > 0 ? static_cast<float>(body.display_aspect) : 0.62F;
  p.display_height = std::max(12 * p.unit, height - 2 * p.bezel - p.keys);
  p.display_width = std::max(14 * p.unit, std::min(width - 2 * p.bezel, p.display_height * aspect));
  return p;
}

}  // namespace

float deviceWidth(const Device& device, float height) {
  const auto p = proportionsOf(device.type().definition.body, FLT_MAX, height);
  return p.display_width + 2 * p.bezel;
}

std::optional<Press> drawDevice(const Device& device, DeviceView& view, float width, float height) {
  const Screen screen = device.screen();
  const auto& definition = device.type().definition;
  const Skin skin = skinOf(definition.skin);
  const auto [unit, bezel, keys, display_width, display_height] = proportionsOf(definition.body, width, height);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 at{corner.x + std::max(0.0F, (width - display_width - 2 * bezel) / 2), corner.y};
  const ImVec2 whole{display_width + 2 * bezel, display_height + 2 * bezel + keys};
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(at, {at.x + whole.x, at.y + whole.y}, skin.body, 1.4F * unit);
  list->AddRect(at, {at.x + whole.x, at.y + whole.y}, skin.body_edge, 1.4F * unit, 0, 2 * unit / 11.6F);
  Pen pen{device, view, skin, unit};
  const bool dark = screen.id.empty();
  ImGui::SetCursorScreenPos({at.x + bezel, at.y + bezel});
  ImGui::PushStyleColor(ImGuiCol_ChildBg, dark ? IM_COL32(10, 11, 12, 255) : skin.display);
  ImGui::PushStyleVar(ImGuiStyleVar_FrameRounding, skin.rounding * unit);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.4F * unit, 0.45F * unit});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_ScrollbarSize, 0.8F * unit);
  ImGui::PushID(definition.id.c_str());
  const bool open = ImGui::BeginChild("display", {display_width, display_height}, false,
                                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  if (open && device.asleep() && ImGui::InvisibleButton("asleep", {display_width, display_height}))
    pen.press = Press{"display", {}};
  if (open && !dark) {
    const ImVec2 inside = ImGui::GetCursorScreenPos();
    titleBar(pen, screen, display_width, 2.3F * unit);
    workingLine(pen, {inside.x, inside.y + 2.3F * unit}, display_width);
    ImGui::PushID(screen.id.c_str());
    ImGui::BeginDisabled(screen.has_dialog);
    const float screen_height = display_height - 2.3F * unit - 0.45F * unit;
    const float keyboard = view.keyboard.field.empty() ? 0 : keyboardHeight(pen, screen_height);
    if (ImGui::BeginChild("screen", {display_width, screen_height - keyboard})) {
      ImGui::Dummy({0, 0.2F * unit});
      pen.left = 0.9F * unit;
      pen.width = ImGui::GetContentRegionAvail().x - 1.8F * unit;
      for (const auto& w : screen.widgets) drawWidget(pen, w);
      ImGui::Dummy({0, 0.6F * unit});
      scrollByFinger(pen);
    }
    ImGui::EndChild();
    ImGui::EndDisabled();
    ImGui::PopID();
    if (keyboard > 0) drawKeyboard(pen, {inside.x, inside.y + display_height - keyboard}, {display_width, keyboard});
    if (!pen.editing) view.keyboard = {};
    overlay(pen, inside, {display_width, display_height - keyboard});
    dim(screen.light, inside, {display_width, display_height});
    if (screen.has_dialog) {
      pen.press.reset();
      ImGui::SetCursorScreenPos(inside);
      if (ImGui::BeginChild("dialog", {display_width, display_height}, false, ImGuiWindowFlags_NoBackground))
        dialogCard(pen, screen.dialog, inside, {display_width, display_height});
      ImGui::EndChild();
    }
  }
  ImGui::EndChild();
  ImGui::PopStyleVar(4);
  ImGui::PopStyleColor();
  body(pen, screen, {at.x + bezel, at.y + bezel + display_height}, {display_width, keys + bezel});
  ImGui::PopID();
  ImGui::SetCursorScreenPos({corner.x, corner.y + whole.y});
  ImGui::Dummy({width, 0});
  return pen.press;
}

}  // namespace standpoint
