// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "project/survey/survey_verbs.h"

namespace standpoint {

// What the next scan along a trajectory is set to. An instrument on a tripod has settings of its own, so that going
// from one to the other and back loses nothing.
struct CarriedScan {
  bool wanted = false;  // the next scan is along the chosen trajectory, not from stations
  ScanChoice choice{.instrument = "leica-blk2go"};
  TrajectoryError error = TrajectoryError::of_instrument;
  bool closures = true, anchors = false;
  Deskew deskew = Deskew::pulse;
};

}  // namespace standpoint
