// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "survey/scanning/scan_request.h"
#include "survey/scanning/scan_world.h"

namespace standpoint {

// 64 bits of all that beams can meet: shapes, places, what is in the scene, what it is made of.
std::uint64_t fingerprintOf(const ScanWorld& world);

// 128 bits of what the scan is, written as a version-8 UUID: the same scan has the same guid, another has another. It
// says whether a file holds just the points that a station would get again.
std::string guidOf(std::uint64_t world_fingerprint, const Station& station, const Pose& believed,
                   const ScanRequest& request);

// Of a copy of a scan that differs from it: two hashes of what it came from and of what was done, as such a UUID.
std::string guidText(std::uint64_t a, std::uint64_t b);

}  // namespace standpoint
