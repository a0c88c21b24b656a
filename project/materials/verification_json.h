// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The verification of the materials as it stands in project.json.

#include <memory>

#include <nlohmann/json.hpp>

#include "project/materials/verification.h"

namespace standpoint {

nlohmann::json verificationToJson(const Verification& verification);
// Nothing where it cannot be read, because somebody edited it.
std::shared_ptr<const Verification> verificationFrom(const nlohmann::json& part);

}  // namespace standpoint
