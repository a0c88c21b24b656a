// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "project/survey/assess_verb.h"

namespace standpoint {

class Actions;
struct Model;

struct QualityState {
  QualityProfile profile = QualityProfile::loa30;
  std::optional<std::size_t> shown_row;  // of the answer: whose worst place was gone to last
};

// "" when there is something to assess, and it can begin.
std::string whyNotAssess(const Model& model);
void assess(QualityState& state, Actions& actions);
// Indices of the rows, what is bad first, then what is to be checked, is good, and is not known; alike in their order.
std::vector<std::size_t> worstFirst(const std::vector<AssessRow>& rows);
// The row to be looked at first: a bad one before one to check, in their order; none without a place to go to.
std::optional<std::size_t> worstRow(const std::vector<AssessRow>& rows);
// Goes to the worst place of a row, and lights it up in the table.
void goToRow(const Model& model, QualityState& state, Actions& actions, std::size_t row);

}  // namespace standpoint
