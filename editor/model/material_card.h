// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/physical_material.h"
#include "scanners/forecast/expectation.h"

namespace standpoint {

// The instruments that a card speaks of, and how far away the material is.
constexpr std::array<const char*, 3> kCardInstruments = {"leica-rtc360", "faro-focus-s350", "trimble-x7"};
constexpr std::array<double, 3> kCardRanges_m = {10, 30, 60};

struct CardRow {
  std::string instrument;  // "RTC360"
  double wavelength_nm = 0;
  std::array<ExpectedReturn, kCardRanges_m.size()> at;  // of kCardRanges_m
};

// What the card's instruments report of a plane of the material at that incidence, with their default settings.
// An instrument that `instruments` lacks has no row.
std::vector<CardRow> reportedOf(const PhysicalMaterial& material, const std::vector<Instrument>& instruments,
                                double incidence_rad);

// ρ_eq in per cent of a white Lambert target seen head-on, at 0°, 1°, … 80°.
std::array<float, 81> angularResponse(const PhysicalMaterial& material, double wavelength_nm);

}  // namespace standpoint
