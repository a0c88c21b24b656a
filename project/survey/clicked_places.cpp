// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/survey/clicked_places.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/units.h"
#include "project/answers.h"
#include "survey/stations/station_places.h"

namespace standpoint {

namespace {

// "X,Y[,Z][:STOP[:LOOK]]"
struct Clicked {
  FloorPlace place;
  double stop_s = 0;
  std::optional<double> look_rad = {};
};

// The number after a waypoint's colon; nothing where there is none. `wrong` is what is said of another text.
Result<std::optional<double>> partFrom(const std::string& text, double least, double most, std::string wrong,
                                       const char* option) {
  if (text.empty()) return std::nullopt;
  const auto number = parseNumbers(text);
  if (!number || number->size() != 1 || (*number)[0] < least || (*number)[0] > most)
    return failure(ErrorKind::usage, std::move(wrong), option);
  return (*number)[0];
}

Result<Clicked> clickedFrom(const std::string& text, const char* option) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == ':')
      parts.emplace_back();
    else
      parts.back() += c;
  const auto numbers = parseNumbers(parts.front());
  if (!numbers || numbers->size() < 2 || numbers->size() > 3 || parts.size() > 3)
    return failure(
        ErrorKind::usage,
        fmt::format("'{}' must be X,Y or X,Y,Z in metres, and may end in :SECONDS or :SECONDS:DEGREES", text), option);
  Clicked clicked{{(*numbers)[0], (*numbers)[1], {}}};
  if (numbers->size() == 3) clicked.place.z_m = (*numbers)[2];
  parts.resize(3);
  TRY_ASSIGN(const auto stop,
             partFrom(parts[1], 0, 3600, fmt::format("'{}' must stop from 0 to 3600 seconds", text), option));
  TRY_ASSIGN(const auto look,
             partFrom(parts[2], -360, 360, fmt::format("'{}' must look from -360 to 360 degrees", text), option));
  clicked.stop_s = stop.value_or(0);
  if (look) clicked.look_rad = *look * kRadPerDeg;
  return clicked;
}

// On the floor there, or in the air where its height is stated and no floor is.
Result<Waypoint> waypointAt(const RayScene& scene, const Georeference& g, const Clicked& clicked, double height_m,
                            const char* option) {
  const double x = clicked.place.x_m - g.shift_m.x(), y = clicked.place.y_m - g.shift_m.y();
  const auto floors = floorsAt(scene, x, y, height_m);
  const auto near = [&](double z) { return std::abs(z + g.shift_m.z() - *clicked.place.z_m) <= 0.5; };
  if (clicked.place.z_m && std::none_of(floors.begin(), floors.end(), near))
    return Waypoint{{x, y, *clicked.place.z_m - g.shift_m.z()}, clicked.stop_s, clicked.look_rad};
  if (floors.empty())
    return failure(ErrorKind::unusable,
                   fmt::format("no floor at ({}, {}) with {:.2f} m of free height; choose another place, or state its "
                               "height as X,Y,Z",
                               clicked.place.x_m, clicked.place.y_m, height_m + kRoomAbove_m),
                   option);
  TRY_ASSIGN(const auto floor, chosenFloor(floors, clicked.place.z_m, g.shift_m.z()));
  return Waypoint{{x, y, floor}, clicked.stop_s, clicked.look_rad};
}

}  // namespace

Result<std::vector<Waypoint>> waypointsOf(const std::vector<std::string>& texts, const RayScene& scene,
                                          const Georeference& georeference, double height_m, const char* option,
                                          std::span<const Waypoint> known) {
  constexpr double kSame_m = 1e-6;
  std::vector<Waypoint> waypoints;
  for (const std::string& text : texts) {
    TRY_ASSIGN(const auto clicked, clickedFrom(text, option));
    const Eigen::Vector3d there(clicked.place.x_m, clicked.place.y_m, clicked.place.z_m.value_or(0));
    const auto kept = std::find_if(known.begin(), known.end(), [&](const Waypoint& w) {
      return clicked.place.z_m && (w.floor_m + georeference.shift_m - there).norm() < kSame_m;
    });
    if (kept != known.end()) {
      waypoints.push_back({kept->floor_m, clicked.stop_s, clicked.look_rad});
      continue;
    }
    TRY_ASSIGN(const auto waypoint, waypointAt(scene, georeference, clicked, height_m, option));
    waypoints.push_back(waypoint);
  }
  return waypoints;
}

}  // namespace standpoint
