// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/settings.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string_view>
#include <tuple>

#include "core/part_file.h"
#include "editor/desktop/interface_scale.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

using nlohmann::json;
constexpr std::size_t kRecent = 12;
constexpr float kDevice_pt = 620;  // what a device's panel needs

// What was kept of each workspace, dragged or not, when each had sizes of its own.
constexpr std::array<AreaSizes, kWorkspaces> kFormerSizes = {{{280, 340, 190},
                                                              {280, 340, 190},
                                                              {350, 320, 170},
                                                              {280, 340, 190},
                                                              {330, 340, 170},
                                                              {260, 620, 130},
                                                              {330, 360, 170}}};

// Reads what is there, and notes the keys of what makes no sense.
class Reader {
 public:
  Reader(const json& object, std::vector<std::string>& wrong) : object_(object), wrong_(wrong) {}

  const json* find(const char* key, json::value_t type) const {
    const auto found = object_.find(key);
    if (found == object_.end()) return nullptr;
    if (found->type() == type) return &*found;
    wrong_.emplace_back(key);
    return nullptr;
  }
  template <class T>
  void number(const char* key, T& value, T low, T high) const {
    const auto found = object_.find(key);
    if (found == object_.end()) return;
    if (!found->is_number()) {
      wrong_.emplace_back(key);
      return;
    }
    const auto stored = found->get<double>();
    const double kept = std::clamp(stored, static_cast<double>(low), static_cast<double>(high));
    if (kept != stored) wrong_.emplace_back(key);
    value = static_cast<T>(kept);
  }
  void dragged(const char* key, std::optional<float>& size, float former, float low, float high) const {
    float value = former;
    number(key, value, low, high);
    if (value != former) size = value;
  }
  template <class T>
  void choice(const char* key, T& value, std::optional<T> (*parse)(std::string_view)) const {
    const auto* found = find(key, json::value_t::string);
    if (found == nullptr) return;
    if (const auto chosen = parse(found->get_ref<const std::string&>()))
      value = *chosen;
    else
      wrong_.emplace_back(key);
  }

 private:
  const json& object_;
  std::vector<std::string>& wrong_;
};

std::optional<std::string> languageChoice(std::string_view code) {
  const auto known = languages();
  const bool valid = code.empty() || std::any_of(known.begin(), known.end(), [&](auto& l) { return code == l.code; });
  return valid ? std::optional<std::string>(code) : std::nullopt;
}

WindowPlace placeFrom(const Reader& window) {
  constexpr int kFar_px = 100000;  // from any monitor
  WindowPlace place;
  window.number("x", place.x, -kFar_px, kFar_px);
  window.number("y", place.y, -kFar_px, kFar_px);
  window.number("width", place.width, 800, kFar_px);
  window.number("height", place.height, 500, kFar_px);
  if (const auto* maximised = window.find("maximised", json::value_t::boolean))
    place.maximised = maximised->get<bool>();
  return place;
}

}  // namespace

const char* nameOf(Workspace workspace) {
  switch (workspace) {
    case Workspace::environment: return "environment";
    case Workspace::optimise: return "optimise";
    case Workspace::materials: return "materials";
    case Workspace::georeference: return "georeference";
    case Workspace::survey: return "survey";
    case Workspace::instrument: return "instrument";
    case Workspace::inspect: return "inspect";
  }
  return "";
}

void Settings::remember(const std::filesystem::path& path) {
  const auto text = std::filesystem::absolute(path).lexically_normal().string();
  recent.erase(std::remove(recent.begin(), recent.end(), text), recent.end());
  recent.insert(recent.begin(), text);
  if (recent.size() > kRecent) recent.resize(kRecent);
}

AreaSizes Settings::sizesIn(Workspace workspace) const {
  AreaSizes usual;
  if (workspace == Workspace::instrument) usual.right = kDevice_pt;
  const auto& dragged = areas[static_cast<std::size_t>(workspace)];
  return {dragged.left.value_or(usual.left), dragged.right.value_or(usual.right),
          dragged.bottom.value_or(usual.bottom)};
}

