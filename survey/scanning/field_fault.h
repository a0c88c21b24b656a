// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "scanners/engine/ray_engine.h"

namespace standpoint {

// What went wrong in the field, and shows in the points.
struct FieldFault {
  double until_fraction = 1;  // of the columns: the scan was cut short
  double noise_factor = 1;    // of the range noise: dust on the optics, an instrument that is not warm
  std::optional<double>
      tripod_moved_at_fraction;  // of the columns: the tripod was pushed there, and nobody told the instrument
  std::optional<double> passer_by_at_fraction;  // of the turn: somebody crosses the laser's way there
  std::optional<double> operator_at_fraction;   // of the turn: who scans stands there, beside the instrument
  double operator_m = kOperator_m;              // from its axis to theirs
  double operator_from_fraction = 0, operator_until_fraction = 1;  // of the columns: while the laser measures these
  static constexpr double kOperator_m = 0.9, kNearest_m = 0.4, kFarthest_m = 50;
  bool anybody() const { return passer_by_at_fraction.has_value() || operator_at_fraction.has_value(); }
  bool any() const {
    return until_fraction < 1 || noise_factor != 1 || tripod_moved_at_fraction.has_value() || anybody();
  }
};

// "until=0.5", "noise=2", "tripod_moved=0.4", "passer_by=0.5", "operator_in_view=0.5", "operator_distance=2" (metres),
// "operator_from=0.2", "operator_until=0.7"; what is not so, or out of bounds, is an error.
Result<FieldFault> fieldFaultFrom(const std::vector<std::string>& pairs);
std::vector<std::string> pairsOf(const FieldFault& fault);

// The label of a person's points.
LabelledProduct personLabel();

// How a bumped tripod moves the instrument: 4 mm aside and 0.05° about its standing axis; a choice of ours.
Pose tripodMoved(const Pose& pose);

// Who walks by is a cylinder of 0.5 m by 1.75 m, 2 m from the instrument, whose centre is 1.6 m above the floor; what
// stands nearer hides it. A second pass of the laser shows it as moving, and the device takes it out: then nothing is
// left of it. Who stays beside the instrument is such a cylinder, and is there in a second pass, too. A person's points
// carry the label behind that of no surface, which the header's table must have (personLabel()), and no material.
// Scans from a tripod as `scan` does, with what went wrong. After a push the points stand in the frame that the
// instrument believes to be the old one; what is true of them is told in the old frame.
Result<ScanCount> scanWithFieldFault(const RayScene& scene, const MaterialAssignment& assignment,
                                     const Instrument& instrument, const ScanSettings& settings, const Pose& pose,
                                     const ScanOptions& options, const FieldFault& field_fault, PointSink& sink,
                                     Progress& progress);

}  // namespace standpoint
