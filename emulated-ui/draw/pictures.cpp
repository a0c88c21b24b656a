// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include <fmt/format.h>

#include "emulated-ui/draw/pen.h"

namespace standpoint {

namespace {

ImVec2 plus(ImVec2 a, ImVec2 b) { return {a.x + b.x, a.y + b.y}; }

// Of the setup on view, else of the newest.
const std::shared_ptr<const ScanPreview>& newestPreview(const Device& device) {
  static const std::shared_ptr<const ScanPreview> kNone;
  if (const auto* shown = device.shownSetup(); shown != nullptr && shown->preview) return shown->preview;
  if (const auto* newest = device.newestSetup(); newest != nullptr) return newest->preview;
  return kNone;
}

}  // namespace

// The picture where there is one, else a grid of the sphere.
bool scanPicture(const Pen& pen, const std::shared_ptr<const ScanPreview>& preview, ImVec2 at, ImVec2 size) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(at, plus(at, size), IM_COL32(28, 30, 33, 255));
  const std::uint64_t texture = preview && pen.view.texture ? pen.view.texture(preview) : 0;
  if (texture != 0) {
    list->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture)), at, plus(at, size));
    return true;
  }
  for (int i = 1; i < 12; ++i) {
    const float x = at.x + size.x * static_cast<float>(i) / 12;
    list->AddLine({x, at.y}, {x, at.y + size.y}, IM_COL32(255, 255, 255, 22));
  }
  for (int i = 1; i < 5; ++i) {
    const float y = at.y + size.y * static_cast<float>(i) / 5;
    list->AddLine({at.x, y}, {at.x + size.x, y}, IM_COL32(255, 255, 255, 22));
  }
  return false;
}

// The bubble runs to where the instrument is high; the ring is as far as the sensor corrects.
void drawLevel(Pen& pen, const Widget& w) {
  if (pen.height == 0) caption(pen, w.label);
  const float radius =
      pen.height > 0 ? 0.46F * std::min(pen.width, pen.height) : std::min(3.4F * pen.unit, pen.width / 4);
  const ImVec2 at = screenAt(pen);
  const ImVec2 centre{at.x + pen.width / 2, at.y + (pen.height > 0 ? pen.height / 2 : radius + 2)};
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddCircleFilled(centre, radius, IM_COL32(196, 214, 96, 255), 48);
  list->AddCircle(centre, radius, pen.skin.dim, 48, pen.hair(1.5F));
  list->AddCircle(centre, radius * 0.5F, IM_COL32(60, 70, 30, 160), 40, 1);
  list->AddLine({centre.x - radius, centre.y}, {centre.x + radius, centre.y}, IM_COL32(60, 70, 30, 80));
  list->AddLine({centre.x, centre.y - radius}, {centre.x, centre.y + radius}, IM_COL32(60, 70, 30, 80));
  const double limit = std::max(1e-6, w.maximum);
  double x = -std::strtod(w.options[0].value.c_str(), nullptr) / limit * 0.5,
         y = std::strtod(w.options[1].value.c_str(), nullptr) / limit * 0.5;
  const double far = std::hypot(x, y);
  if (far > 0.8) x *= 0.8 / far, y *= 0.8 / far;
  const ImVec2 bubble{centre.x + radius * static_cast<float>(x), centre.y + radius * static_cast<float>(y)};
  list->AddCircleFilled(bubble, 0.18F * radius, IM_COL32(245, 250, 225, 235), 24);
  list->AddCircle(bubble, 0.18F * radius, IM_COL32(90, 110, 40, 255), 24);
  if (area(("##" + w.id).c_str(), at, {pen.width, pen.height > 0 ? pen.height : 2 * radius + 4}) && pen.view.asking)
    pen.pressed(w.id);
}

