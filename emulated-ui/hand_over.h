// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include <Eigen/Core>

#include "core/progress.h"
#include "core/report.h"
#include "core/result.h"
#include "core/survey.h"
#include "emulated-ui/device/orders.h"
#include "emulated-ui/device/state.h"

namespace standpoint {

// What the links of a device did to its set-ups, by file: the place that a scan's file has, moved by it, is where the
// device believes the set-up to be, local frame. A wrong link moves all that hang on it; a set-up without a joined link
// is not moved, and is not in the list.
using LinkedPlaces = std::map<std::string, Pose>;
LinkedPlaces linkedPlaces(const DeviceState& state);

// Where copies of scans go: a folder beside that of the scans.
std::filesystem::path officeBeside(const std::filesystem::path& scans_folder);
// The copy of a scan there, in its own format.
std::filesystem::path copyIn(const std::filesystem::path& office, const std::filesystem::path& scan);
// Whether the office has all of it: as large as on the card; or transferred whole, but with another pose or format.
bool isHandedOver(const StoredSetup& setup, const std::filesystem::path& office);

// Copies the order's scans to a folder, which is made where it is missing: byte for byte where the links leave a scan
// where it is and no other format is asked for; else converted, with the pose that the links give it and the true one
// beside it where the scan holds the truth. What the other format cannot hold is in the report. A copy that was
// broken off is not taken for a whole one.
Result<void> handOver(const TransferOrder& order, const LinkedPlaces& links, const Eigen::Vector3d& shift_m,
                      const std::filesystem::path& office, Report& report, Progress& progress);

}  // namespace standpoint
