// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/result.h"
#include "editor/desktop/window_place.h"
#include "editor/model/graphics.h"

namespace standpoint {

// In the order of the work.
enum class Workspace { environment, optimise, materials, georeference, survey, instrument, inspect };
constexpr int kWorkspaces = 7;
const char* nameOf(Workspace workspace);  // "environment"

// Widths and heights of the areas in points (pixels at scale 1).
struct AreaSizes {
  float left = 330, right = 340, bottom = 180;
};

// What of them the user has dragged.
struct DraggedSizes {
  std::optional<float> left, right, bottom;
  bool operator==(const DraggedSizes&) const = default;
};

// What the editor remembers from one start to the next.
struct Settings {
  std::vector<std::string> recent;  // projects and models, newest first
  std::array<DraggedSizes, kWorkspaces> areas;
  std::optional<WindowPlace> window;  // as it was last; none: never opened
  std::string last_folder;            // of the file dialog
  double user_scale = 1;              // on top of the monitor's
  bool recovery = true;               // keep a copy of unsaved work after every change
  GraphicsChoice graphics = GraphicsChoice::automatic;
  Theme theme = Theme::dark;
  bool sounds = false;          // of instruments
  bool drag_turns_head = true;  // where one looks around, as in games; else what is seen follows the pointer
  std::string language;         // code of words.h; "": as the user's locale says
  bool operator==(const Settings&) const = default;

  void remember(const std::filesystem::path& path);
  // The same in all workspaces, so that the view stays where it is; but a device has the room that it needs.
  AreaSizes sizesIn(Workspace workspace) const;
  DraggedSizes& draggedIn(Workspace workspace) { return areas[static_cast<std::size_t>(workspace)]; }
};

nlohmann::json toJson(const Settings& settings);
// What is missing or makes no sense keeps its default: a settings file must never keep the editor from starting.
// `wrong` gets the keys of what makes no sense.
Settings settingsFrom(const nlohmann::json& object, std::vector<std::string>& wrong);

struct StoredSettings {
  Settings settings;
  std::string problem;  // what was not usable, for the user; "" mostly
};
StoredSettings readSettings(const std::filesystem::path& file);
Result<void> writeSettings(const Settings& settings, const std::filesystem::path& file);

// Writes what has changed while the editor runs, so that a crash takes no preference with it; not in every frame of a
// drag.
class SettingsKeeper {
 public:
  SettingsKeeper(std::filesystem::path file, Settings known) : file_(std::move(file)), known_(std::move(known)) {}
  void keep(const Settings& settings);
  double untilDue_s() const;  // -1: nothing waits

 private:
  using Clock = std::chrono::steady_clock;
  std::filesystem::path file_;
  Settings known_;
  std::optional<Clock::time_point> due_;
};

}  // namespace standpoint
