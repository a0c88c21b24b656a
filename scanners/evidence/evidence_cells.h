// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "scanners/evidence/material_evidence.h"
#include "scanners/radiometry/radiometry.h"

namespace standpoint {

// Returns of one group within a quarter octave of range and 5° of incidence.
struct EvidenceCell {
  std::uint32_t group = 0;
  std::uint64_t points = 0;
  double measured = 0;             // median
  double range_m = 0, cosine = 0;  // geometric means
  double weight() const;           // √points: neighbours share what is wrong with them
};
// In the order of groups, ranges, incidences. Takes what is not grazing and not at the end of the vendor's scale.
std::vector<EvidenceCell> evidenceCells(const std::vector<MeasuredReturn>& returns, const EvidenceOptions& options,
                                        MaterialComparison& counts, std::vector<bool>& is_used);

// What is left of the power by the way there and back, in dB.
double wayDb(const Instrument& instrument, double range_m, bool range_compensated);
// What the surface sends back, in dB of a white Lambert board head-on.
double surfaceDb(const Optics& optics, double cosine);

struct Weighted {
  double value = 0, weight = 1;
};
double weightedMedian(std::vector<Weighted> values);  // 0 of none
Spread spreadOf(std::vector<float>& values);          // sorts them

}  // namespace standpoint
