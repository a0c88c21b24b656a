// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "emulated-ui/device/program.h"

namespace standpoint::trimble_x7 {

namespace phase {

inline const PhaseId off{"off"}, booting{"booting"}, disconnected{"disconnected"}, connecting{"connecting"},
    idle{"idle"}, calibrating{"calibrating"}, levelling{"levelling"}, not_level{"not_level"}, scanning{"scanning"},
    imaging{"imaging"}, downloading{"downloading"}, interrupted{"interrupted"}, registering{"registering"},
    refining{"refining"}, error{"error"}, shutting_down{"shutting_down"};

}  // namespace phase

using Event = EngineEvent;

}  // namespace standpoint::trimble_x7
