// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/points.h"
#include "project/survey/survey_verbs.h"
#include "survey/scanning/scan_world.h"
#include "survey/trajectories/carried_motion.h"

namespace standpoint {

// What all scans of a document need and what takes a while to make, so that it can be made before it is asked for: a
// million triangles take half a second. It stays good while stations move.
struct ScanPreparation {
  std::shared_ptr<const Environment> model;  // these three are what it was made for
  std::shared_ptr<const MaterialChoice> materials;
  std::vector<Target> targets;
  std::vector<Mover> movers;
  bool carried = false;  // by somebody, who is in it
  ScanWorld world;
  std::shared_ptr<const RayScene> scene;
  std::uint64_t fingerprint = 0;  // of the world

  bool fits(const Document& document, bool with_movers = true) const;
};

// Who carries a scanner along a trajectory.
struct ScanOperator {
  PoseFunctionPtr scanner_path;
  double height_m = 0;
  bool in_front = true;  // … of whom it is held; else above
  double ahead_s = 0;    // the movers' clock of the trajectory's
};

// `of_model` is a scene of the document's environment, where there is one already; without targets it is the one.
Result<std::shared_ptr<const ScanPreparation>> prepareScan(const Document& document,
                                                           std::shared_ptr<const RayScene> of_model, Progress& progress,
                                                           bool with_movers = true,
                                                           const std::optional<ScanOperator>& who = {});

// How somebody on foot carried a scanner along a trajectory of the job, for whoever knows it better than by its file.
struct CarriedBy {
  CarriedMotion motion;
  std::vector<std::array<double, 2>> recorded;                            // from and to: only then points are kept
  unsigned one_pulse_in = 1;                                              // of the instrument's
  std::vector<ControlPoint> control;                                      // local frame, beside those of a file
  std::function<void(const CarriedMotion&, const SolvedMotion&)> solved;  // what became of it; may be empty
};

// Whom a scan is made for: what was prepared for it, who watches its points beside the file, and where its crew
// believes that it stands. Each may be missing.
struct ScanSurroundings {
  std::shared_ptr<const ScanPreparation> preparation;
  std::shared_ptr<PointSink> watcher;
  std::optional<Pose> believed;  // of every station, local frame: else where it stands, as levelled by the compensator
  std::shared_ptr<const CarriedBy> carried;
};

// The verb `scan` with company.
Result<Answered<ScanAnswer>> runScan(const Document& document, const ScanVerbOptions& options,
                                     const ScanSurroundings& company, Progress& progress);

}  // namespace standpoint
