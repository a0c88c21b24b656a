// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "editor/trajectories/carried_scan.h"
#include "project/document.h"
#include "scanners/instruments/instrument.h"

namespace standpoint {

// Another instrument with its own settings; what is not the instrument's stays.
void chooseInstrument(ScanChoice& asked, const Instrument& instrument);

// What the next scan along a trajectory of that name asks for; without a file.
ScanVerbOptions optionsAlong(const CarriedScan& carried, const std::string& trajectory);

// "all effects", "ideal", "without striping, footprint", "13 of 16 effects", and the quality where it is none of the
// usual: what a folded list says of itself.
std::string effectsSummary(Effects effects, ScanQuality quality = ScanQuality::standard);
// "clear air", "rain 10 mm/h, visibility 5 km".
std::string weatherSummary(const Weather& weather);
// "range-noise" → "Range noise".
std::string readableEffect(const EffectName& effect);

}  // namespace standpoint
