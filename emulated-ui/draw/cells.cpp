// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "emulated-ui/draw/pen.h"

namespace standpoint {

namespace {

ImVec2 corner(const Box& b) { return {b.x, b.y}; }
ImVec2 sizeOf(const Box& b) { return {b.width, b.height}; }
ImVec2 end(const Box& b) { return {b.right(), b.bottom()}; }
Box inset(const Box& b, float by) { return {b.x + by, b.y + by, b.width - 2 * by, b.height - 2 * by}; }

// The option that follows the chosen one and can be chosen.
const WidgetOption* nextOption(const Widget& w) {
  const auto now = std::find_if(w.options.begin(), w.options.end(), [&](const auto& o) { return o.label == w.value; });
  const auto n = static_cast<std::ptrdiff_t>(w.options.size());
  const auto from = now == w.options.end() ? -1 : now - w.options.begin();
  for (std::ptrdiff_t i = 1; i <= n; ++i)
    if (const auto& option = w.options[(from + i + n) % n]; option.enabled) return &option;
  return nullptr;
}

// A press on the whole box; true while it is hovered and would do something.
bool pressBox(Pen& pen, const Widget& w, const Box& box) {
  const auto id = "##" + w.id;
  if (w.kind == WidgetKind::choice) {
    const auto* next = nextOption(w);
    if (area(id.c_str(), corner(box), sizeOf(box)) && next != nullptr) pen.pressed(w.id, next->value);
  } else {
    const bool toggles = w.kind == WidgetKind::toggle;
    touch(pen, w, id.c_str(), corner(box), sizeOf(box), !toggles ? "" : w.value == "on" ? "off" : "on");
  }
  const bool hovered = ImGui::IsItemHovered() && w.enabled;
  tip(w.why_not);
  return hovered;
}

void plate(const Pen& pen, const Box& box, ImU32 fill, bool hovered, bool held, bool edge) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float rounding = pen.skin.rounding * pen.unit;
  list->AddRectFilled(corner(box), end(box), fill, rounding);
  if (hovered)
    list->AddRectFilled(corner(box), end(box), held ? IM_COL32(0, 0, 0, 60) : IM_COL32(128, 128, 128, 36), rounding);
  if (edge) list->AddRect(corner(box), end(box), pen.skin.line, rounding, 0, pen.hair());
}

bool held() { return ImGui::IsItemActive(); }

// What stands below a tile's label; a switch says it by its plate.
std::string tileValue(const Widget& w) { return w.kind == WidgetKind::toggle ? std::string() : w.value; }

void tile(Pen& pen, const Widget& w, const Box& box) {
  const bool on = w.kind == WidgetKind::toggle && w.value == "on";
  const bool hovered = pressBox(pen, w, box);
  const ImU32 fill = on ? pen.skin.accent : pen.skin.tile;
  plate(pen, box, fill, hovered, held(), true);
  const ImU32 ink = faded(on ? pen.skin.accent_text : pen.skin.tile_text, w.enabled);
  const ImU32 pale = faded(on ? pen.skin.accent_text : pen.skin.dim, w.enabled);
  const auto& icon = iconOf(pen, w.id);
  const auto value = tileValue(w);
  const Box in = inset(box, 0.45F * pen.unit);
  const float text = pen.text();
  if (in.width > 2.6F * in.height && in.height < 4.2F * text) {  // a low one: the icon at its left
    const float side = icon.empty() ? 0 : std::min(in.height, 1.9F * text);
    drawIcon(pen, icon, {in.x + side / 2, in.y + in.height / 2}, side, ink);
    const float left = in.x + (icon.empty() ? 0 : side + 0.6F * pen.unit);
    const float room = in.right() - left;
    const bool stacked = in.height > 2.1F * text;
    if (value.empty()) return fitted(pen, w.id, {left, in.y, room, in.height}, ink, w.label, Align::left);
    if (stacked) {
      fitted(pen, w.id, {left, in.y, room, in.height / 2}, ink, w.label, Align::left);
      return fitted(pen, w.id, {left, in.y + in.height / 2, room, in.height / 2}, pale, value, Align::left);
    }
    fitted(pen, w.id, {left, in.y, 0.5F * room, in.height}, ink, w.label, Align::left);
    return fitted(pen, w.id, {left + 0.5F * room, in.y, 0.5F * room, in.height}, pale, value, Align::right);
  }
  const float value_height = value.empty() ? 0 : std::min(2.1F * text, 0.32F * in.height);
  const float label_height = std::min(2.2F * text, (icon.empty() ? 1.0F : 0.5F) * (in.height - value_height));
  const float above = in.height - value_height - label_height;
  if (!icon.empty())
    drawIcon(pen, icon, {in.x + in.width / 2, in.y + above / 2}, std::min({above, 0.62F * in.width, 3.4F * text}), ink);
  fitted(pen, w.id, {in.x, in.y + above, in.width, label_height}, ink, w.label);
  fitted(pen, w.id, {in.x, in.y + above + label_height, in.width, value_height}, pale, value, Align::centre, 0.9F);
}

void block(Pen& pen, const Widget& w, const Box& box) {
  const bool hovered = pressBox(pen, w, box);
  plate(pen, box, faded(pen.skin.key, w.enabled), hovered, held(), false);
  const Box in = inset(box, 0.5F * pen.unit);
  const auto& icon = iconOf(pen, w.id);
  const ImU32 ink = faded(pen.skin.key_text, w.enabled);
  if (icon.empty()) return fitted(pen, w.id, in, ink, w.label, Align::centre, 1.1F);
  if (in.width > 2 * in.height) {
    const float side = std::min(in.height, 1.7F * pen.text());
    const float width = std::min(in.width - side - 0.5F * pen.unit, ImGui::CalcTextSize(w.label.c_str()).x * 1.1F + 1);
    const float left = in.x + std::max(0.0F, (in.width - width - side - 0.5F * pen.unit) / 2);
    drawIcon(pen, icon, {left + side / 2, in.y + in.height / 2}, side, ink);
    return fitted(pen, w.id,
                  {left + side + 0.5F * pen.unit, in.y, in.right() - left - side - 0.5F * pen.unit, in.height}, ink,
                  w.label, Align::left, 1.1F);
  }
  const float label = std::min(0.4F * in.height, 2.4F * pen.text());
  const float side = std::min({0.8F * (in.height - label), 0.7F * in.width, 6 * pen.text()});
  drawIcon(pen, icon, {in.x + in.width / 2, in.y + (in.height - label) / 2}, side, ink);
  fitted(pen, w.id, {in.x, in.bottom() - label, in.width, label}, ink, w.label, Align::centre, 1.1F);
}

void roundKey(Pen& pen, const Widget& w, const Box& box, bool on_picture) {
  const float label = 1.15F * pen.text();
  const float r = std::min(box.width, box.height - label) / 2;
  const ImVec2 centre{box.x + box.width / 2, box.y + (box.height - label) / 2};
  const Box disc{centre.x - r, centre.y - r, 2 * r, 2 * r};
  const bool hovered = pressBox(pen, w, {disc.x, disc.y, disc.width, disc.height + label});
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddCircleFilled(centre, r, faded(pen.skin.key, w.enabled), 64);
  list->AddCircle(centre, r - 2.2F * pen.hair(), faded(pen.skin.key_text, w.enabled), 64, pen.hair(1.4F));
  if (hovered) list->AddCircleFilled(centre, r, held() ? IM_COL32(0, 0, 0, 60) : IM_COL32(255, 255, 255, 36), 64);
  drawIcon(pen, iconOf(pen, w.id), centre, 1.05F * r, faded(pen.skin.key_text, w.enabled));
  const ImU32 ink = on_picture ? IM_COL32(232, 236, 240, 255) : pen.skin.text;
  fitted(pen, w.id, {box.x, disc.bottom() + 0.1F * pen.text(), box.width, label}, faded(ink, w.enabled), w.label);
}

void iconOnly(Pen& pen, const Widget& w, const Box& box) {
  const bool hovered = pressBox(pen, w, box);
  if (w.why_not.empty()) tip(w.label);
  plate(pen, box, pen.skin.tile, hovered, held(), true);
  drawIcon(pen, iconOf(pen, w.id), {box.x + box.width / 2, box.y + box.height / 2},
           0.62F * std::min(box.width, box.height), faded(pen.skin.tile_text, w.enabled));
}

ImU32 valueColour(const Pen& pen, const Widget& w) { return w.why_not.empty() ? pen.skin.text : pen.skin.warning; }

void pair(Pen& pen, const Widget& w, const Box& box) {
  if (area(("##" + w.id).c_str(), corner(box), sizeOf(box)) && pen.view.asking) pen.pressed(w.id);
  tip(w.why_not);
  const float small = 1.05F * pen.text();
  static const std::string kNone;
  const auto& icon = box.width < 7 * pen.text() ? kNone : iconOf(pen, w.id);
  const float side = icon.empty() ? 0 : std::min(0.75F * box.height, 1.9F * pen.text());
  const float left = box.x + 0.4F * pen.unit + (icon.empty() ? 0 : side + 0.5F * pen.unit);
  const float room = box.right() - left - 0.3F * pen.unit;
  drawIcon(pen, icon, {box.x + 0.4F * pen.unit + side / 2, box.y + box.height / 2}, side, pen.skin.dim);
  const float top = box.y + std::max(0.0F, (box.height - small - 1.3F * pen.text()) / 2);
  fitted(pen, w.id, {left, top, room, small}, pen.skin.dim, w.label, Align::left, 0.85F);
  fitted(pen, w.id, {left, top + small, room, std::min(1.4F * pen.text(), box.bottom() - top - small)},
         valueColour(pen, w), w.value.empty() ? "–" : w.value, Align::left, 1.1F);
}

void figure(Pen& pen, const Widget& w, const Box& box) {
  if (area(("##" + w.id).c_str(), corner(box), sizeOf(box)) && pen.view.asking) pen.pressed(w.id);
  tip(w.label);
  fitted(pen, w.id, box, valueColour(pen, w), w.value, Align::centre,
         std::max(1.0F, std::min(2.2F, 0.7F * box.height / pen.text())));
}

// A stop for each option; one that the device excludes is hollow and cannot be chosen.
void slider(Pen& pen, const Widget& w, const Box& box) {
  const float text = 1.1F * pen.text(), side = 0.9F * pen.unit;
  const Box in = inset(box, 0.4F * pen.unit);
  const float label_width = 0.5F * in.width;
  fitted(pen, w.id, {in.x, in.y, label_width, text}, faded(pen.skin.dim, w.enabled), w.label, Align::left);
  fitted(pen, w.id, {in.x + label_width, in.y, in.width - label_width, text}, faded(pen.skin.text, w.enabled), w.value,
         Align::right, 1.1F);
  const int n = static_cast<int>(w.options.size());
  if (n == 0) return;
  const float y = in.y + text + std::max(side, (in.height - text) / 2);
  const float from = in.x + side, to = in.right() - side;
  const auto x_of = [&](int i) {
    return n == 1 ? from : from + (to - from) * static_cast<float>(i) / static_cast<float>(n - 1);
  };
  const Box track{in.x, y - pen.touch() / 2, in.width, pen.touch()};
  (void)area(("##" + w.id).c_str(), corner(track), sizeOf(track));
  int chosen = -1, nearest = -1;
  const float mouse = ImGui::GetIO().MousePos.x;
  for (int i = 0; i < n; ++i) {
    if (w.options[i].label == w.value) chosen = i;
    if (w.options[i].enabled && (nearest < 0 || std::abs(x_of(i) - mouse) < std::abs(x_of(nearest) - mouse)))
      nearest = i;
  }
  const bool dragging = ImGui::IsItemActive() && w.enabled;
  if (ImGui::IsItemDeactivated() && nearest >= 0 && nearest != chosen) pen.pressed(w.id, w.options[nearest].value);
  if (ImGui::IsItemDeactivated() && pen.view.asking) pen.pressed(w.id);
  tip(w.enabled ? std::string() : w.why_not);
  const int shown = dragging && nearest >= 0 ? nearest : chosen;
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled({from, y - 0.12F * pen.unit}, {to, y + 0.12F * pen.unit}, pen.skin.line, 0.12F * pen.unit);
  if (shown > 0)
    list->AddRectFilled({from, y - 0.12F * pen.unit}, {x_of(shown), y + 0.12F * pen.unit},
                        faded(pen.skin.accent, w.enabled));
  for (int i = 0; i < n; ++i) {
    const bool can = w.options[i].enabled && w.enabled;
    if (can)
      list->AddCircleFilled({x_of(i), y}, 0.28F * pen.unit, pen.skin.dim, 16);
    else
      list->AddCircle({x_of(i), y}, 0.26F * pen.unit, pen.skin.off, 16, pen.hair());
  }
  if (shown >= 0) {
    list->AddCircleFilled({x_of(shown), y}, 0.75F * pen.unit, faded(pen.skin.accent, w.enabled), 24);
    list->AddCircle({x_of(shown), y}, 0.75F * pen.unit, pen.skin.accent_text, 24, pen.hair(1.5F));
  }
  const float below = y + 0.95F * pen.unit;
  if (below + pen.text() * 0.8F > in.bottom()) return;
  const Box ends{in.x, below, in.width / 2, in.bottom() - below};
  fitted(pen, w.id, ends, pen.skin.dim, w.options.front().label, Align::left, 0.8F);
  fitted(pen, w.id, {in.x + in.width / 2, below, in.width / 2, ends.height}, pen.skin.dim, w.options.back().label,
         Align::right, 0.8F);
}

void ring(Pen& pen, const Widget& w, const Box& box) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 centre{box.x + box.width / 2, box.y + box.height / 2};
  const float r = 0.44F * std::min(box.width, box.height), thick = 0.13F * r;
  list->AddCircle(centre, r, pen.skin.line, 72, thick);
  const float share = std::clamp(static_cast<float>(w.number), 0.0F, 1.0F);
  if (share > 0) {
    constexpr float kTop = -std::numbers::pi_v<float> / 2;
    list->PathArcTo(centre, r, kTop, kTop + share * 2 * std::numbers::pi_v<float>, 72);
    list->PathStroke(pen.skin.accent, 0, thick);
  }
  fitted(pen, w.id, {centre.x - 0.75F * r, centre.y - 0.5F * r, 1.5F * r, r}, pen.skin.text, w.value, Align::centre,
         std::max(1.0F, 0.5F * r / pen.text()));
}

