// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace standpoint {

// What a beam's width costs: preview looks at its axis alone; standard at the whole footprint where an edge of the
// scene is in it; reference at 64 rays of every pulse, wherever it goes.
enum class ScanQuality { preview, standard, reference };

}  // namespace standpoint
