// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "emulated-ui/device/program.h"

namespace standpoint::leica_blk360 {

namespace phase {

inline const PhaseId off{"off"}, starting{"starting"}, ready{"ready"}, connected{"connected"}, standby{"standby"},
    self_timer{"self_timer"}, shooting{"shooting"}, scanning{"scanning"}, finishing{"finishing"}, storing{"storing"},
    error{"error"}, fatal{"fatal"}, formatting{"formatting"}, transferring{"transferring"},
    shutting_down{"shutting_down"};

}  // namespace phase

using Event = EngineEvent;

}  // namespace standpoint::leica_blk360
