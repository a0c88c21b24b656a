// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/model/optimize_verb.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/data_folder.h"
#include "core/units.h"
#include "optimizer/simplify/visibility.h"
#include "project/answers.h"
#include "project/model/treatments.h"

namespace standpoint {

namespace {

std::string alikeName(const OptimizeOptions& options) {
  return options.budget == 0 ? "lossless" : fmt::format("budget {}", options.budget);
}

std::string levelsOf(const OptimizeOptions& options) {
  if (options.products.empty()) return alikeName(options);
  std::set<std::string> names;
  for (const auto& allowance : options.products) names.insert(allowance.lod);
  return fmt::format("{}", fmt::join(names, " and "));
}

// What the rules said, with the numbers they hold and how many products each decided.
void reportRules(const SimplificationPlan& plan, Report& report) {
  const auto& products = plan.options.products;
  for (std::uint32_t budget_group = 0; budget_group < plan.levels.size(); ++budget_group) {
    const LodLevel& level = plan.levels[budget_group];
    const auto count = [&](const std::string& reason) {
      return std::count_if(products.begin(), products.end(),
                           [&](const auto& a) { return a.budget_group == budget_group && a.reason == reason; });
    };
    const auto members =
        std::count_if(products.begin(), products.end(), [&](const auto& a) { return a.budget_group == budget_group; });
    if (members == 0) continue;
    const auto budget = budget_group == 0 ? plan.options.budget : plan.options.further_budgets[budget_group - 1];
    report.note(level.level, fmt::format("{}: {} products, {} triangles, max deviation {} m unless a rule overrides it",
                                         level.part, members, budget, level.max_deviation_m));
    for (const auto& rule : level.rules)
      if (const auto decided = count(rule.reason); decided > 0)
        report.note(level.level, rule.drop ? fmt::format("{}: {} products dropped", rule.reason, decided)
                                 : rule.keep
                                     ? fmt::format("{}: {} products kept unchanged", rule.reason, decided)
                                     : fmt::format("{}: {} products within {} m, weight {}", rule.reason, decided,
                                                   rule.max_deviation_m.value_or(level.max_deviation_m), rule.weight));
  }
}

void reportTreatments(const Document& document, Report& report) {
  if (!document.treatments) return;
  for (const auto& row : treatmentsToJson(*document.treatments))
    report.note("treat", fmt::format("{}: {}", row.at("products").get<std::string>(), row.at("as").get<std::string>()));
}

}  // namespace

Result<SimplificationPlan> planLightening(const Document& document, const SimplificationRequest& request,
                                          const Progress& progress) {
  SimplificationPlan plan;
  if (request.by_view && !document.collision)
    return failure(ErrorKind::usage, "visibility is computed from the walkable surface: compute that first",
                   "--by-view");
  if (request.lod_rules.empty()) {
    plan.options.budget = request.budget.value_or(0);
    plan.options.max_deviation_m = request.max_deviation_m;
  } else {
    const std::filesystem::path file = request.lod_rules == "default"
                                           ? dataFolder() / "optimizer" / "lod" / "default.json"
                                           : std::filesystem::path(request.lod_rules);
    TRY_ASSIGN(auto levels, readLodRules(file));
    plan.levels = std::move(levels);
    plan.options = allowances(*document.imported, plan.levels, {request.budget, request.surroundings});
  }
  if (document.treatments)
    applyTreatments(*document.imported, *document.treatments, alikeName(plan.options), plan.options);
  if (request.by_view) weighByView(plan.options, sceneOf(*document.imported), document.collision->walkable, progress);
  return plan;
}

const Fields<SimplificationRequest>& optimizeFields() {
  using O = SimplificationRequest;
  static const Fields<O> fields = {
      {"budget", &O::budget, "placed triangles in all; 0 merges planar regions only", {.minimum = 0, .maximum = 1e12}},
      {"max-deviation",
       &O::max_deviation_m,
       "maximum deviation of a surface where --lod has no limit for it",
       {.unit = "m", .minimum = 0, .maximum = 1000}},
      {"by-view", &O::by_view, "weigh errors by what is visible from the walkable surface; needs `collide` first"},
      {"lod", &O::lod_rules, "file of level-of-detail rules, or `default` for LoD 300 with surroundings of LoD 200"},
      {"surroundings", &O::surroundings,
       "selectors of the surroundings of the main model: #id, class:…, name:…, storey:…"},
      {"engine",
       &O::engine,
       "simplification engine; `best`: for each shape the one that deviates least; `auto`: `own`, and `best` for large "
       "shapes of many parts",
       {.choices = engineIds()}}};
  return fields;
}

const AnswerFields<ProductLoss>& answerFields(const ProductLoss*) {
  using A = ProductLoss;
  static const AnswerFields<A> fields = {{"triangles_before", &A::triangles_before},
                                         {"triangles_after", &A::triangles_after},
                                         {"max_deviation_m", &A::max_deviation_m},
                                         {"mean_deviation_m", &A::mean_deviation_m},
                                         {"mean_turn_deg", &A::mean_turn_rad, answers::degrees}};
  return fields;
}

const AnswerFields<OptimizedProduct>& answerFields(const OptimizedProduct* product) {
  using A = OptimizedProduct;
  static const auto fields =
      withBases<A>({{"lod", &A::lod}, {"engine", &A::engine, kLeftOut}, {"rule", &A::rule, kLeftOut}},
                   answerFields(static_cast<const ProductIdentity*>(product)),
                   answerFields(static_cast<const ProductLoss*>(product)));
  return fields;
}

const AnswerFields<OptimizeAnswer>& answerFields(const OptimizeAnswer* answer) {
  using A = OptimizeAnswer;
  static const auto fields = withBases<A>({{"lod", &A::lod},
                                           {"budget_reached", &A::budget_reached},
                                           {"smallest_budget", &A::smallest_budget, kLeftOut},
                                           {"products", &A::products}},
                                          answerFields(static_cast<const ProductLoss*>(answer)));
  return fields;
}

Result<Answered<OptimizeAnswer>> runOptimize(const Document& document, const SimplificationRequest& request,
                                             Progress& progress) {
  if (!request.surroundings.empty() && request.lod_rules.empty())
    return failure(ErrorKind::usage, "requires --lod", "surroundings");
  progress.stage("Optimise");
  TRY_ASSIGN(auto plan, planLightening(document, request, progress));
  plan.options.engine = request.engine;
  const auto& options = plan.options;
  TRY_ASSIGN(auto result, optimize(*document.imported, options, progress));
  Answered<OptimizeAnswer> outcome{document};
  reportRules(plan, outcome.report);
  reportTreatments(document, outcome.report);
  outcome.report.append(result.report);
  const auto lod = [&](std::size_t product) {
    return options.products.empty() ? alikeName(options) : options.products[product].lod;
  };
  outcome.answer = {result.all, levelsOf(options), result.budget_reached, {}, {}};
  if (!result.budget_reached) outcome.answer.smallest_budget = result.smallest_budget;
  for (std::size_t i = 0; i < result.products.size(); ++i) {
    if (result.products[i].triangles_before == 0) continue;
    OptimizedProduct row{identityOf(document.imported->products[i]), result.products[i], lod(i), {}, {}};
    if (!result.engines[i].empty()) row.engine = result.engines[i];
    if (!options.products.empty()) row.rule = options.products[i].reason;
    outcome.answer.products.push_back(std::move(row));
  }
  outcome.description =
      fmt::format("Optimised {} to {} triangles, max deviation {:.1f} mm", result.all.triangles_before,
                  result.all.triangles_after, result.all.max_deviation_m * 1000);
  SimplifiedModel simplified{std::make_shared<const Environment>(std::move(result.environment)),
                             std::move(result.products),
                             result.all,
                             request,
                             {}};
  for (const auto& allowance : options.products) simplified.levels.push_back(allowance.lod);
  outcome.document.simplified = std::make_shared<const SimplifiedModel>(std::move(simplified));
  return outcome;
}

Result<Answered<OptimizeAnswer>> optimizeTowards(const Document& document, const SimplificationRequest& request,
                                                 Progress& progress) {
  TRY_ASSIGN(auto outcome, runOptimize(document, request, progress));
  auto& answer = outcome.answer;
  if (answer.budget_reached || !request.budget || !request.lod_rules.empty()) return outcome;
  const auto least = *answer.smallest_budget;
  auto& issues = outcome.report.issues;
  std::erase_if(issues,
                [](const Issue& issue) { return issue.severity == Severity::loss && issue.source == "budget"; });
  outcome.report.note("budget", fmt::format("the maximum deviation allows no fewer than {} triangles; asked for {}",
                                            least, *request.budget));
  auto kept = *outcome.document.simplified;
  kept.request.budget = least;
  outcome.document.simplified = std::make_shared<const SimplifiedModel>(std::move(kept));
  answer.budget_reached = true;
  answer.smallest_budget.reset();
  return outcome;
}

}  // namespace standpoint
