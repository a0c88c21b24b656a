// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "emulated-ui/draw/pen.h"

namespace standpoint {

namespace {

constexpr ImU32 kUnlit = IM_COL32(70, 72, 75, 255);
constexpr float kPi = std::numbers::pi_v<float>;

ImU32 lampColour(const std::string& word) {
  constexpr std::pair<const char*, ImU32> kColours[] = {
      {"green", IM_COL32(60, 200, 90, 255)},   {"red", IM_COL32(235, 60, 50, 255)},
      {"yellow", IM_COL32(250, 200, 50, 255)}, {"blue", IM_COL32(70, 150, 250, 255)},
      {"orange", IM_COL32(250, 140, 40, 255)}, {"white", IM_COL32(240, 244, 248, 255)}};
  for (const auto& [name, colour] : kColours)
    if (word.starts_with(name)) return colour;
  return kUnlit;
}

// How a lamp is lit: "yellow spinning".
enum class Light { steady, flashing, spinning, progress };
Light lightOf(const std::string& word) {
  if (word.ends_with("flashing") || word.ends_with("pulsating") || word.ends_with("blinking")) return Light::flashing;
  if (word.ends_with("spinning")) return Light::spinning;
  return word.ends_with("progress") ? Light::progress : Light::steady;
}

// With its corners rounded where both edges are long enough.
std::vector<ImVec2> outline(const BodyShape& shape, ImVec2 at, float scale) {
  std::vector<ImVec2> out;
  const std::size_t n = shape.points.size();
  const auto point = [&](std::size_t i) {
    const auto& [x, y] = shape.points[i % n];
    return ImVec2{at.x + x * scale, at.y + y * scale};
  };
  for (std::size_t i = 0; i < n; ++i) {
    const ImVec2 a = point(i + n - 1), b = point(i), c = point(i + 1);
    const float ab = std::hypot(b.x - a.x, b.y - a.y), bc = std::hypot(c.x - b.x, c.y - b.y);
    const float r = std::min({shape.round * scale, ab / 2, bc / 2});
    if (r < 0.5F) {
      out.push_back(b);
      continue;
    }
    const ImVec2 from{b.x + (a.x - b.x) * r / ab, b.y + (a.y - b.y) * r / ab};
    const ImVec2 to{b.x + (c.x - b.x) * r / bc, b.y + (c.y - b.y) * r / bc};
    constexpr int kSteps = 8;
    for (int k = 0; k <= kSteps; ++k) {  // a quarter of an ellipse between both edges, as its quadratic curve's middle
      const float t = static_cast<float>(k) / kSteps * kPi / 2, u = 1 - std::sin(t), v = 1 - std::cos(t);
      out.push_back({b.x + (from.x - b.x) * u + (to.x - b.x) * v, b.y + (from.y - b.y) * u + (to.y - b.y) * v});
    }
  }
  return out;
}

void lamp(Pen& pen, const Widget& w, const BodyKey& key, const Box& box) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  const double now = pen.view.still ? 0 : ImGui::GetTime();
  const Light light = lightOf(w.value);
  const bool dark = light == Light::flashing && std::fmod(now, 1.0) > 0.5;
  const ImU32 colour = dark ? kUnlit : lampColour(w.value);
  const ImVec2 centre{box.x + box.width / 2, box.y + box.height / 2};
  const float r = std::min(box.width, box.height) / 2;
  if (key.ring == 0) {
    list->AddCircleFilled(centre, r, (colour & 0x00FFFFFFU) | 0x40000000U, 24);
    list->AddCircleFilled(centre, 0.62F * r, colour, 24);
    list->AddCircle(centre, 0.62F * r, IM_COL32(40, 42, 45, 255), 24, pen.hair());
  } else {
    const auto share = pen.device.fact("phase.progress");
    const int lit = light == Light::progress && share
                        ? static_cast<int>(std::lround(share->number.value_or(0) * key.ring))
                        : key.ring;
    const int first = static_cast<int>(std::fmod(now, 1.0) * key.ring);  // of the two that spin, one turn in a second
    for (int i = 0; i < key.ring; ++i) {
      const bool on = light == Light::spinning ? (i - first + key.ring) % key.ring < 2 : i < lit;
      const float step = 2 * kPi / static_cast<float>(key.ring), a = -kPi / 2 + static_cast<float>(i) * step;
      list->PathArcTo(centre, 0.9F * r, a + 0.12F * step, a + 0.88F * step, 4);
      list->PathStroke(on ? colour : kUnlit, 0, 0.16F * r);
    }
  }
  // The key that a ring goes about lies in it.
  const float side = key.ring == 0 ? 2 * r : 0.3F * r;
  if (area(("##" + w.id).c_str(), {centre.x - r, centre.y - r}, {2 * r, side}) && pen.view.asking) pen.pressed(w.id);
  tip(w.label + ": " + w.value);
}

void hardKey(Pen& pen, const Widget& w, const BodyKey& key, const Box& box) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  touch(pen, w, ("##" + w.id).c_str(), {box.x, box.y}, {box.width, box.height});
  const bool hovered = ImGui::IsItemHovered(), down = ImGui::IsItemActive();
  tip(w.why_not.empty() ? w.label : w.why_not);
  const float r = std::min(box.width, box.height) / 2;
  const ImVec2 from{box.x, box.y}, to{box.right(), box.bottom()};
  list->AddRectFilled({from.x, from.y + pen.hair(1.5F)}, {to.x, to.y + pen.hair(1.5F)}, IM_COL32(0, 0, 0, 90), r);
  list->AddRectFilled(from, to,
                      down      ? IM_COL32(64, 67, 72, 255)
                      : hovered ? IM_COL32(112, 116, 122, 255)
                                : IM_COL32(88, 92, 98, 255),
                      r);
  list->AddRect(from, to, IM_COL32(30, 31, 33, 200), r, 0, pen.hair());
  if (!key.icon.empty())
    drawIcon(pen, key.icon, {box.x + box.width / 2, box.y + box.height / 2}, 0.62F * box.height, IM_COL32_WHITE);
  else
    fitted(pen, w.id, {box.x + 0.3F * r, box.y, box.width - 0.6F * r, box.height}, IM_COL32_WHITE, w.label);
  frame(pen, w, from, {box.width, box.height});
}

}  // namespace

void drawBody(Pen& pen, const Screen& screen, const DeviceFace& face, ImVec2 at, float scale) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  for (const auto& shape : face.shapes) {
    const auto points = outline(shape, at, scale);
    // Concave outlines are drawn as what they are made of; a file says each convex part as a shape.
    list->AddConvexPolyFilled(points.data(), static_cast<int>(points.size()), packed(shape.fill));
    if (shape.line)
      list->AddPolyline(points.data(), static_cast<int>(points.size()), packed(*shape.line), ImDrawFlags_Closed,
                        pen.hair(1.4F));
  }
  for (const auto& key : face.keys) {
    const auto found =
        std::find_if(screen.body.begin(), screen.body.end(), [&](const Widget& w) { return w.id == key.widget; });
    if (found == screen.body.end()) continue;
    const Box box{at.x + key.x * scale, at.y + key.y * scale, key.width * scale, key.height * scale};
    if (found->kind == WidgetKind::lamp)
      lamp(pen, *found, key, box);
    else
      hardKey(pen, *found, key, box);
  }
}

}  // namespace standpoint
