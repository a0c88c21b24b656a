// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/banners.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "editor/shell/editor.h"
#include "editor/shell/navigation_cube_view.h"
#include "editor/shell/overlay.h"

namespace standpoint {

namespace {

constexpr float kPad_pt = 8, kAboveEdge_pt = 26;

// What is set apart by wide gaps goes to the next line as a whole.
std::string brokenAtGaps(std::string_view words, float room) {
  constexpr std::string_view kGap = "   ";
  std::string text, line;
  while (!words.empty()) {
    const auto end = words.find(kGap);
    const std::string part(words.substr(0, end));
    const std::string longer = line.empty() ? part : line + std::string(kGap) + part;
    if (!line.empty() && ImGui::CalcTextSize(longer.c_str()).x > room) {
      text += line + "\n";
      line = part;
    } else {
      line = longer;
    }
    words.remove_prefix(end == std::string_view::npos ? words.size() : end + kGap.size());
  }
  return text + line;
}

bool isInTheWay(const Editor& editor, ImVec2 origin, ImVec2 size, ImVec2 extent, float top) {
  const ImVec2 pointer = ImGui::GetIO().MousePos;
  return std::abs(pointer.x - origin.x - size.x / 2) < extent.x / 2 + editor.px(48) &&
         pointer.y > top - editor.px(64) && pointer.y < origin.y + size.y;
}

float lowerPlace(const Editor& editor, ImVec2 origin, ImVec2 size, ImVec2 extent) {
  return origin.y + size.y - extent.y - editor.px(kAboveEdge_pt);
}

}  // namespace

ImVec2 bannersPlace(const Editor& editor, ImVec2 origin, ImVec2 size, ImVec2 extent) {
  const ImVec2 at(origin.x + (size.x - extent.x) / 2, lowerPlace(editor, origin, size, extent));
  if (!isInTheWay(editor, origin, size, extent, at.y)) return at;
  const float gap = editor.px(2 * kPad_pt);
  const ImVec2 cube = navigationCubeCorner(editor, origin, size);
  float controls_end = controlsCorner(editor, origin).y;
  if (at.x + extent.x + gap > cube.x) controls_end = std::max(controls_end, cube.y);
  return {at.x, std::max(controls_end, origin.y) + gap};
}

void drawBanners(Editor& editor, ImVec2 origin, ImVec2 size, const std::vector<Banner>& banners) {
  struct Placed {
    std::string words;
    ImVec2 extent;
    ImU32 ground;
  };
  const float pad = editor.px(kPad_pt), room = size.x - 4 * pad, between = 1.5F * pad;
  std::vector<Placed> placed;
  ImVec2 all(0, 0);
  for (const auto& banner : banners) {
    if (banner.words.empty()) continue;
    auto words = brokenAtGaps(banner.words.c_str(), room);
    const ImVec2 extent = ImGui::CalcTextSize(words.c_str(), nullptr, false, room);
    all = {std::max(all.x, extent.x), all.y + extent.y + (placed.empty() ? 0 : between)};
    placed.push_back({std::move(words), extent, banner.ground});
  }
  editor.banners_size = {all.x, all.y};
  if (placed.empty()) return;
  float y = bannersPlace(editor, origin, size, all).y;
  if (y == lowerPlace(editor, origin, size, all)) std::reverse(placed.begin(), placed.end());
  auto& list = *ImGui::GetWindowDrawList();
  for (const auto& one : placed) {
    const ImVec2 at(origin.x + (size.x - one.extent.x) / 2, y);
    list.AddRectFilled({at.x - pad, at.y - pad / 2}, {at.x + one.extent.x + pad, at.y + one.extent.y + pad / 2},
                       one.ground, pad / 2);
    list.AddText(nullptr, 0, at, IM_COL32(255, 255, 255, 255), one.words.c_str(), nullptr, room);
    y += one.extent.y + between;
  }
}

}  // namespace standpoint
