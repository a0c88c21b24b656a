// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/materials/materials_verb.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/data_folder.h"
#include "core/readable_name.h"
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

std::vector<std::string> productIds(const Environment& environment, const std::vector<std::uint32_t>& products) {
  std::vector<std::string> ids;
  for (const auto p : products) ids.push_back(environment.products[p].id);
  return ids;
}

FindingRow findingRow(const Environment& environment, const MaterialFinding& f) {
  FindingRow row{f.id, f.kind,   f.severity, f.source, f.message, f.why, f.area_m2, productIds(environment, f.products),
                 {},   f.because};
  for (const auto& r : f.remedies) {
    row.remedies.push_back({r.text, r.selector, {}});
    if (!r.material.empty()) row.remedies.back().options = {assignWords(r, r.material)};
  }
  return row;
}

CoverageFractions fractionsOf(const CoverageRow& row) {
  if (row.area_m2 <= 0) return {row.area_m2};
  return {row.area_m2, row.assigned_m2 / row.area_m2, row.weak_m2 / row.area_m2};
}

std::vector<ReasonRow> surfaceReasons(const Environment& environment, const MaterialAssignment& assignment) {
  std::map<std::pair<std::string, std::string>, ReasonRow> groups;  // by material and reason
  const auto add = [&](const auto& of, double confidence) {
    const auto id = of.material < 0 ? std::string() : assignment.materials[static_cast<std::size_t>(of.material)].id;
    auto& row = groups[{id, of.reason}];
    row.confidence = confidence;
    row.surfaces.push_back({environment.products[of.product].id, environment.surfaces[of.surface].name});
  };
  for (const auto& s : assignment.surfaces) add(s, s.confidence);
  for (const auto& f : assignment.faces) add(f, 1);
  std::vector<ReasonRow> rows;
  for (auto& [key, row] : groups) {
    std::tie(row.material, row.reason) = key;
    rows.push_back(std::move(row));
  }
  return rows;
}

MaterialsAnswer materialsAnswer(const Environment& environment, const MaterialChoice& choice,
                                const std::vector<MaterialFinding>& all) {
  const auto& report = choice.result.report;
  MaterialsAnswer answer;
  answer.coverage = report.coverage;
  answer.area_m2 = report.area_m2;
  for (const auto& use : report.uses)
    answer.materials.push_back({use.material, use.area_m2, productIds(environment, use.products)});
  for (const auto& f : all) {
    answer.findings.push_back(findingRow(environment, f));
    answer.open += f.because.empty() ? 1 : 0;
  }
  for (const auto& row : report.by_class) answer.by_class.push_back({fractionsOf(row), row.name});
  for (const auto& row : report.by_storey) answer.by_storey.push_back({fractionsOf(row), row.name});
  answer.reasons = surfaceReasons(environment, choice.result.assignment);
  return answer;
}

MaterialPlaces placesOf(const Environment& environment, const MaterialResult& result, const std::string& id) {
  MaterialPlaces places{id, 0, {}};
  for (const auto& use : result.report.uses) {
    if (use.material != id) continue;
    places.area_m2 = use.area_m2;
    for (const auto p : use.products) places.products.push_back(identityOf(environment.products[p]));
  }
  return places;
}

