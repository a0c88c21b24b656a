// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "pointclouds/e57/e57_scan_reader.h"

namespace standpoint::e57 {

using Place = std::optional<std::size_t>;

// Which stream of a scan holds what.
struct Roles {
  Place x, y, z;
  bool spherical = false;
  Place intensity, colour[3], row, column, product, material, time, channel, return_index, return_count, truth[7];
  Place cartesian_state, spherical_state, intensity_invalid, colour_invalid, time_invalid;

  template <class F>
  void forEach(F f) const {
    for (const Place& place : {x,
                               y,
                               z,
                               intensity,
                               colour[0],
                               colour[1],
                               colour[2],
                               row,
                               column,
                               product,
                               material,
                               time,
                               channel,
                               return_index,
                               return_count,
                               truth[0],
                               truth[1],
                               truth[2],
                               truth[3],
                               truth[4],
                               truth[5],
                               truth[6],
                               cartesian_state,
                               spherical_state,
                               intensity_invalid,
                               colour_invalid,
                               time_invalid})
      if (place) f(*place);
  }
};

Roles rolesOf(const std::vector<StoredField>& fields, const ScanPlan& plan);

}  // namespace standpoint::e57
