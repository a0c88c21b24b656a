// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include "project/verb.h"

namespace standpoint {

// What came of holding the assigned materials against a measured cloud.
struct Verification {
  std::uint64_t basis = 0;     // of what it was found with: see isCurrent
  nlohmann::json answer;       // as of the verb: docs/against-reality.md
};

// Whether cloud, placement and assignment are still those that it was found with.
bool isCurrent(const Verification& verification, const Document& document);

nlohmann::json verificationToJson(const Verification& verification);
std::shared_ptr<const Verification> verificationFrom(const nlohmann::json& part);   // throws nlohmann::json::exception

// Compares the intensities of an underlay with what its surfaces' materials should send back. A verb of its own and no
// option of `materials`, which assigns: this one assigns nothing, and its options mean nothing to an assignment.
Result<Outcome> runVerify(const Document& document, const nlohmann::json& options, Progress& progress);

}  // namespace standpoint
