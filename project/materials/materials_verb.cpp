// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/materials/materials_verb.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "core/data_folder.h"
#include "project/answers.h"
#include "project/materials/material_findings.h"
#include "project/materials/materials_report.h"
#include "project/materials/materials_text.h"
#include "scanners/instruments/instrument.h"
#include "survey/instruments.h"

namespace standpoint {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

fs::path libraryFolder() { return dataFolder() / "materials" / "library"; }
fs::path defaultRules() { return dataFolder() / "materials" / "rules" / "default.json"; }

json productIds(const Environment& environment, const std::vector<std::uint32_t>& products) {
  json ids = json::array();
  for (const auto p : products) ids.push_back(environment.products[p].id);
  return ids;
}

json findingAnswer(const Environment& environment, const MaterialFinding& f) {
  json remedies = json::array();
  for (const auto& r : f.remedies) {
    json remedy = {{"text", r.text}, {"selector", r.selector}};
    if (!r.material.empty()) remedy["options"] = {{"assign", assignWords(r, r.material)}};  // of this verb: one click
    remedies.push_back(std::move(remedy));
  }
  json row = {{"id", f.id},
              {"kind", f.kind},
              {"severity", f.severity},
              {"source", f.source},
              {"message", f.message},
              {"why", f.why},
              {"area_m2", f.area_m2},
              {"products", productIds(environment, f.products)},
              {"remedies", remedies}};
  if (!f.because.empty()) row["accepted"] = f.because;
  return row;
}

json coverageRows(const std::vector<CoverageRow>& rows, const char* key) {
  json result = json::array();
  for (const auto& r : rows)
    result.push_back({{key, r.name},
                      {"area_m2", r.area_m2},
                      {"coverage", r.area_m2 > 0 ? r.assigned_m2 / r.area_m2 : 0},
                      {"weak", r.area_m2 > 0 ? r.weak_m2 / r.area_m2 : 0}});
  return result;
}

// Surfaces with the same reason stand together: a reason is a sentence, and a building has thousands of surfaces.
json surfaceReasons(const Environment& environment, const MaterialAssignment& assignment) {
  struct Group {
    double confidence = 0;
    json surfaces = json::array();
  };
  std::map<std::pair<std::string, std::string>, Group> groups;  // by material and reason
  const auto id = [&](std::int32_t material) {
    return material < 0 ? std::string() : assignment.materials[static_cast<std::size_t>(material)].id;
  };
  for (const auto& s : assignment.surfaces) {
    auto& group = groups[{id(s.material), s.reason}];
    group.confidence = s.confidence;
    group.surfaces.push_back({environment.products[s.product].id, environment.surfaces[s.surface].name});
  }
  for (const auto& f : assignment.faces) {
    auto& group = groups[{id(f.material), f.reason}];
    group.confidence = 1;
    group.surfaces.push_back({environment.products[f.product].id, environment.surfaces[f.surface].name});
  }
  json result = json::array();
  for (auto& [key, group] : groups)
    result.push_back({{"material", key.first.empty() ? json(nullptr) : json(key.first)},
                      {"reason", key.second},
                      {"confidence", group.confidence},
                      {"surfaces", std::move(group.surfaces)}});
  return result;
}

json materialAnswer(const Environment& environment, const MaterialChoice& choice,
                    const std::vector<MaterialFinding>& all) {
  const auto& report = choice.result.report;
  json uses = json::array();
  for (const auto& use : report.uses)
    uses.push_back({{"material", use.material.empty() ? json(nullptr) : json(use.material)},
                    {"area_m2", use.area_m2},
                    {"products", productIds(environment, use.products)}});
  json findings = json::array();
  std::size_t open = 0;
  for (const auto& f : all) {
    findings.push_back(findingAnswer(environment, f));
    open += f.because.empty() ? 1 : 0;
  }
  return {{"coverage", report.coverage},
          {"area_m2", report.area_m2},
          {"materials", uses},
          {"findings", findings},
          {"open", open},
          {"by_class", coverageRows(report.by_class, "class")},
          {"by_storey", coverageRows(report.by_storey, "storey")},
          {"reasons", surfaceReasons(environment, choice.result.assignment)}};
}

json whereAnswer(const Environment& environment, const MaterialResult& result, const std::string& id) {
  json answer = {{"material", id}, {"area_m2", 0.0}, {"products", json::array()}};
  for (const auto& use : result.report.uses) {
    if (use.material != id) continue;
    answer["area_m2"] = use.area_m2;
    for (const auto p : use.products) answer["products"].push_back(identity(environment.products[p]));
  }
  return answer;
}

// Own materials of a file join those that the project has; one with a known id replaces it.
Result<json> takeLibrary(MaterialChoice& choice, const fs::path& file, const std::vector<PhysicalMaterial>& shipped) {
  TRY_ASSIGN(auto own, readOwnMaterials(file, libraryFolder()));
  json added = json::array(), changed = json::array();
  const auto known = withOwn(shipped, choice.own);
  for (const auto& m : own) {
    const auto before =
        std::find_if(known.begin(), known.end(), [&](const PhysicalMaterial& k) { return k.id == m.id; });
    if (before == known.end())
      added.push_back(m.id);
    else if (!(*before == m))
      changed.push_back(m.id);
  }
  choice.own = withOwn(choice.own, own);
  return json{{"file", file.filename().string()}, {"added", added}, {"changed", changed}};
}

Result<void> forget(MaterialChoice& choice, const std::vector<std::string>& ids) {
  for (const auto& id : ids)
    if (std::erase_if(choice.own, [&](const PhysicalMaterial& m) { return m.id == id; }) == 0)
      return failure(ErrorKind::usage, "not a custom material", id);
  return {};
}

Result<void> takeOverrides(MaterialChoice& choice, const std::vector<MaterialOverride>& said) {
  for (const auto& o : said) {
    if (o.material != "rules") {
      choice.overrides.push_back(o);
    } else if (std::erase_if(choice.overrides,
                             [&](const MaterialOverride& old) { return old.selector == o.selector; }) == 0) {
      return failure(ErrorKind::usage, "this selector has no assignment to remove", o.selector);
    }
  }
  return {};
}

// An old project knows its rules by their file only.
Result<RuleSet> rulesOf(MaterialChoice& choice, const std::vector<PhysicalMaterial>& library) {
  if (choice.rules_file.empty()) return readAssignmentRules(defaultRules(), library);
  if (choice.rules_text.empty()) {
    TRY_ASSIGN(auto text, readRulesText(choice.rules_file));
    choice.rules_text = std::move(text);
  }
  return parseAssignmentRules(choice.rules_text, fs::path(choice.rules_file).filename().string(), library,
                              defaultRules());
}

Result<std::vector<double>> wavelengths(const Document& document, const std::string& instrument) {
  std::vector<std::string> ids;
  if (!instrument.empty())
    ids.push_back(instrument);
  else
    for (const auto& station : document.job->stations)
      for (const auto& scan : station.scans) ids.push_back(scan.instrument);
  if (ids.empty()) return std::vector<double>();
  TRY_ASSIGN(const auto instruments, knownInstruments());
  std::vector<double> result;
  for (const auto& each : instruments)
    if (std::find(ids.begin(), ids.end(), each.id) != ids.end()) result.push_back(each.wavelength_nm);
  if (!instrument.empty() && result.empty()) return failure(ErrorKind::usage, "unknown instrument", instrument);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

// Takes up or lets go of what the user accepted. Acceptances whose finding has another cause by now do not hold.
Result<bool> judge(MaterialChoice& choice, const std::vector<MaterialFinding>& findings,
                   const MaterialRequest& request) {
  if (request.accept.empty() && request.reopen.empty()) return false;
  if (!request.accept.empty() && request.because.find_first_not_of(" \t\n") == std::string::npos)
    return failure(ErrorKind::usage, "accepting a finding requires a reason", "because");
  for (const auto& id : request.reopen)
    if (std::erase_if(choice.accepted, [&](const AcceptedFinding& a) { return a.finding == id; }) == 0)
      return failure(ErrorKind::usage, "no accepted finding with this id", id);
  for (const auto& id : request.accept) {
    const auto found =
        std::find_if(findings.begin(), findings.end(), [&](const MaterialFinding& f) { return f.id == id; });
    if (found == findings.end())
      return failure(ErrorKind::usage, "unknown finding; `materials` lists all findings", id);
    std::erase_if(choice.accepted, [&](const AcceptedFinding& a) { return a.finding == id; });
    choice.accepted.push_back({id, found->cause, request.because});
  }
  return true;
}

std::string description(const MaterialRequest& request, const MaterialReport& report) {
  if (!request.accept.empty()) return fmt::format("Accepted {}", fmt::join(request.accept, ", "));
  if (!request.reopen.empty()) return fmt::format("Reopened {}", fmt::join(request.reopen, ", "));
  if (!request.assign.empty())
    return fmt::format("Assigned {} to {}", request.assign.back().material, request.assign.back().selector);
  if (!request.libraries.empty())
    return fmt::format("Added materials from {}", request.libraries.back().filename().string());
  return fmt::format("Assigned materials to {:.1f} % of the area", report.coverage * 100);
}

}  // namespace

Result<Outcome> assignDocumentMaterials(const Document& document, const MaterialRequest& request, Progress& progress) {
  progress.stage("Materials");
  TRY_ASSIGN(const auto shipped, readMaterialLibrary(libraryFolder()));
  MaterialChoice choice = document.materials ? *document.materials : MaterialChoice();
  if (!request.rules.empty()) {
    choice.rules_file = request.rules == "default" ? "" : request.rules.string();
    choice.rules_text.clear();
  }
  if (!request.instrument.empty()) choice.instrument = request.instrument;
  json taken = json::array();
  for (const auto& file : request.libraries) {
    TRY_ASSIGN(auto news, takeLibrary(choice, file, shipped));
    taken.push_back(std::move(news));
  }
  TRY(forget(choice, request.forget));
  TRY(takeOverrides(choice, request.assign));
  const auto library = withOwn(shipped, choice.own);
  TRY_ASSIGN(auto rules, rulesOf(choice, library));
  TRY_ASSIGN(auto waves, wavelengths(document, choice.instrument));
  AssignOptions options{choice.accepted, std::move(waves),
                        document.georeference ? document.georeference->shift_m : Eigen::Vector3d::Zero()};
  const auto& environment = *document.environment();
  TRY_ASSIGN(auto result, assignMaterials(environment, library, rules, choice.overrides, options, progress));
  choice.result = std::move(result);
  Document done = document;
  done.materials = std::make_shared<const MaterialChoice>(choice);
  TRY_ASSIGN(const auto judged, judge(choice, materialFindings(done), request));
  if (judged) {
    options.accepted = choice.accepted;
    choice.result = assignMaterials(environment, library, rules, choice.overrides, options, progress).value();
    done.materials = std::make_shared<const MaterialChoice>(choice);
  }
  Outcome outcome{std::move(done), {}, {}, description(request, choice.result.report)};
  outcome.answer = materialAnswer(environment, choice, materialFindings(outcome.document));
  for (auto& news : taken) {
    json used = json::array();
    for (const auto& id : news["changed"]) used.push_back(whereAnswer(environment, choice.result, id));
    news["used"] = std::move(used);
  }
  if (!taken.empty()) outcome.answer["libraries"] = std::move(taken);
  MaterialReport shown = choice.result.report;
  shown.findings = materialFindings(outcome.document);
  outcome.text = materialsText(environment, shown) + libraryText(outcome.answer);
  return outcome;
}

Result<std::vector<MaterialOverride>> FieldValue<std::vector<MaterialOverride>>::read(const json& texts) {
  std::vector<MaterialOverride> overrides;
  for (const auto& each : texts) {
    const auto& text = each.get_ref<const std::string&>();
    const auto equals = text.rfind('=');
    overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return overrides;
}

json FieldValue<std::vector<MaterialOverride>>::write(const std::vector<MaterialOverride>& overrides) {
  json texts;
  for (const auto& o : overrides) texts.push_back(o.selector + "=" + o.material);
  return texts;
}

const Fields<MaterialsOptions>& materialsFields() {
  using O = MaterialsOptions;
  static const Fields<O> fields = {
      {"rules", &O::rules, "file of own assignment rules, or `default`; kept in the project"},
      {"library", &O::libraries, "files of own materials; kept in the project"},
      {"forget", &O::forget, "ids of own materials to remove"},
      {"assign", &O::assign,
       "SELECTOR=MATERIAL, or SELECTOR=rules to go back to the rules; a selector is #id, a GlobalId, or conditions "
       "joined by &: class:IfcWall, type:…, name:*glass*, storey:…, group:…, layer:…, material:…, colour:red; append "
       "@0,0,1 for faces of that direction only, @0,0,1@X,Y,Z for the one of them at a point of the model's own frame"},
      {"where", &O::where, "id of a material whose uses to list"},
      {"accept", &O::accept, "ids of findings to accept, with --because"},
      {"because", &O::because, "reason for accepting; kept in the project until the cause changes"},
      {"reopen", &O::reopen, "ids of accepted findings to reopen"},
      {"instrument", &O::instrument,
       "id of the instrument whose wavelength needs figures (default: those used for scanning)"},
      {"report", &O::report, "printable report to write (.html, .csv)"}};
  return fields;
}

Result<Outcome> runMaterials(const Document& document, const MaterialsOptions& options, Progress& progress) {
  auto outcome = assignDocumentMaterials(document, options, progress);
  if (!outcome) return outcome;
  const auto& choice = *outcome->document.materials;
  if (const auto& id = options.where; !id.empty()) {
    TRY_ASSIGN(const auto shipped, readMaterialLibrary(libraryFolder()));
    const auto library = withOwn(shipped, choice.own);
    if (std::none_of(library.begin(), library.end(), [&](const PhysicalMaterial& m) { return m.id == id; }))
      return failure(ErrorKind::usage, "not in the material library", id);
    outcome->answer["where"] = whereAnswer(*document.environment(), choice.result, id);
    outcome->text = whereText(outcome->answer["where"]);
  }
  if (!options.report.empty()) TRY(writeMaterialReport(outcome->document, options.report));
  return outcome;
}

}  // namespace standpoint
