// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/points_legend.h"

#include <algorithm>

#include "editor/shell/editor.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/figures.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

constexpr std::size_t kMostClasses = 10;
constexpr float kMargin_pt = 18, kPad_pt = 8;

std::string shareText(std::uint64_t points, std::uint64_t all) {
  return figures("{:.1f} %",
                 100.0 * static_cast<double>(points) / static_cast<double>(std::max<std::uint64_t>(1, all)));
}

// At the lower left of the view, above the words there that it would lie on; where what stands on it begins.
ImVec2 drawGround(Editor& editor, ImVec2 origin, ImVec2 view, ImVec2 size) {
  constexpr float kBesideWords_pt = 16, kOverWords_pt = 40;
  const float pad = editor.px(kPad_pt), margin = editor.px(kMargin_pt);
  const auto& words = editor.banners_size;
  const bool on_words = words.y() > 0 && margin + size.x + pad > (view.x - words.x()) / 2 - editor.px(kBesideWords_pt);
  const float below = on_words ? words.y() + editor.px(kOverWords_pt) : margin;
  const ImVec2 at(origin.x + margin, origin.y + view.y - size.y - below);
  ImGui::GetWindowDrawList()->AddRectFilled({at.x - pad, at.y - pad}, {at.x + size.x + pad, at.y + size.y + pad},
                                            tone::kOverlay, editor.px(4));
  editor.legend_size = {margin + size.x + pad, below + size.y + pad};
  return at;
}

// Which points the ends stand for, and which have no figure.
std::string clampText(const PointLegend& legend) {
  std::uint64_t all = legend.no_data + legend.below + legend.above;
  for (const auto n : legend.histogram) all += n;
  std::string text = trf("{} below, {} above", shareText(legend.below, all), shareText(legend.above, all));
  if (legend.no_data > 0) text += trf(", {} without (grey)", shareText(legend.no_data, all));
  return text;
}

// In a low view colours and figures alone: the histogram and its shares would hide much of what they are about.
void drawScale(Editor& editor, const PointLegend& legend, ImVec2 origin, ImVec2 size) {
  constexpr float kLow_pt = 440;
  auto& list = *ImGui::GetWindowDrawList();
  const bool low = size.y < editor.px(kLow_pt);
  const float line = ImGui::GetTextLineHeight(), width = editor.px(low ? 220.0F : 320.0F), bar = editor.px(10);
  const float peaks = low ? 0 : editor.px(26);
  const auto title = tr(legend.title) + (legend.unit.empty() ? "" : ", " + legend.unit);
  const auto clamped = low ? std::string() : clampText(legend);
  const float wide = std::max({width, ImGui::CalcTextSize(title.c_str()).x, ImGui::CalcTextSize(clamped.c_str()).x});
  const float height = line + peaks + bar + editor.px(6) + (low ? 1.0F : 2.0F) * line;
  const ImVec2 at = drawGround(editor, origin, size, {wide, height});
  list.AddText(at, tone::kText, title.c_str());
  const float top = at.y + line, y = top + peaks;
  const auto most = std::max<std::uint32_t>(1, *std::max_element(legend.histogram.begin(), legend.histogram.end()));
  for (std::size_t i = 0; i < PointLegend::kBins; ++i) {
    const double fraction = (static_cast<double>(i) + 0.5) / PointLegend::kBins;
    const auto tone = packed(legend.is_diverging ? diverging(fraction) : viridis(fraction));
    const float from = at.x + width * static_cast<float>(i) / PointLegend::kBins,
                to = at.x + width * static_cast<float>(i + 1) / PointLegend::kBins;
    const float peak = peaks * 0.9F * static_cast<float>(legend.histogram[i]) / static_cast<float>(most);
    list.AddRectFilled({from, y - peak}, {to, y}, tone::kDim);
    list.AddRectFilled({from, y}, {to, y + bar}, tone);
  }
  for (std::size_t i = 0; i < legend.ticks.size(); ++i) {
    const auto x = at.x + width * static_cast<float>((legend.ticks[i] - legend.low) / (legend.high - legend.low));
    list.AddLine({x, y + bar}, {x, y + bar + editor.px(4)}, tone::kText, editor.px(1));
    const std::string text = asFigure(legend.tick_texts[i]);
    const float half = ImGui::CalcTextSize(text.c_str()).x / 2;
    list.AddText({std::clamp(x - half, at.x, at.x + std::max(0.0F, wide - 2 * half)), y + bar + editor.px(5)},
                 tone::kText, text.c_str());
  }
  list.AddText({at.x, y + bar + editor.px(6) + line}, tone::kDim, clamped.c_str());
}

// Files name materials by their ids; who reads a legend knows them by their labels.
std::string className(const Editor& editor, const std::string& name) {
  if (editor.view.points_by != ColourBy::material) return name;
  const auto& materials = editor.offeredMaterials();
  const auto found = std::find_if(materials.begin(), materials.end(), [&](const auto& m) { return m.id == name; });
  return found == materials.end() ? name : tr(found->label);
}

void drawClasses(Editor& editor, const PointLegend& legend, ImVec2 origin, ImVec2 size) {
  auto& list = *ImGui::GetWindowDrawList();
  std::uint64_t all = legend.no_data, others = 0;
  for (std::size_t i = 0; i < legend.classes.size(); ++i) {
    all += legend.classes[i].points;
    if (i >= kMostClasses) others += legend.classes[i].points;
  }
  std::vector<std::pair<Rgba8, std::string>> rows;
  for (std::size_t i = 0; i < std::min(kMostClasses, legend.classes.size()); ++i)
    rows.emplace_back(legend.classes[i].colour,
                      className(editor, legend.classes[i].name) + "   " + shareText(legend.classes[i].points, all));
  if (others > 0)
    rows.emplace_back(kOtherColour,
                      trf("{} others   {}", legend.classes.size() - kMostClasses, shareText(others, all)));
  if (legend.no_data > 0) rows.emplace_back(kNoDataColour, trf("none   {}", shareText(legend.no_data, all)));
  const float line = ImGui::GetTextLineHeight() + editor.px(3), swatch = editor.px(10);
  const auto title = tr(legend.title);
  float wide = ImGui::CalcTextSize(title.c_str()).x;
  for (const auto& [colour, text] : rows)
    wide = std::max(wide, swatch + editor.px(6) + ImGui::CalcTextSize(text.c_str()).x);
  const float height = line * static_cast<float>(rows.size() + 1);
  ImVec2 at = drawGround(editor, origin, size, {wide, height});
  list.AddText(at, tone::kText, title.c_str());
  for (const auto& [colour, text] : rows) {
    at.y += line;
    list.AddRectFilled({at.x, at.y + editor.px(2)}, {at.x + swatch, at.y + editor.px(2) + swatch}, packed(colour));
    list.AddText({at.x + swatch + editor.px(6), at.y}, tone::kText, text.c_str());
  }
}

}  // namespace

void drawPointsLegend(Editor& editor, ImVec2 origin, ImVec2 size) {
  editor.legend_size = {0, 0};
  const auto* legend = editor.pointLegend();
  if (legend == nullptr) return;
  if (legend->has_scale)
    drawScale(editor, *legend, origin, size);
  else if (!legend->classes.empty() || legend->no_data > 0)
    drawClasses(editor, *legend, origin, size);
}

}  // namespace standpoint
