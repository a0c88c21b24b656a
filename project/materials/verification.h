// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "project/fields.h"

namespace standpoint {

// What came of holding the assigned materials against a measured cloud.
struct Verification {
  std::uint64_t basis = 0;  // of what it was found with: see isCurrent
  std::uint64_t rest = 0;   // of the same without what it proposes to change: see hasStandingProposals
  nlohmann::json answer;    // as of the verb: docs/explanation/verification.md
};

// Whether cloud, placement and assignment are still those that it was found with.
bool isCurrent(const Verification& verification, const Document& document);

// Whether the proposals hold that nobody has followed: all is as it was but for surfaces that a proposal means. Who
// follows one of three keeps the other two. Throws nlohmann::json::exception when somebody edited the answer.
bool hasStandingProposals(const Verification& verification, const Document& document);
// The surfaces that a proposal of the answer means, by product and surface, as (product, surface).
std::vector<std::pair<std::uint32_t, std::uint32_t>> surfacesOf(const nlohmann::json& proposal,
                                                                const Document& document);

// With the basis of the document as it is.
Verification verificationOf(const Document& document, nlohmann::json answer);

nlohmann::json verificationToJson(const Verification& verification);
std::shared_ptr<const Verification> verificationFrom(const nlohmann::json& part);  // throws nlohmann::json::exception

// Compares the intensities of an underlay with what its surfaces' materials should send back. A verb of its own and no
// option of `materials`, which assigns: this one assigns nothing, and its options mean nothing to an assignment.
struct VerifyOptions {
  std::string underlay;                 // its name; empty: the only one
  std::string instrument;               // id; empty: as the cloud says
  std::optional<Eigen::Vector3d> from;  // the station in the model's file frame, m
  double tolerance_m = 0.03;
  std::size_t points = 2000000;  // maximum drawn from the cloud
};
const Fields<VerifyOptions>& verifyFields();
Result<Outcome> runVerify(const Document& document, const VerifyOptions& options, Progress& progress);

}  // namespace standpoint
