// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/treatments.h"

#include <algorithm>
#include <array>

namespace standpoint {

using nlohmann::json;

std::vector<const Treatment*> treatmentOf(const Environment& environment, const std::vector<Treatment>& treatments) {
  std::vector<const Treatment*> result(environment.products.size(), nullptr);
  for (const auto& treatment : treatments)
    for (const auto product : select(environment, treatment.selector)) result[product] = &treatment;
  return result;
}

std::shared_ptr<const Environment> withExclusions(const std::shared_ptr<const Environment>& environment,
                                                  const std::vector<Treatment>& treatments) {
  const auto decided = treatmentOf(*environment, treatments);
  const auto excluded = [&](std::size_t i) {
    return decided[i] != nullptr && decided[i]->kind == TreatmentKind::excluded;
  };
  std::shared_ptr<Environment> changed;
  for (std::size_t i = 0; i < decided.size(); ++i) {
    if (environment->products[i].excluded == excluded(i)) continue;
    if (!changed) changed = std::make_shared<Environment>(*environment);
    changed->products[i].excluded = excluded(i);
  }
  return changed ? changed : environment;
}

void applyTreatments(const Environment& environment, const std::vector<Treatment>& treatments, const std::string& alike,
                     OptimizeOptions& options) {
  const auto decided = treatmentOf(environment, treatments);
  const auto matters = [](const Treatment* t) {
    return t != nullptr && (t->kind == TreatmentKind::kept || t->kind == TreatmentKind::simplified);
  };
  if (options.products.empty()) {
    if (std::none_of(decided.begin(), decided.end(), matters)) return;
    ProductAllowance like_all;
    like_all.lod = alike;
    like_all.max_deviation_m = options.max_deviation_m;
    options.products.assign(environment.products.size(), like_all);
  }
  for (std::size_t i = 0; i < decided.size(); ++i) {
    if (!matters(decided[i])) continue;
    auto& allowance = options.products[i];
    allowance.drop = false;
    allowance.keep = decided[i]->kind == TreatmentKind::kept;
    allowance.max_deviation_m = decided[i]->max_deviation_m.value_or(allowance.max_deviation_m);
    allowance.weight = decided[i]->weight.value_or(allowance.weight);
    allowance.reason = "user treatment of " + decided[i]->selector;
  }
}

namespace {

constexpr std::array kKinds = {"rules", "excluded", "kept", "simplified"};

}  // namespace

TreatmentKind treatmentKind(const std::string& word) {
  const auto kind = std::find(kKinds.begin(), kKinds.end(), word);
  return kind == kKinds.end() ? TreatmentKind::as_rules : static_cast<TreatmentKind>(kind - kKinds.begin());
}

json treatmentsToJson(const std::vector<Treatment>& treatments) {
  json rows = json::array();
  for (const auto& t : treatments) {
    json row = {{"products", t.selector}, {"as", kKinds.at(static_cast<std::size_t>(t.kind))}};
    if (t.max_deviation_m) row["max_deviation_m"] = *t.max_deviation_m;
    if (t.weight) row["weight"] = *t.weight;
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Treatment> treatmentsFrom(const json& rows) {
  std::vector<Treatment> treatments;
  for (const auto& row : rows) {
    Treatment t;
    t.selector = row.at("products");
    t.kind = treatmentKind(row.at("as"));
    if (row.contains("max_deviation_m")) t.max_deviation_m = row.at("max_deviation_m").get<double>();
    if (row.contains("weight")) t.weight = row.at("weight").get<double>();
    treatments.push_back(std::move(t));
  }
  return treatments;
}

}  // namespace standpoint
