// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "emulated-ui/draw/pen.h"

namespace standpoint {

namespace {

constexpr ImU32 kAlarm = IM_COL32(255, 190, 120, 255);
constexpr ImGuiWindowFlags kStill = ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;

const Widget* onScreen(const Screen& screen, const std::string& id) {
  const auto found =
      std::find_if(screen.widgets.begin(), screen.widgets.end(), [&](const Widget& w) { return w.id == id; });
  return found == screen.widgets.end() ? nullptr : &*found;
}

// A state that holds is its own word: "WLAN".
std::string stateText(const Widget& w, bool label) {
  return w.value.empty() ? w.label : label ? w.label + " " + w.value : w.value;
}

float stateWidth(const Pen& pen, const Widget& w, bool label) {
  const float icon = iconOf(pen, w.id).empty() ? 0 : 1.25F * pen.text();
  const std::string text = icon > 0 && w.value.empty() ? std::string() : stateText(w, label && icon == 0);
  return icon + ImGui::CalcTextSize(text.c_str()).x;
}

void drawState(const Pen& pen, const Widget& w, float x, const Box& bar, bool label, ImU32 ink) {
  const ImU32 colour = w.why_not.empty() ? ink : kAlarm;
  const auto& icon = iconOf(pen, w.id);
  const float middle = bar.y + bar.height / 2;
  if (!icon.empty()) {
    drawIcon(pen, icon, {x + 0.55F * pen.text(), middle}, 1.1F * pen.text(), colour);
    x += 1.25F * pen.text();
    if (w.value.empty()) return;
  }
  const auto text = stateText(w, label && icon.empty());
  ImGui::GetWindowDrawList()->AddText({x, middle - ImGui::GetTextLineHeight() / 2}, colour, text.c_str());
}

void stateArea(Pen& pen, const Widget& w, const Box& box) {
  if (area(("state_" + w.id).c_str(), {box.x, box.y}, {std::max(2.0F, box.width), box.height}) && pen.view.asking)
    pen.pressed(w.id);
  tip(w.why_not.empty() ? stateText(w, true) : stateText(w, true) + "\n" + w.why_not);
}

std::vector<const Widget*> shownOf(const Screen& screen, const Region& region) {
  std::vector<const Widget*> shown;
  for (const auto& id : region.widgets)
    if (const auto* w = onScreen(screen, id)) shown.push_back(w);
  return shown;
}

// A title with the way back on its left, so that nobody has to look for it at the end of a long screen.
void title(Pen& pen, const Screen& screen, const Region& region, const Box& box) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled({box.x, box.y}, {box.right(), box.bottom()}, pen.skin.title_bar);
  const auto* back = onScreen(screen, "back");
  const bool leads_back = back != nullptr && back->enabled;
  float left = box.x + 0.8F * pen.unit;
  const float wide = ImGui::CalcTextSize(screen.title.c_str()).x;
  if (leads_back) {
    const float width = std::min(box.width, std::max(pen.touch(), 2.4F * pen.unit + wide));
    if (area("title_back", {box.x, box.y}, {width, box.height})) pen.pressed(back->id);
    if (ImGui::IsItemHovered())
      list->AddRectFilled({box.x, box.y}, {box.x + width, box.bottom()}, IM_COL32(255, 255, 255, 24));
    chevron(pen, {box.x + 0.8F * pen.unit, box.y + box.height / 2}, false, pen.skin.title_text);
    frame(pen, *back, {box.x, box.y}, {width, box.height});
    left += 1.1F * pen.unit;
  }
  const auto shown = shownOf(screen, region);
  const float gap = 0.9F * pen.unit;
  const auto total = [&](bool label) {
    float sum = 0;
    for (const auto* w : shown) sum += stateWidth(pen, *w, label) + gap;
    return sum;
  };
  const bool label = total(true) < box.right() - left - wide - gap;  // else the figures alone
  float x = box.right() - total(label);
  const float end = x - gap / 2;
  for (const auto* w : shown) {
    const float width = stateWidth(pen, *w, label);
    stateArea(pen, *w, {x, box.y, width, box.height});
    drawState(pen, *w, x, box, label, pen.skin.title_text);
    x += width + gap;
  }
  fitted(pen, "title", {left, box.y, end - left, box.height}, pen.skin.title_text, screen.title, Align::left);
}

void status(Pen& pen, const Screen& screen, const Region& region, const Box& box) {
  ImGui::GetWindowDrawList()->AddRectFilled({box.x, box.y}, {box.right(), box.bottom()}, pen.skin.title_bar);
  const auto shown = shownOf(screen, region);
  float sum = 0;
  for (const auto* w : shown) sum += stateWidth(pen, *w, true);
  const bool label = sum + static_cast<float>(shown.size() + 1) * 0.8F * pen.unit < box.width;
  sum = 0;
  for (const auto* w : shown) sum += stateWidth(pen, *w, label);
  const float gap = (box.width - sum) / static_cast<float>(shown.size() + 1);
  if (gap < 0.2F * pen.unit) pen.view.cut.push_back("status: " + screen.id);
  float x = box.x + gap;
  for (const auto* w : shown) {
    const float width = stateWidth(pen, *w, label);
    stateArea(pen, *w, {x - gap / 2, box.y, width + gap, box.height});
    drawState(pen, *w, x, box, label, pen.skin.title_text);
    x += width + gap;
  }
}

void slots(Pen& pen, const Screen& screen, const Region& region, const Box& box) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  const bool soft = region.kind == RegionKind::softkeys;
  list->AddRectFilled({box.x, box.y}, {box.right(), box.bottom()}, pen.skin.title_bar);
  // Soft keys keep their places; a bar closes up.
  std::vector<const Widget*> shown;
  for (const auto& id : region.widgets)
    if (const auto* w = onScreen(screen, id); w != nullptr || soft) shown.push_back(w);
  const float width = box.width / static_cast<float>(std::max<std::size_t>(1, shown.size()));
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const float gap = soft ? 0.2F * pen.unit : 0;
    const Box slot{box.x + static_cast<float>(i) * width + gap, box.y + gap, width - 2 * gap, box.height - 2 * gap};
    const auto* w = shown[i];
    const float rounding = soft ? 0.25F * pen.unit : 0;
    const ImU32 ink = pen.skin.title_text;
    if (soft)
      list->AddRectFilled({slot.x, slot.y}, {slot.right(), slot.bottom()},
                          w == nullptr ? IM_COL32(255, 255, 255, 14) : IM_COL32(255, 255, 255, 40), rounding);
    if (w == nullptr) continue;
    touch(pen, *w, ("##" + w->id).c_str(), {slot.x, slot.y}, {slot.width, slot.height});
    if (ImGui::IsItemHovered() && w->enabled)
      list->AddRectFilled({slot.x, slot.y}, {slot.right(), slot.bottom()},
                          ImGui::IsItemActive() ? IM_COL32(0, 0, 0, 60) : IM_COL32(255, 255, 255, 30), rounding);
    tip(w->why_not);
    const auto& icon = iconOf(pen, w->id);
    const float side = soft || icon.empty() ? 0 : std::min(0.5F * slot.height, 1.7F * pen.text());
    drawIcon(pen, icon, {slot.x + slot.width / 2, slot.y + 0.12F * slot.height + side / 2}, side,
             faded(ink, w->enabled));
    const float top = side == 0 ? slot.y : slot.y + 0.12F * slot.height + side;
    fitted(pen, w->id, {slot.x + 0.2F * pen.unit, top, slot.width - 0.4F * pen.unit, slot.bottom() - top},
           faded(ink, w->enabled), w->label, Align::centre, soft ? 0.95F : 0.85F);
    frame(pen, *w, {slot.x, slot.y}, {slot.width, slot.height});
  }
}

