// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/model/treatments.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "project/materials/materials_verb.h"

namespace standpoint {

using nlohmann::json;

namespace {

TreatAnswer answerOf(const Environment& environment, const std::vector<Treatment>& treatments) {
  TreatAnswer answer;
  for (const auto& treatment : treatments)
    answer.treatments.push_back({treatment, select(environment, treatment.selector).size()});
  for (const auto& product : environment.products) answer.excluded_products += product.excluded ? 1 : 0;
  return answer;
}

// First what later words have replaced goes, then what takes back something that is no longer there. Rows that mean no
// product stay: an update may bring theirs back.
void tidy(const Environment& environment, std::vector<Treatment>& treatments) {
  std::vector<std::vector<std::uint32_t>> meant;
  std::vector<std::size_t> deciding(environment.products.size(), treatments.size());
  for (std::size_t i = 0; i < treatments.size(); ++i) {
    meant.push_back(select(environment, treatments[i].selector));
    for (const auto product : meant[i]) deciding[product] = i;
  }
  std::vector<Treatment> kept;
  std::vector<bool> treated(environment.products.size(), false);
  for (std::size_t i = 0; i < treatments.size(); ++i) {
    const auto any = [&](auto holds) { return std::any_of(meant[i].begin(), meant[i].end(), holds); };
    if (!meant[i].empty()) {
      if (!any([&](std::uint32_t p) { return deciding[p] == i; })) continue;
      if (treatments[i].kind == TreatmentKind::as_rules && !any([&](std::uint32_t p) { return treated[p]; })) continue;
    }
    for (const auto product : meant[i]) treated[product] = true;
    kept.push_back(std::move(treatments[i]));
  }
  treatments = std::move(kept);
}

// What was made from the scene as it was before: the lighter one only changes its marks, the rest is made anew or goes.
Result<void> follow(Document& document, Report& report, Progress& progress) {
  if (document.simplified) {
    auto simplified = *document.simplified;
    simplified.environment = withExclusions(simplified.environment, *document.treatments);
    document.simplified = std::make_shared<const SimplifiedModel>(std::move(simplified));
  }
  if (document.collision) {
    document.collision = nullptr;
    report.note("collide", "collision shapes are out of date; compute them again");
  }
  if (!document.materials) return {};
  TRY_ASSIGN(auto assigned, assignDocumentMaterials(document, {}, progress));
  document.materials = assigned.document.materials;
  return {};
}

std::string nameOf(const Product* product) { return product->name.empty() ? product->id : product->name; }

}  // namespace

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

const char* wordOf(TreatmentKind kind) { return kKinds.at(static_cast<std::size_t>(kind)); }

json treatmentsToJson(const std::vector<Treatment>& treatments) {
  return AnswerValue<std::vector<Treatment>>::write(treatments);
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

std::span<const Choice<TreatmentKind>> choices(TreatmentKind) {
  static constexpr std::array kTreatments = {Choice<TreatmentKind>{"excluded", TreatmentKind::excluded},
                                             Choice<TreatmentKind>{"kept", TreatmentKind::kept},
                                             Choice<TreatmentKind>{"simplified", TreatmentKind::simplified},
                                             Choice<TreatmentKind>{"rules", TreatmentKind::as_rules}};
  return kTreatments;
}

const Fields<TreatOptions>& treatFields() {
  using O = TreatOptions;
  static const Fields<O> fields = {
      {"products", &O::products, "#id, a GlobalId, class:IfcFurniture, name:*chair*, storey:…", {.positional = true}},
      {"as", &O::as, "`excluded`: not in the scene; `kept`: never simplified; `rules`: back to the rules"},
      {"max-deviation",
       &O::max_deviation_m,
       "with simplified: maximum deviation of the surface",
       {.unit = "m", .minimum = 0, .maximum = 1000}},
      {"weight", &O::weight, "with simplified: factor on the product's error", {.minimum = 0.001, .maximum = 1000}}};
  return fields;
}

const AnswerFields<Treatment>& answerFields(const Treatment*) {
  using A = Treatment;
  static const AnswerFields<A> fields = {{"products", &A::selector},
                                         {"as", &A::kind, [](TreatmentKind kind) { return std::string(wordOf(kind)); }},
                                         {"max_deviation_m", &A::max_deviation_m, kLeftOut},
                                         {"weight", &A::weight, kLeftOut}};
  return fields;
}

const AnswerFields<TreatmentRow>& answerFields(const TreatmentRow* row) {
  static const auto fields =
      withBases<TreatmentRow>({{"count", &TreatmentRow::count}}, answerFields(static_cast<const Treatment*>(row)));
  return fields;
}

const AnswerFields<TreatAnswer>& answerFields(const TreatAnswer*) {
  using A = TreatAnswer;
  static const AnswerFields<A> fields = {{"treatments", &A::treatments}, {"excluded_products", &A::excluded_products}};
  return fields;
}

Result<Answered<TreatAnswer>> runTreat(const Document& document, const TreatOptions& options, Progress& progress) {
  const auto& selectors = options.products;
  const auto now = document.treatments ? *document.treatments : std::vector<Treatment>{};
  if (selectors.empty()) {
    if (options.as)
      return failure(ErrorKind::usage, "specify products: #id, a GlobalId, class:IfcFurniture, name:*chair*, storey:…",
                     "products");
    return Answered<TreatAnswer>{document, answerOf(*document.imported, now)};
  }
  if (!options.as) return failure(ErrorKind::usage, "specify a treatment: excluded, kept, simplified or rules", "--as");
  const auto kind = *options.as;
  Treatment treatment{{}, kind, options.max_deviation_m, options.weight};
  if (kind != TreatmentKind::simplified && (treatment.max_deviation_m || treatment.weight))
    return failure(ErrorKind::usage, "limits require --as simplified",
                   treatment.weight ? "--weight" : "--max-deviation");
  auto treatments = now;
  std::size_t count = 0;
  const Product* last = nullptr;
  for (const auto& selector : selectors) {
    const auto meant = select(*document.imported, selector);
    if (meant.empty())
      return failure(ErrorKind::usage,
                     "no products match; use #id, a GlobalId, class:IfcFurniture, name:*chair* or storey:…", selector);
    count += meant.size();
    last = &document.imported->products[meant.back()];
    treatment.selector = selector;
    treatments.push_back(treatment);
  }
  Answered<TreatAnswer> outcome{document};
  auto& after = outcome.document;
  tidy(*document.imported, treatments);
  after.treatments = std::make_shared<const std::vector<Treatment>>(std::move(treatments));
  after.imported = withExclusions(document.imported, *after.treatments);
  if (after.imported != document.imported) TRY(follow(after, outcome.report, progress));
  if (document.simplified && kind != TreatmentKind::excluded)
    outcome.report.note("optimize", "the simplified model is out of date; compute it again");
  outcome.answer = answerOf(*after.imported, *after.treatments);
  const char* done = kind == TreatmentKind::excluded     ? "Excluded"
                     : kind == TreatmentKind::kept       ? "Keep unchanged:"
                     : kind == TreatmentKind::simplified ? "Simplify within custom limits:"
                                                         : "Reset to rules:";
  outcome.description = fmt::format("{} {}", done, count == 1 ? nameOf(last) : fmt::format("{} products", count));
  return outcome;
}

}  // namespace standpoint