// What is scanned, as far as the head has turned.
void sweep(Pen& pen, const Widget& w, const Box& box) {
  const float text = 1.15F * pen.text();
  const Box strip{box.x, box.y, box.width, box.height - text};
  const auto& data = pen.device.state().data;
  (void)scanPicture(pen, data ? data->preview : nullptr, corner(strip), sizeOf(strip));
  const float share = std::clamp(static_cast<float>(w.number), 0.0F, 1.0F), x = strip.x + share * strip.width;
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled({x, strip.y}, end(strip), IM_COL32(8, 9, 10, 255));
  if (!data || !data->preview) list->AddRectFilled(corner(strip), {x, strip.bottom()}, IM_COL32(150, 156, 164, 70));
  list->AddLine({x, strip.y}, {x, strip.bottom()}, pen.skin.accent, pen.hair(2));
  fitted(pen, w.id, {box.x, strip.bottom(), box.width, text}, pen.skin.text, w.value);
}

void thumbs(Pen& pen, const Widget& w, const Box& box) {
  const auto* project = pen.device.project();
  const int n = static_cast<int>(w.options.size());
  if (n == 0) return fitted(pen, w.id, box, pen.skin.dim, w.label + ": –");
  const int columns = box.width > 1.3F * box.height ? 3 : 2;
  const float gap = 0.5F * pen.unit,
              width = (box.width - static_cast<float>(columns - 1) * gap) / static_cast<float>(columns);
  const float label = 2.2F * pen.text(), height = 0.5F * width + label;
  ImGui::PushID(w.id.c_str());
  for (int i = 0; i < n; ++i) {
    const auto& option = w.options[i];
    const Box card{box.x + static_cast<float>(i % columns) * (width + gap),
                   box.y + static_cast<float>(i / columns) * (height + gap), width, height};
    touch(pen, w, option.value.c_str(), corner(card), sizeOf(card), option.value);
    plate(pen, card, pen.skin.tile, ImGui::IsItemHovered(), held(), true);
    const Box top{card.x, card.y, card.width, card.height - label};
    const bool stored =
        project != nullptr && option.setup >= 0 && option.setup < static_cast<int>(project->setups.size());
    (void)scanPicture(pen, stored ? project->setups[option.setup].preview : nullptr, corner(top), sizeOf(top));
    fitted(pen, w.id, {card.x + 0.3F * pen.unit, top.bottom(), card.width - 0.6F * pen.unit, label}, pen.skin.tile_text,
           option.label, Align::left, 0.85F);
  }
  ImGui::PopID();
  const float rows = static_cast<float>((n + columns - 1) / columns);
  ImGui::SetCursorScreenPos({box.x, box.y + rows * (height + gap)});
  ImGui::Dummy({0, 0});
}

