// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/survey.h"

namespace standpoint {

// The station or targets that were moved, changed, added or removed since the scan was made, by name: the station
// first. Nothing where the record does not say how they stood.
std::vector<std::string> newerThan(const Scan& scan, const Station& station, const std::vector<Target>& targets);

// "older than K3", "older than K3 and 2 more"; "" where nothing is newer.
std::string ageText(const Scan& scan, const Station& station, const std::vector<Target>& targets);

// The same of the newest scan of a station; "" where there is none.
std::string ageText(const Station& station, const std::vector<Target>& targets);

// Another one once somebody goes another way, at another pace or otherwise: of all but name and scans.
std::uint64_t wayFingerprint(const CarriedTrajectory& trajectory);
// "older than W1" where it has another way by now.
std::string ageText(const Scan& scan, const CarriedTrajectory& trajectory);

}  // namespace standpoint
