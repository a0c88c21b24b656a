// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/verbs/file_verbs.h"

#include <algorithm>
#include <memory>

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
#include "project/survey/underlays.h"
#include "survey/trajectories/placed_anew.h"

namespace standpoint {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

// Passes all on.
class CountingSink final : public PointSink {
 public:
  CountingSink(PointSink& to, std::uint64_t& points) : to_(to), points_(points) {}
  Result<void> begin(const ScanHeader& header) override { return to_.begin(header); }
  Result<void> write(const PointBlock& block) override {
    points_ += block.size();
    return to_.write(block);
  }
  Result<void> picture(const StationPicture& picture) override { return to_.picture(picture); }
  Result<void> end() override { return to_.end(); }
  Result<void> close() override { return to_.close(); }

 private:
  PointSink& to_;
  std::uint64_t& points_;
};

InfoSurvey surveyInfo(const Job& job) {
  InfoSurvey survey{job.stations.size(), job.targets.size(), 0, 0};
  for (const auto& station : job.stations)
    for (const auto& scan : station.scans) {
      ++survey.scans;
      survey.points += scan.points;
    }
  return survey;
}

ProjectInfo projectInfo(const Document& document) {
  ProjectInfo info;
  info.name = document.name;
  info.sources = document.sources;
  if (document.georeference) info.georeference = *document.georeference;
  if (document.imported) {
    const auto& products = document.imported->products;
    info.products = products.size();
    info.products_excluded = static_cast<std::size_t>(
        std::count_if(products.begin(), products.end(), [](const Product& p) { return p.excluded; }));
    info.triangles_imported = sceneTriangleCount(*document.imported);
    info.triangles = sceneTriangleCount(*document.environment());
    const Eigen::Vector3d shift = document.georeference ? document.georeference->shift_m : Eigen::Vector3d::Zero();
    info.bounds_m = document.hasModel() ? fileBounds(bounds(*document.environment()), shift) : siteInFile(document);
  }
  if (document.simplified) info.max_deviation_m = document.simplified->all.max_deviation_m;
  if (document.collision) {
    info.collision_shapes = document.collision->shapes.size();
    info.walkable_m2 = document.collision->walkable_area_m2;
  }
  if (document.materials) info.material_coverage = document.materials->result.report.coverage;
  if (document.job) info.survey = surveyInfo(*document.job);
  info.underlays = document.underlays.size();
  return info;
}

CloudScanInfo scanInfo(const ScanInfo& scan) {
  const auto& h = scan.header;
  return {h.file_from_scanner, h.name,          h.guid,         scan.points,  h.rows,
          h.columns,           h.sensor_vendor, h.sensor_model, h.has_colour, h.has_labels};
}

CloudFileInfo cloudInfo(const CloudInfo& cloud) {
  CloudFileInfo info{cloud.format, 0, {}, cloud.crs};
  for (const auto& scan : cloud.scans) {
    info.scans.push_back(scanInfo(scan));
    info.points += scan.points;
  }
  return info;
}

Result<void> mustExist(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) return failure(ErrorKind::file_system, "file not found", file.string());
  return {};
}

// IN into a labelled set, a folder.
Result<Answered<ConvertAnswer>> convertTo(const ConvertOptions& options, Answered<ConvertAnswer> outcome,
                                          Progress& progress) {
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
  outcome.answer.files = {out};
  outcome.description = "Converted " + in.filename().string() + " to " + set->description;
  return outcome;
}

}  // namespace

std::uint64_t sizeOf(const std::vector<fs::path>& files) {
  std::uint64_t bytes = 0;
  std::error_code error;
  for (const auto& file : files)
    if (const auto size = fs::file_size(file, error); !error) bytes += size;
  return bytes;
}