std::string tabsKey(const Pen& pen, const Region& region) { return pen.screen + region.pointer; }

void tabTitles(Pen& pen, const Region& region, const Box& box) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled({box.x, box.y}, {box.right(), box.bottom()}, pen.skin.title_bar);
  const float width = box.width / static_cast<float>(region.parts.size());
  int& chosen = pen.view.tabs[tabsKey(pen, region)];
  for (int i = 0; i < static_cast<int>(region.parts.size()); ++i) {
    const Box tab{box.x + static_cast<float>(i) * width, box.y, width, box.height};
    if (area(("tab" + std::to_string(i)).c_str(), {tab.x, tab.y}, {tab.width, tab.height})) chosen = i;
    const bool open = i == chosen;
    if (open || ImGui::IsItemHovered())
      list->AddRectFilled({tab.x, tab.y}, {tab.right(), tab.bottom()},
                          open ? pen.skin.display : IM_COL32(255, 255, 255, 24));
    if (open) {
      const float y = region.at_bottom ? tab.bottom() - 0.25F * pen.unit : tab.y;
      list->AddRectFilled({tab.x, y}, {tab.right(), y + 0.25F * pen.unit}, pen.skin.accent);
    }
    fitted(pen, "tab", {tab.x + 0.2F * pen.unit, tab.y, tab.width - 0.4F * pen.unit, tab.height},
           open ? pen.skin.text : pen.skin.title_text, pen.device.word(region.parts[i].words));
    const auto inside = placedWidgets(region.parts[i]);
    if (!open && std::find(inside.begin(), inside.end(), pen.view.pointed) != inside.end()) {
      Widget hint;
      hint.id = pen.view.pointed;
      frame(pen, hint, {tab.x, tab.y}, {tab.width, tab.height});
    }
  }
}

