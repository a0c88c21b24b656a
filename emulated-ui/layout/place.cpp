// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/layout/place.h"

#include <algorithm>

namespace standpoint {

namespace {

bool anythingThere(const Region& region, const PlacingState& state) {
  switch (region.kind) {
    case RegionKind::empty:
    case RegionKind::title:
    case RegionKind::softkeys:
    case RegionKind::bottombar: return true;
    case RegionKind::widget: return state.there(region.widget);
    case RegionKind::form:
    case RegionKind::status: return std::any_of(region.widgets.begin(), region.widgets.end(), state.there);
    default:
      return std::any_of(region.parts.begin(), region.parts.end(),
                         [&](const Region& part) { return anythingThere(part, state); });
  }
}

class Placer {
 public:
  Placer(const PlacingState& state, std::vector<PlacedRegion>& out) : state_(state), out_(out) {}

  void place(const Region& region, const Box& box, int depth) {
    switch (region.kind) {
      case RegionKind::rows:
      case RegionKind::columns: return along(region, box, depth);
      case RegionKind::over:
        place(region.parts.front(), box, depth);
        for (std::size_t i = 1; i < region.parts.size(); ++i)
          if (anythingThere(region.parts[i], state_)) lay(region.parts[i], anchored(box, region.parts[i]), depth + 1);
        return;
      case RegionKind::tabs: return tabs(region, box, depth);
      default: out_.push_back({&region, box, depth});
    }
  }

 private:
  // Several things that lie on a picture have one ground.
  void lay(const Region& region, const Box& box, int depth) {
    if (region.kind == RegionKind::rows || region.kind == RegionKind::columns) out_.push_back({&region, box, depth});
    place(region, box, depth);
  }

  void along(const Region& region, const Box& box, int depth) {
    std::vector<const Region*> parts;
    for (const auto& part : region.parts)
      if (anythingThere(part, state_)) parts.push_back(&part);
    double fixed = 0;
    int open = 0;
    for (const auto* part : parts) {
      fixed += part->size;
      open += part->size == 0 ? 1 : 0;
    }
    const bool down = region.kind == RegionKind::rows;
    const float extent = down ? box.height : box.width;
    const float rest = open == 0 ? 0 : extent * static_cast<float>(std::max(0.0, 1 - fixed)) / static_cast<float>(open);
    float at = down ? box.y : box.x;
    for (const auto* part : parts) {
      const float length = part->size == 0 ? rest : extent * static_cast<float>(part->size);
      place(*part, down ? Box{box.x, at, box.width, length} : Box{at, box.y, length, box.height}, depth);
      at += length;
    }
  }

  void tabs(const Region& region, const Box& box, int depth) {
    const float strip = std::min(state_.strip, box.height / 2);
    const float titles = region.at_bottom ? box.bottom() - strip : box.y;
    out_.push_back({&region, {box.x, titles, box.width, strip}, depth});
    const int chosen = std::clamp(state_.tab(region), 0, static_cast<int>(region.parts.size()) - 1);
    place(region.parts[chosen], {box.x, region.at_bottom ? box.y : box.y + strip, box.width, box.height - strip},
          depth);
  }

  const PlacingState& state_;
  std::vector<PlacedRegion>& out_;
};

}  // namespace

bool overlap(const Box& a, const Box& b) {
  constexpr float kTouch = 0.01F;
  return a.x + kTouch < b.right() && b.x + kTouch < a.right() && a.y + kTouch < b.bottom() && b.y + kTouch < a.bottom();
}

Box anchored(const Box& whole, const Region& part) {
  Box box{whole.x, whole.y, whole.width * static_cast<float>(part.width),
          whole.height * static_cast<float>(part.height)};
  const auto at = [&](const char* word) { return part.anchor.find(word) != std::string::npos; };
  const float free_x = whole.width - box.width, free_y = whole.height - box.height;
  box.x += at("left") ? 0 : at("right") ? free_x : free_x / 2;
  box.y += at("top") ? 0 : at("bottom") ? free_y : free_y / 2;
  return box;
}

std::vector<PlacedRegion> placeRegions(const Region& root, const Box& whole, const PlacingState& state) {
  std::vector<PlacedRegion> out;
  Placer(state, out).place(root, whole, 0);
  return out;
}

}  // namespace standpoint
