// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "emulated-ui/layout/layout.h"

namespace standpoint {

// All that readLayout refuses beyond the form of the file, with their places in it. `file` is named in them.
std::vector<Error> checkLayout(const Layout& layout, const DeviceDefinition& definition, const std::string& file);

}  // namespace standpoint
