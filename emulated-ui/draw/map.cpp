// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/units.h"
#include "emulated-ui/device/linking.h"
#include "emulated-ui/draw/pen.h"

namespace standpoint {

namespace {

constexpr ImU32 kGround = IM_COL32(14, 16, 18, 255), kPoint = IM_COL32(150, 160, 170, 120);
constexpr ImU32 kHolds = IM_COL32(70, 200, 110, 255), kFailed = IM_COL32(235, 80, 70, 255);
constexpr ImU32 kProposed = IM_COL32(170, 176, 184, 255), kName = IM_COL32(232, 236, 240, 255);
constexpr ImU32 kMoving = IM_COL32(255, 170, 60, 255), kFixed = IM_COL32(90, 200, 235, 190);  // while one is laid
constexpr ImU32 kBeside = IM_COL32(110, 116, 122, 90), kDrawn = IM_COL32(255, 255, 255, 230);
constexpr double kFarthest_m = 100;  // that a cloud is laid away
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

// Where a cloud lies on the plan, and how it is turned.
struct CloudPlace {
  double x_m = 0, y_m = 0, turn_rad = 0;

  explicit CloudPlace(const StoredSetup& s) : x_m(s.plan_x_m), y_m(s.plan_y_m), turn_rad(s.plan_turn_rad) {}
  void move(const Pose& by) {
    const Eigen::Vector3d at = by * Eigen::Vector3d(x_m, y_m, 0), ahead = by.rotation * Eigen::Vector3d::UnitX();
    x_m = at.x(), y_m = at.y();
    turn_rad += std::atan2(ahead.y(), ahead.x());
  }
};

// What its links make of it: a wrong match is seen as walls that are double.
CloudPlace linkedPlace(const std::vector<StoredSetup>& setups, const StoredSetup& setup) {
  CloudPlace place(setup);
  place.move(movedByLinks(setups, setup));
  return place;
}

// As it is laid by hand, or is being laid; untouched, as its link has it.
CloudPlace laidPlace(const std::vector<StoredSetup>& setups, const LaidCloud& laid, const std::array<double, 3>& by) {
  const auto& setup = setups[laid.setup];
  if (by == std::array<double, 3>{} && setup.link && setup.link->joined) return linkedPlace(setups, setup);
  CloudPlace place(setup);
  place.x_m += by[0];
  place.y_m += by[1];
  place.turn_rad += (laid.start_turn_deg + by[2]) * kRadPerDeg;
  return place;
}

template <class Each>
void eachPoint(const StoredSetup& setup, const CloudPlace& place, const Each& each) {
  if (!setup.preview) return;
  const auto& p = *setup.preview;
  const auto step = std::max<std::size_t>(1, p.x_m.size() / kPointsOfSetup);
  const double c = std::cos(place.turn_rad), s = std::sin(place.turn_rad);
  for (std::size_t i = 0; i < p.x_m.size(); i += step)
    if (std::isfinite(p.x_m[i]) && p.z_m[i] > kLowest_m && p.z_m[i] < kHighest_m)
      each(place.x_m + c * p.x_m[i] - s * p.y_m[i], place.y_m + s * p.x_m[i] + c * p.y_m[i]);
}

Extent extentOf(const std::vector<StoredSetup>& setups) {
  constexpr double kFar_m = 40;  // a window's view of the street makes no room small
  Extent extent;
  for (const auto& setup : setups) {
    extent.add(setup.plan_x_m, setup.plan_y_m);
    eachPoint(setup, CloudPlace(setup), [&](double x, double y) {
      if (std::hypot(x - setup.plan_x_m, y - setup.plan_y_m) < kFar_m) extent.add(x, y);
    });
  }
  return extent;
}

MapFrame frameOf(const Extent& extent, ImVec2 at, ImVec2 size, float margin, const MapView& view) {
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
void moveMap(MapView& view, const MapGrip& grip, ImVec2 at, ImVec2 size) {
  const auto& io = ImGui::GetIO();
  if (grip.on == MapGrip::On::ground && ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left)) {
    view.x += io.MouseDelta.x / size.x;
    view.y += io.MouseDelta.y / size.y;
  }
  if (!ImGui::IsItemHovered()) return;
  float factor = io.MouseWheel == 0 ? 1 : std::pow(kWheel, io.MouseWheel);
  if (grip.on == MapGrip::On::ground && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) factor *= kDoubleTap;
  const float zoom = std::clamp(view.zoom * factor, 1.0F, kLargest), grown = zoom / view.zoom;
  if (grown == 1) return;
  const float u = (io.MousePos.x - at.x) / size.x - 0.5F, v = (io.MousePos.y - at.y) / size.y - 0.5F;
  view.x = u + (view.x - u) * grown;
  view.y = v + (view.y - v) * grown;
  view.zoom = zoom;
  if (zoom == 1) view = {};
}

float away(ImVec2 a, ImVec2 b) { return std::hypot(a.x - b.x, a.y - b.y); }

float awayFromLine(ImVec2 p, ImVec2 a, ImVec2 b) {
  const ImVec2 along{b.x - a.x, b.y - a.y};
  const float square = along.x * along.x + along.y * along.y;
  const float t = square == 0 ? 0 : std::clamp(((p.x - a.x) * along.x + (p.y - a.y) * along.y) / square, 0.0F, 1.0F);
  return away(p, {a.x + t * along.x, a.y + t * along.y});
}

struct MapLink {
  int setup;  // that has it
  ImVec2 from, to;
  const LinkResult* result;  // null: it is proposed
};

// A map as it is drawn just now, and what fingers do on it.
class Map {
 public:
  Map(Pen& pen, const Widget& w, ImVec2 at, ImVec2 size, const std::vector<StoredSetup>& setups, const Extent& extent)
      : pen_(pen),
        w_(w),
        at_(at),
        size_(size),
        setups_(setups),
        frame_(frameOf(extent, at, size, w.laid ? ringRadius() + pen.unit : 1.6F * pen.unit,
                       pen.view.maps[pen.screen + "/" + w.id])) {
    by_ = grip().on == On::cloud || grip().on == On::ring ? grip().laid
          : w.laid ? std::array{w.laid->shift_x_m, w.laid->shift_y_m, w.laid->turn_deg}
                   : std::array<double, 3>{};
    for (std::size_t i = 0; i < setups.size(); ++i) {
      places_.push_back(isLaid(i) ? laidPlace(setups, *w.laid, by_) : linkedPlace(setups, setups[i]));
      marks_.push_back(frame_.at(places_[i].x_m, places_[i].y_m));
    }
    findLinks();
  }