// A finger that lies on a form moves it; what it lay on is not pressed then.
void scrollByFinger(const Pen& pen, const std::string& form) {
  DeviceView& view = pen.view;
  const auto& io = ImGui::GetIO();
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && ImGui::GetScrollMaxY() > 0 &&
      ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) &&
      io.MousePos.x < ImGui::GetWindowPos().x + ImGui::GetWindowWidth() - ImGui::GetStyle().ScrollbarSize)
    view.grabbed = form;
  if (view.grabbed != form) return;
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) view.grabbed.clear();
  const bool elsewhere = view.dragged_edge >= 0 || io.WantTextInput;  // the finger does something else
  if (!elsewhere && std::abs(ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 0).y) > 0.6F * pen.unit)
    view.scrolling = true;
  if (view.scrolling && !view.grabbed.empty()) ImGui::SetScrollY(ImGui::GetScrollY() - io.MouseDelta.y);
}

// How much of a column a widget is, about, in rows.
int rowsOf(const Widget& w) {
  switch (w.kind) {
    case WidgetKind::choice: return 2 + static_cast<int>(w.options.size()) / 3;
    case WidgetKind::list: return 1 + static_cast<int>(w.options.size());
    case WidgetKind::text:
    case WidgetKind::number: return 2;
    case WidgetKind::area:
    case WidgetKind::preview:
    case WidgetKind::plan:
    case WidgetKind::seen: return 5;
    case WidgetKind::level: return 4;
    case WidgetKind::readout: return 1;
    default: return 2;
  }
}

void form(Pen& pen, const Screen& screen, const Region& region, const Box& box) {
  const auto shown = shownOf(screen, region);
  int total = 0;
  for (const auto* w : shown) total += rowsOf(*w);
  const float side = 0.9F * pen.unit, gap = 1.2F * pen.unit;
  const float room = ImGui::GetContentRegionAvail().x - 2 * side;
  constexpr float kRow = 0.75F, kWidest = 32;  // of a row about, in fingers; of a column, in heights of letters
  const bool one_is_enough = kRow * static_cast<float>(total) * pen.touch() < box.height && total <= 6;
  const int columns = one_is_enough || box.width < 24 * pen.text() ? 1 : region.columns;
  pen.width =
      std::min(kWidest * pen.text(), (room - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns));
  const float top = 0.5F * pen.unit;
  float deepest = top;
  int column = 0, filled = 0;
  const auto begin = [&] {
    pen.left = side + static_cast<float>(column) * (pen.width + gap);
    ImGui::SetCursorPosY(top);
  };
  begin();
  for (const auto* w : shown) {
    if (column + 1 < columns && filled * columns >= total * (column + 1)) {
      deepest = std::max(deepest, ImGui::GetCursorPosY());
      ++column;
      begin();
    }
    drawWidget(pen, *w);
    filled += rowsOf(*w);
  }
  ImGui::SetCursorPosY(std::max(deepest, ImGui::GetCursorPosY()));
  ImGui::Dummy({0, 0.6F * pen.unit});
  scrollByFinger(pen, pen.screen + region.pointer);
}

bool holds(const Region& region, const std::string& widget) {
  return !widget.empty() && std::find(region.widgets.begin(), region.widgets.end(), widget) != region.widgets.end();
}

