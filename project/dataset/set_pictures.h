// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "project/dataset/set_verify.h"
#include "project/document.h"

namespace standpoint {

// Pictures of a set as SVG, the same bytes on every machine.

// Plans of a document: a section at the height of the instruments for each storey that has stations, with their names.
std::string plansOf(const Document& document);

// Points of each class of one map, as bars of the shares of each split; what is starved is marked.
std::string balanceChart(const Recipe& recipe, const SetCheck& check, std::size_t map);

}  // namespace standpoint
