// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/model/lod_rules.h"

#include <algorithm>
#include <array>

#include "core/json_file.h"
#include "materials/materials.h"
#include "optimizer/simplify/visibility.h"

namespace standpoint {

namespace {

using nlohmann::json;

Result<std::vector<std::string>> readSelectors(const json& object, const JsonPlace& at) {
  std::vector<std::string> selectors;
  const auto found = object.find("products");
  if (found == object.end()) return selectors;
  const JsonPlace place = at / "products";
  if (!found->is_array() || found->empty()) return place.unusable("must be a list of selectors");
  for (std::size_t i = 0; i < found->size(); ++i) {
    if (!(*found)[i].is_string() || (*found)[i].get<std::string>().empty())
      return (place / i).unusable("must be a selector such as class:IfcWall*");
    selectors.push_back((*found)[i].get<std::string>());
  }
  return selectors;
}

Result<void> readOptional(const json& object, const JsonPlace& at, const char* key, std::optional<double>& value) {
  if (!object.contains(key)) return {};
  TRY_ASSIGN(auto number, readNumber(object.at(key), at / key, 0, 1e6));
  value = number;
  return {};
}

Result<void> readFlag(const json& object, const JsonPlace& at, const char* key, bool& value) {
  if (!object.contains(key)) return {};
  if (!object.at(key).is_boolean()) return (at / key).unusable("must be true or false");
  value = object.at(key).get<bool>();
  return {};
}

Result<LodRule> readRule(const json& entry, const JsonPlace& at) {
  TRY(checkKeys(entry, at,
                {"reason", "products", "smaller_than_m", "thinner_than_m", "sees_sky_less_than", "drop", "keep",
                 "max_deviation_m", "weight"}));
  LodRule rule;
  TRY_ASSIGN(auto reason, readText(entry, at, "reason"));
  rule.reason = std::move(reason);
  TRY_ASSIGN(auto selectors, readSelectors(entry, at));
  rule.products = std::move(selectors);
  for (const auto& [key, field] :
       {std::pair{"smaller_than_m", &LodRule::smaller_than_m}, std::pair{"thinner_than_m", &LodRule::thinner_than_m},
        std::pair{"sees_sky_less_than", &LodRule::sees_sky_less_than},
        std::pair{"max_deviation_m", &LodRule::max_deviation_m}})
    TRY(readOptional(entry, at, key, rule.*field));
  for (const auto& [key, field] : {std::pair{"drop", &LodRule::drop}, std::pair{"keep", &LodRule::keep}})
    TRY(readFlag(entry, at, key, rule.*field));
  if (rule.drop && rule.keep) return at.unusable("cannot both drop and keep");
  if (entry.contains("weight")) {
    TRY_ASSIGN(auto weight, readNumber(entry.at("weight"), at / "weight", 0.001, 1000));
    rule.weight = weight;
  }
  return rule;
}

Result<LodLevel> readLevel(const json& entry, const JsonPlace& at, const char* part) {
  TRY(checkKeys(entry, at,
                {"part", "level", "budget", "max_deviation_m", "hidden_faces", "farther_than_m", "products", "rules"}));
  LodLevel level;
  for (const auto& [key, field] : {std::pair{"part", &LodLevel::part}, std::pair{"level", &LodLevel::level}}) {
    TRY_ASSIGN(auto text, readText(entry, at, key));
    level.*field = std::move(text);
  }
  if (level.part != part)
    return (at / "part").unusable(std::string("must be ") + part + ": list the main part first, then the surroundings");
  for (const char* key : {"budget", "max_deviation_m", "rules"})
    if (!entry.contains(key)) return (at / key).unusable("is missing");
  TRY_ASSIGN(auto budget, readNumber(entry.at("budget"), at / "budget", 0, 1e12));
  level.budget = static_cast<std::uint64_t>(budget);
  TRY_ASSIGN(auto deviation, readNumber(entry.at("max_deviation_m"), at / "max_deviation_m", 0, 1000));
  level.max_deviation_m = deviation;
  TRY(readOptional(entry, at, "farther_than_m", level.farther_than_m));
  TRY(readFlag(entry, at, "hidden_faces", level.hidden_faces));
  if (level.hidden_faces && level.part != "main")
    return (at / "hidden_faces").unusable("is for the whole and belongs in the main part");
  TRY_ASSIGN(auto selectors, readSelectors(entry, at));
  level.products = std::move(selectors);
  if (level.part == "main" && (level.farther_than_m || !level.products.empty()))
    return at.unusable("define it in the surroundings; the main part is everything else");
  if (!entry.at("rules").is_array()) return (at / "rules").unusable("must be a list");
  for (std::size_t i = 0; i < entry.at("rules").size(); ++i) {
    TRY_ASSIGN(auto rule, readRule(entry.at("rules")[i], at / "rules" / i));
    level.rules.push_back(std::move(rule));
  }
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
  const JsonPlace top{file.filename().string(), {}};
  if (entries.size() != 2) return top.unusable("must contain two levels: main and surroundings");
  std::vector<LodLevel> levels;
  for (std::size_t i = 0; i < 2; ++i) {
    TRY_ASSIGN(auto level, readLevel(entries[i], top / i, std::array{"main", "surroundings"}[i]));
    levels.push_back(std::move(level));
  }
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
