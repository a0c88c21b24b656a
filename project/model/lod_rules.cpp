// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/model/lod_rules.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/json_fields.h"
#include "core/json_file.h"
#include "materials/materials.h"
#include "optimizer/simplify/visibility.h"

namespace standpoint {

namespace {

std::vector<std::string> readSelectors(JsonFields& f) {
  auto selectors = f.texts("products");
  if (f.has("products") && (selectors.empty() || std::find(selectors.begin(), selectors.end(), "") != selectors.end()))
    f.wrong("products", "must be a list of selectors such as class:IfcWall*");
  return selectors;
}

LodRule readRule(JsonFields& f) {
  LodRule rule;
  rule.reason = f.text("reason");
  rule.products = readSelectors(f);
  rule.smaller_than_m = f.optionalNumber("smaller_than_m", 0, 1e6);
  rule.thinner_than_m = f.optionalNumber("thinner_than_m", 0, 1e6);
  rule.sees_sky_less_than = f.optionalNumber("sees_sky_less_than", 0, 1e6);
  rule.max_deviation_m = f.optionalNumber("max_deviation_m", 0, 1e6);
  rule.drop = f.flagOr("drop", rule.drop);
  rule.keep = f.flagOr("keep", rule.keep);
  if (rule.drop && rule.keep) f.wrong("", "cannot both drop and keep");
  rule.weight = f.numberOr("weight", rule.weight, 0.001, 1000);
  return rule;
}

LodLevel readLevel(JsonFields f, const char* part) {
  LodLevel level;
  level.part = f.text("part");
  level.level = f.text("level");
  if (level.part != part)
    f.wrong("part", std::string("must be ") + part + ": list the main part first, then the surroundings");
  level.budget = static_cast<std::uint64_t>(f.number("budget", 0, 1e12));
  level.max_deviation_m = f.number("max_deviation_m", 0, 1000);
  level.farther_than_m = f.optionalNumber("farther_than_m", 0, 1e6);
  level.hidden_faces = f.flagOr("hidden_faces", level.hidden_faces);
  if (level.hidden_faces && level.part != "main")
    f.wrong("hidden_faces", "is for the whole and belongs in the main part");
  level.products = readSelectors(f);
  if (level.part == "main" && (level.farther_than_m || !level.products.empty()))
    f.wrong("", "define it in the surroundings; the main part is everything else");
  f.required("rules");
  f.list("rules", [&](JsonFields& rule) { level.rules.push_back(readRule(rule)); });
  f.close();
  return level;
}

std::vector<bool> selected(const Environment& environment, const std::vector<std::string>& selectors, bool of_none) {
  std::vector<bool> result(environment.products.size(), selectors.empty() && of_none);
  for (const auto& selector : selectors)
    for (const auto product : select(environment, selector)) result[product] = true;
  return result;
}

double distance(const Bounds& a, const Bounds& b) {
  return (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(0.0).norm();
}

// Beyond the given distance from all that is not surroundings by its selector, measured from the largest product: the
// building grows from there, product by product, over gaps that are no wider.
void addDistant(const std::vector<Bounds>& boxes, double gap_m, std::vector<bool>& around) {
  std::size_t seed = boxes.size();
  for (std::size_t i = 0; i < boxes.size(); ++i)
    if (!around[i] && !boxes[i].empty() && (seed == boxes.size() || boxes[i].diagonal() > boxes[seed].diagonal()))
      seed = i;
  if (seed == boxes.size()) return;
  std::vector<bool> reached(boxes.size(), false);
  std::vector<std::size_t> open{seed};
  reached[seed] = true;
  while (!open.empty()) {
    const std::size_t from = open.back();
    open.pop_back();
    for (std::size_t i = 0; i < boxes.size(); ++i)
      if (!reached[i] && !around[i] && !boxes[i].empty() && distance(boxes[from], boxes[i]) <= gap_m)
        reached[i] = true, open.push_back(i);
  }
  for (std::size_t i = 0; i < boxes.size(); ++i)
    if (!reached[i] && !boxes[i].empty()) around[i] = true;
}

bool fitsSize(const LodRule& rule, const Bounds& box) {
  if (!rule.smaller_than_m && !rule.thinner_than_m) return true;
  if (box.empty()) return false;
  Eigen::Vector3d edges = box.max - box.min;
  std::sort(edges.data(), edges.data() + 3);
  return (!rule.smaller_than_m || box.diagonal() < *rule.smaller_than_m) &&
         (!rule.thinner_than_m || edges.y() < *rule.thinner_than_m);
}

// Only where a rule asks for it, as it takes some million rays.
std::vector<double> skyFractionsIfAsked(const Environment& environment, const std::vector<LodLevel>& levels) {
  for (const auto& level : levels)
    for (const auto& rule : level.rules)
      if (rule.sees_sky_less_than) return skyFractions(environment, Progress());
  return std::vector<double>(environment.products.size(), 1);
}

}  // namespace

Result<std::vector<LodLevel>> readLodRules(const std::filesystem::path& file) {
  TRY_ASSIGN(const auto entries, readJsonArray(file));
  JsonFault fault(file.filename().string());
  if (entries.size() != 2) fault.say("", "must contain two levels: main and surroundings");
  TRY(fault.result());
  std::vector<LodLevel> levels{readLevel(JsonFields(fault, entries[0], "/0"), "main"),
                               readLevel(JsonFields(fault, entries[1], "/1"), "surroundings")};
  TRY(fault.result());
  return levels;
}

OptimizeOptions allowances(const Environment& environment, const std::vector<LodLevel>& levels,
                           const LodChoice& choice) {
  const auto boxes = productBounds(environment);
  auto selectors = levels[1].products;
  selectors.insert(selectors.end(), choice.surroundings.begin(), choice.surroundings.end());
  std::vector<bool> around = selected(environment, selectors, false);
  if (levels[1].farther_than_m) addDistant(boxes, *levels[1].farther_than_m, around);

  OptimizeOptions options;
  options.budget = choice.budget.value_or(levels[0].budget);
  options.max_deviation_m = levels[0].max_deviation_m;
  options.hidden_faces = levels[0].hidden_faces;
  options.further_budgets = {levels[1].budget};
  options.products.resize(environment.products.size());
  const bool any_around = std::find(around.begin(), around.end(), true) != around.end();
  const auto sky =
      any_around ? skyFractionsIfAsked(environment, levels) : skyFractionsIfAsked(environment, {levels[0]});
  for (std::uint32_t budget_group = 0; budget_group < 2; ++budget_group) {
    const LodLevel& level = levels[budget_group];
    std::vector<bool> decided(environment.products.size(), false);
    for (std::size_t i = 0; i < decided.size(); ++i) {
      if (around[i] != (budget_group == 1)) continue;
      options.products[i].lod = level.level;
      options.products[i].budget_group = budget_group;
      options.products[i].max_deviation_m = level.max_deviation_m;
    }
    for (const auto& rule : level.rules) {
      const auto meant = selected(environment, rule.products, true);
      for (std::size_t i = 0; i < decided.size(); ++i) {
        if (decided[i] || around[i] != (budget_group == 1) || !meant[i] || !fitsSize(rule, boxes[i])) continue;
        if (rule.sees_sky_less_than && !(sky[i] < *rule.sees_sky_less_than)) continue;
        decided[i] = true;
        ProductAllowance& allowance = options.products[i];
        allowance.max_deviation_m = rule.max_deviation_m.value_or(level.max_deviation_m);
        allowance.weight = rule.weight;
        allowance.keep = rule.keep;
        allowance.drop = rule.drop;
        allowance.reason = rule.reason;
      }
    }
  }
  return options;
}

}  // namespace standpoint
