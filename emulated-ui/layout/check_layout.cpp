// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/layout/check_layout.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/nearest_name.h"
#include "emulated-ui/layout/icons.h"
#include "emulated-ui/layout/place.h"

namespace standpoint {

namespace {

constexpr double kRound = 1e-6;
constexpr float kStripPerText = 2.2F;  // height of the titles of tabs, in heights of letters

const std::set<WidgetKind> kPictures = {WidgetKind::plan, WidgetKind::seen, WidgetKind::preview, WidgetKind::area};
const std::set<WidgetKind> kPressed = {WidgetKind::button, WidgetKind::key,  WidgetKind::choice,
                                       WidgetKind::toggle, WidgetKind::text, WidgetKind::number};

std::set<WidgetKind> kindsFor(Look as) {
  switch (as) {
    case Look::normal: return {};
    case Look::tile: return {WidgetKind::button, WidgetKind::key, WidgetKind::choice, WidgetKind::toggle};
    case Look::block:
    case Look::round:
    case Look::icon: return {WidgetKind::button, WidgetKind::key};
    case Look::pair:
    case Look::figure: return {WidgetKind::readout, WidgetKind::status};
    case Look::slider: return {WidgetKind::choice};
    case Look::ring:
    case Look::sweep: return {WidgetKind::progress};
    case Look::thumbs: return {WidgetKind::list};
    case Look::cross: return {WidgetKind::preview};
    case Look::quality: return {WidgetKind::seen};
  }
  return {};
}

class LayoutChecker {
 public:
  LayoutChecker(const Layout& layout, const DeviceDefinition& definition, std::string file)
      : layout_(layout), definition_(definition), file_(std::move(file)) {}

  std::vector<Error> faults() {
    if (const auto& icons = deviceIcons(); !icons) return {icons.error()};
    for (std::size_t i = 0; i < layout_.faces.size(); ++i) checkFace(layout_.faces[i], fmt::format("/faces/{}", i));
    checkIcons();
    for (const auto& [id, plan] : layout_.screens) {
      const auto* screen = findScreen(definition_, id);
      if (screen == nullptr) {
        std::vector<std::string> known;
        for (const auto& s : definition_.screens) known.push_back(s.id);
        say("/screens/" + id, fmt::format("the device has no screen '{}'; {}", id, knownInstead(id, known, 6)));
        continue;
      }
      checkWidgets(*screen, plan.root);
      if (!faults_.empty()) continue;  // places of what is not there cannot be measured
      checkRegion(plan.root, *screen);
      checkPlaces(*screen, plan);
    }
    return std::move(faults_);
  }

 private:
  void say(const std::string& pointer, const std::string& message) {
    faults_.push_back({ErrorKind::unusable, message, file_ + " " + pointer});
  }

  static double scaleAt100(const DeviceFace& face) {
    return std::min(kLayoutRoom[0] / face.box[0], kLayoutRoom[1] / face.box[1]);
  }

  void checkFace(const DeviceFace& face, const std::string& pointer) {
    const auto [left, top, width, height] = face.display;
    const Box display{left, top, width, height};
    if (width < 100 || height < 100 || display.right() > face.box[0] || display.bottom() > face.box[1])
      say(pointer + "/display", "the display must lie in its body and be at least 100 points wide and high");
    const double text_px = face.text * scaleAt100(face);
    if (text_px < kSmallestText_px)
      say(pointer + "/text",
          fmt::format("letters are {:.1f} pixels high at 100 %; at least {} can be read", text_px, kSmallestText_px));
    std::set<std::string> keys;
    for (std::size_t i = 0; i < face.keys.size(); ++i) {
      const auto& key = face.keys[i];
      const auto at = fmt::format("{}/keys/{}", pointer, i);
      keys.insert(key.widget);
      const bool known = std::any_of(definition_.keys.begin(), definition_.keys.end(),
                                     [&](const WidgetRow& row) { return row.id == key.widget; });
      if (!known) say(at + "/widget", fmt::format("the body has no key or lamp '{}'", key.widget));
      const Box box{key.x, key.y, key.width, key.height};
      if (overlap(box, display) || box.right() > face.box[0] || box.bottom() > face.box[1])
        say(at + "/box", "a key must lie on the body beside the display");
      if (!key.icon.empty() && findIcon(key.icon) == nullptr) say(at + "/icon", noIcon(key.icon));
    }
    for (const auto& row : definition_.keys)
      if (keys.count(row.id) == 0) say(pointer + "/keys", fmt::format("'{}' has no place on the body", row.id));
  }

  static std::string noIcon(const std::string& id) {
    std::vector<std::string> known;
    for (const auto& icon : *deviceIcons()) known.push_back(icon.id);
    return fmt::format("there is no icon '{}'; {}", id, knownInstead(id, known, 6));
  }

  void checkIcons() {
    for (const auto& [widget, icon] : layout_.icons)
      if (findIcon(icon) == nullptr) say("/icons/" + widget, noIcon(icon));
  }

  // Each widget of the screen has one place, and what has a place is a widget of the screen.
  void checkWidgets(const ScreenRow& screen, const Region& root) {
    std::map<std::string, int> places;
    collect(root, screen, places);
    for (const auto& row : screen.widgets) {
      if (row.id == "back" && titled_) continue;
      if (places[row.id] == 0)
        say("/screens/" + screen.id,
            fmt::format("'{}' has no place; put it into a region, or \"*\" into a form", row.id));
      if (places[row.id] > 1) say("/screens/" + screen.id, fmt::format("'{}' has {} places", row.id, places[row.id]));
    }
    titled_ = false;
  }

