// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "emulated-ui/draw/pen.h"

namespace standpoint {

namespace {

constexpr ImU32 kGround = IM_COL32(14, 16, 18, 255), kPoint = IM_COL32(150, 160, 170, 120);
constexpr ImU32 kHolds = IM_COL32(70, 200, 110, 255), kFailed = IM_COL32(235, 80, 70, 255);
constexpr ImU32 kProposed = IM_COL32(170, 176, 184, 255), kName = IM_COL32(232, 236, 240, 255);
constexpr int kPointsOfSetup = 3000;
constexpr float kLowest_m = -1.2F, kHighest_m = 0.9F;  // of what is drawn, from the scanner: walls, no floor or ceiling
constexpr float kDoubleTap = 1.75F, kWheel = 1.2F, kLargest = 20;

// Metres to pixels: north is up.
struct MapFrame {
  double x_m = 0, y_m = 0, scale = 1;
  ImVec2 middle;

  ImVec2 at(double x, double y) const {
    return {middle.x + static_cast<float>((x - x_m) * scale), middle.y - static_cast<float>((y - y_m) * scale)};
  }
};

struct Extent {
  double low_x = 1e300, high_x = -1e300, low_y = 1e300, high_y = -1e300;

  void add(double x, double y) {
    low_x = std::min(low_x, x), high_x = std::max(high_x, x);
    low_y = std::min(low_y, y), high_y = std::max(high_y, y);
  }
};

// Where points of the preview lie on the plan.
template <class Each>
void eachPoint(const StoredSetup& setup, const Each& each) {
  if (!setup.preview) return;
  const auto& p = *setup.preview;
  const auto step = std::max<std::size_t>(1, p.x_m.size() / kPointsOfSetup);
  const double c = std::cos(setup.plan_turn_rad), s = std::sin(setup.plan_turn_rad);
  for (std::size_t i = 0; i < p.x_m.size(); i += step)
    if (std::isfinite(p.x_m[i]) && p.z_m[i] > kLowest_m && p.z_m[i] < kHighest_m)
      each(setup.plan_x_m + c * p.x_m[i] - s * p.y_m[i], setup.plan_y_m + s * p.x_m[i] + c * p.y_m[i]);
}

MapFrame frameOf(const std::vector<StoredSetup>& setups, ImVec2 at, ImVec2 size, float margin, const MapView& view) {
  constexpr double kFar_m = 40;  // a window's view of the street makes no room small
  Extent extent;
  for (const auto& setup : setups) {
    extent.add(setup.plan_x_m, setup.plan_y_m);
    eachPoint(setup, [&](double x, double y) {
      if (std::hypot(x - setup.plan_x_m, y - setup.plan_y_m) < kFar_m) extent.add(x, y);
    });
  }
  MapFrame frame;
  frame.x_m = (extent.low_x + extent.high_x) / 2, frame.y_m = (extent.low_y + extent.high_y) / 2;
  frame.scale = view.zoom * std::min((size.x - 2 * margin) / std::max(2.0, extent.high_x - extent.low_x),
                                     (size.y - 2 * margin) / std::max(2.0, extent.high_y - extent.low_y));
  frame.middle = {at.x + size.x * (0.5F + view.x), at.y + size.y * (0.5F + view.y)};
  return frame;
}

void dashed(ImDrawList* list, ImVec2 a, ImVec2 b, ImU32 colour, float dash, float thick) {
  const float length = std::hypot(b.x - a.x, b.y - a.y);
  if (length < 1) return;
  for (float t = 0; t < length; t += 2 * dash) {
    const float u = t / length, v = std::min(t + dash, length) / length;
    list->AddLine({a.x + u * (b.x - a.x), a.y + u * (b.y - a.y)}, {a.x + v * (b.x - a.x), a.y + v * (b.y - a.y)},
                  colour, thick);
  }
}

// Dragged, the wheel and a double tap; what is below the pointer stays there.
void moveMap(MapView& view, ImVec2 at, ImVec2 size) {
  const auto& io = ImGui::GetIO();
  if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left)) {
    view.x += io.MouseDelta.x / size.x;
    view.y += io.MouseDelta.y / size.y;
  }
  if (!ImGui::IsItemHovered()) return;
  float factor = io.MouseWheel == 0 ? 1 : std::pow(kWheel, io.MouseWheel);
  if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) factor *= kDoubleTap;
  const float zoom = std::clamp(view.zoom * factor, 1.0F, kLargest), grown = zoom / view.zoom;
  if (grown == 1) return;
  const float u = (io.MousePos.x - at.x) / size.x - 0.5F, v = (io.MousePos.y - at.y) / size.y - 0.5F;
  view.x = u + (view.x - u) * grown;
  view.y = v + (view.y - v) * grown;
  view.zoom = zoom;
  if (zoom == 1) view = {};
}

}  // namespace

// Set-ups from above on what they have seen; links that hold are green, failed ones red, proposed ones broken lines.
void drawPlan(Pen& pen, const Widget& w) {
  if (pen.height == 0) caption(pen, w.label);
  const ImVec2 at = screenAt(pen);
  const ImVec2 size{pen.width, pen.height > 0 ? pen.height : pen.width * 0.6F};
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, kGround);
  if (area(("##" + w.id).c_str(), at, size) && pen.view.asking) pen.pressed(w.id);
  auto& view = pen.view.maps[pen.screen + "/" + w.id];
  moveMap(view, at, size);
  const auto* project = pen.device.project();
  if (project == nullptr || project->setups.empty()) return centred(list, at, size, kProposed, "–");
  list->PushClipRect(at, {at.x + size.x, at.y + size.y}, true);
  const auto& setups = project->setups;
  const auto map = frameOf(setups, at, size, 1.6F * pen.unit, view);
  const float dot = pen.hair(0.8F);
  for (const auto& setup : setups)
    eachPoint(setup, [&](double x, double y) {
      const ImVec2 p = map.at(x, y);
      list->AddRectFilled({p.x - dot, p.y - dot}, {p.x + dot, p.y + dot}, kPoint);
    });
  for (std::size_t i = 1; i < setups.size(); ++i) {
    const ImVec2 a = map.at(setups[i - 1].plan_x_m, setups[i - 1].plan_y_m),
                 b = map.at(setups[i].plan_x_m, setups[i].plan_y_m);
    if (const auto& link = setups[i].link)
      list->AddLine(a, b, link->joined ? kHolds : kFailed, pen.hair(2.5F));
    else if (setups[i].tracked)
      dashed(list, a, b, kProposed, 0.5F * pen.unit, pen.hair(1.5F));
  }
  const float r = 0.85F * pen.unit;
  for (const auto& s : setups) {
    const ImVec2 p = map.at(s.plan_x_m, s.plan_y_m);
    list->AddCircleFilled(p, r, pen.skin.accent, 32);
    list->AddCircle(p, r, kName, 32, pen.hair(1.2F));
    fitted(pen, w.id, {p.x - 0.8F * r, p.y - r, 1.6F * r, 2 * r}, pen.skin.accent_text, std::to_string(s.number),
           Align::centre, 0.85F);
    const float width = ImGui::CalcTextSize(s.name.c_str()).x;
    const bool right = p.x + 1.3F * r + width < at.x + size.x;
    list->AddText({right ? p.x + 1.3F * r : p.x - 1.3F * r - width, p.y - ImGui::GetTextLineHeight() / 2}, kName,
                  s.name.c_str());
  }
  list->PopClipRect();
}

}  // namespace standpoint
