// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "emulated-ui/device/program.h"

namespace standpoint::leica_p_series {

namespace phase {

inline const PhaseId off{"off"}, idle{"idle"}, scanning{"scanning"}, imaging{"imaging"}, paused{"paused"},
    finishing{"finishing"}, storing{"storing"}, error{"error"}, searching_target{"searching_target"},
    adjusting{"adjusting"};

}  // namespace phase

using Event = EngineEvent;

}  // namespace standpoint::leica_p_series
