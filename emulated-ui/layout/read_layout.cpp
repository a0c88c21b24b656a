// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/json_fields.h"
#include "core/json_file.h"
#include "core/nearest_name.h"
#include "emulated-ui/layout/check_layout.h"
#include "emulated-ui/layout/icons.h"
#include "emulated-ui/layout/layout.h"

namespace standpoint {

namespace {

using nlohmann::json;

const std::vector<std::string> kLooks(std::begin(kLookNames), std::end(kLookNames));
const std::vector<std::string> kAnchors = {"top left", "top",         "top right", "left",        "centre",
                                           "right",    "bottom left", "bottom",    "bottom right"};
constexpr int kDeepestRegion = 12;  // regions in regions

struct KindName {
  const char* key;
  RegionKind kind;
};
// The key of an object that is a region says what it is.
constexpr KindName kKindNames[] = {{"rows", RegionKind::rows},           {"columns", RegionKind::columns},
                                   {"over", RegionKind::over},           {"tabs", RegionKind::tabs},
                                   {"form", RegionKind::form},           {"title", RegionKind::title},
                                   {"status", RegionKind::status},       {"softkeys", RegionKind::softkeys},
                                   {"bottombar", RegionKind::bottombar}, {"widget", RegionKind::widget}};

Region readRegion(JsonFault& fault, const json& value, const std::string& pointer, int depth);

bool hasParts(RegionKind kind) {
  return kind == RegionKind::rows || kind == RegionKind::columns || kind == RegionKind::over ||
         kind == RegionKind::tabs;
}

std::vector<Region> readParts(JsonFields& f, const char* key, int depth) {
  std::vector<Region> parts;
  const auto* list = f.required(key);
  if (list == nullptr) return parts;
  if (!list->is_array() || list->empty()) {
    f.needs(key, *list, "a list of regions");
    return parts;
  }
  for (std::size_t i = 0; i < list->size(); ++i)
    parts.push_back(readRegion(f.fault(), (*list)[i], fmt::format("{}/{}", f.pointer(key), i), depth + 1));
  return parts;
}

// Names of widgets; null is an empty slot.
std::vector<std::string> readSlots(JsonFields& f, const char* key) {
  std::vector<std::string> slots;
  const auto* list = f.required(key);
  if (list == nullptr) return slots;
  if (!list->is_array()) {
    f.needs(key, *list, "a list of widgets");
    return slots;
  }
  for (std::size_t i = 0; i < list->size(); ++i)
    slots.push_back((*list)[i].is_null() ? std::string()
                                         : textAt(f.fault(), (*list)[i], fmt::format("{}/{}", f.pointer(key), i)));
  return slots;
}

PlaceSource readPlaceSource(JsonFields& f) {
  const auto word = f.has("evidence") ? f.wordOf("evidence", {"S", "K", "P"}) : "P";
  return word == "S" ? PlaceSource::source : word == "K" ? PlaceSource::known : PlaceSource::proposed;
}

Region readRegion(JsonFault& fault, const json& value, const std::string& pointer, int depth) {
  Region region;
  region.pointer = pointer;
  if (depth > kDeepestRegion) {
    fault.say(pointer, "regions lie more than twelve deep in one another");
    return region;
  }
  if (value.is_null()) return region;
  if (value.is_string()) {
    region.kind = RegionKind::widget;
    region.widget = textAt(fault, value, pointer);
    return region;
  }
  JsonFields f(fault, value, pointer);
  const KindName* found = nullptr;
  for (const auto& name : kKindNames)
    if (f.has(name.key)) {
      if (found != nullptr) f.wrong(name.key, fmt::format("a region is either '{}' or '{}'", found->key, name.key));
      found = &name;
    }
  region.size = f.numberOr("size", 0, 0, 1);
  region.evidence = readPlaceSource(f);
  region.words = f.textOr("words", "");
  region.anchor = f.has("anchor") ? f.wordOf("anchor", kAnchors) : "";
  region.width = f.numberOr("width", 1, 0.02, 1);
  region.height = f.numberOr("height", 1, 0.02, 1);
  if (found == nullptr) {
    f.close();
    return region;
  }
  region.kind = found->kind;
  if (region.kind == RegionKind::widget) {
    region.widget = f.text("widget");
    if (f.has("as")) {
      const auto as = f.wordOf("as", kLooks);
      region.as = static_cast<Look>(std::find(kLooks.begin(), kLooks.end(), as) - kLooks.begin());
    }
  } else if (hasParts(region.kind)) {
    region.parts = readParts(f, found->key, depth);
  } else {
    region.widgets = readSlots(f, found->key);
  }
  if (region.kind == RegionKind::form) region.columns = static_cast<int>(f.numberOr("across", 1, 1, 3));
  if (region.kind == RegionKind::tabs) region.at_bottom = f.flagOr("at_bottom", false);
  f.close();
  return region;
}

template <std::size_t N>
std::array<float, N> readNumbers(JsonFields& f, const char* key, double least) {
  std::array<float, N> out{};
  const auto* list = f.required(key);
  if (list == nullptr) return out;
  if (!list->is_array() || list->size() != N) {
    f.needs(key, *list, fmt::format("a list of {} numbers", N));
    return out;
  }
  for (std::size_t i = 0; i < N; ++i)
    out[i] = static_cast<float>(numberAt(f.fault(), (*list)[i], fmt::format("{}/{}", f.pointer(key), i), least, 10000));
  return out;
}

BodyShape readShape(JsonFields& f) {
  BodyShape shape;
  shape.round = static_cast<float>(f.numberOr("round", 0, 0, 1000));
  shape.fill = f.colourOr("fill", shape.fill);
  if (f.has("line")) shape.line = f.colourOr("line", 0);
  if (f.has("box")) {
    const auto [x, y, w, h] = readNumbers<4>(f, "box", 0);
    shape.points = {{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}};
    return shape;
  }
  if (f.has("disc")) {  // centre and radius
    const auto [x, y, r] = readNumbers<3>(f, "disc", 0);
    shape.points = {{x - r, y - r}, {x + r, y - r}, {x + r, y + r}, {x - r, y + r}};
    shape.round = r;
    return shape;
  }
  const auto* points = f.required("points");
  if (points == nullptr) return shape;
  if (!points->is_array() || points->size() < 3) {
    f.needs("points", *points, "a list of at least three points, [[x, y], …]");
    return shape;
  }
  for (std::size_t i = 0; i < points->size(); ++i) {
    const auto at = fmt::format("{}/{}", f.pointer("points"), i);
    const auto& point = (*points)[i];
    if (!point.is_array() || point.size() != 2) {
      f.fault().needs(at, point, "a point, [x, y]");
      return shape;
    }
    shape.points.push_back({static_cast<float>(numberAt(f.fault(), point[0], at, 0, 10000)),
                            static_cast<float>(numberAt(f.fault(), point[1], at, 0, 10000))});
  }
  return shape;
}

DeviceFace readFace(JsonFields& f) {
  DeviceFace face;
  face.id = f.text("id");
  face.box = readNumbers<2>(f, "box", 10);
  face.display = readNumbers<4>(f, "display", 0);
  face.text = static_cast<float>(f.number("text", 4, 200));
  f.list("shapes", [&](JsonFields& shape) { face.shapes.push_back(readShape(shape)); });
  f.list("keys", [&](JsonFields& key) {
    BodyKey k;
    k.widget = key.text("widget");
    const auto [x, y, w, h] = readNumbers<4>(key, "box", 0);
    k.x = x, k.y = y, k.width = w, k.height = h;
    k.ring = static_cast<int>(key.numberOr("ring", 0, 0, 120));
    k.icon = key.textOr("icon", "");
    face.keys.push_back(k);
  });
  return face;
}

Region titleAndForm(const ScreenRow& screen, int columns) {
  Region title, form, root;
  title.kind = RegionKind::title;
  title.size = 0.1;
  form.kind = RegionKind::form;
  form.columns = columns;
  title.widgets = form.widgets = {"*"};
  root.kind = RegionKind::rows;
  root.pointer = "/screens/" + screen.id;
  root.parts = {title, form};
  return root;
}

// Replaces "*" by what has no place elsewhere: in titles and strips the states, in forms the rest.
void fillRest(Region& region, const ScreenRow& screen, const std::vector<std::string>& placed, bool titled) {
  for (auto& part : region.parts) fillRest(part, screen, placed, titled);
  const auto star = std::find(region.widgets.begin(), region.widgets.end(), "*");
  if (star == region.widgets.end()) return;
  const bool states = region.kind != RegionKind::form;
  std::vector<std::string> rest;
  for (const auto& row : screen.widgets)
    if ((row.kind == WidgetKind::status) == states && !(titled && row.id == "back") &&
        std::find(placed.begin(), placed.end(), row.id) == placed.end())
      rest.push_back(row.id);
  const auto at = region.widgets.erase(star);
  region.widgets.insert(at, rest.begin(), rest.end());
}

bool hasTitle(const Region& region) {
  return region.kind == RegionKind::title || std::any_of(region.parts.begin(), region.parts.end(), hasTitle);
}

void completeScreens(Layout& layout, const DeviceDefinition& definition) {
  const auto& fallback = layout.faces.front();
  const int columns = fallback.display[2] > 1.2F * fallback.display[3] ? 2 : 1;
  for (const auto& screen : definition.screens) {
    auto found = layout.screens.find(screen.id);
    if (found == layout.screens.end())
      found = layout.screens.emplace(screen.id, ScreenPlan{fallback.id, titleAndForm(screen, columns)}).first;
    auto& root = found->second.root;
    fillRest(root, screen, placedWidgets(root), hasTitle(root));
  }
}

}  // namespace

std::vector<std::string> placedWidgets(const Region& region) {
  std::vector<std::string> all;
  if (!region.widget.empty()) all.push_back(region.widget);
  for (const auto& widget : region.widgets)
    if (!widget.empty() && widget != "*") all.push_back(widget);
  for (const auto& part : region.parts)
    for (auto& widget : placedWidgets(part)) all.push_back(std::move(widget));
  return all;
}

const DeviceFace& faceOf(const Layout& layout, const std::string& screen) {
  const auto plan = layout.screens.find(screen);
  if (plan == layout.screens.end()) return layout.faces.front();
  const auto found = std::find_if(layout.faces.begin(), layout.faces.end(),
                                  [&](const DeviceFace& face) { return face.id == plan->second.face; });
  return found == layout.faces.end() ? layout.faces.front() : *found;
}

Layout plainLayout(const DeviceDefinition& definition) {
  Layout layout;
  DeviceFace face;
  face.id = "plain";
  face.box = {520, 940};
  face.display = {20, 20, 480, 800};
  face.text = 22;
  face.shapes = {{{{0, 0}, {520, 0}, {520, 940}, {0, 940}}, 40, definition.skin.body, definition.skin.body_edge}};
  float x = 30;
  for (const auto& key : definition.keys) {
    const float width = key.kind == WidgetKind::lamp ? 50 : 130;
    face.keys.push_back({key.id, x, 850, width, 60, 0, ""});
    x += width + 20;
  }
  layout.faces = {face};
  completeScreens(layout, definition);
  return layout;
}

Result<Layout> readLayout(const std::filesystem::path& file, const DeviceDefinition& definition) {
  TRY_ASSIGN(const auto json, readJsonFile(file));
  JsonFault fault(nameWithFolder(file));
  JsonFields root(fault, json, "");
  root.skip("about");
  Layout layout;
  root.list("faces", [&](JsonFields& f) { layout.faces.push_back(readFace(f)); });
  if (layout.faces.empty()) root.wrong("faces", "a device needs at least one face");
  TRY(fault.result());
  root.each("icons", [&](const std::string& widget, const nlohmann::json& icon, const std::string& pointer) {
    layout.icons[widget] = textAt(fault, icon, pointer);
  });
  root.each("screens", [&](const std::string& screen, const nlohmann::json& value, const std::string& pointer) {
    JsonFields f(fault, value, pointer);
    std::vector<std::string> faces;
    for (const auto& face : layout.faces) faces.push_back(face.id);
    ScreenPlan plan;
    plan.face = f.has("face") ? f.wordOf("face", faces) : layout.faces.front().id;
    if (const auto* region = f.required("region")) plan.root = readRegion(fault, *region, pointer + "/region", 0);
    f.close();
    layout.screens[screen] = std::move(plan);
  });
  root.close();
  TRY(fault.result());
  completeScreens(layout, definition);
  if (const auto faults = checkLayout(layout, definition, fault.file()); !faults.empty())
    return failure(faults.front());
  return layout;
}

}  // namespace standpoint
