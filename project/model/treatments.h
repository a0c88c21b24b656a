// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the author says of single products, beside the rules: left out, kept as they are, or held to limits of their
// own.

#include <memory>
#include <vector>

#include "project/fields.h"

namespace standpoint {

// The treatment that decides for each product: the last that means it; nullptr = none.
std::vector<const Treatment*> treatmentOf(const Environment& environment, const std::vector<Treatment>& treatments);

// The environment with the products that are excluded marked so, and no others; the same pointer when it is so already.
std::shared_ptr<const Environment> withExclusions(const std::shared_ptr<const Environment>& environment,
                                                  const std::vector<Treatment>& treatments);

// Kept and limited products, in the allowances for the optimizer. Where the options treat all alike and no product is
// treated otherwise, they stay as they are; `alike` is what the level of all others is called.
void applyTreatments(const Environment& environment, const std::vector<Treatment>& treatments, const std::string& alike,
                     OptimizeOptions& options);

// "excluded", "kept", "simplified"; "rules" and whatever else takes back.
TreatmentKind treatmentKind(const std::string& word);
const char* wordOf(TreatmentKind kind);

nlohmann::json treatmentsToJson(const std::vector<Treatment>& treatments);
std::vector<Treatment> treatmentsFrom(const nlohmann::json& rows);  // throws nlohmann's exceptions

std::span<const Choice<TreatmentKind>> choices(TreatmentKind);
struct TreatOptions {
  std::vector<std::string> products;  // selectors; empty: list what was said
  std::optional<TreatmentKind> as;
  std::optional<double> max_deviation_m;  // with TreatmentKind::simplified, as the next
  std::optional<double> weight;
};
const Fields<TreatOptions>& treatFields();

const AnswerFields<Treatment>& answerFields(const Treatment*);
struct TreatmentRow : Treatment {
  std::size_t count = 0;  // of the products that it means
};
const AnswerFields<TreatmentRow>& answerFields(const TreatmentRow*);
struct TreatAnswer {
  std::vector<TreatmentRow> treatments;
  std::size_t excluded_products = 0;
};
const AnswerFields<TreatAnswer>& answerFields(const TreatAnswer*);
Result<Answered<TreatAnswer>> runTreat(const Document& document, const TreatOptions& options, Progress& progress);

}  // namespace standpoint
