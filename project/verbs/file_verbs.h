// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Verbs on files: what a document or a cloud is written to, and what is found in one.

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "importers/gltf/gltf_writer.h"
#include "pointclouds/filters/point_filter.h"
#include "pointclouds/statistics/statistics.h"
#include "project/answers.h"
#include "project/dataset/cleaning_answer.h"
#include "project/fields.h"

namespace standpoint {

std::span<const Choice<CollisionNaming>> choices(CollisionNaming);

std::uint64_t sizeOf(const std::vector<std::filesystem::path>& files);  // in bytes, of those that are there

struct ExportOptions {
  std::filesystem::path output;     // .glb, .gltf, .obj, or .xml for HELIOS++
  bool physical = false;            // of an .obj
  std::vector<std::string> levels;  // triangles of each, falling
  std::optional<CollisionNaming> collision;
};
const Fields<ExportOptions>& exportFields();

struct ExportLevel {
  std::uint64_t triangles = 0;
  double max_deviation_m = 0, mean_deviation_m = 0;
};
const AnswerFields<ExportLevel>& answerFields(const ExportLevel*);
struct ExportAnswer {
  std::filesystem::path file;
  std::uint64_t triangles = 0;
  std::uint64_t bytes = 0;                      // of the file, and of the .bin or .mtl beside it
  std::optional<std::string> schema;            // of an IFC file
  std::vector<ExportLevel> levels;              // that were asked for
  std::optional<std::size_t> collision_shapes;  // likewise
};
const AnswerFields<ExportAnswer>& answerFields(const ExportAnswer*);
Result<Answered<ExportAnswer>> runExport(const Document& document, const ExportOptions& options, Progress& progress);

struct ConvertOptions {
  std::filesystem::path in, out;
  std::vector<std::filesystem::path> with;               // more files, whose scans follow those of `in`
  std::string as;                                        // variant of the format
  std::string dataset;                                   // name of the set; `out` is its folder
  std::filesystem::path classes;                         // of the set
  std::filesystem::path from_trajectory, to_trajectory;  // by which the points were placed, and are to be
};
const Fields<ConvertOptions>& convertFields();

struct ConvertAnswer {
  std::vector<std::filesystem::path> files;  // written
  std::optional<std::uint64_t> points;       // in them; not of a data set
  std::optional<std::uint64_t> bytes;        // likewise
};
const AnswerFields<ConvertAnswer>& answerFields(const ConvertAnswer*);
Result<Answered<ConvertAnswer>> runConvert(const Document& document, const ConvertOptions& options, Progress& progress);

// "NAME" or "NAME:KEY=VALUE,…" of each.
Result<std::vector<ChosenFilter>> filtersFrom(const std::vector<std::string>& texts);
template <>
struct FieldValue<std::vector<ChosenFilter>> {
  static constexpr auto kKind = ParameterKind::list;
  static void describe(Parameter&) {}
  static Result<std::vector<ChosenFilter>> read(const nlohmann::json& texts);
  static nlohmann::json write(const std::vector<ChosenFilter>& filters);
};
struct CleanOptions {
  std::filesystem::path in, output;
  std::vector<ChosenFilter> filters;
  std::filesystem::path report;  // .json or .csv
};
const Fields<CleanOptions>& cleanFields();

struct CleanFilter {
  std::string filter;  // as it was written
  std::uint64_t in = 0, removed = 0, out = 0;
  std::optional<std::map<std::string, CleanCause>> truth;    // by cause; where the file has it, like the next two
  std::optional<CleanCount> plainly_mixed, good;             // mixed by more than 1 cm; where a surface is
  std::optional<std::map<std::string, CleanCount>> classes;  // of good points; where the file has labels
};
const AnswerFields<CleanFilter>& answerFields(const CleanFilter*);
struct CleanFigures {  // what a report holds
  std::uint64_t points_in = 0, points_out = 0;
  std::vector<CleanFilter> filters;
};
const AnswerFields<CleanFigures>& answerFields(const CleanFigures*);
struct CleanAnswer : CleanFigures {
  std::vector<std::filesystem::path> files;  // written
};
const AnswerFields<CleanAnswer>& answerFields(const CleanAnswer*);
Result<Answered<CleanAnswer>> runClean(const Document& document, const CleanOptions& options, Progress& progress);

struct InfoOptions {
  std::filesystem::path file;
};
const Fields<InfoOptions>& infoFields();

struct InfoSurvey {
  std::size_t stations = 0, targets = 0, scans = 0;
  std::uint64_t points = 0;
};
const AnswerFields<InfoSurvey>& answerFields(const InfoSurvey*);
// What a project holds and how far it is: the model, what was made of it, and the survey. Numbers in the model's file
// frame.
struct ProjectInfo {
  std::string format = "project", name;
  std::vector<std::string> sources;
  std::optional<Georeference> georeference;
  std::optional<std::size_t> products, products_excluded, triangles_imported, triangles;
  std::optional<Bounds> bounds_m;
  std::optional<double> max_deviation_m;  // of the simplified model, where there is one; like the next three
  std::optional<std::size_t> collision_shapes;
  std::optional<double> walkable_m2, material_coverage;
  InfoSurvey survey;
  std::size_t underlays = 0;
};
const AnswerFields<ProjectInfo>& answerFields(const ProjectInfo*);
struct CloudScanInfo : Pose {  // file from scanner
  std::string name, guid;
  std::uint64_t points = 0;
  std::uint32_t rows = 0, columns = 0;
  std::string vendor, model;
  bool colour = false, labels = false;
};
const AnswerFields<CloudScanInfo>& answerFields(const CloudScanInfo*);
struct CloudFileInfo {
  std::string format;
  std::uint64_t points = 0;
  std::vector<CloudScanInfo> scans;
  std::string crs;  // empty where the file has none
};
const AnswerFields<CloudFileInfo>& answerFields(const CloudFileInfo*);
struct ModelInfo {
  std::size_t products = 0, triangles = 0;
  Bounds bounds_m;  // in the model's file frame
  Georeference georeference;
};
const AnswerFields<ModelInfo>& answerFields(const ModelInfo*);
using InfoAnswer = std::variant<ProjectInfo, CloudFileInfo, ModelInfo>;
Result<Answered<InfoAnswer>> runInfo(const Document& document, const InfoOptions& options, Progress& progress);

struct InstrumentsOptions {
  std::string copy, as;  // ids
};
const Fields<InstrumentsOptions>& instrumentsFields();

struct InstrumentRange {  // of a setting
  double from = 0, to = 0;
  std::string unit;
};
const AnswerFields<InstrumentRange>& answerFields(const InstrumentRange*);
struct InstrumentRow {
  std::string id, maker, model, technology;
  double wavelength_nm = 0, max_range_m = 0;
  bool moving = false, own = false;
  std::filesystem::path file;
  std::map<std::string, std::variant<std::vector<std::string>, InstrumentRange>> settings;  // by key: its choices
};
const AnswerFields<InstrumentRow>& answerFields(const InstrumentRow*);
struct BrokenInstrumentRow {  // of the user's own: what is wrong where
  std::string id;
  std::filesystem::path file;
  std::string source, message;
};
const AnswerFields<BrokenInstrumentRow>& answerFields(const BrokenInstrumentRow*);
struct InstrumentCopy {
  std::string id, from;
  std::filesystem::path file;
};
const AnswerFields<InstrumentCopy>& answerFields(const InstrumentCopy*);
struct InstrumentsAnswer {
  std::optional<InstrumentCopy> copied;
  std::filesystem::path own_folder, schema;
  std::vector<InstrumentRow> instruments;
  std::vector<BrokenInstrumentRow> broken;  // likewise listed as warnings; nothing else minds them
};
const AnswerFields<InstrumentsAnswer>& answerFields(const InstrumentsAnswer*);
Result<Answered<InstrumentsAnswer>> runInstruments(const Document& document, const InstrumentsOptions& options,
                                                   Progress& progress);

struct CompareOptions {
  std::filesystem::path a, b;
  std::string a_scan = {}, b_scan = {};  // by name, of files with several; empty: all of them
};
const Fields<CompareOptions>& compareFields();

const AnswerFields<Distribution>& answerFields(const Distribution*);
const AnswerFields<MaterialIntensity>& answerFields(const MaterialIntensity*);
struct ComparedCloud : CloudStatistics {
  Bounds bounds_m;
};
const AnswerFields<ComparedCloud>& answerFields(const ComparedCloud*);
const AnswerFields<LargestDifference>& answerFields(const LargestDifference*);
struct CompareAnswer {
  ComparedCloud a, b;
  double a_covered_by_b = 0, b_covered_by_a = 0;  // 0..1
  Distribution a_from_b_m, b_from_a_m;
  std::optional<LargestDifference> a_largest, b_largest;
  std::shared_ptr<const CloudDistances> a_distances, b_distances;  // of each point; not in the JSON
};
const AnswerFields<CompareAnswer>& answerFields(const CompareAnswer*);
Result<Answered<CompareAnswer>> runCompare(const Document& document, const CompareOptions& options, Progress& progress);

struct JobOptions {
  std::filesystem::path job;
};
const Fields<JobOptions>& jobFields();

struct JobStep {
  std::string verb;
  nlohmann::json answer;  // as the verb's own door says it: a job is one
};
template <>
struct AnswerValue<JobStep> {  // the verb beside its answer's keys
  static nlohmann::json write(const JobStep& step);
  static std::vector<std::string> names() { return {"verb"}; }
};
struct JobAnswer {
  std::vector<JobStep> steps;
};
const AnswerFields<JobAnswer>& answerFields(const JobAnswer*);
Result<Answered<JobAnswer>> runJob(const Document& document, const JobOptions& options, Progress& progress);

}  // namespace standpoint
