// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace standpoint {

struct Editor;
struct Instrument;
struct ScanSettings;

// The folded parts of the scan panel: effects one by one, the weather, and what comes with the points.
void drawScanConditions(Editor& editor, const Instrument& instrument, const ScanSettings& settings);
// Why these cannot be scanned with; empty when they can.
std::string whyNotConditions(const Editor& editor, const ScanSettings& settings);

}  // namespace standpoint
