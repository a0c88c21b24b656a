// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "emulated-ui/device/picture.h"
#include "emulated-ui/draw/pen.h"

namespace standpoint {

namespace {

constexpr float kFirstCell_px = 5, kSmallestCell_px = 1.5F, kLargestCell_px = 24, kCloser = 1.2F;
constexpr ImU32 kCross = IM_COL32(255, 178, 0, 255), kCrossEdge = IM_COL32(0, 0, 0, 190);

using Aim = std::array<double, 2>;

// All around a picture goes on from its left edge at its right one; above and below it ends.
Aim inside(const ScanPreview& picture, Aim aim) {
  aim[0] -= std::floor(aim[0]);
  aim[0] = std::min(aim[0], 1 - 1e-5);
  aim[1] = std::clamp(aim[1], 0.5 / picture.rows, 1 - 0.5 / picture.rows);
  return aim;
}

void pressedAim(Pen& pen, const Widget& w, const Aim& aim) {
  pen.pressed(w.id, fmt::format("{:.5f},{:.5f}", aim[0], aim[1]));
}

// The picture three times beside itself, so that its ends meet under the cross.
void drawTurned(Pen& pen, const std::shared_ptr<const ScanPreview>& preview, const Box& box, const Aim& aim,
                float cell) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  const std::uint64_t texture = pen.view.texture ? pen.view.texture(preview) : 0;
  const float width = cell * static_cast<float>(preview->columns), height = cell * static_cast<float>(preview->rows);
  const float top = box.y + box.height / 2 - static_cast<float>(aim[1]) * height;
  const float left = box.x + box.width / 2 - static_cast<float>(aim[0]) * width;
  for (const float x : {left - width, left, left + width}) {
    if (texture != 0)
      list->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture)), {x, top},
                     {x + width, top + height});
    else
      list->AddRect({x, top}, {x + width, top + height}, IM_COL32(255, 255, 255, 60), 0, 0, pen.hair());
  }
}

void drawCrossLines(const Pen& pen, ImVec2 middle) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float gap = 0.4F * pen.unit, reach = 2.2F * pen.unit;
  for (const auto& [colour, thick] : {std::pair{kCrossEdge, 4.0F}, {kCross, 1.8F}}) {
    for (const float side : {-1.0F, 1.0F}) {
      list->AddLine({middle.x + side * gap, middle.y}, {middle.x + side * reach, middle.y}, colour, pen.hair(thick));
      list->AddLine({middle.x, middle.y + side * gap}, {middle.x, middle.y + side * reach}, colour, pen.hair(thick));
    }
    list->AddCircle(middle, reach, colour, 40, pen.hair(thick));
  }
}

struct Nudge {
  const char* id;
  int x, y;
  ImGuiKey key;
};
constexpr std::array kNudges = {Nudge{"left", -1, 0, ImGuiKey_LeftArrow}, Nudge{"right", 1, 0, ImGuiKey_RightArrow},
                                Nudge{"up", 0, -1, ImGuiKey_UpArrow}, Nudge{"down", 0, 1, ImGuiKey_DownArrow}};

// Wherever the pointer is, as long as the device has the keyboard and no text is typed.
std::optional<Nudge> arrowKey() {
  if (ImGui::GetIO().WantTextInput || !ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows))
    return std::nullopt;
  for (const auto& n : kNudges)
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(n.key))) return n;
  return std::nullopt;
}

// At the edges of the picture: one cell further.
std::optional<Nudge> nudged(const Pen& pen, const Box& box) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  std::optional<Nudge> by;
  const float side = pen.touch();
  for (const auto& n : kNudges) {
    const auto x = static_cast<float>(n.x), y = static_cast<float>(n.y);
    const ImVec2 c{box.x + box.width / 2 + x * (box.width - side) / 2,
                   box.y + box.height / 2 + y * (box.height - side) / 2};
    if (area(n.id, {c.x - side / 2, c.y - side / 2}, {side, side})) by = n;
    const bool hovered = ImGui::IsItemHovered();
    list->AddCircleFilled(c, 0.42F * side, IM_COL32(0, 0, 0, hovered ? 210 : 140), 32);
    const float s = 0.16F * side;
    const ImVec2 tip{c.x + x * s, c.y + y * s};
    list->AddPolyline(std::array{ImVec2{tip.x - (x + y) * s, tip.y - (y - x) * s}, tip,
                                 ImVec2{tip.x - (x - y) * s, tip.y - (y + x) * s}}
                          .data(),
                      3, IM_COL32_WHITE, 0, pen.hair(2));
  }
  return by;
}

}  // namespace

void drawCross(Pen& pen, const Widget& w, const Box& box) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled({box.x, box.y}, {box.right(), box.bottom()}, IM_COL32(12, 13, 15, 255));
  const auto* setup = pen.device.shownSetup();
  const auto preview = setup == nullptr ? nullptr : setup->preview;
  if (!preview || preview->columns == 0 || preview->rows == 0)
    return centred(list, {box.x, box.y}, {box.width, box.height}, IM_COL32(200, 204, 210, 255), w.label);
  const auto told = placeIn(pen.device.entry("aim")).value_or(PicturePlace{});
  Aim aim = pen.view.aim.value_or(Aim{told.u, told.v});
  auto& zoom = pen.view.maps[pen.screen + "/" + w.id].zoom;
  const float cell = std::clamp(kFirstCell_px * zoom, kSmallestCell_px, kLargestCell_px) * pen.hair();
  list->PushClipRect({box.x, box.y}, {box.right(), box.bottom()}, true);
  drawTurned(pen, preview, box, aim, cell);
  auto nudge = nudged(pen, box);
  (void)area(("##" + w.id).c_str(), {box.x, box.y}, {box.width, box.height});
  const auto& io = ImGui::GetIO();
  const float width = cell * static_cast<float>(preview->columns), height = cell * static_cast<float>(preview->rows);
  const ImVec2 middle{box.x + box.width / 2, box.y + box.height / 2};
  if (ImGui::IsItemHovered())
    zoom = std::clamp(zoom * std::pow(kCloser, io.MouseWheel), kSmallestCell_px / kFirstCell_px,
                      kLargestCell_px / kFirstCell_px);
  if (const auto by_key = arrowKey(); by_key && !nudge) nudge = by_key;
  if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left)) {
    aim[0] -= io.MouseDelta.x / width;
    aim[1] -= io.MouseDelta.y / height;
    pen.view.aim = aim = inside(*preview, aim);
  }
  if (ImGui::IsItemDeactivated()) {
    if (!pen.view.aim)  // a tap: what it is on comes under the cross
      aim =
          inside(*preview, {aim[0] + (io.MousePos.x - middle.x) / width, aim[1] + (io.MousePos.y - middle.y) / height});
    pressedAim(pen, w, aim);
    pen.view.aim.reset();
  }
  if (nudge)
    pressedAim(pen, w,
               inside(*preview, {aim[0] + static_cast<double>(nudge->x) / preview->columns,
                                 aim[1] + static_cast<double>(nudge->y) / preview->rows}));
  drawCrossLines(pen, middle);
  list->PopClipRect();
}

}  // namespace standpoint