// Own materials of a file join those that the project has; one with a known id replaces it.
Result<LibraryRow> takeLibrary(MaterialChoice& choice, const fs::path& file,
                               const std::vector<PhysicalMaterial>& shipped) {
  TRY_ASSIGN(auto own, readOwnMaterials(file, libraryFolder()));
  LibraryRow row{file.filename().string(), {}, {}, {}};
  const auto known = withOwn(shipped, choice.own);
  for (const auto& m : own) {
    const auto before =
        std::find_if(known.begin(), known.end(), [&](const PhysicalMaterial& k) { return k.id == m.id; });
    if (before == known.end())
      row.added.push_back(m.id);
    else if (!(*before == m))
      row.changed.push_back(m.id);
  }
  choice.own = withOwn(choice.own, own);
  return row;
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
  if (!instrument.empty()) {
    TRY_ASSIGN(const auto named, instrumentNamed(instrument));
    return std::vector<double>{named.wavelength_nm};
  }
  std::vector<std::string> ids;
  for (const auto& station : document.job->stations)
    for (const auto& scan : station.scans) ids.push_back(scan.instrument);
  if (ids.empty()) return std::vector<double>();
  TRY_ASSIGN(const auto instruments, knownInstruments());
  std::vector<double> result;
  for (const auto& each : instruments)
    if (std::find(ids.begin(), ids.end(), each.id) != ids.end()) result.push_back(each.wavelength_nm);
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

// "Wall 7", "class IfcWall, name *glass*": a product by its name, conditions with neither signs nor coordinates.
std::string inWords(const Environment& environment, const std::string& selector) {
  if (!selectedProduct(selector).empty())
    if (const auto products = select(environment, selector); !products.empty())
      return readableName(environment.products[products.front()]);
  std::string words = selector.substr(0, selector.find('@'));
  for (const auto& [sign, word] : {std::pair{"&", ", "}, {":", " "}})
    for (auto at = words.find(sign); at != std::string::npos; at = words.find(sign, at + 1)) words.replace(at, 1, word);
  return words;
}

std::string findingsText(std::size_t count) { return count == 1 ? "a finding" : fmt::format("{} findings", count); }

// A library is named by what it brought: its file may be one that the editor made for a moment.
std::string description(const Environment& environment, const std::vector<PhysicalMaterial>& library,
                        const MaterialRequest& request, const std::vector<LibraryRow>& taken,
                        const MaterialReport& report) {
  const auto material = [&](const std::string& id) {
    const auto at = std::find_if(library.begin(), library.end(), [&](const auto& m) { return m.id == id; });
    return at == library.end() || at->label.empty() ? id : "'" + at->label + "'";
  };
  if (!request.accept.empty()) return "Accepted " + findingsText(request.accept.size());
  if (!request.reopen.empty()) return "Reopened " + findingsText(request.reopen.size());
  if (!request.assign.empty())
    return fmt::format("Assigned {} to {}", material(request.assign.back().material),
                       inWords(environment, request.assign.back().selector));
  if (!taken.empty()) {
    const auto& [file, added, changed, used] = taken.back();
    if (added.size() == 1 && changed.empty()) return "Added material " + material(added.front());
    if (added.empty() && changed.size() == 1) return "Changed material " + material(changed.front());
    return "Added materials from " + request.libraries.back().filename().string();
  }
  return fmt::format("Assigned materials to {:.1f} % of the area", report.coverage * 100);
}

}  // namespace

Result<std::vector<PhysicalMaterial>> shippedMaterials() { return readMaterialLibrary(libraryFolder()); }

Result<void> checkRules(const fs::path& file, const std::vector<PhysicalMaterial>& library) {
  TRY_ASSIGN(const auto rules, readAssignmentRules(file, library, defaultRules()));
  for (const auto& rule : rules.rules)
    if (std::none_of(library.begin(), library.end(), [&](const auto& m) { return m.id == rule.assign; }))
      return failure(ErrorKind::usage, fmt::format("'{}' is not in the library", rule.assign), rule.place);
  return {};
}

Result<Answered<MaterialsAnswer>> assignDocumentMaterials(const Document& document, const MaterialRequest& request,
                                                          Progress& progress) {
  progress.stage("Materials");
  TRY_ASSIGN(const auto shipped, shippedMaterials());
  MaterialChoice choice = document.materials ? *document.materials : MaterialChoice();
  if (!request.rules.empty()) {
    choice.rules_file = request.rules == "default" ? "" : request.rules.string();
    choice.rules_text.clear();
  }
  if (!request.instrument.empty())  // kept: a file is found from any folder
    choice.instrument =
        isInstrumentFile(request.instrument) ? fs::absolute(request.instrument).string() : request.instrument;
  std::vector<LibraryRow> taken;
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
  Answered<MaterialsAnswer> outcome{
      std::move(done), {}, {}, description(environment, library, request, taken, choice.result.report)};
  auto& answer = outcome.answer;
  answer = materialsAnswer(environment, choice, materialFindings(outcome.document));
  for (auto& row : taken)
    for (const auto& id : row.changed) row.used.push_back(placesOf(environment, choice.result, id));
  answer.libraries = std::move(taken);
  MaterialReport shown = choice.result.report;
  shown.findings = materialFindings(outcome.document);
  outcome.text = materialsText(environment, shown) + libraryText(answer.libraries);
  return outcome;
}

std::vector<MaterialOverride> overridesFrom(const std::vector<std::string>& texts) {
  std::vector<MaterialOverride> overrides;
  for (const auto& text : texts) {
    const auto equals = std::min(text.rfind('='), text.size());
    overrides.push_back({text.substr(0, equals), text.substr(std::min(equals + 1, text.size()))});
  }
  return overrides;
}

Result<std::vector<MaterialOverride>> FieldValue<std::vector<MaterialOverride>>::read(const json& texts) {
  return overridesFrom(texts.get<std::vector<std::string>>());
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
       "id or file of the instrument whose wavelength needs figures (default: those used for scanning)"},
      {"report", &O::report, "printable report to write (.html, .csv)"}};
  return fields;
}