  // Of the map's own area, which is the last item.
  void handle() {
    const auto& io = ImGui::GetIO();
    const bool at_once = isHeldAtOnce();
    if (at_once || (ImGui::IsItemActivated() && io.MouseDown[ImGuiMouseButton_Left])) take(io.MousePos);
    if (at_once || ImGui::IsItemActive()) drag(io.MousePos);
    if (at_once) grip() = {};
    if (ImGui::IsItemDeactivated()) release(io.MousePos);
  }

  void draw() {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float dot = pen_.hair(0.8F);
    for (std::size_t i = 0; i < setups_.size(); ++i) {
      const ImU32 colour = pointColour(static_cast<int>(i));
      eachPoint(setups_[i], places_[i], [&](double x, double y) {
        const ImVec2 p = frame_.at(x, y);
        list->AddRectFilled({p.x - dot, p.y - dot}, {p.x + dot, p.y + dot}, colour);
      });
    }
    for (const auto& link : links_) {
      const bool held = grip().on == On::link && grip().setup == link.setup;
      if (link.result != nullptr)
        list->AddLine(link.from, link.to, link.result->joined ? kHolds : kFailed, pen_.hair(held ? 5 : 2.5F));
      else
        dashed(list, link.from, link.to, kProposed, 0.5F * pen_.unit, pen_.hair(1.5F));
    }
    if (w_.laid) drawRing(list);
    drawDrawnLink(list);
    for (std::size_t i = 0; i < setups_.size(); ++i) drawMark(list, i);
  }

 private:
  using On = MapGrip::On;

