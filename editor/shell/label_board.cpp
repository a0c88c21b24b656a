// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/label_board.h"

#include <algorithm>

#include "editor/widgets/theme.h"

namespace standpoint {

namespace {

constexpr ImU32 kButton = IM_COL32(38, 84, 148, 245), kPointedButton = IM_COL32(64, 120, 196, 250);
constexpr float kLabelMargin = 4, kBesideMark = 10, kMark = 4, kSlack = 5;
constexpr float kOverHints = 110;  // at the lower edge of a view

// Each line in the middle.
void drawLines(ImDrawList& list, const std::string& text, ImVec2 at, float width, ImU32 tone) {
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const char *from = text.data() + begin, *to = text.data() + end;
    list.AddText({at.x + (width - ImGui::CalcTextSize(from, to).x) / 2, at.y}, tone, from, to);
    at.y += ImGui::GetTextLineHeight();
    begin = end + 1;
  }
}

// Where something is drawn that the label names.
bool hasMark(LabelKind kind) {
  return kind == LabelKind::station || kind == LabelKind::target || kind == LabelKind::waypoint ||
         kind == LabelKind::worst_place;
}

}  // namespace

void LabelBoard::add(LabelOf of, ImVec2 p, std::vector<std::string> texts, ImU32 tone, bool chosen, bool centred) {
  WantedLabel label;
  label.of = of;
  label.at_px = {p.x - origin_.x, p.y - origin_.y};
  label.centred = centred;
  label.chosen = chosen;
  label.gap_px = kBesideMark * scale_;
  if (hasMark(of.kind)) label.mark_px = kMark * scale_;
  for (auto& words : texts) {
    const ImVec2 size = ImGui::CalcTextSize(words.c_str());
    label.texts.push_back({std::move(words), {size.x + 2 * kLabelMargin * scale_, size.y + kLabelMargin * scale_}});
  }
  wanted_.push_back(std::move(label));
  tones_.push_back(tone);
}

void LabelBoard::keepFree(ImVec2 low, ImVec2 high) {
  kept_free_.push_back(
      {Eigen::Vector2d(low.x - origin_.x, low.y - origin_.y), Eigen::Vector2d(high.x - origin_.x, high.y - origin_.y)});
}

void LabelBoard::button(LabelOf of, ImVec2 p, std::string text) {
  buttons_.insert(of);
  const float half = ImGui::CalcTextSize(text.c_str()).x / 2 + (2 * kLabelMargin + kSlack) * scale_;
  p.x = std::max(std::min(p.x, origin_.x + size_.x - half), origin_.x + half);  // so that all of it is in the view
  p.y = std::max(std::min(p.y, origin_.y + size_.y - kOverHints * scale_), origin_.y + half);
  add(of, p, {std::move(text)}, IM_COL32(255, 255, 255, 255), false, true);
}

std::optional<LabelOf> LabelBoard::draw(ImDrawList& list, LabelLayout& layout, std::optional<ImVec2> pointer) const {
  std::optional<LabelOf> pointed;
  const auto places = layout.layOut(wanted_, {size_.x, size_.y}, kSlack * scale_, kept_free_);
  for (std::size_t i = 0; i < wanted_.size(); ++i) {
    if (!places[i]) continue;
    const auto& text = wanted_[i].texts[places[i]->text];
    const ImVec2 corner(origin_.x + static_cast<float>(places[i]->corner_px.x()),
                        origin_.y + static_cast<float>(places[i]->corner_px.y()));
    const ImVec2 size(static_cast<float>(text.size_px.x()), static_cast<float>(text.size_px.y()));
    const ImVec2 end(corner.x + size.x, corner.y + size.y);
    const bool acts = buttons_.contains(wanted_[i].of);
    const bool here =
        acts && pointer && pointer->x >= corner.x && pointer->x < end.x && pointer->y >= corner.y && pointer->y < end.y;
    if (here) pointed = wanted_[i].of;
    const ImU32 ground = acts ? here ? kPointedButton : kButton : ImU32(tone::kOverlay);
    list.AddRectFilled(corner, end, ground, kLabelMargin * scale_);
    drawLines(list, text.words, {corner.x, corner.y + kLabelMargin * scale_ / 2}, size.x, tones_[i]);
  }
  return pointed;
}

}  // namespace standpoint
