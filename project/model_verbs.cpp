// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/model_verbs.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "project/answers.h"
#include "project/lod_rules.h"

namespace standpoint {

namespace {

using nlohmann::json;

json toJson(const ProductLoss& loss, const std::string& lod) {
  return {{"triangles_before", loss.triangles_before},
          {"triangles_after", loss.triangles_after},
          {"max_deviation_m", loss.max_deviation_m},
          {"mean_deviation_m", loss.mean_deviation_m},
          {"lod", lod}};
}

json identity(const Product& product) {
  return {{"id", product.id}, {"global_id", product.global_id}, {"class", product.ifc_class}, {"name", product.name}};
}

json materialAnswer(const Environment& environment, const MaterialChoice& choice) {
  const auto& report = choice.result.report;
  json uses = json::array();
  for (const auto& use : report.uses) {
    json ids = json::array();
    for (const auto p : use.products) ids.push_back(environment.products[p].id);
    uses.push_back({{"material", use.material.empty() ? json(nullptr) : json(use.material)},
                    {"area_m2", use.area_m2},
                    {"products", std::move(ids)}});
  }
  json findings = json::array();
  for (const auto& f : report.findings)
    findings.push_back({{"severity", f.severity}, {"source", f.source}, {"message", f.message}});
  return {{"coverage", report.coverage}, {"area_m2", report.area_m2}, {"materials", uses}, {"findings", findings}};
}

std::string levelsOf(const OptimizeOptions& options) {
  std::set<std::string> names;
  for (const auto& allowance : options.products) names.insert(allowance.lod);
  return fmt::format("{}", fmt::join(names, " and "));
}

// What the rules said, with the numbers they hold and how many products each decided.
void reportRules(const std::vector<LodLevel>& levels, const OptimizeOptions& options, Report& report) {
  for (std::uint32_t share = 0; share < levels.size(); ++share) {
    const LodLevel& level = levels[share];
    const auto count = [&](const std::string& reason) {
      return std::count_if(options.products.begin(), options.products.end(), [&](const auto& a) { return a.share == share && a.reason == reason; });
    };
    const auto members = std::count_if(options.products.begin(), options.products.end(), [&](const auto& a) { return a.share == share; });
    if (members == 0) continue;
    const auto budget = share == 0 ? options.budget : options.further_budgets[share - 1];
    report.note(level.level, fmt::format("{}: {} products, {} triangles, deviations of at most {} m where no rule says otherwise", level.part, members, budget, level.max_deviation_m));
    for (const auto& rule : level.rules)
      if (const auto products = count(rule.reason); products > 0)
        report.note(level.level, fmt::format("{}: {} products {}", rule.reason, products,
                                             rule.drop   ? "dropped"
                                             : rule.keep ? "kept as they are"
                                                         : fmt::format("within {} m, weight {}", rule.max_deviation_m.value_or(level.max_deviation_m), rule.weight)));
  }
}

Result<Outcome> runLevels(const Document& document, const json& options, Progress& progress) {
  const auto file = options.at("lod").get<std::string>();
  const auto levels = readLodRules(file == "default" ? dataFolder() / "optimizer" / "lod" / "default.json" : std::filesystem::path(file));
  if (!levels) return failure(levels.error());
  LodChoice choice;
  if (options.contains("budget")) choice.budget = options.at("budget").get<std::uint64_t>();
  if (options.contains("surroundings")) choice.surroundings = options.at("surroundings").get<std::vector<std::string>>();
  const auto allowed = allowances(*document.imported, *levels, choice);
  auto outcome = optimizeDocument(document, allowed, progress);
  if (!outcome) return outcome;
  Report report;
  reportRules(*levels, allowed, report);
  report.append(outcome->report);
  outcome->report = std::move(report);
  return outcome;
}

// Which doors stand closed is a setting of each door: what was set last, or now with --closed.
Result<void> setDoors(const Document& document, const json& options, CollideOptions& typed) {
  const auto doors = options.at("doors").get<std::string>();
  typed.doors = doors == "closed" ? DoorState::closed : doors == "as-set" ? DoorState::as_set : DoorState::open;
  if (typed.doors != DoorState::as_set) {
    if (options.contains("closed")) return failure(ErrorKind::usage, "names doors that are set one by one: give --doors as-set as well", "closed");
    return {};
  }
  typed.closed.assign(document.imported->products.size(), false);
  if (!options.contains("closed")) {
    if (document.collision)
      for (const auto& door : document.collision->doors) typed.closed[door.product] = door.closed;
    return {};
  }
  for (const auto& selector : options.at("closed").get<std::vector<std::string>>()) {
    bool any = false;
    for (const auto product : select(*document.imported, selector)) {
      typed.closed[product] = true;
      any = any || document.imported->products[product].ifc_class.starts_with("IfcDoor");
    }
    if (!any) return failure(ErrorKind::usage, fmt::format("{} names no door", selector), "closed");
  }
  return {};
}

}  // namespace

Result<Outcome> optimizeDocument(const Document& document, const OptimizeOptions& options, Progress& progress) {
  progress.stage("Optimise");
  auto result = optimize(*document.imported, options, progress);
  if (!result) return failure(result.error());
  Outcome outcome{document, json::object(), result->report, {}};
  const std::string all_alike = options.budget == 0 ? "lossless" : fmt::format("budget {}", options.budget);
  const auto lod = [&](std::size_t product) { return options.products.empty() ? all_alike : options.products[product].lod; };
  outcome.answer = toJson(result->all, options.products.empty() ? all_alike : levelsOf(options));
  outcome.answer["budget_reached"] = result->budget_reached;
  if (!result->budget_reached) outcome.answer["smallest_budget"] = result->smallest_budget;
  json rows = json::array();
  for (std::size_t i = 0; i < result->products.size(); ++i) {
    if (result->products[i].triangles_before == 0) continue;
    json row = identity(document.imported->products[i]);
    row.update(toJson(result->products[i], lod(i)));
    if (!options.products.empty()) row["rule"] = options.products[i].reason;
    rows.push_back(std::move(row));
  }
  outcome.answer["products"] = std::move(rows);
  outcome.description = fmt::format("Optimised {} to {} triangles, at most {:.1f} mm off", result->all.triangles_before,
                                    result->all.triangles_after, result->all.max_deviation_m * 1000);
  Lightening lightening{std::make_shared<const Environment>(std::move(result->environment)),
                        std::move(result->products), result->all, options, {}};
  for (const auto& allowance : options.products) lightening.levels.push_back(allowance.lod);
  outcome.document.lightening = std::make_shared<const Lightening>(std::move(lightening));
  return outcome;
}

Result<Outcome> runOptimize(const Document& document, const json& options, Progress& progress) {
  if (options.contains("lod")) return runLevels(document, options, progress);
  if (options.contains("surroundings"))
    return failure(ErrorKind::usage, "tells surroundings apart for level rules: give --lod as well", "surroundings");
  OptimizeOptions typed;
  typed.budget = options.value("budget", std::uint64_t{0});
  typed.max_deviation_m = options.at("max-deviation").get<double>();
  return optimizeDocument(document, typed, progress);
}

Result<Outcome> collideDocument(const Document& document, const CollideOptions& options, Progress& progress) {
  progress.stage("Collision shapes");
  // From the model as it came: walls that are still prisms give few convex pieces, and no doorway has been simplified.
  const auto& environment = *document.imported;
  const Eigen::Vector3d shift = document.georeference ? document.georeference->shift_m : Eigen::Vector3d::Zero();
  auto result = collide(environment, options, progress);
  if (!result) return failure(result.error());
  Outcome outcome{document, json::object(), result->report, {}};
  json rows = json::array();
  for (std::size_t i = 0; i < result->products.size(); ++i) {
    const auto& c = result->products[i];
    if (c.shapes == 0) continue;
    json row = identity(environment.products[i]);
    row["shapes"] = c.shapes;
    row["triangles"] = c.triangles;
    row["max_deviation_m"] = c.max_deviation_m;
    rows.push_back(std::move(row));
  }
  json doors = json::array();
  std::size_t passable = 0;
  for (const auto& d : result->doors) {
    json row = identity(environment.products[d.product]);
    row["floor"] = d.floor;
    row["passable"] = d.passable;
    row["closed"] = d.closed;
    row["clear_width_m"] = d.clear_width_m;
    row["at"] = toJson(d.position + shift);
    doors.push_back(std::move(row));
    passable += d.passable ? 1 : 0;
  }
  json rooms = json::array();
  for (const auto& r : result->rooms) {
    json row = identity(environment.products[r.product]);
    row["walkable_m2"] = r.walkable_m2;
    row["reached"] = r.reached;
    row["at"] = toJson(r.position + shift);
    rooms.push_back(std::move(row));
  }
  outcome.answer = {{"products", std::move(rows)},
                    {"shapes", result->shapes.size()},
                    {"walkable_area_m2", result->walkable_area_m2},
                    {"doors", std::move(doors)},
                    {"doors_passable", passable},
                    {"rooms", std::move(rooms)}};
  outcome.description = fmt::format("Made {} collision shapes; {:.1f} m² walkable, {} of {} doors passable",
                                    result->shapes.size(), result->walkable_area_m2, passable, result->doors.size());
  outcome.document.collision = std::make_shared<const CollideResult>(*std::move(result));
  return outcome;
}

Result<Outcome> runCollide(const Document& document, const json& options, Progress& progress) {
  CollideOptions typed;
  typed.agent_radius_m = options.at("agent-radius").get<double>();
  typed.agent_height_m = options.at("agent-height").get<double>();
  if (auto set = setDoors(document, options, typed); !set) return failure(set.error());
  return collideDocument(document, typed, progress);
}

Result<Outcome> assignDocumentMaterials(const Document& document, const std::string& rules_file,
                                        const std::vector<MaterialOverride>& overrides, Progress& progress) {
  progress.stage("Materials");
  auto library = readMaterialLibrary(dataFolder() / "materials" / "library");
  if (!library) return failure(library.error());
  MaterialChoice choice;
  if (document.materials) {
    choice.rules_file = document.materials->rules_file;
    choice.overrides = document.materials->overrides;
  }
  if (!rules_file.empty()) choice.rules_file = rules_file;
  choice.overrides.insert(choice.overrides.end(), overrides.begin(), overrides.end());
  const auto file = choice.rules_file.empty() ? dataFolder() / "materials" / "rules" / "default.json"
                                              : std::filesystem::path(choice.rules_file);
  auto rules = readAssignmentRules(file, *library);
  if (!rules) return failure(rules.error());
  auto result = assignMaterials(*document.environment(), *library, *rules, choice.overrides, progress);
  if (!result) return failure(result.error());
  choice.result = *std::move(result);
  Outcome outcome{document, materialAnswer(*document.environment(), choice), {}, {}};
  const double coverage = choice.result.report.coverage;
  outcome.description = overrides.empty()
                            ? fmt::format("Assigned materials to {:.1f} % of the area", coverage * 100)
                            : fmt::format("Assigned {} to {}", overrides.back().material, overrides.back().selector);
  outcome.document.materials = std::make_shared<const MaterialChoice>(std::move(choice));
  return outcome;
}

Result<Outcome> runMaterials(const Document& document, const json& options, Progress& progress) {
  std::vector<MaterialOverride> overrides;
  for (const auto& pair : options.value("assign", json::array())) {
    const auto text = pair.get<std::string>();
    const auto equals = text.rfind('=');
    overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return assignDocumentMaterials(document, options.value("rules", ""), overrides, progress);
}

}  // namespace standpoint
