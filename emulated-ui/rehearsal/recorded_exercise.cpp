// SPDX-License-Identifier: GPL-3.0-or-later
#include <set>

#include <fmt/format.h>

#include "emulated-ui/device/device.h"
#include "emulated-ui/rehearsal/exercise.h"

namespace standpoint {

namespace {

using nlohmann::json;

json spoken(const Device& device, const std::string& english) {
  json texts;
  for (const auto& language : device.type().words->languages()) texts[language] = english;
  return texts;
}

// A step for it would be done before anybody comes.
bool isStandard(const Device& device, const std::string& key) {
  for (const auto& s : device.type().instrument.settings)
    if (s.key == key) return s.default_value == device.setting(key);
  return false;
}

}  // namespace

json recordedExercise(const Device& device, const std::vector<RehearsalAction>& actions) {
  json solution = json::array(), steps = json::array();
  std::set<std::string> settings;
  for (const auto& action : actions) {
    solution.push_back(toJson(action));
    if (action.kind != RehearsalAction::Kind::press || action.value.empty() || device.setting(action.name).empty() ||
        isStandard(device, action.name) || !settings.insert(action.name).second)
      continue;
    const auto condition = fmt::format("setting.{} == '{}'", action.name, device.setting(action.name));
    steps.push_back({{"id", action.name},
                     {"text", spoken(device, device.word(action.name) + ": " + device.setting(action.name))},
                     {"widget", action.name},
                     {"done", condition},
                     {"points", 1}});
  }
  const auto setups = device.number("setups");
  if (setups > 0)
    steps.push_back({{"id", "scan"},
                     {"text", spoken(device, fmt::format("Scan {} times", setups))},
                     {"done", fmt::format("setups >= {}", setups)},
                     {"points", 2}});
  if (steps.empty())
    steps.push_back(
        {{"id", "on"}, {"text", spoken(device, "Switch the instrument on")}, {"done", "power == on"}, {"points", 1}});
  return {{"id", "NEW"},
          {"title", spoken(device, "A recorded exercise")},
          {"goal", spoken(device, "Describe the goal here.")},
          {"devices", {device.type().definition.id}},
          {"instrument", device.type().instrument.id},
          {"model", "house"},
          {"setup", json::array()},
          {"in_order", false},
          {"steps", std::move(steps)},
          {"pass_mark", 0.7},
          {"solution", std::move(solution)}};
}

}  // namespace standpoint