// As in a form, in the middle of its box; it scrolls where it is longer.
void asInForm(Pen& pen, const Widget& w, const Box& box) {
  pen.left = 0;
  pen.width = box.width;
  pen.height = box.height;
  drawWidget(pen, w);
  pen.height = 0;
}

void qualityMap(Pen& pen, const Widget& w, const Box& box) {
  pen.left = 0;
  pen.width = box.width;
  pen.height = box.height;
  drawSeen(pen, w, true);
  pen.height = 0;
}

}  // namespace

void drawCell(Pen& pen, const Widget& w, const Region& region, const Box& box) {
  switch (region.as) {
    case Look::tile: tile(pen, w, box); break;
    case Look::block: block(pen, w, box); break;
    case Look::round: roundKey(pen, w, box, !region.anchor.empty()); break;
    case Look::icon: iconOnly(pen, w, box); break;
    case Look::pair: pair(pen, w, box); break;
    case Look::figure: figure(pen, w, box); break;
    case Look::slider: slider(pen, w, box); break;
    case Look::ring: ring(pen, w, box); break;
    case Look::sweep: sweep(pen, w, box); break;
    case Look::thumbs: thumbs(pen, w, box); break;
    case Look::cross: drawCross(pen, w, box); break;
    case Look::quality: qualityMap(pen, w, box); break;
    case Look::normal:
      if (w.kind == WidgetKind::key) {
        block(pen, w, box);
        break;
      }
      if (w.kind == WidgetKind::button) {
        tile(pen, w, box);
        break;
      }
      return asInForm(pen, w, box);
  }
  frame(pen, w, corner(box), sizeOf(box));
}

}  // namespace standpoint