json toJson(const Settings& settings) {
  json areas = json::object();
  for (std::size_t i = 0; i < settings.areas.size(); ++i) {
    const auto& a = settings.areas[i];
    json dragged = json::object();
    for (const auto& [key, size] : {std::pair("left", a.left), {"right", a.right}, {"bottom", a.bottom}})
      if (size) dragged[key] = *size;
    if (!dragged.empty()) areas[nameOf(static_cast<Workspace>(i))] = std::move(dragged);
  }
  json window;
  if (const auto& w = settings.window)
    window = {{"x", w->x}, {"y", w->y}, {"width", w->width}, {"height", w->height}, {"maximised", w->maximised}};
  json stored = {{"recent", settings.recent},           {"areas", std::move(areas)},
                 {"last_folder", settings.last_folder}, {"user_scale", settings.user_scale},
                 {"recovery", settings.recovery},       {"graphics", graphicsKey(settings.graphics)},
                 {"theme", themeKey(settings.theme)},   {"language", settings.language},
                 {"sounds", settings.sounds},           {"drag_turns_head", settings.drag_turns_head}};
  if (!window.is_null()) stored["window"] = std::move(window);
  return stored;
}

Settings settingsFrom(const json& object, std::vector<std::string>& wrong) {
  Settings result;
  if (!object.is_object()) {
    wrong.emplace_back("");
    return result;
  }
  const Reader reader(object, wrong);
  if (const auto* recent = reader.find("recent", json::value_t::array))
    for (const auto& r : *recent)
      if (r.is_string() && result.recent.size() < kRecent) result.recent.push_back(r.get<std::string>());
  const auto stored =
      object.find("areas");  // an array, by number, before the workspaces had names: it says nothing now
  const bool by_number = stored != object.end() && stored->is_array();
  if (const auto* areas = by_number ? nullptr : reader.find("areas", json::value_t::object))
    for (std::size_t i = 0; i < result.areas.size(); ++i) {
      const auto found = areas->find(nameOf(static_cast<Workspace>(i)));
      if (found == areas->end() || !found->is_object()) continue;
      const Reader area(*found, wrong);
      area.dragged("left", result.areas[i].left, kFormerSizes[i].left, 160, 900);
      area.dragged("right", result.areas[i].right, kFormerSizes[i].right, 200, 1200);
      area.dragged("bottom", result.areas[i].bottom, kFormerSizes[i].bottom, 80, 700);
    }
  if (const auto* folder = reader.find("last_folder", json::value_t::string))
    result.last_folder = folder->get<std::string>();
  reader.number("user_scale", result.user_scale, kUserScales.front(), kUserScales.back());
  // Before, a copy was kept every so many minutes, or never.
  if (object.value("recovery_minutes", json()) == 0) result.recovery = false;
  if (const auto* recovery = reader.find("recovery", json::value_t::boolean)) result.recovery = recovery->get<bool>();
  if (const auto* sounds = reader.find("sounds", json::value_t::boolean)) result.sounds = sounds->get<bool>();
  if (const auto* turns = reader.find("drag_turns_head", json::value_t::boolean))
    result.drag_turns_head = turns->get<bool>();
  if (const auto* window = reader.find("window", json::value_t::object)) result.window = placeFrom({*window, wrong});
  reader.choice("graphics", result.graphics, graphicsChoice);
  reader.choice("theme", result.theme, themeOf);
  reader.choice("language", result.language, languageChoice);
  return result;
}

StoredSettings readSettings(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) return {};
  std::vector<std::string> wrong;
  StoredSettings stored{settingsFrom(json::parse(in, nullptr, false), wrong), {}};
  if (wrong.empty()) return stored;
  if (wrong.front().empty()) {
    stored.problem = trf("Preferences cannot be read, defaults are used: {}", file.string());
    return stored;
  }
  std::string keys;
  for (const auto& key : wrong) keys += (keys.empty() ? "" : ", ") + key;
  stored.problem = trf("Preferences without a valid value, changed to what is valid: {}", keys);
  return stored;
}

Result<void> writeSettings(const Settings& settings, const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  return writeWholeText(file, toJson(settings).dump(2) + '\n');
}

void SettingsKeeper::keep(const Settings& settings) {
  constexpr std::chrono::milliseconds kQuiet(500);
  if (settings == known_) return due_.reset();
  const auto now = Clock::now();
  if (!due_) due_ = now + kQuiet;
  if (now < *due_) return;
  due_.reset();
  known_ = settings;
  std::ignore = writeSettings(settings, file_);  // the end of the editor tries once more, and says what is wrong
}

double SettingsKeeper::untilDue_s() const {
  return due_ ? std::max(0.0, std::chrono::duration<double>(*due_ - Clock::now()).count()) : -1;
}

}  // namespace standpoint