  MapGrip& grip() { return pen_.view.grip; }
  bool isLaid(std::size_t i) const { return w_.laid && static_cast<int>(i) == w_.laid->setup; }
  float markRadius() const { return 0.85F * pen_.unit; }
  float ringRadius() const { return std::min({6 * pen_.unit, 0.3F * size_.x, 0.3F * size_.y}); }
  ImVec2 ringHandle() const {
    const auto& laid = places_[w_.laid->setup];
    const ImVec2 middle = marks_[w_.laid->setup];
    return {middle.x + ringRadius() * static_cast<float>(std::cos(laid.turn_rad)),
            middle.y - ringRadius() * static_cast<float>(std::sin(laid.turn_rad))};
  }
  ImU32 pointColour(int setup) const {
    if (!w_.laid) return kPoint;
    return setup == w_.laid->setup ? kMoving : setup == w_.laid->onto ? kFixed : kBeside;
  }

  void findLinks() {
    for (std::size_t i = 1; i < setups_.size(); ++i) {
      const auto& link = setups_[i].link;
      const auto* to = link ? setupWithFile(setups_, link->to) : nullptr;
      const std::size_t other = to == nullptr ? i - 1 : static_cast<std::size_t>(to - setups_.data());
      if (link || setups_[i].tracked)
        links_.push_back({static_cast<int>(i), marks_[other], marks_[i], link ? &*link : nullptr});
    }
  }

  int markAt(ImVec2 p) const {
    int nearest = -1;
    const float reach = std::max(1.3F * markRadius(), 0.5F * pen_.touch());
    for (std::size_t i = 0; i < marks_.size(); ++i)
      if (away(p, marks_[i]) < reach && (nearest < 0 || away(p, marks_[i]) < away(p, marks_[nearest])))
        nearest = static_cast<int>(i);
    return nearest;
  }

  void take(ImVec2 p) {
    auto& g = grip();
    g = {On::ground, -1, by_, 0, 0, 0};
    if (w_.laid) {
      const ImVec2 middle = marks_[w_.laid->setup];
      const float far = away(p, middle);
      const bool on_ring = std::abs(far - ringRadius()) < 1.1F * pen_.unit;
      if (on_ring || far < ringRadius()) {
        g.on = on_ring ? On::ring : On::cloud;
        g.from_x_m = p.x, g.from_y_m = p.y;
        g.from_turn_rad = std::atan2(middle.y - p.y, p.x - middle.x);
        return;
      }
    }
    if (const int mark = markAt(p); mark >= 0 && (w_.acts || w_.takes(Gesture::join) || w_.takes(Gesture::hold))) {
      g.on = On::mark, g.setup = mark;
      return;
    }
    for (const auto& link : links_)
      if (link.result != nullptr && w_.takes(Gesture::part) && awayFromLine(p, link.from, link.to) < 0.8F * pen_.unit)
        g.on = On::link, g.setup = link.setup;
  }

  // In the place of a setup, or of a cloud that is laid.
  void drag(ImVec2 p) {
    auto& g = grip();
    const bool takes = g.on == On::mark ? w_.takes(Gesture::hold) : g.on == On::link;
    if (takes && isHeld(pen_)) {
      pen_.pressed(w_.id, std::to_string(g.setup), g.on == On::mark ? Gesture::hold : Gesture::part);
      pen_.view.held = true;
      g.on = On::nothing;
    }
    if (g.on != On::cloud && g.on != On::ring) return;
    const auto& start = *w_.laid;
    const auto rounded = [](double value, double step) { return std::round(value / step) * step; };
    if (g.on == On::cloud) {
      g.laid[0] =
          std::clamp(rounded(start.shift_x_m + (p.x - g.from_x_m) / frame_.scale, 0.001), -kFarthest_m, kFarthest_m);
      g.laid[1] =
          std::clamp(rounded(start.shift_y_m - (p.y - g.from_y_m) / frame_.scale, 0.001), -kFarthest_m, kFarthest_m);
    } else {
      const ImVec2 middle = marks_[start.setup];
      const double turned = std::atan2(middle.y - p.y, p.x - middle.x) - g.from_turn_rad;
      g.laid[2] = std::remainder(rounded(start.turn_deg + turned / kRadPerDeg, 0.1), 360.0);
    }
  }