const AnswerFields<RemedyOptions>& answerFields(const RemedyOptions*) {
  static const AnswerFields<RemedyOptions> fields = {{"assign", &RemedyOptions::assign}};
  return fields;
}

const AnswerFields<RemedyRow>& answerFields(const RemedyRow*) {
  using A = RemedyRow;
  static const AnswerFields<A> fields = {
      {"text", &A::text}, {"selector", &A::selector}, {"options", &A::options, kLeftOut}};
  return fields;
}

const AnswerFields<FindingRow>& answerFields(const FindingRow*) {
  using A = FindingRow;
  static const AnswerFields<A> fields = {{"id", &A::id},
                                         {"kind", &A::kind},
                                         {"severity", &A::severity},
                                         {"source", &A::source},
                                         {"message", &A::message},
                                         {"why", &A::why},
                                         {"area_m2", &A::area_m2},
                                         {"products", &A::products},
                                         {"remedies", &A::remedies},
                                         {"accepted", &A::because, answers::nullWhereEmpty, kLeftOut}};
  return fields;
}

const AnswerFields<CoverageFractions>& answerFields(const CoverageFractions*) {
  using A = CoverageFractions;
  static const AnswerFields<A> fields = {{"area_m2", &A::area_m2}, {"coverage", &A::coverage}, {"weak", &A::weak}};
  return fields;
}

const AnswerFields<ClassCoverage>& answerFields(const ClassCoverage* row) {
  static const auto fields = withBases<ClassCoverage>({{"class", &ClassCoverage::ifc_class}},
                                                      answerFields(static_cast<const CoverageFractions*>(row)));
  return fields;
}

const AnswerFields<StoreyCoverage>& answerFields(const StoreyCoverage* row) {
  static const auto fields = withBases<StoreyCoverage>({{"storey", &StoreyCoverage::storey}},
                                                       answerFields(static_cast<const CoverageFractions*>(row)));
  return fields;
}

const AnswerFields<MaterialUseRow>& answerFields(const MaterialUseRow*) {
  using A = MaterialUseRow;
  static const AnswerFields<A> fields = {
      {"material", &A::material, answers::nullWhereEmpty}, {"area_m2", &A::area_m2}, {"products", &A::products}};
  return fields;
}

const AnswerFields<ReasonRow>& answerFields(const ReasonRow*) {
  using A = ReasonRow;
  static const AnswerFields<A> fields = {{"material", &A::material, answers::nullWhereEmpty},
                                         {"reason", &A::reason},
                                         {"confidence", &A::confidence},
                                         {"surfaces", &A::surfaces}};
  return fields;
}

const AnswerFields<MaterialPlaces>& answerFields(const MaterialPlaces*) {
  using A = MaterialPlaces;
  static const AnswerFields<A> fields = {
      {"material", &A::material}, {"area_m2", &A::area_m2}, {"products", &A::products}};
  return fields;
}

const AnswerFields<LibraryRow>& answerFields(const LibraryRow*) {
  using A = LibraryRow;
  static const AnswerFields<A> fields = {
      {"file", &A::file}, {"added", &A::added}, {"changed", &A::changed}, {"used", &A::used}};
  return fields;
}

const AnswerFields<MaterialsAnswer>& answerFields(const MaterialsAnswer*) {
  using A = MaterialsAnswer;
  static const AnswerFields<A> fields = {
      {"coverage", &A::coverage},    {"area_m2", &A::area_m2}, {"materials", &A::materials},
      {"findings", &A::findings},    {"open", &A::open},       {"by_class", &A::by_class},
      {"by_storey", &A::by_storey},  {"reasons", &A::reasons}, {"libraries", &A::libraries, kLeftOut},
      {"where", &A::where, kLeftOut}};
  return fields;
}

Result<Answered<MaterialsAnswer>> runMaterials(const Document& document, const MaterialsOptions& options,
                                               Progress& progress) {
  auto outcome = assignDocumentMaterials(document, options, progress);
  if (!outcome) return outcome;
  const auto& choice = *outcome->document.materials;
  if (const auto& id = options.where; !id.empty()) {
    TRY_ASSIGN(const auto shipped, shippedMaterials());
    const auto library = withOwn(shipped, choice.own);
    if (std::none_of(library.begin(), library.end(), [&](const PhysicalMaterial& m) { return m.id == id; }))
      return failure(ErrorKind::usage, "not in the material library", id);
    outcome->answer.where = placesOf(*document.environment(), choice.result, id);
    outcome->text = whereText(*outcome->answer.where);
  }
  if (!options.report.empty()) TRY(writeMaterialReport(outcome->document, options.report));
  return outcome;
}

}  // namespace standpoint
