// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "editor/bodies/instrument_body.h"

namespace standpoint {

// What carries an instrument whose beam leaves `height_m` above the floor: three legs, and a tribrach or a quick clamp
// between their head and its foot. In a frame with its origin where the beam leaves and Z up, so the floor is at
// -height_m. Where there is no room for legs a low plate takes their place; nothing reaches below the floor.
BodyMesh tripodOf(const InstrumentBody& body, double height_m);

}  // namespace standpoint
