// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/progress.h"
#include "emulated-ui/device/orders.h"
#include "project/document.h"

namespace standpoint {

struct ScannedWalk {
  CarriedTrajectory trajectory;  // for the job, with its scan: the way as it was is in a file beside it
  WalkResult result;
};

struct WalkScanOptions {
  std::filesystem::path file;
  std::uint64_t seed = 1;
  bool truth = false;
  std::string mount = "hand";  // of the scanner
};

// What the office makes of a walk: the real scan along it, one of 16 pulses of the scanner and without the width of its
// beam, its trajectory solved with the closures, points and stations that hold it. Doors on the way open as somebody
// comes to them, unless they were opened before. An error says where nobody can walk.
Result<ScannedWalk> scanWalk(const Document& document, const ScanOrder& order, const WalkScanOptions& options,
                             Progress& progress);

}  // namespace standpoint
