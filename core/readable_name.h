// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/environment.h"

namespace standpoint {

// IfcSpace.LongName and the like; empty where the model has none.
std::string longNameOf(const Product& product);

// The name in the words of the model: number and long name of a room ("4 Bedroom"), any other product's name, else
// its id.
std::string readableName(const Product& product);

}  // namespace standpoint
