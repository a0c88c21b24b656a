// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/instruments/stand.h"

#include <numbers>

#include <nlohmann/json.hpp>

#include "core/json_file.h"
#include "core/units.h"
#include "scanners/instruments/figure_reader.h"

namespace standpoint {

namespace {

class StandReader : FigureReader {
 public:
  using FigureReader::FigureReader;

  Result<TripodStand> read(const Json& document) {
    Group root = open(document, "");
    root.fields.text("id");
    readSources(root);
    TripodStand stand;
    stand.clearance_m = figure(root, "clearance_m", {0.01, 5});
    stand.headroom_m = figure(root, "headroom_m", {0, 5});
    Group plate = child(root, "plate");
    stand.lowest_plate_m = figure(plate, "lowest_m", {0, 10});
    stand.highest_plate_m = figure(plate, "highest_m", {0.01, 10});
    plate.fields.close();
    Group feet = child(root, "feet");
    stand.foot_radius_m = figure(feet, "radius_m", {0.01, 5});
    stand.foot_play_m = figure(feet, "play_m", {0.01, 5});
    feet.fields.close();
    stand.steepest_rad = figure(root, "steepest_deg", {0, 89, kRadPerDeg});
    stand.wall_rad = figure(root, "wall_deg", {0, 90, kRadPerDeg});
    root.fields.close();
    if (!error() && stand.lowest_plate_m >= stand.highest_plate_m) fail("/plate/highest_m", "must be above lowest_m");
    if (error()) return failure(*error());
    return stand;
  }
};

}  // namespace

Result<TripodStand> readTripodStand(const std::filesystem::path& file) {
  TRY_ASSIGN(const auto document, readJsonFile(file, kLargestFile));
  return StandReader(file.filename().string()).read(document);
}

}  // namespace standpoint
