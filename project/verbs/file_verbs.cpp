// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/verbs/file_verbs.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/data_folder.h"
#include "core/json_fields.h"
#include "core/json_file.h"
#include "core/output_place.h"
#include "importers/importers.h"
#include "pointclouds/datasets/datasets.h"
#include "pointclouds/formats.h"
#include "project/answers.h"
#include "project/storage/project_files.h"
#include "project/storage/session.h"

namespace standpoint {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

json survey(const Job& job) {
  std::size_t scans = 0;
  std::uint64_t points = 0;
  for (const auto& station : job.stations)
    for (const auto& scan : station.scans) {
      ++scans;
      points += scan.points;
    }
  return {{"stations", job.stations.size()}, {"targets", job.targets.size()}, {"scans", scans}, {"points", points}};
}

// What a project holds and how far it is: the model, what was made of it, and the survey. Numbers in the file's own
// frame.
json projectInfo(const Document& document) {
  json answer = {{"format", "project"}, {"name", document.name}, {"sources", document.sources}};
  if (document.georeference) answer["georeference"] = georeferenceToJson(*document.georeference);
  if (document.imported) {
    const auto& products = document.imported->products;
    answer["products"] = products.size();
    answer["products_excluded"] =
        std::count_if(products.begin(), products.end(), [](const Product& p) { return p.excluded; });
    answer["triangles_imported"] = sceneTriangleCount(*document.imported);
    answer["triangles"] = sceneTriangleCount(*document.environment());
    const Eigen::Vector3d shift = document.georeference ? document.georeference->shift_m : Eigen::Vector3d::Zero();
    answer["bounds"] = toJson(bounds(*document.environment()), shift);
  }
  answer["max_deviation_m"] = document.simplified ? json(document.simplified->all.max_deviation_m) : json(nullptr);
  answer["collision_shapes"] = document.collision ? json(document.collision->shapes.size()) : json(nullptr);
  answer["walkable_m2"] = document.collision ? json(document.collision->walkable_area_m2) : json(nullptr);
  answer["material_coverage"] = document.materials ? json(document.materials->result.report.coverage) : json(nullptr);
  answer["survey"] = survey(document.job ? *document.job : Job{});
  answer["underlays"] = document.underlays.size();
  return answer;
}

json scanInfo(const ScanInfo& scan) {
  const auto& h = scan.header;
  return {{"name", h.name},
          {"guid", h.guid},
          {"points", scan.points},
          {"rows", h.rows},
          {"columns", h.columns},
          {"vendor", h.sensor_vendor},
          {"model", h.sensor_model},
          {"colour", h.has_colour},
          {"labels", h.has_labels},
          {"translation", toJson(h.file_from_scanner.translation)},
          {"rotation",
           {h.file_from_scanner.rotation.w(), h.file_from_scanner.rotation.x(), h.file_from_scanner.rotation.y(),
            h.file_from_scanner.rotation.z()}}};
}

Result<void> mustExist(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) return failure(ErrorKind::file_system, "file not found", file.string());
  return {};
}

// IN into a labelled set, a folder.
Result<Outcome> convertTo(const ConvertOptions& options, Outcome outcome, Progress& progress) {
  const fs::path &in = options.in, &out = options.out;
  if (!options.as.empty()) return failure(ErrorKind::usage, "use --as for a file, --dataset for a folder", "convert");
  const auto& name = options.dataset;
  const auto set = std::find_if(datasets().begin(), datasets().end(), [&](const Dataset& d) { return name == d.name; });
  if (set == datasets().end()) return failure(ErrorKind::usage, "unknown dataset '" + name + "'", "--dataset");
  TRY_ASSIGN(auto map,
             readClassMap(options.classes.empty() ? dataFolder() / "pointclouds" / "classes" / (name + ".json")
                                                  : options.classes));
  TRY_ASSIGN(auto report, convertToDataset(in, out, *set, std::move(map), progress));
  outcome.report = std::move(report);
  outcome.answer["files"] = {out.string()};
  outcome.description = "Converted " + in.filename().string() + " to " + set->description;
  return outcome;
}

}  // namespace

