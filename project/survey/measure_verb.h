// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "project/fields.h"
#include "survey/measuring/measurement.h"

namespace standpoint {

using Measurements = std::vector<Measurement>;

std::span<const Choice<MeasurementKind>> choices(MeasurementKind);

// "X,Y,Z" of each; errors name the text.
template <>
struct FieldValue<std::vector<Eigen::Vector3d>> {
  static constexpr auto kKind = ParameterKind::list;
  static void describe(Parameter&) {}
  static Result<std::vector<Eigen::Vector3d>> read(const nlohmann::json& texts);
  static nlohmann::json write(const std::vector<Eigen::Vector3d>& places);
};

// Adds, renames, removes or lists measurements; of the actions at most one, none lists. Places in metres, the frame of
// the model's file.
struct MeasureOptions {
  std::optional<std::string> add, rename, remove;
  std::string name;  // the new one, for `rename`
  MeasurementKind kind = MeasurementKind::distance;
  std::vector<Eigen::Vector3d> points;
  std::string note;
};
const Fields<MeasureOptions>& measureFields();

struct MeasurementRow {
  std::string name, kind;
  std::map<std::string, double> figures;  // by name and unit: "distance_m", "angle_deg", "area_m2"
  std::vector<Eigen::Vector3d> points;    // m, the model's file frame
  std::string note;
};
const AnswerFields<MeasurementRow>& answerFields(const MeasurementRow*);
struct MeasureAnswer {
  std::optional<MeasurementRow> placed;  // what was added or renamed
  std::vector<MeasurementRow> measurements;
};
const AnswerFields<MeasureAnswer>& answerFields(const MeasureAnswer*);
Result<Answered<MeasureAnswer>> runMeasure(const Document& document, const MeasureOptions& options, Progress& progress);

std::string freeMeasurementName(const Document& document);  // "M1", "M2" …

// As they stand in project.json. The reader throws nlohmann::json::exception; what cannot be measured is left out and
// told.
nlohmann::json measurementsToJson(const Measurements& measurements);
Measurements measurementsFrom(const nlohmann::json& rows, Report& report);

}  // namespace standpoint
