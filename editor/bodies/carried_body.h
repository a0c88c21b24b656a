// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "editor/bodies/instrument_body.h"

namespace standpoint {

// How an instrument that is carried looks, in the frame in which its trajectory has it: x ahead, y left, z up, the
// origin where its beams begin. All of it is the body's head.
struct CarriedBody {
  InstrumentBody look;                    // its foot_m: how far below the origin it is set on a mast
  double top_m = 0.05;                    // how far above the origin it ends: it hangs there below an aircraft
  std::optional<Eigen::Vector3d> grip_m;  // where a hand holds it; none: it has no handle
  bool worn = false;                      // on the shoulders, by a frame of its own
};

// One for each carried instrument that looks different; the last is for any other.
std::span<const CarriedBody> carriedBodies();
// Of an instrument's id, such as "leica-blk2go"; never null.
const CarriedBody& carriedBodyOf(std::string_view instrument);

}  // namespace standpoint