const Fields<ConvertOptions>& convertFields() {
  using O = ConvertOptions;
  std::vector<const char*> sets;
  for (const auto& set : datasets()) sets.push_back(set.name);
  static const Fields<O> fields = {
      {"in", &O::in, "cloud to read", {.positional = true, .required = true}},
      {"out", &O::out, "cloud to write", {.positional = true, .required = true}},
      {"as",
       &O::as,
       "an E57 of integers of 0.1 mm, or of range and angles; a PCD as a list of points instead of a grid; a LAS of "
       "point format 8",
       {.choices = {"scaled", "spherical", "points", "pdrf8"}}},
      {"dataset",
       &O::dataset,
       "write a labelled training set to the new folder OUT; the scans must have labels",
       {.choices = sets}},
      {"classes", &O::classes,
       "for --dataset: JSON file that maps IFC classes to those of the set (default: pointclouds/classes)"}};
  return fields;
}

Result<Outcome> runConvert(const Document& document, const ConvertOptions& options, Progress& progress) {
  const fs::path& in = options.in;
  TRY(mustExist(in));
  progress.stage("Convert " + in.filename().string());
  Outcome outcome{document, json::object(), {}, {}};
  if (!options.dataset.empty()) return convertTo(options, std::move(outcome), progress);
  TRY(checkFolderOf(options.out, "OUT"));
  TRY_ASSIGN(auto files, convertCloud(in, options.out, options.as, outcome.report, progress));
  json names = json::array();
  for (const auto& f : files) names.push_back(f.string());
  outcome.answer["files"] = std::move(names);
  outcome.description = "Converted " + in.filename().string();
  return outcome;
}

const Fields<InfoOptions>& infoFields() {
  static const Fields<InfoOptions> fields = {
      {"file", &InfoOptions::file, "the file, or the folder of a project", {.positional = true, .required = true}}};
  return fields;
}

Result<Outcome> runInfo(const Document& document, const InfoOptions& options, Progress& progress) {
  const fs::path& file = options.file;
  TRY(mustExist(file));
  progress.stage("Read " + file.filename().string());
  Outcome outcome{document, json::object(), {}, {}};
  if (fs::is_directory(file)) {
    TRY_ASSIGN(auto project, loadProject(file, progress));
    outcome.answer = projectInfo(project);
    return outcome;
  }
  if (const auto* format = readableCloudFormat(file)) {
    TRY_ASSIGN(auto info, format->info(file));
    json scans = json::array();
    std::uint64_t points = 0;
    for (const auto& s : info.scans) {
      scans.push_back(scanInfo(s));
      points += s.points;
    }
    outcome.answer = {{"format", info.format},
                      {"points", points},
                      {"scans", std::move(scans)},
                      {"crs", info.crs.empty() ? json(nullptr) : json(info.crs)}};
    outcome.report = info.report;
    return outcome;
  }
  TRY_ASSIGN(auto model, importFile(file, {}, progress));
  outcome.answer = {{"products", model.environment.products.size()},
                    {"triangles", triangleCount(model.environment)},
                    {"bounds", toJson(bounds(model.environment), model.georeference.shift_m)},
                    {"georeference", georeferenceToJson(model.georeference)}};
  outcome.report = model.report;
  return outcome;
}

const Fields<JobOptions>& jobFields() {
  static const Fields<JobOptions> fields = {{"job",
                                             &JobOptions::job,
                                             "JSON file: [{\"verb\": …, option: value, …}, …]",
                                             {.positional = true, .required = true}}};
  return fields;
}

Result<Outcome> runJob(const Document& document, const JobOptions& options, Progress& progress) {
  const fs::path& file = options.job;
  TRY_ASSIGN(const auto steps, readJsonArray(file));
  Outcome outcome{document, json::object(), {}, {}};
  json answers = json::array();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    JsonFault fault(file.filename().string());
    JsonFields fields(fault, steps[i], fmt::format("/{}", i));
    const auto verb_name = fields.text("verb", "scan");
    const Verb* verb = findVerb(verbs(), verb_name);
    if (verb == nullptr || verb_name == "run") fields.wrong("verb", fmt::format("unknown job verb '{}'", verb_name));
    TRY(fault.result());
    json step = steps[i];
    step.erase("verb");
    auto done = runOnDisk(*verb, step, progress);
    if (!done) {
      Error error = done.error();
      error.source = fault.file() + " " + fields.pointer() + (error.source.empty() ? "" : " " + error.source);
      return failure(error);
    }
    for (auto issue : done->report.issues) {
      issue.source = verb_name + " " + issue.source;
      outcome.report.issues.push_back(std::move(issue));
    }
    json answer = std::move(done->answer);
    answer["verb"] = verb_name;
    answers.push_back(std::move(answer));
  }
  outcome.answer["steps"] = std::move(answers);
  outcome.description = "Ran " + file.filename().string();
  return outcome;
}

}  // namespace standpoint
