// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "emulated-ui/devices/riegl-vz-i/registering.h"

namespace standpoint::riegl_vz_i {

namespace {

constexpr std::size_t kMostControlPoints = 200;
constexpr std::size_t kFewestSeen = 3;    // tie points that a position needs [S34]
const std::string kControl = "control.";  // + project + name: a value of the device

std::string controlOf(const Device& device) {
  return kControl + (device.project() == nullptr ? "" : device.project()->name) + "/";
}

}  // namespace

std::vector<std::string> controlNames(const Device& device) {
  std::vector<std::string> names;
  const auto key = controlOf(device);
  for (const auto& [id, value] : device.state().values)
    if (id.starts_with(key)) names.push_back(id.substr(key.size()));
  return names;
}

// A line of the list: a name and three coordinates, parted by commas or semicolons [S31].
Result<void> addPoint(Device& device, const std::string&) {
  std::string line = device.entry("control_point");
  std::replace(line.begin(), line.end(), ';', ',');
  std::array<std::string, 4> field;
  std::size_t at = 0, n = 0;
  for (; n < field.size() && at <= line.size(); ++n) {
    const auto end = std::min(line.find(',', at), line.size());
    field[n] = line.substr(at, end - at);
    at = end + 1;
  }
  bool whole = n == field.size() && at > line.size() && !field[0].empty();
  for (std::size_t i = 1; i < field.size() && whole; ++i) {
    char* end = nullptr;
    whole = std::isfinite(std::strtod(field[i].c_str(), &end)) && end != field[i].c_str() && *end == '\0';
  }
  if (!whole) return failure(ErrorKind::usage, device.word("control_point_wrong"));
  if (controlNames(device).size() >= kMostControlPoints)
    return failure(ErrorKind::usage, device.word("control_points_full"));
  device.change().values[controlOf(device) + field[0]] = field[1] + " " + field[2] + " " + field[3];
  device.change().entries["control_point"].clear();
  device.note("control_point", field[0]);
  return {};
}

Result<void> clearPoints(Device& device, const std::string&) {
  for (const auto& name : controlNames(device)) device.change().values.erase(controlOf(device) + name);
  device.change().values.erase("georeferenced");
  return {};
}

// The project is tied to the list where enough of its points were found as reflectors.
Result<void> georeference(Device& device, const std::string&) {
  std::size_t seen = 0;
  for (const auto& name : controlNames(device)) {
    const auto& setups = device.project()->setups;
    seen += std::any_of(setups.begin(), setups.end(),
                        [&](const StoredSetup& s) {
                          return std::any_of(s.targets.begin(), s.targets.end(),
                                             [&](const FittedTarget& t) { return t.found && t.name == name; });
                        })
                ? 1
                : 0;
  }
  if (seen < kFewestSeen) return failure(ErrorKind::usage, device.word("too_few_seen"));
  device.change().values["georeferenced"] = device.project()->name;
  device.note("georeferenced", std::to_string(seen));
  return {};
}

std::vector<WidgetOption> controlRows(const Device& device) {
  std::vector<WidgetOption> rows;
  for (const auto& name : controlNames(device))
    rows.push_back({name, name + "  " + device.value(controlOf(device) + name), true, {}});
  return rows;
}

bool isGeoreferenced(const Device& device) {
  return device.project() != nullptr && device.value("georeferenced") == device.project()->name;
}

}  // namespace standpoint::riegl_vz_i
