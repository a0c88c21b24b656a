// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/survey/measure_verb.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/units.h"
#include "project/answers.h"

namespace standpoint {

namespace {

using nlohmann::json;

MeasurementRow measurementRow(const Measurement& m, const Georeference& g) {
  MeasurementRow row{m.name, rowOf(m.kind).name, {}, m.points, m.note};
  for (auto& p : row.points) p += g.shift_m;
  for (const auto& f : figuresOf(m)) {
    static constexpr std::array<const char*, 4> kSuffix = {"_m", "_deg", "_m2", "_m"};
    const double value = f.unit == MeasuredUnit::radian ? f.value / kRadPerDeg : f.value;
    row.figures[f.key + std::string(kSuffix.at(static_cast<std::size_t>(f.unit)))] = value;
  }
  return row;
}

Result<void> checkName(const Measurements& measurements, const std::string& name) {
  if (name.empty()) return failure(ErrorKind::usage, "a measurement needs a name", "--name");
  if (std::any_of(measurements.begin(), measurements.end(), [&](const auto& m) { return m.name == name; }))
    return failure(ErrorKind::usage, fmt::format("measurement '{}' already exists; use another name", name));
  return {};
}

Result<Measurements::iterator> named(Measurements& measurements, const std::string& name) {
  const auto at = std::find_if(measurements.begin(), measurements.end(), [&](const auto& m) { return m.name == name; });
  if (at != measurements.end()) return at;
  std::vector<std::string> names;
  for (const auto& m : measurements) names.push_back(m.name);
  return failure(ErrorKind::usage, fmt::format("unknown measurement '{}'; available: {}", name,
                                               names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

Result<Measurement> added(const Measurements& measurements, const MeasureOptions& options, const Georeference& g) {
  Measurement m{*options.add, options.kind, options.points, options.note};
  TRY(checkName(measurements, m.name));
  for (auto& p : m.points) p -= g.shift_m;
  if (auto checked = checkMeasurement(m); !checked)
    return failure(checked.error().kind, checked.error().message, "--points");
  return m;
}

// The answer's `placed` and the description come with it.
Result<void> change(Measurements& measurements, const MeasureOptions& options, const Georeference& g,
                    Answered<MeasureAnswer>& outcome) {
  if (options.add) {
    TRY_ASSIGN(auto m, added(measurements, options, g));
    outcome.description = fmt::format("Measured {} {}: {}", rowOf(m.kind).name, m.name, figureText(figuresOf(m)[0]));
    outcome.answer.placed = measurementRow(m, g);
    measurements.push_back(std::move(m));
  } else if (options.rename) {
    TRY_ASSIGN(const auto at, named(measurements, *options.rename));
    if (options.name != at->name) TRY(checkName(measurements, options.name));
    at->name = options.name;
    outcome.answer.placed = measurementRow(*at, g);
    outcome.description = fmt::format("Renamed measurement {} to {}", *options.rename, options.name);
  } else if (options.remove) {
    TRY_ASSIGN(const auto at, named(measurements, *options.remove));
    outcome.description = "Removed measurement " + at->name;
    measurements.erase(at);
  }
  return {};
}

}  // namespace

Result<std::vector<Eigen::Vector3d>> FieldValue<std::vector<Eigen::Vector3d>>::read(const json& texts) {
  std::vector<Eigen::Vector3d> places;
  for (const auto& text : texts) {
    const auto numbers = parseNumbers(text.get<std::string>());
    if (!numbers || numbers->size() != 3)
      return failure(ErrorKind::usage, fmt::format("'{}' must be X,Y,Z", text.get<std::string>()), "--points");
    places.push_back(vectorFrom(*numbers));
  }
  return places;
}

json FieldValue<std::vector<Eigen::Vector3d>>::write(const std::vector<Eigen::Vector3d>& places) {
  json texts;
  for (const auto& p : places) texts.push_back(fmt::format("{},{},{}", p.x(), p.y(), p.z()));
  return texts;
}

std::span<const Choice<MeasurementKind>> choices(MeasurementKind) {
  static const auto kChoices = [] {
    std::vector<Choice<MeasurementKind>> all;
    for (const auto& row : measurementKinds()) all.push_back({row.name, row.kind});
    return all;
  }();
  return kChoices;
}

std::string freeMeasurementName(const Document& document) {
  const Measurements none;
  const Measurements& taken = document.measurements ? *document.measurements : none;
  for (int i = 1;; ++i) {
    auto name = fmt::format("M{}", i);
    if (std::none_of(taken.begin(), taken.end(), [&](const auto& m) { return m.name == name; })) return name;
  }
}

const Fields<MeasureOptions>& measureFields() {
  using O = MeasureOptions;
  static const Fields<O> fields = {
      {"add", &O::add, "name of a new measurement"},
      {"kind", &O::kind, "what is measured: the second point above the first, the angle at the second of three points"},
      {"points", &O::points, "X,Y,Z of each point, in the file's frame"},
      {"note", &O::note, "text that is kept with it"},
      {"rename", &O::rename, "name of the measurement to rename"},
      {"name", &O::name, "its new name"},
      {"remove", &O::remove, "name of the measurement to remove"}};
  return fields;
}

const AnswerFields<MeasurementRow>& answerFields(const MeasurementRow*) {
  using A = MeasurementRow;
  static const AnswerFields<A> fields = {{"name", &A::name},
                                         {"kind", &A::kind},
                                         {"figures", &A::figures},
                                         {"points", &A::points},
                                         {"note", &A::note, answers::nullWhereEmpty}};
  return fields;
}

const AnswerFields<MeasureAnswer>& answerFields(const MeasureAnswer*) {
  using A = MeasureAnswer;
  static const AnswerFields<A> fields = {{"placed", &A::placed, kLeftOut}, {"measurements", &A::measurements}};
  return fields;
}

Result<Answered<MeasureAnswer>> runMeasure(const Document& document, const MeasureOptions& options,
                                           Progress& progress) {
  progress.stage("Measure");
  const int asked = static_cast<int>(options.add.has_value()) + static_cast<int>(options.rename.has_value()) +
                    static_cast<int>(options.remove.has_value());
  if (asked > 1) return failure(ErrorKind::usage, "specify one of --add NAME, --rename NAME, --remove NAME");
  if (!options.add && !options.points.empty()) return failure(ErrorKind::usage, "--points requires --add NAME");
  Answered<MeasureAnswer> outcome{document};
  Measurements measurements = document.measurements ? *document.measurements : Measurements();
  TRY(change(measurements, options, *document.georeference, outcome));
  for (const auto& m : measurements) outcome.answer.measurements.push_back(measurementRow(m, *document.georeference));
  if (asked == 1) outcome.document.measurements = std::make_shared<const Measurements>(std::move(measurements));
  return outcome;
}

json measurementsToJson(const Measurements& measurements) {
  json rows = json::array();
  for (const auto& m : measurements) {
    json points = json::array();
    for (const auto& p : m.points) points.push_back(toJson(p));
    rows.push_back({{"name", m.name}, {"kind", rowOf(m.kind).name}, {"points", std::move(points)}, {"note", m.note}});
  }
  return rows;
}

Measurements measurementsFrom(const json& rows, Report& report) {
  Measurements measurements;
  for (const auto& row : rows) {
    Measurement m{row.at("name"), {}, {}, row.at("note")};
    const auto kind = std::find_if(measurementKinds().begin(), measurementKinds().end(),
                                   [&](const auto& k) { return row.at("kind") == k.name; });
    for (const auto& p : row.at("points")) m.points.push_back(vectorFrom(p));
    if (kind != measurementKinds().end()) m.kind = kind->kind;
    if (kind == measurementKinds().end() || !checkMeasurement(m))
      report.warn("measurement " + m.name, "the measurement is damaged and was dropped; measure again");
    else
      measurements.push_back(std::move(m));
  }
  return measurements;
}

}  // namespace standpoint
