// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/settings.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "core/part_file.h"
#include "editor/model/interface_scale.h"

namespace standpoint {

namespace {

using nlohmann::json;
constexpr std::size_t kRecent = 12;

std::filesystem::path baseFolder(const char* variable, const char* fallback) {
  if (const char* set = std::getenv(variable); set != nullptr && *set != 0) return set;
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != 0)
    return std::filesystem::path(home) / fallback;
  return std::filesystem::temp_directory_path();
}

template <class T>
void read(const json& object, const char* key, T& value, T low, T high) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return;
  value = std::clamp(found->get<T>(), low, high);
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

json toJson(const Settings& settings) {
  json areas = json::object();
  for (std::size_t i = 0; i < settings.areas.size(); ++i) {
    const auto& a = settings.areas[i];
    areas[nameOf(static_cast<Workspace>(i))] = {{"left", a.left}, {"right", a.right}, {"bottom", a.bottom}};
  }
  return {{"recent", settings.recent},
          {"areas", std::move(areas)},
          {"last_folder", settings.last_folder},
          {"user_scale", settings.user_scale},
          {"recovery", settings.recovery}};
}

Settings settingsFrom(const json& object) {
  Settings result;
  if (!object.is_object()) return result;
  if (const auto recent = object.find("recent"); recent != object.end() && recent->is_array())
    for (const auto& r : *recent)
      if (r.is_string() && result.recent.size() < kRecent) result.recent.push_back(r.get<std::string>());
  if (const auto areas = object.find("areas"); areas != object.end() && areas->is_object())
    for (std::size_t i = 0; i < result.areas.size(); ++i) {
      const auto area = areas->find(nameOf(static_cast<Workspace>(i)));
      if (area == areas->end()) continue;
      read(*area, "left", result.areas[i].left, 160.0F, 900.0F);
      read(*area, "right", result.areas[i].right, 200.0F, 1200.0F);
      read(*area, "bottom", result.areas[i].bottom, 80.0F, 700.0F);
    }
  if (const auto folder = object.find("last_folder"); folder != object.end() && folder->is_string())
    result.last_folder = folder->get<std::string>();
  read(object, "user_scale", result.user_scale, kUserScales.front(), kUserScales.back());
  // Before, a copy was kept every so many minutes, or never.
  if (object.value("recovery_minutes", json()) == 0) result.recovery = false;
  if (const auto recovery = object.find("recovery"); recovery != object.end() && recovery->is_boolean())
    result.recovery = recovery->get<bool>();
  return result;
}

std::filesystem::path settingsFile() { return baseFolder("XDG_CONFIG_HOME", ".config") / "standpoint" / "editor.json"; }

std::filesystem::path unsavedRoot() { return baseFolder("XDG_DATA_HOME", ".local/share") / "standpoint" / "unsaved"; }

std::filesystem::path recoveryRoot() {
  return baseFolder("XDG_STATE_HOME", ".local/state") / "standpoint" / "recovery";
}

Settings readSettings(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) return {};
  return settingsFrom(json::parse(in, nullptr, false));
}

Result<void> writeSettings(const Settings& settings, const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  return writeWholeText(file, toJson(settings).dump(2) + '\n');
}

}  // namespace standpoint
