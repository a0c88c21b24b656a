// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "project/verb.h"
#include "scanners/engine/ray_engine.h"
#include "scanners/instruments/instrument.h"

namespace standpoint {

constexpr double kUsualHeight_m = 1.6;    // of the instrument's centre, where no instrument says its own
constexpr double kUsualTrunnion_m = 0.2;  // above the tripod's plate, likewise

constexpr double kFloorSearch_m = 0.5;  // how far a stated floor height may be off

// Where a tripod of that height can stand at (x, y): upward faces below which the beam from above ends, with room for
// the instrument. Heights of the floor in the local frame, ascending.
std::vector<double> floorsAt(const RayScene& scene, double x_m, double y_m, double instrument_height_m);

Result<Outcome> runStation(const Document& document, const nlohmann::json& options, Progress& progress);
Result<Outcome> runTarget(const Document& document, const nlohmann::json& options, Progress& progress);

// The environment that a scan sees: the document's, with the job's targets standing in it as products of their own
// (class "Target") of stated reflectance.
struct ScanWorld {
  std::shared_ptr<const Environment> environment;
  MaterialAssignment assignment;
};
ScanWorld scanWorld(const Document& document, const MaterialAssignment& assignment);

// What the stations' scans would bring, before they are made: coverage, overlap, points, time, and a place for another
// one.
Result<Outcome> runPlan(const Document& document, const nlohmann::json& options, Progress& progress);
Result<Outcome> runScan(const Document& document, const nlohmann::json& options, Progress& progress);

}  // namespace standpoint
