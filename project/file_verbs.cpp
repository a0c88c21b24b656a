// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/file_verbs.h"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>

#include "importers/importers.h"
#include "pointclouds/datasets/datasets.h"
#include "pointclouds/formats.h"
#include "project/answers.h"
#include "project/output_place.h"
#include "project/project_files.h"
#include "project/project_info.h"
#include "project/session.h"

namespace standpoint {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

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
Result<Outcome> convertTo(const json& options, Outcome outcome, Progress& progress) {
  const fs::path in = options.at("in").get<std::string>(), out = options.at("out").get<std::string>();
  if (options.contains("as"))
    return failure(ErrorKind::usage, "use --as for a file, --dataset for a folder", "convert");
  const auto name = options.at("dataset").get<std::string>();
  const auto set = std::find_if(datasets().begin(), datasets().end(), [&](const Dataset& d) { return name == d.name; });
  if (set == datasets().end()) return failure(ErrorKind::usage, "unknown dataset '" + name + "'", "--dataset");
  auto map = readClassMap(options.contains("classes") ? fs::path(options["classes"].get<std::string>())
                                                      : dataFolder() / "pointclouds" / "classes" / (name + ".json"));
  if (!map) return failure(map.error());
  auto report = convertToDataset(in, out, *set, *std::move(map), progress);
  if (!report) return failure(report.error());
  outcome.report = *std::move(report);
  outcome.answer["files"] = {out.string()};
  outcome.description = "Converted " + in.filename().string() + " to " + set->description;
  return outcome;
}

}  // namespace

Result<Outcome> runConvert(const Document& document, const json& options, Progress& progress) {
  const fs::path in = options.at("in").get<std::string>();
  if (auto ok = mustExist(in); !ok) return failure(ok.error());
  progress.stage("Convert " + in.filename().string());
  Outcome outcome{document, json::object(), {}, {}};
  if (options.contains("dataset")) return convertTo(options, std::move(outcome), progress);
  if (auto there = checkFolderOf(options.at("out").get<std::string>(), "OUT"); !there) return failure(there.error());
  auto files =
      convertCloud(in, options.at("out").get<std::string>(), options.value("as", ""), outcome.report, progress);
  if (!files) return failure(files.error());
  json names = json::array();
  for (const auto& f : *files) names.push_back(f.string());
  outcome.answer["files"] = std::move(names);
  outcome.description = "Converted " + in.filename().string();
  return outcome;
}

Result<Outcome> runInfo(const Document& document, const json& options, Progress& progress) {
  const fs::path file = options.at("file").get<std::string>();
  if (auto ok = mustExist(file); !ok) return failure(ok.error());
  progress.stage("Read " + file.filename().string());
  Outcome outcome{document, json::object(), {}, {}};
  if (fs::is_directory(file)) {
    auto project = loadProject(file, progress);
    if (!project) return failure(project.error());
    outcome.answer = projectInfo(*project);
    return outcome;
  }
  if (const auto* format = readableCloudFormat(file)) {
    auto info = format->info(file);
    if (!info) return failure(info.error());
    json scans = json::array();
    std::uint64_t points = 0;
    for (const auto& s : info->scans) {
      scans.push_back(scanInfo(s));
      points += s.points;
    }
    outcome.answer = {{"format", info->format},
                      {"points", points},
                      {"scans", std::move(scans)},
                      {"crs", info->crs.empty() ? json(nullptr) : json(info->crs)}};
    outcome.report = info->report;
    return outcome;
  }
  auto model = importFile(file, {}, progress);
  if (!model) return failure(model.error());
  outcome.answer = {{"products", model->environment.products.size()},
                    {"triangles", triangleCount(model->environment)},
                    {"bounds", toJson(bounds(model->environment), model->georeference.shift_m)},
                    {"georeference", georeferenceToJson(model->georeference)}};
  outcome.report = model->report;
  return outcome;
}

Result<Outcome> runJob(const Document& document, const json& options, Progress& progress) {
  const fs::path file = options.at("job").get<std::string>();
  std::ifstream in(file);
  if (!in) return failure(ErrorKind::file_system, "cannot read the file", file.string());
  json steps;
  try {
    steps = json::parse(in);
  } catch (const json::exception& e) {  // also a number beyond double
    return failure(ErrorKind::unusable, e.what(), file.string());
  }
  if (!steps.is_array()) return failure(ErrorKind::unusable, "a job must be a list of {\"verb\": …}", file.string());
  Outcome outcome{document, json::object(), {}, {}};
  json answers = json::array();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto place = fmt::format("{} /{}", file.string(), i);
    if (!steps[i].is_object() || !steps[i].contains("verb") || !steps[i]["verb"].is_string())
      return failure(ErrorKind::unusable, "a step must be an object with a \"verb\"", place);
    const auto verb_name = steps[i]["verb"].get<std::string>();
    const Verb* verb = findVerb(verbs(), verb_name);
    if (verb == nullptr || verb_name == "run")
      return failure(ErrorKind::unusable, fmt::format("unknown job verb '{}'", verb_name), place);
    json step = steps[i];
    step.erase("verb");
    auto done = runOnDisk(*verb, step, progress);
    if (!done) {
      Error error = done.error();
      error.source = place + (error.source.empty() ? "" : " " + error.source);
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
