// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/environment.h"
#include "materials/materials.h"
#include "project/materials/materials_verb.h"

namespace standpoint {

// What the command line tells of `materials`: the coverage, each material's share, the findings by kind, and how to go
// on.
std::string materialsText(const Environment& environment, const MaterialReport& report);

// What was taken in, and where what changed is used. Empty without.
std::string libraryText(const std::vector<LibraryRow>& libraries);

std::string whereText(const MaterialPlaces& where);

}  // namespace standpoint