bool scrolls(const Screen& screen, const Region& region) {
  if (region.kind == RegionKind::form) return true;
  const auto* w = region.kind == RegionKind::widget ? onScreen(screen, region.widget) : nullptr;
  if (w == nullptr || (region.as != Look::normal && region.as != Look::thumbs)) return false;
  return w->kind == WidgetKind::list || w->kind == WidgetKind::choice || w->kind == WidgetKind::note;
}

// What lies on a picture has a ground of its own.
bool hasGround(const PlacedRegion& placed) {
  const auto kind = placed.region->kind;
  return placed.depth > 0 && (kind == RegionKind::rows || kind == RegionKind::columns || kind == RegionKind::form ||
                              placed.region->as == Look::pair || placed.region->as == Look::figure);
}

void drawRegion(Pen& pen, const Screen& screen, const PlacedRegion& placed, const Box& box) {
  const auto& region = *placed.region;
  switch (region.kind) {
    case RegionKind::title: return title(pen, screen, region, box);
    case RegionKind::status: return status(pen, screen, region, box);
    case RegionKind::softkeys:
    case RegionKind::bottombar: return slots(pen, screen, region, box);
    case RegionKind::tabs: return tabTitles(pen, region, box);
    case RegionKind::form: return form(pen, screen, region, box);
    case RegionKind::widget:
      if (const auto* w = onScreen(screen, region.widget)) drawCell(pen, *w, region, box);
      return;
    default: return;
  }
}

bool isStrip(RegionKind kind) {
  return kind == RegionKind::title || kind == RegionKind::status || kind == RegionKind::softkeys ||
         kind == RegionKind::bottombar || kind == RegionKind::tabs;
}

bool isPicture(const Screen& screen, const Region& region) {
  const auto* w = region.kind == RegionKind::widget ? onScreen(screen, region.widget) : nullptr;
  return w != nullptr && (w->kind == WidgetKind::plan || w->kind == WidgetKind::seen || w->kind == WidgetKind::preview);
}

}  // namespace

void drawRegions(Pen& pen, const Screen& screen, const Region& root, const Box& display, float covered) {
  const PlacingState state{[&](const std::string& id) { return onScreen(screen, id) != nullptr; },
                           [&](const Region& tabs) { return pen.view.tabs[tabsKey(pen, tabs)]; }, 2.2F * pen.text()};
  int number = 0;  // counts also those that the keyboard covers: a field keeps its place among them
  for (const auto& placed : placeRegions(root, display, state)) {
    const auto id = "region" + std::to_string(number++);
    Box box = placed.box;
    const bool strip = isStrip(placed.region->kind);
    // Pictures reach from edge to edge; what else there is keeps a little away from its neighbours.
    const auto kind = placed.region->kind;
    const bool ground = kind == RegionKind::rows || kind == RegionKind::columns;
    const float gap =
        strip || ground || kind == RegionKind::form || isPicture(screen, *placed.region) ? 0 : 0.3F * pen.unit;
    const float left = std::round(box.x + gap), top = std::round(box.y + gap);
    box = {left, top, std::round(box.right() - gap) - left, std::round(box.bottom() - gap) - top};
    if (!pen.view.keyboard.field.empty() && holds(*placed.region, pen.view.keyboard.field)) {
      box.height = std::min(box.height, covered - box.y);
      if (box.height < 4 * pen.touch()) box = {display.x, display.y, display.width, covered - display.y};
    } else if (box.y >= covered) {
      continue;
    }
    ImGui::SetCursorScreenPos({box.x, box.y});
    ImGui::PushStyleColor(ImGuiCol_ChildBg, hasGround(placed) ? pen.skin.display : IM_COL32(0, 0, 0, 0));
    const auto flags = scrolls(screen, *placed.region) ? ImGuiWindowFlags_None : kStill;
    if (ImGui::BeginChild(id.c_str(), {std::max(1.0F, box.width), std::max(1.0F, box.height)}, false, flags)) {
      useText(pen);
      const ImVec2 at = ImGui::GetCursorScreenPos();
      drawRegion(pen, screen, placed, {at.x, at.y, box.width, box.height});
    }
    ImGui::EndChild();
    ImGui::PopStyleColor();
  }
}

}  // namespace standpoint
