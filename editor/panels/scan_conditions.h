// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace standpoint {

struct CarriedScan;
struct Instrument;
struct Model;
struct ScanChoice;
struct ScanSettings;
struct ScanState;

// The folded parts of the scan panel: how a trajectory is known, effects one by one, the weather, and what comes with
// the points. `carried`: of a scan along a trajectory, else null.
void drawScanConditions(const Model& model, ScanState& state, ScanChoice& asked, CarriedScan* carried,
                        const Instrument& instrument, const ScanSettings& settings);
// Why these cannot be scanned with; empty when they can.
std::string whyNotConditions(const ScanChoice& asked, const ScanSettings& settings);

}  // namespace standpoint
