// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/physical_material.h"
#include "core/progress.h"
#include "core/result.h"
#include "scanners/instruments/instrument.h"
#include "scanners/radiometry/intensity_scale.h"

namespace standpoint {

// A point of a real scan on a surface of the model.
struct MeasuredReturn {
  float intensity = 0;  // raw
  float range_m = 0, cosine = 0;
  std::uint32_t group = 0;
};

// One surface of one product, and what it is said to be made of.
struct SurfaceGroup {
  std::uint32_t product = 0, surface = 0;
  std::int32_t material = -1;  // index into the library; -1 = nothing is assigned
};

// Percentiles 5, 25, 50, 75, 95.
struct Spread {
  std::uint64_t points = 0;
  double low = 0, lower = 0, median = 0, upper = 0, high = 0;
};
struct SpreadBin {
  double from = 0, to = 0;  // metres or degrees
  Spread off_db;
};

// All differences are measured minus expected, in dB of received power: +3 is twice as bright as it should be.
struct GroupEvidence {
  std::uint32_t group = 0;
  std::uint64_t points = 0;
  double off_db = 0, sigma_db = 0;  // median over its cells
  bool supported = false;           // enough points, ranges and incidences to judge it by
  bool agrees = false;
};
struct MaterialEvidence {
  std::int32_t material = -1;
  std::uint64_t points = 0;
  Spread off_db;
  std::vector<SpreadBin> by_range, by_incidence;  // those with points only
  std::vector<GroupEvidence> groups;              // by group
  bool supported = false, agrees = false;         // as most of its supported groups
};
struct MaterialProposal {
  std::int32_t material = -1, instead = -1;  // indices into the library
  std::vector<std::int32_t> alike;           // explain it as well, by rising misfit
  std::vector<std::uint32_t> groups;
  bool whole_material = false;  // all its groups that can be judged
  std::uint64_t points = 0;
  double off_db = 0;
  double misfit_db = 0, misfit_instead_db = 0;  // median |difference| as assigned, and as proposed
  double range_from_m = 0, range_to_m = 0, incidence_from_deg = 0, incidence_to_deg = 0;
};

struct MaterialComparison {
  IntensityScale scale;
  double level_db = 0;  // added to the scale: the constant on which most materials agree
  std::uint64_t used = 0, saturated = 0, grazing = 0;
  std::vector<MaterialEvidence> materials;  // by index into the library
  std::vector<MaterialProposal> proposals;  // by falling |off_db|
  std::string no_verdict;                   // why nothing can be proposed; empty where it can
};

struct EvidenceOptions {
  double agree_db = 1.0;  // what materials of one class differ by anyway
  double steepest_deg = 75;
  std::uint32_t fewest_points = 150, fewest_cells = 3, fewest_in_cell = 8;
};

// Compares what was measured with what the library's materials would send back. The vendor's scale is unknown: it is
// fitted within surfaces (intensity_scale.h), and its constant is where most materials agree: a wrong material stands
// out where most are right.
Result<MaterialComparison> compareMaterials(const std::vector<MeasuredReturn>& returns,
                                            const std::vector<SurfaceGroup>& groups,
                                            const std::vector<PhysicalMaterial>& library, const Instrument& instrument,
                                            const EvidenceOptions& options, Progress& progress);

}  // namespace standpoint