  void release(ImVec2 p) {
    const MapGrip g = std::exchange(grip(), MapGrip{});
    if (g.on == On::cloud || g.on == On::ring) {
      if (g.laid != std::array{w_.laid->shift_x_m, w_.laid->shift_y_m, w_.laid->turn_deg})
        pen_.pressed(w_.id, fmt::format("{:.3f},{:.3f},{:.1f}", g.laid[0], g.laid[1], g.laid[2]), Gesture::lay);
    } else if (g.on == On::mark) {
      const int to = markAt(p);
      if (to == g.setup && w_.acts) pen_.pressed(w_.id, std::to_string(to));
      if (to >= 0 && to != g.setup && w_.takes(Gesture::join))
        pen_.pressed(w_.id, fmt::format("{},{}", g.setup, to), Gesture::join);
    }
  }

  // What the finger draws from the mark that it came down on.
  void drawDrawnLink(ImDrawList* list) {
    if (grip().on != On::mark || !w_.takes(Gesture::join)) return;
    const ImVec2 from = marks_[grip().setup], p = ImGui::GetIO().MousePos;
    const int to = markAt(p);
    if (to == grip().setup) return;
    list->AddLine(from, to < 0 ? p : marks_[to], kDrawn, pen_.hair(3));
    if (to >= 0) list->AddCircle(marks_[to], 1.5F * markRadius(), kDrawn, 32, pen_.hair(3));
  }

  void drawRing(ImDrawList* list) {
    const ImVec2 middle = marks_[w_.laid->setup], handle = ringHandle();
    const bool turns = grip().on == On::ring;
    list->AddCircle(middle, ringRadius(), IM_COL32(0, 0, 0, 160), 96, pen_.hair(6));
    list->AddCircle(middle, ringRadius(), kMoving, 96, pen_.hair(turns ? 4 : 2.5F));
    list->AddLine(middle, handle, (kMoving & 0x00FFFFFFU) | 0x80000000U, pen_.hair(1.2F));
    list->AddCircleFilled(handle, 0.75F * pen_.unit, kMoving, 24);
    list->AddCircle(handle, 0.75F * pen_.unit, IM_COL32_BLACK, 24, pen_.hair(1.5F));
  }

  void drawMark(ImDrawList* list, std::size_t i) {
    const auto& s = setups_[i];
    const float r = markRadius();
    const ImVec2 p = marks_[i];
    list->AddCircleFilled(p, r, isLaid(i) ? kMoving : pen_.skin.accent, 32);
    list->AddCircle(p, r, kName, 32, pen_.hair(1.2F));
    fitted(pen_, w_.id, {p.x - 0.8F * r, p.y - r, 1.6F * r, 2 * r}, isLaid(i) ? IM_COL32_BLACK : pen_.skin.accent_text,
           std::to_string(s.number), Align::centre, 0.85F);
    const float width = ImGui::CalcTextSize(s.name.c_str()).x;
    const bool right = p.x + 1.3F * r + width < at_.x + size_.x;
    list->AddText({right ? p.x + 1.3F * r : p.x - 1.3F * r - width, p.y - ImGui::GetTextLineHeight() / 2}, kName,
                  s.name.c_str());
  }

  Pen& pen_;
  const Widget& w_;
  ImVec2 at_, size_;
  const std::vector<StoredSetup>& setups_;
  MapFrame frame_;
  std::array<double, 3> by_{};
  std::vector<CloudPlace> places_;
  std::vector<ImVec2> marks_;
  std::vector<MapLink> links_;
};

}  // namespace

// Set-ups from above on what they have seen; links that hold are green, failed ones red, proposed ones broken lines. A
// cloud that is laid by hand has another colour and a ring, by which it is turned.
void drawPlan(Pen& pen, const Widget& w) {
  if (pen.height == 0) caption(pen, w.label);
  const ImVec2 at = screenAt(pen);
  const ImVec2 size{pen.width, pen.height > 0 ? pen.height : pen.width * 0.6F};
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, kGround);
  if (area(("##" + w.id).c_str(), at, size) && pen.view.asking) pen.pressed(w.id);
  const auto* project = pen.device.project();
  if (project == nullptr || project->setups.empty()) return centred(list, at, size, kProposed, "–");
  const auto extent = extentOf(project->setups);  // however the map is moved
  Map(pen, w, at, size, project->setups, extent).handle();
  moveMap(pen.view.maps[pen.screen + "/" + w.id], pen.view.grip, at, size);
  list->PushClipRect(at, {at.x + size.x, at.y + size.y}, true);
  Map(pen, w, at, size, project->setups, extent).draw();  // as it lies now
  list->PopClipRect();
}

}  // namespace standpoint
