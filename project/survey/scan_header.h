// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/points.h"
#include "project/document.h"
#include "survey/scanning/scan_request.h"
#include "survey/scanning/scan_world.h"

namespace standpoint {

// The simulation's clock is not the wall clock, so that the same job gives the same bytes: the first station starts on
// 2026-01-01 09:00:00 UTC, in seconds since 1980-01-06 without leap seconds.
inline constexpr double kFirstStart_gps_s = 1451293200.0;

// What is known of a scan of that name before its first point. `believed`: where its crew believes that it stands,
// local frame.
ScanHeader scanHeader(const Document& document, const ScanWorld& world, const std::string& name, const Pose& believed,
                      const std::string& guid, const ScanRequest& request, double start_gps_s);

}  // namespace standpoint
