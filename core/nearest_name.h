// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace standpoint {

// What to say to somebody who wrote a name that is not there: "did you mean scan_started? Known are scan_started, …".
// The known ones come with the most alike first; of more than `most` the rest is left out.
std::string knownInstead(const std::string& wanted, std::vector<std::string> known, std::size_t most = 64);

}  // namespace standpoint
