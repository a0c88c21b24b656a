// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/survey.h"
#include "editor/bodies/carried_body.h"

namespace standpoint {

// An instrument at a moment of the trajectory along which it is carried; all poses in the local frame.
struct CarriedInstrument {
  const CarriedBody* body = nullptr;  // of carriedBodies()
  Pose pose;                          // of its own frame
  std::string carrier;                // id of core/motion/carriers.h; "": nobody knows what bears it
  double height_m = 0;                // of the pose above what is walked or driven on
  std::vector<Pose> limbs;            // of who walks with it, in the order of kLimbs; empty: nobody does
  bool operator==(const CarriedInstrument& other) const;
};
struct InstrumentsUnderWay {
  std::vector<CarriedInstrument> carried;
  bool operator==(const InstrumentsUnderWay&) const = default;
};

// Who or what bears it, local frame: somebody who holds it in the right hand or has it on the back, a trolley, a car
// or a multicopter. Sizes are not sourced.
BodyMesh bearerOf(const CarriedInstrument& instrument);

}  // namespace standpoint
