// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/environment.h"
#include "core/report.h"

namespace standpoint {

// Where the model's unit and upright axis come from; what nobody stated was guessed, and is doubted first.
struct FrameOrigin {
  double metres_per_unit = 1;   // by which the file's numbers were multiplied
  bool unit_stated = false;     // by the file or by the user's --unit
  bool up_stated = false;       // by the file or by the user's --up
};

// Says, as warnings, what looks wrong about the model's size and stance: a house 3 km high is in millimetres, one whose
// largest faces all look sideways lies on its side. Each names the option that would mend it, where there is one. Every
// importer calls it once on what it made (local frame, Z up) and appends the issues to its report. Linear in triangles;
// an empty model has no issues.
std::vector<Issue> plausibility(const Environment& environment, const FrameOrigin& origin);

}  // namespace standpoint
