// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "project/document.h"

namespace standpoint {

// What there is to look at: the findings of the assignment, and those of its verification by a cloud, which the
// assignment knows nothing of. The latter are gone when cloud, placement or other materials have changed, and when they
// were followed.
std::vector<MaterialFinding> materialFindings(const Document& document);

}  // namespace standpoint