const Fields<ConvertOptions>& convertFields() {
  using O = ConvertOptions;
  std::vector<const char*> sets;
  for (const auto& set : datasets()) sets.push_back(set.name);
  static const Fields<O> fields = {
      {"in", &O::in, "scan or point cloud", {.positional = true, .required = true, .label = "Points"}},
      {"out",
       &O::out,
       "file to write: .e57, .ptx and .las hold all scans; of .ply, .pcd, .pts, .xyz and .csv each scan gets its own "
       "file",
       {.positional = true, .required = true, .label = "File"}},
      {"with", &O::with, "more scans or point clouds, whose scans follow those of IN in OUT", {.label = "More points"}},
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
       "for --dataset: JSON file that maps IFC classes to those of the set (default: pointclouds/classes)"},
      {"from-trajectory", &O::from_trajectory, "trajectory by which the points were placed, with --to-trajectory"},
      {"to-trajectory", &O::to_trajectory, "trajectory by which they are placed anew, each at its own time"}};
  return fields;
}

const AnswerFields<ConvertAnswer>& answerFields(const ConvertAnswer*) {
  using A = ConvertAnswer;
  static const AnswerFields<A> fields = {
      {"files", &A::files}, {"points", &A::points, kLeftOut}, {"bytes", &A::bytes, kLeftOut}};
  return fields;
}

Result<Answered<ConvertAnswer>> runConvert(const Document& document, const ConvertOptions& options,
                                           Progress& progress) {
  const fs::path& in = options.in;
  TRY(mustExist(in));
  for (const auto& file : options.with) TRY(mustExist(file));
  if (!options.with.empty() && !(options.dataset.empty() && options.to_trajectory.empty()))
    return failure(ErrorKind::usage, "a labelled set and another trajectory take one file: leave --with out", "--with");
  progress.stage("Convert " + in.filename().string());
  Answered<ConvertAnswer> outcome{document};
  if (!options.dataset.empty()) return convertTo(options, std::move(outcome), progress);
  TRY(checkFolderOf(options.out, "OUT"));
  if (options.from_trajectory.empty() != options.to_trajectory.empty())
    return failure(ErrorKind::usage, "--from-trajectory and --to-trajectory belong together", "convert");
  if (!options.to_trajectory.empty()) {
    TRY(mustExist(options.from_trajectory));
    TRY(mustExist(options.to_trajectory));
    TRY_ASSIGN(outcome.answer.files, placeAnew(in, options.out, options.as, options.from_trajectory,
                                               options.to_trajectory, outcome.report, progress));
    outcome.answer.bytes = sizeOf(outcome.answer.files);
    outcome.description = "Placed " + in.filename().string() + " by another trajectory";
    return outcome;
  }
  std::uint64_t points = 0;
  const auto counted = [&](PointSink& writer) { return std::make_unique<CountingSink>(writer, points); };
  std::vector<fs::path> all = {in};
  all.insert(all.end(), options.with.begin(), options.with.end());
  TRY_ASSIGN(outcome.answer.files, convertCloud(all, options.out, options.as, outcome.report, progress, counted));
  outcome.answer.points = points;
  outcome.answer.bytes = sizeOf(outcome.answer.files);
  const auto nameOf = [&files = outcome.answer.files](std::size_t i) { return fs::path(files[i]).filename().string(); };
  const std::size_t count = outcome.answer.files.size();
  outcome.description = count > 1 ? fmt::format("Exported {} files, {} to {}", count, nameOf(0), nameOf(count - 1))
                                  : "Exported " + options.out.filename().string();
  return outcome;
}

const Fields<InfoOptions>& infoFields() {
  static const Fields<InfoOptions> fields = {
      {"file", &InfoOptions::file, "the file, or the folder of a project", {.positional = true, .required = true}}};
  return fields;
}

const AnswerFields<InfoSurvey>& answerFields(const InfoSurvey*) {
  using A = InfoSurvey;
  static const AnswerFields<A> fields = {
      {"stations", &A::stations}, {"targets", &A::targets}, {"scans", &A::scans}, {"points", &A::points}};
  return fields;
}

