// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/survey/clicked_places.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "project/answers.h"
#include "survey/stations/station_places.h"

namespace standpoint {

namespace {

// "X,Y[,Z][:STOP]"
struct Clicked {
  FloorPlace place;
  double stop_s = 0;
};

Result<Clicked> clickedFrom(const std::string& text, const char* option) {
  const auto colon = std::min(text.find(':'), text.size());
  const auto numbers = parseNumbers(text.substr(0, colon));
  if (!numbers || numbers->size() < 2 || numbers->size() > 3)
    return failure(ErrorKind::usage, fmt::format("'{}' must be X,Y or X,Y,Z in metres, and may end in :SECONDS", text),
                   option);
  Clicked clicked{{(*numbers)[0], (*numbers)[1], {}}};
  if (numbers->size() == 3) clicked.place.z_m = (*numbers)[2];
  if (colon == text.size()) return clicked;
  const auto stop = parseNumbers(text.substr(colon + 1));
  if (!stop || stop->size() != 1 || (*stop)[0] < 0 || (*stop)[0] > 3600)
    return failure(ErrorKind::usage, fmt::format("'{}' must stop from 0 to 3600 seconds", text), option);
  clicked.stop_s = (*stop)[0];
  return clicked;
}

// On the floor there, or in the air where its height is stated and no floor is.
Result<Waypoint> waypointAt(const RayScene& scene, const Georeference& g, const Clicked& clicked, double height_m,
                            const char* option) {
  const double x = clicked.place.x_m - g.shift_m.x(), y = clicked.place.y_m - g.shift_m.y();
  const auto floors = floorsAt(scene, x, y, height_m);
  const auto near = [&](double z) { return std::abs(z + g.shift_m.z() - *clicked.place.z_m) <= 0.5; };
  if (clicked.place.z_m && std::none_of(floors.begin(), floors.end(), near))
    return Waypoint{{x, y, *clicked.place.z_m - g.shift_m.z()}, clicked.stop_s};
  if (floors.empty())
    return failure(ErrorKind::unusable,
                   fmt::format("no floor at ({}, {}) with {:.2f} m of free height; choose another place, or state its "
                               "height as X,Y,Z",
                               clicked.place.x_m, clicked.place.y_m, height_m + kRoomAbove_m),
                   option);
  TRY_ASSIGN(const auto floor, chosenFloor(floors, clicked.place.z_m, g.shift_m.z()));
  return Waypoint{{x, y, floor}, clicked.stop_s};
}

}  // namespace

Result<std::vector<Waypoint>> waypointsOf(const std::vector<std::string>& texts, const RayScene& scene,
                                          const Georeference& georeference, double height_m, const char* option) {
  std::vector<Waypoint> waypoints;
  for (const std::string& text : texts) {
    TRY_ASSIGN(const auto clicked, clickedFrom(text, option));
    TRY_ASSIGN(const auto waypoint, waypointAt(scene, georeference, clicked, height_m, option));
    waypoints.push_back(waypoint);
  }
  return waypoints;
}

}  // namespace standpoint
