// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "emulated-ui/device/device.h"

// For what the figures of an exercise's data are made from.
namespace standpoint {

inline FactDomain numbers(double minimum, double maximum) { return {{}, true, minimum, maximum}; }

// A figure that nothing was measured for is not there.
inline std::optional<Fact> factOf(const std::optional<double>& figure) {
  return figure ? std::optional(numberFact(*figure)) : std::nullopt;
}

inline std::vector<const StoredSetup*> allSetups(const Device& device) {
  std::vector<const StoredSetup*> all;
  for (const auto& p : device.state().projects)
    for (const auto& s : p.setups) all.push_back(&s);
  return all;
}

}  // namespace standpoint
