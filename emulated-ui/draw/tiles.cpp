// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include "emulated-ui/draw/pen.h"

namespace standpoint {

void chevron(const Pen& pen, ImVec2 tip, bool to_the_right, ImU32 colour) {
  const float s = 0.35F * pen.unit, back = to_the_right ? -s : s;
  ImGui::GetWindowDrawList()->AddPolyline(
      std::array<ImVec2, 3>{ImVec2{tip.x + back, tip.y - s}, tip, ImVec2{tip.x + back, tip.y + s}}.data(), 3, colour, 0,
      pen.hair(1.5F));
}

namespace {

// Label on the left and value on the right of a row; the value below where both do not fit beside one another.
class TwoTexts {
 public:
  TwoTexts(const std::string& label, const std::string& value, float room, float gap)
      : label_(label), value_(value), room_(room) {
    value_width_ = ImGui::CalcTextSize(value.c_str()).x;
    beside_ = ImGui::CalcTextSize(label.c_str()).x + (value.empty() ? 0 : gap + value_width_) <= room;
    label_height_ = beside_ ? ImGui::GetTextLineHeight() : wrappedHeight(label, room);
  }
  float height() const { return label_height_ + (beside_ || value_.empty() ? 0 : wrappedHeight(value_, room_)); }
  void draw(ImVec2 at, ImU32 label_colour, ImU32 value_colour) const {
    wrapped(at, beside_ ? 1e6F : room_, label_colour, label_);
    if (value_.empty()) return;
    const float x = at.x + std::max(0.0F, room_ - value_width_);
    wrapped({x, beside_ ? at.y : at.y + label_height_}, beside_ ? 1e6F : room_, value_colour, value_);
  }

 private:
  const std::string &label_, &value_;
  float room_, value_width_ = 0, label_height_ = 0;
  bool beside_ = true;
};

struct Row {
  std::string id, value;  // what a press sends
  std::string label, shown;
  bool enabled = true;
  Leads leads = Leads::nowhere;
};

void pressedRow(Pen& pen, const Widget& w, const Row& row) {
  const float inset = 0.8F * pen.unit, mark = 1.2F * pen.unit;
  const float left = inset + (row.leads == Leads::back ? mark : 0),
              right = inset + (row.leads == Leads::onwards ? mark : 0);
  const TwoTexts texts(row.label, row.shown, pen.width - left - right, inset);
  const ImVec2 size{pen.width, std::max(pen.touch(), texts.height() + inset)};
  const ImVec2 at = screenAt(pen);
  touch(pen, w, row.id.c_str(), at, size, row.value);
  const bool hovered = ImGui::IsItemHovered() && row.enabled;
  tip(w.why_not);
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float rounding = pen.skin.rounding * pen.unit, middle = at.y + size.y / 2;
  list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, hovered ? pen.skin.tile_hover : pen.skin.tile, rounding);
  list->AddRect(at, {at.x + size.x, at.y + size.y}, pen.skin.line, rounding, 0, pen.hair());
  if (row.leads == Leads::onwards)
    chevron(pen, {at.x + size.x - inset, middle}, true, faded(pen.skin.dim, row.enabled));
  if (row.leads == Leads::back) chevron(pen, {at.x + inset, middle}, false, faded(pen.skin.dim, row.enabled));
  texts.draw({at.x + left, middle - texts.height() / 2}, faded(pen.skin.tile_text, row.enabled),
             faded(pen.skin.dim, row.enabled));
  frame(pen, w, at, size);
}

// A row that is only read, with a line below.
void readRow(Pen& pen, const Widget& w, const std::string& label, const std::string& value, ImU32 label_colour,
             ImU32 value_colour, bool line) {
  const float inset = 0.4F * pen.unit;
  const TwoTexts texts(label, value, pen.width - 2 * inset, 2 * inset);
  const ImVec2 size{pen.width, texts.height() + inset};
  const ImVec2 at = screenAt(pen);
  if (area(("##" + w.id + label).c_str(), at, size) && pen.view.asking) pen.pressed(w.id);
  tip(w.why_not);
  texts.draw({at.x + inset, at.y + (line ? inset / 2 : 0)}, label_colour, value_colour);
  if (line)
    ImGui::GetWindowDrawList()->AddLine({at.x, at.y + size.y}, {at.x + size.x, at.y + size.y}, pen.skin.line,
                                        pen.hair());
  frame(pen, w, at, size);
}

}  // namespace

void drawTile(Pen& pen, const Widget& w) {
  pressedRow(pen, w, {"##" + w.id, "", w.label, w.value, w.enabled, w.leads});
}

void drawRows(Pen& pen, const Widget& w) {
  if (w.options.empty() || !w.acts) caption(pen, w.options.empty() ? w.label + ": –" : w.label);
  ImGui::PushID(w.id.c_str());
  for (const auto& option : w.options) {
    if (w.acts)
      pressedRow(pen, w, {option.value, option.value, option.label, "", w.enabled && option.enabled, w.leads});
    else
      readRow(pen, w, option.label, "", pen.skin.text, pen.skin.text, true);
  }
  ImGui::PopID();
}

void drawReadout(Pen& pen, const Widget& w) {
  readRow(pen, w, w.label, w.value, pen.skin.dim, w.why_not.empty() ? pen.skin.text : pen.skin.warning, false);
}

void drawBigKey(Pen& pen, const Widget& w) {
  const ImVec2 size{pen.width, 1.35F * pen.touch()};
  const ImVec2 at = screenAt(pen);
  touch(pen, w, ("##" + w.id).c_str(), at, size);
  const bool hovered = ImGui::IsItemHovered() && w.enabled;
  tip(w.why_not);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, faded(pen.skin.key, w.enabled), pen.skin.rounding * pen.unit);
  if (hovered)
    list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, IM_COL32(255, 255, 255, 28), pen.skin.rounding * pen.unit);
  centred(list, at, size, pen.skin.key_text, w.label);
  frame(pen, w, at, size);
}

void drawToggle(Pen& pen, const Widget& w) {
  const float inset = 0.8F * pen.unit, h = 1.4F * pen.unit, length = 2.6F * pen.unit;
  const float room = pen.width - 3 * inset - length;
  const float label = wrappedHeight(w.label, room);
  const ImVec2 size{pen.width, std::max(pen.touch(), label + inset)};
  const ImVec2 at = screenAt(pen);
  if (area(("##" + w.id).c_str(), at, size)) pen.pressed(w.id, w.value == "on" ? "off" : "on");
  const bool hovered = ImGui::IsItemHovered() && w.enabled;
  tip(w.why_not);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, hovered ? pen.skin.tile_hover : pen.skin.tile,
                      pen.skin.rounding * pen.unit);
  list->AddRect(at, {at.x + size.x, at.y + size.y}, pen.skin.line, pen.skin.rounding * pen.unit, 0, pen.hair());
  wrapped({at.x + inset, at.y + (size.y - label) / 2}, room, faded(pen.skin.tile_text, w.enabled), w.label);
  const bool on = w.value == "on";
  const float x = at.x + size.x - length - inset, y = at.y + (size.y - h) / 2;
  list->AddRectFilled({x, y}, {x + length, y + h}, faded(on ? pen.skin.accent : pen.skin.off, w.enabled), h / 2);
  list->AddCircleFilled({on ? x + length - h / 2 : x + h / 2, y + h / 2}, 0.42F * h, IM_COL32_WHITE, 20);
  frame(pen, w, at, size);
}

}  // namespace standpoint
