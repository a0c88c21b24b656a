// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "editor/bodies/standing.h"
#include "scanners/engine/ray_engine.h"
#include "scanners/instruments/instrument.h"

namespace standpoint {

// How an instrument's head turns while it measures, in the azimuths of its own frame (clockwise from X).
struct SweepShape {
  double from_rad = 0;
  double turn_rad = 0;               // of the head: half of what is measured where there are two fans
  int fans = 1;                      // the second looks the other way
  double low_rad = 0, high_rad = 0;  // elevations of each
};
// Two fans only where all around is measured: a window is swept by one.
SweepShape sweepShapeOf(const InstrumentBody& body, const ScanSettings& settings);

// How much of the head's turn is done when the beam passes an azimuth, 0 to 1.
double shareAt(const SweepShape& shape, double azimuth_rad);

// The fans of a head that has done that share of its turn, each as far as the beam reaches in the scene; without a
// scene as far as the fan is drawn at most.
std::vector<SweepFan> fansOf(const SweepShape& shape, double share, const StandingInstrument& stands,
                             const RayScene* scene);

}  // namespace standpoint
