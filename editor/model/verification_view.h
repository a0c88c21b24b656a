// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "project/materials/verification.h"

namespace standpoint {

// What the document's verification says, as a panel shows it.
struct VerifiedMaterial {
  std::string material;  // id; "" = nothing is assigned
  std::uint64_t points = 0;
  std::array<double, 5> off_db = {};  // 5, 25, 50, 75, 95 %
  bool judged = false, agrees = false;
  std::vector<std::uint32_t> products;
};
struct VerifiedProposal {
  std::string material, behaves_like;  // ids; "" = nothing is assigned
  std::vector<std::string> alike;      // ids that explain it as well
  bool whole_material = false;
  std::string evidence;
  std::vector<MaterialOverride> assign;  // to follow it
  std::vector<std::uint32_t> products;
};
struct VerificationView {
  bool there = false, current = false;
  std::string underlay, instrument, scale, no_verdict;
  double moved_m = -1;  // that a fit to the model would move the cloud by; -1 = unknown
  std::uint64_t compared = 0;
  double reach_db = 3;  // of a picture of all boxes, to either side of 0
  std::vector<VerifiedMaterial> materials;
  std::vector<VerifiedProposal> proposals;
};
VerificationView verificationView(const Document& document);

}  // namespace standpoint
