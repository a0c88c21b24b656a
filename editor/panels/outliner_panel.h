// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

namespace standpoint {

struct OutlinerState {
  std::uint64_t made = 0;  // OutlinerView::made of the tree that this belongs to
  std::string filter;
  std::uint32_t anchor = 0;  // row where a Shift-selection starts
};

}  // namespace standpoint