// The field of view on the picture all around: its edges are dragged.
void drawArea(Pen& pen, const Widget& w) {
  if (pen.height == 0) caption(pen, w.label);
  const ImVec2 at = screenAt(pen);
  const ImVec2 size{pen.width, pen.height > 0 ? pen.height : pen.width * 0.42F};
  scanPicture(pen, newestPreview(pen.device), at, size);
  const auto& instrument = pen.device.type().instrument;
  const double low = instrument.min_elevation_rad * 57.29577951308232,
               high = instrument.max_elevation_rad * 57.29577951308232;
  std::array<double, 4> edges{};
  for (int i = 0; i < 4; ++i) edges[i] = std::strtod(w.options[i].value.c_str(), nullptr);
  if (pen.view.dragged_edge >= 0) edges = pen.view.area;
  const auto x_of = [&](double deg) { return at.x + size.x * static_cast<float>(deg / 360); };
  const auto y_of = [&](double deg) { return at.y + size.y * static_cast<float>((high - deg) / (high - low)); };
  const ImVec2 from{x_of(edges[0]), y_of(edges[3])}, to{x_of(edges[1]), y_of(edges[2])};
  ImDrawList* list = ImGui::GetWindowDrawList();
  // What is not scanned is dark.
  constexpr ImU32 kOutside = IM_COL32(0, 0, 0, 150);
  list->AddRectFilled(at, {at.x + size.x, from.y}, kOutside);
  list->AddRectFilled({at.x, to.y}, plus(at, size), kOutside);
  if (from.x > to.x) {  // it goes on over the picture's edge
    list->AddRectFilled({to.x, from.y}, {from.x, to.y}, kOutside);
    list->AddRect({at.x, from.y}, to, pen.skin.accent, 0, 0, pen.hair(2));
    list->AddRect(from, {at.x + size.x, to.y}, pen.skin.accent, 0, 0, pen.hair(2));
  } else {
    list->AddRectFilled({at.x, from.y}, {from.x, to.y}, kOutside);
    list->AddRectFilled({to.x, from.y}, {at.x + size.x, to.y}, kOutside);
    list->AddRect(from, to, pen.skin.accent, 0, 0, pen.hair(2));
  }
  (void)area(("##" + w.id).c_str(), at, size);
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (ImGui::IsItemActivated()) {
    if (pen.view.asking) return pen.pressed(w.id);
    const std::array<float, 4> far = {std::abs(mouse.x - from.x), std::abs(mouse.x - to.x), std::abs(mouse.y - to.y),
                                      std::abs(mouse.y - from.y)};
    pen.view.dragged_edge = static_cast<int>(std::min_element(far.begin(), far.end()) - far.begin());
    pen.view.area = edges;
  }
  if (pen.view.dragged_edge >= 0 && ImGui::IsItemActive()) {
    auto& e = pen.view.area;
    const double h = std::clamp(360.0 * (mouse.x - at.x) / size.x, 0.0, 360.0),
                 v = std::clamp(high - (high - low) * (mouse.y - at.y) / size.y, low, high);
    if (pen.view.dragged_edge == 0) e[0] = std::min(std::round(h), e[1] - 1);
    if (pen.view.dragged_edge == 1) e[1] = std::max(std::round(h), e[0] + 1);
    if (pen.view.dragged_edge == 2) e[2] = std::min(std::round(v), e[3] - 1);
    if (pen.view.dragged_edge == 3) e[3] = std::max(std::round(v), e[2] + 1);
  }
  if (pen.view.dragged_edge >= 0 && ImGui::IsItemDeactivated()) {
    const auto& e = pen.view.area;
    pen.pressed(w.id, fmt::format("{:g},{:g},{:g},{:g}", e[0], e[1], e[2], e[3]));
    pen.view.dragged_edge = -1;
  }
}

// What was tapped to measure: "u,v" or "u,v;u,v" from the upper left.
void drawTaps(const Pen& pen, ImVec2 at, ImVec2 size) {
  const auto text = pen.device.entry("tapped");
  std::array<ImVec2, 2> p;
  const int read = std::sscanf(text.c_str(), "%f,%f;%f,%f", &p[0].x, &p[0].y, &p[1].x, &p[1].y);
  ImDrawList* list = ImGui::GetWindowDrawList();
  for (auto& tap : p) tap = {at.x + tap.x * size.x, at.y + tap.y * size.y};
  if (read == 4) list->AddLine(p[0], p[1], IM_COL32(255, 178, 0, 255), pen.hair(2));
  for (int i = 0; 2 * i + 1 < read; ++i) {
    list->AddCircle(p[i], 0.45F * pen.unit, IM_COL32(0, 0, 0, 200), 16, pen.hair(4));
    list->AddCircle(p[i], 0.45F * pen.unit, IM_COL32(255, 178, 0, 255), 16, pen.hair(2));
  }
}

void drawPreview(Pen& pen, const Widget& w) {
  const auto* setup = pen.device.shownSetup();
  const auto preview = setup == nullptr ? nullptr : setup->preview;
  const auto& instrument = pen.device.type().instrument;
  const auto whole =
      static_cast<float>((instrument.max_elevation_rad - instrument.min_elevation_rad) / (2 * std::numbers::pi));
  const float aspect = preview && preview->columns > 0
                           ? static_cast<float>(preview->rows) / static_cast<float>(preview->columns)
                           : whole;
  ImVec2 at = screenAt(pen);
  ImVec2 size{pen.width, pen.width * aspect};
  if (pen.height > 0) {  // as large as the room lets it be, in its middle
    const ImVec2 room{pen.width, pen.height};
    ImGui::GetWindowDrawList()->AddRectFilled(at, plus(at, room), IM_COL32(12, 13, 15, 255));
    const float scale = std::min(1.0F, room.y / size.y);
    size = {size.x * scale, size.y * scale};
    at = plus(at, {(room.x - size.x) / 2, (room.y - size.y) / 2});
  }
  const bool has = scanPicture(pen, preview, at, size);
  if (!has)
    centred(ImGui::GetWindowDrawList(), at, size, IM_COL32(200, 204, 210, 255), w.label);
  else
    drawTaps(pen, at, size);
  double u = 0, v = 0;  // where its laser pointer rests
  const auto spot = pen.device.fact("pointer.range");
  if (spot && spot->number.value_or(0) > 0 && std::sscanf(pen.device.entry("pointer").c_str(), "%lf,%lf", &u, &v) == 2)
    ImGui::GetWindowDrawList()->AddCircleFilled(
        {at.x + size.x * static_cast<float>(u), at.y + size.y * static_cast<float>(v)}, 0.35F * pen.unit,
        IM_COL32(255, 30, 20, 255), 16);
  if (area(("##" + w.id).c_str(), at, size)) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    pen.pressed(w.id, fmt::format("{:.4f},{:.4f}", std::clamp((mouse.x - at.x) / size.x, 0.0F, 0.9999F),
                                  std::clamp((mouse.y - at.y) / size.y, 0.0F, 0.9999F)));
  }
}

}  // namespace standpoint
