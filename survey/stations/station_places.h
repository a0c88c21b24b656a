// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "survey/stations/placement.h"

namespace standpoint {

constexpr double kUsualHeight_m = 1.6;    // of the instrument's centre, where no instrument says its own
constexpr double kUsualTrunnion_m = 0.2;  // above the tripod's plate, likewise

constexpr double kRoomAbove_m = 0.3;  // of the tilting axis, for a height to count as a floor

// Where a tripod of that height can stand at (x, y): upward faces below which the beam from above ends, with room for
// the instrument; a suspended ceiling bears none. Heights of the floor in the local frame, ascending.
std::vector<double> floorsAt(const RayScene& scene, double x_m, double y_m, double instrument_height_m);
// The lowest floor there that something is above too low for the instrument, or the one within 0.5 m of a stated
// height, and what that is; nothing: there is no such floor.
struct BlockedFloor {
  double floor_m = 0, free_m = 0;  // local frame; between floor and what is above it
  std::uint32_t product = 0;
};
std::optional<BlockedFloor> blockedFloorAt(const RayScene& scene, double x_m, double y_m, double instrument_height_m,
                                           std::optional<double> z_m);
bool isRoomAbove(const RayScene& scene, const Eigen::Vector3d& floor, double instrument_height_m);
// Of these floors the lowest, or the one at a stated height of the file's frame. Refused where it is farther than 0.5
// m.
Result<double> chosenFloor(const std::vector<double>& floors, std::optional<double> z_file_m, double shift_z_m);

// Grounds to try for another station, in the local frame, one list after the other until a tripod can stand on one of
// it. For the first station of a job the storeys, from the ground up (storeys.h); then the floors of the whole model
// that are made for standing, and then whatever else is level: of `walkable` where there is such a surface, else of a
// grid.
struct GroundSearch {
  const Mesh* walkable = nullptr;
  double height_m = kUsualHeight_m;
  double shift_z_m = 0;  // of the georeference
};
std::vector<std::vector<Eigen::Vector3d>> groundsToTry(const Job& job, const RayScene& scene,
                                                       const GroundSearch& search);
// For models without a floor (walls alone, a roof, a set of frames, a line of masts): within and beside the whole and
// beside some of its products, on the lowest height.
std::vector<Eigen::Vector3d> groundWithoutFloor(const RayScene& scene);

// The instrument's centre of another station of the same height beside one that stands: on the nearest place in its
// sight where a tripod can stand, a metre or more from all others. None within 5 m.
std::optional<Eigen::Vector3d> placeBeside(const Job& job, const StationPlacement& placement, const Station& station);

// How much a station would see: the mean distance to what it meets, capped so that neither a long corridor nor the open
// ground outside outweighs a room, and nothing for beams that leave the model.
double roomAround(const RayScene& scene, const Eigen::Vector3d& centre);

// Of the places in the first of these lists that has such a place the one that is worth most (more than nothing), where
// a tripod can stand at least 2.5 m from every station that is there already. The instrument's centre; none where there
// is no such place.
std::optional<Eigen::Vector3d> bestOf(const std::vector<std::vector<Eigen::Vector3d>>& grounds, const Job& job,
                                      const StationPlacement& placement, double height_m,
                                      const std::function<double(const Eigen::Vector3d&)>& worth, Progress& progress);

}  // namespace standpoint
