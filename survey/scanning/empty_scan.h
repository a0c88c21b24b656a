// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "scanners/engine/ray_engine.h"

namespace standpoint {

// Why a scan from there brought nothing, in words with a remedy: looks round over the field of view.
std::string whyNothing(const RayScene& scene, const Pose& local_from_scanner, const Instrument& instrument,
                       const ScanSettings& settings);

}  // namespace standpoint
