// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Verbs on files: what a document or a cloud is written to, and what is found in one.

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "importers/gltf/gltf_writer.h"
#include "pointclouds/filters/point_filter.h"
#include "project/fields.h"

namespace standpoint {

std::span<const Choice<CollisionNaming>> choices(CollisionNaming);

struct ExportOptions {
  std::filesystem::path output;     // .glb, .gltf, .obj, or .xml for HELIOS++
  bool physical = false;            // of an .obj
  std::vector<std::string> levels;  // triangles of each, falling
  std::optional<CollisionNaming> collision;
};
const Fields<ExportOptions>& exportFields();
Result<Outcome> runExport(const Document& document, const ExportOptions& options, Progress& progress);

struct ConvertOptions {
  std::filesystem::path in, out;
  std::string as;                 // variant of the format
  std::string dataset;            // name of the set; `out` is its folder
  std::filesystem::path classes;  // of the set
};
const Fields<ConvertOptions>& convertFields();
Result<Outcome> runConvert(const Document& document, const ConvertOptions& options, Progress& progress);

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
Result<Outcome> runClean(const Document& document, const CleanOptions& options, Progress& progress);

struct InfoOptions {
  std::filesystem::path file;
};
const Fields<InfoOptions>& infoFields();
Result<Outcome> runInfo(const Document& document, const InfoOptions& options, Progress& progress);

struct InstrumentsOptions {
  std::string copy, as;  // ids
};
const Fields<InstrumentsOptions>& instrumentsFields();
Result<Outcome> runInstruments(const Document& document, const InstrumentsOptions& options, Progress& progress);

struct CompareOptions {
  std::filesystem::path a, b;
};
const Fields<CompareOptions>& compareFields();
Result<Outcome> runCompare(const Document& document, const CompareOptions& options, Progress& progress);

struct JobOptions {
  std::filesystem::path job;
};
const Fields<JobOptions>& jobFields();
Result<Outcome> runJob(const Document& document, const JobOptions& options, Progress& progress);

}  // namespace standpoint