const AnswerFields<ProjectInfo>& answerFields(const ProjectInfo*) {
  using A = ProjectInfo;
  static const AnswerFields<A> fields = {{"format", &A::format},
                                         {"name", &A::name},
                                         {"sources", &A::sources},
                                         {"georeference", &A::georeference, kLeftOut},
                                         {"products", &A::products, kLeftOut},
                                         {"products_excluded", &A::products_excluded, kLeftOut},
                                         {"triangles_imported", &A::triangles_imported, kLeftOut},
                                         {"triangles", &A::triangles, kLeftOut},
                                         {"bounds", &A::bounds_m, kLeftOut},
                                         {"max_deviation_m", &A::max_deviation_m},
                                         {"collision_shapes", &A::collision_shapes},
                                         {"walkable_m2", &A::walkable_m2},
                                         {"material_coverage", &A::material_coverage},
                                         {"survey", &A::survey},
                                         {"underlays", &A::underlays}};
  return fields;
}

const AnswerFields<CloudScanInfo>& answerFields(const CloudScanInfo* info) {
  using A = CloudScanInfo;
  static const auto fields = withBases<A>({{"name", &A::name},
                                           {"guid", &A::guid},
                                           {"points", &A::points},
                                           {"rows", &A::rows},
                                           {"columns", &A::columns},
                                           {"vendor", &A::vendor},
                                           {"model", &A::model},
                                           {"colour", &A::colour},
                                           {"labels", &A::labels}},
                                          answerFields(static_cast<const Pose*>(info)));
  return fields;
}

const AnswerFields<CloudFileInfo>& answerFields(const CloudFileInfo*) {
  using A = CloudFileInfo;
  static const AnswerFields<A> fields = {
      {"format", &A::format}, {"points", &A::points}, {"scans", &A::scans}, {"crs", &A::crs, answers::nullWhereEmpty}};
  return fields;
}

const AnswerFields<ModelInfo>& answerFields(const ModelInfo*) {
  using A = ModelInfo;
  static const AnswerFields<A> fields = {{"products", &A::products},
                                         {"triangles", &A::triangles},
                                         {"bounds", &A::bounds_m},
                                         {"georeference", &A::georeference}};
  return fields;
}

Result<Answered<InfoAnswer>> runInfo(const Document& document, const InfoOptions& options, Progress& progress) {
  const fs::path& file = options.file;
  TRY(mustExist(file));
  progress.stage("Read " + file.filename().string());
  if (fs::is_directory(file)) {
    Report dropped;
    TRY_ASSIGN(const auto project, loadProject(file, progress, &dropped));
    return Answered<InfoAnswer>{document, projectInfo(project), dropped};
  }
  if (const auto* format = readableCloudFormat(file)) {
    TRY_ASSIGN(const auto cloud, format->info(file));
    return Answered<InfoAnswer>{document, cloudInfo(cloud), cloud.report};
  }
  TRY_ASSIGN(const auto model, importFile(file, {}, progress));
  const auto& environment = model.environment;
  return Answered<InfoAnswer>{
      document,
      ModelInfo{environment.products.size(), triangleCount(environment),
                fileBounds(bounds(environment), model.georeference.shift_m), model.georeference},
      model.report};
}

const Fields<JobOptions>& jobFields() {
  static const Fields<JobOptions> fields = {{"job",
                                             &JobOptions::job,
                                             "JSON file: [{\"verb\": …, option: value, …}, …]",
                                             {.positional = true, .required = true}}};
  return fields;
}

json AnswerValue<JobStep>::write(const JobStep& step) {
  json answer = step.answer;
  answer["verb"] = step.verb;
  return answer;
}

const AnswerFields<JobAnswer>& answerFields(const JobAnswer*) {
  static const AnswerFields<JobAnswer> fields = {{"steps", &JobAnswer::steps}};
  return fields;
}

Result<Answered<JobAnswer>> runJob(const Document& document, const JobOptions& options, Progress& progress) {
  const fs::path& file = options.job;
  TRY_ASSIGN(const auto steps, readJsonArray(file));
  Answered<JobAnswer> outcome{document};
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
    outcome.answer.steps.push_back({verb_name, std::move(done->answer)});
  }
  outcome.description = "Ran " + file.filename().string();
  return outcome;
}

}  // namespace standpoint
