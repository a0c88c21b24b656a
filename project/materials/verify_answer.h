// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/surface_fit.h"
#include "project/materials/verification.h"
#include "project/verb.h"
#include "survey/scene/measured_returns.h"

namespace standpoint {

// All that a verification found, before it becomes an answer.
struct VerifyFound {
  std::string underlay;
  const Instrument* instrument = nullptr;
  const std::vector<PhysicalMaterial>* library = nullptr;
  const Document* document = nullptr;
  MeasuredReturns measured;
  Result<SurfaceFit> placement = SurfaceFit();  // where a fit to the surface would put the cloud
  MaterialComparison comparison;
};

VerifyAnswer verifyAnswer(const VerifyFound& found);
// One line for each material and each proposal.
void tellVerified(const VerifyFound& found, Report& report);

}  // namespace standpoint