  void collect(const Region& region, const ScreenRow& screen, std::map<std::string, int>& places) {
    titled_ = titled_ || region.kind == RegionKind::title;
    auto all = region.widgets;
    if (!region.widget.empty()) all.push_back(region.widget);
    for (const auto& widget : all) {
      if (widget.empty()) continue;
      if (rowOf(screen, widget) == nullptr) {
        std::vector<std::string> known;
        for (const auto& row : screen.widgets) known.push_back(row.id);
        say(region.pointer,
            fmt::format("the screen '{}' has no widget '{}'; {}", screen.id, widget, knownInstead(widget, known, 6)));
      }
      ++places[widget];
    }
    for (const auto& part : region.parts) collect(part, screen, places);
  }

  static const WidgetRow* rowOf(const ScreenRow& screen, const std::string& id) {
    const auto found =
        std::find_if(screen.widgets.begin(), screen.widgets.end(), [&](const WidgetRow& row) { return row.id == id; });
    return found == screen.widgets.end() ? nullptr : &*found;
  }

  void checkRegion(const Region& region, const ScreenRow& screen) {
    double sum = 0;
    int open = 0;
    for (const auto& part : region.parts) {
      sum += part.size;
      open += part.size == 0 ? 1 : 0;
      checkRegion(part, screen);
    }
    const bool along = region.kind == RegionKind::rows || region.kind == RegionKind::columns;
    if (along && (sum > 1 + kRound || (open > 0 && sum > 1 - kRound)))
      say(region.pointer,
          open > 0 ? fmt::format("its parts take {:.2f} of its size, and nothing is left for those without a size", sum)
                   : fmt::format("its parts take {:.2f} of its size", sum));
    if (region.kind == RegionKind::widget) checkWidget(region, *rowOf(screen, region.widget));
    if (region.kind == RegionKind::over) checkOver(region, screen);
    if (region.kind == RegionKind::tabs)
      for (const auto& part : region.parts)
        if (part.words.empty()) say(part.pointer, "a tab needs the key of its title, \"words\"");
  }

  void checkWidget(const Region& region, const WidgetRow& row) {
    const auto kinds = kindsFor(region.as);
    if (!kinds.empty() && kinds.count(row.kind) == 0)
      say(region.pointer, fmt::format("a {} cannot be drawn as '{}'", kWidgetKindNames[static_cast<int>(row.kind)],
                                      kLookNames[static_cast<int>(region.as)]));
    if (row.kind == WidgetKind::text || row.kind == WidgetKind::number)
      say(region.pointer, "a field that is typed into must be in a form, so that the keyboard never covers it");
  }

  void checkOver(const Region& region, const ScreenRow& screen) {
    const auto& base = region.parts.front();
    const auto* row = base.kind == RegionKind::widget ? rowOf(screen, base.widget) : nullptr;
    if (row == nullptr || kPictures.count(row->kind) == 0)
      say(base.pointer, "only a picture, a map or an area can have something lie on it");
    const Box whole{0, 0, 1, 1};
    for (std::size_t i = 1; i < region.parts.size(); ++i) {
      if (region.parts[i].anchor.empty()) say(region.parts[i].pointer, "what lies on something needs an anchor");
      for (std::size_t j = 1; j < i; ++j)
        if (overlap(anchored(whole, region.parts[i]), anchored(whole, region.parts[j])))
          say(region.parts[i].pointer, fmt::format("lies on what is at {}", region.parts[j].pointer));
    }
  }

  // With all that can be there: nothing is too small for a finger, nor out of its display.
  void checkPlaces(const ScreenRow& screen, const ScreenPlan& plan) {
    const auto& face = faceOf(layout_, screen.id);
    const Box display{0, 0, face.display[2], face.display[3]};
    const auto scale = static_cast<float>(scaleAt100(face));
    PlacingState state{[](const std::string&) { return true; }, [](const Region&) { return 0; },
                       kStripPerText * face.text};
    for (const auto& placed : placeRegions(plan.root, display, state)) {
      const auto& region = *placed.region;
      if (region.kind == RegionKind::empty || region.kind == RegionKind::rows || region.kind == RegionKind::columns)
        continue;
      float width = placed.box.width * scale, height = placed.box.height * scale;
      if (region.kind == RegionKind::softkeys || region.kind == RegionKind::bottombar)
        width /= static_cast<float>(std::max<std::size_t>(1, region.widgets.size()));
      const bool pressed =
          region.kind == RegionKind::softkeys || region.kind == RegionKind::bottombar ||
          (region.kind == RegionKind::widget && kPressed.count(rowOf(screen, region.widget)->kind) > 0);
      const float least = pressed ? kSmallestTarget_px : 0.8F * kSmallestText_px;
      if (width < least || height < least)
        say(region.pointer, fmt::format("is {:.0f} by {:.0f} pixels at 100 %; {} needs at least {:.0f}", width, height,
                                        pressed ? "a finger" : "a line of text", least));
    }
  }

  const Layout& layout_;
  const DeviceDefinition& definition_;
  std::string file_;
  std::vector<Error> faults_;
  bool titled_ = false;
};

}  // namespace

std::vector<Error> checkLayout(const Layout& layout, const DeviceDefinition& definition, const std::string& file) {
  return LayoutChecker(layout, definition, file).faults();
}

}  // namespace standpoint
