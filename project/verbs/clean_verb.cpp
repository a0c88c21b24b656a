// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "core/output_place.h"
#include "core/part_file.h"
#include "pointclouds/filters/cleaning.h"
#include "project/verbs/file_verbs.h"
#include "survey/trajectories/trajectory_file.h"

namespace standpoint {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

CleanFilter filterRow(const FilterFigures& f) {
  CleanFilter row{f.filter, f.points.in, f.points.taken, f.points.in - f.points.taken, {}, {}, {}, {}};
  if (f.has_truth) {
    row.truth.emplace();
    for (std::size_t bit = 0; bit < f.flags.size(); ++bit)
      (*row.truth)[flagNames()[bit]] = causeOf(f.flags[bit], f.with_truth.taken);
    row.plainly_mixed = countOf(f.plainly_mixed);
    row.good = countOf(f.good);
  }
  if (f.has_labels) {
    row.classes.emplace();
    for (const auto& [name, taken] : f.good_of_class)
      if (taken.in > 0) (*row.classes)[name] = countOf(taken);
  }
  return row;
}

std::string csvWord(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

// One line for each filter and what it is counted by.
std::string csv(const Cleaning& cleaning) {
  std::string text = "filter,counted,in,removed\n";
  const auto line = [&](const FilterFigures& f, const std::string& what, const Taken& t) {
    text += fmt::format("{},{},{},{}\n", csvWord(f.filter), csvWord(what), t.in, t.taken);
  };
  for (const FilterFigures& f : cleaning.filters) {
    line(f, "all", f.points);
    if (f.has_truth) {
      for (std::size_t bit = 0; bit < f.flags.size(); ++bit) line(f, flagNames()[bit], f.flags[bit]);
      line(f, "mixed by over 1 cm", f.plainly_mixed);
      line(f, "good", f.good);
    }
    for (const auto& [name, taken] : f.good_of_class)
      if (taken.in > 0) line(f, "good " + name, taken);
  }
  return text;
}

std::string percent(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? "–" : fmt::format("{:.2f} %", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

std::string table(const Cleaning& cleaning) {
  std::string text;
  for (const FilterFigures& f : cleaning.filters) {
    text += fmt::format("{}: {} points in, {} removed ({}), {} out\n", f.filter, f.points.in, f.points.taken,
                        percent(f.points.taken, f.points.in), f.points.in - f.points.taken);
    for (std::size_t bit = 0; f.has_truth && bit < f.flags.size(); ++bit)
      if (f.flags[bit].in > 0)
        text += fmt::format("  {:<14} {} of {} found ({}), {} of all removed points\n", flagNames()[bit],
                            f.flags[bit].taken, f.flags[bit].in, percent(f.flags[bit].taken, f.flags[bit].in),
                            percent(f.flags[bit].taken, f.with_truth.taken));
    if (f.plainly_mixed.in > 0)
      text += fmt::format("  {:<14} {} of {} found ({})\n", "mixed > 1 cm", f.plainly_mixed.taken, f.plainly_mixed.in,
                          percent(f.plainly_mixed.taken, f.plainly_mixed.in));
    if (f.has_truth)
      text += fmt::format("  {:<14} {} of {} lost ({})\n", "good", f.good.taken, f.good.in,
                          percent(f.good.taken, f.good.in));
    for (const auto& [name, taken] : f.good_of_class)
      if (taken.taken > 0)
        text += fmt::format("    {:<22} {} of {} ({})\n", name, taken.taken, taken.in, percent(taken.taken, taken.in));
  }
  return text;
}

}  // namespace

Result<std::vector<ChosenFilter>> filtersFrom(const std::vector<std::string>& texts) {
  std::vector<ChosenFilter> filters;
  for (const auto& text : texts) {
    TRY_ASSIGN(auto chosen, filterFrom(text));
    filters.push_back(std::move(chosen));
  }
  return filters;
}

Result<std::vector<ChosenFilter>> FieldValue<std::vector<ChosenFilter>>::read(const json& texts) {
  return filtersFrom(texts.get<std::vector<std::string>>());
}

json FieldValue<std::vector<ChosenFilter>>::write(const std::vector<ChosenFilter>& filters) {
  json texts;
  for (const auto& filter : filters) texts.push_back(filter.text);
  return texts;
}

const Fields<CleanOptions>& cleanFields() {
  using O = CleanOptions;
  static const std::string filters =
      "filters in this order, NAME or NAME:KEY=VALUE,…, in metres and degrees: " + filterList();
  static const Fields<O> fields = {
      {"in", &O::in, "scan or point cloud", {.positional = true, .required = true, .label = "Points"}},
      {"output", &O::output, "file to write, in the format of its ending", {.required = true, .label = "File"}},
      {"filters", &O::filters, filters.c_str(), {.required = true}},
      {"report", &O::report, "file for the figures of each filter (.json, .csv)"}};
  return fields;
}

const AnswerFields<CleanFilter>& answerFields(const CleanFilter*) {
  using A = CleanFilter;
  static const AnswerFields<A> fields = {
      {"filter", &A::filter},         {"in", &A::in},
      {"removed", &A::removed},       {"out", &A::out},
      {"truth", &A::truth, kLeftOut}, {"mixed_by_over_1cm", &A::plainly_mixed, kLeftOut},
      {"good", &A::good, kLeftOut},   {"classes", &A::classes, kLeftOut}};
  return fields;
}

const AnswerFields<CleanFigures>& answerFields(const CleanFigures*) {
  using A = CleanFigures;
  static const AnswerFields<A> fields = {
      {"points_in", &A::points_in}, {"points_out", &A::points_out}, {"filters", &A::filters}};
  return fields;
}

const AnswerFields<CleanAnswer>& answerFields(const CleanAnswer* answer) {
  static const auto fields =
      withBases<CleanAnswer>({{"files", &CleanAnswer::files}}, answerFields(static_cast<const CleanFigures*>(answer)));
  return fields;
}

Result<Answered<CleanAnswer>> runClean(const Document& document, const CleanOptions& options, Progress& progress) {
  const fs::path &in = options.in, &report = options.report;
  std::error_code error;
  if (!fs::exists(in, error)) return failure(ErrorKind::file_system, "file not found", in.string());
  if (!report.empty() && report.extension() != ".json" && report.extension() != ".csv")
    return failure(ErrorKind::usage, "unsupported report format: use .json or .csv", "--report");
  TRY(checkFolderOf(options.output, "--output"));
  if (!report.empty()) TRY(checkFolderOf(report, "--report"));
  Answered<CleanAnswer> outcome{document};
  auto filters = options.filters;
  for (auto& filter : filters) {
    if (filter.trajectory.empty()) continue;
    TRY_ASSIGN(auto poses, cloudPoses(filter.trajectory, outcome.report, progress));
    filter.carrier = std::make_shared<const PoseSpline>(std::move(poses));
  }
  TRY_ASSIGN(const auto cleaning, cleanCloud(in, options.output, filters, progress));
  outcome.report.append(cleaning.report);
  auto& answer = outcome.answer;
  answer.points_in = cleaning.points_in;
  answer.points_out = cleaning.points_out;
  for (const auto& filter : cleaning.filters) answer.filters.push_back(filterRow(filter));
  answer.files = cleaning.files;
  if (!report.empty())
    TRY(writeWholeText(report, report.extension() == ".csv" ? csv(cleaning)
                                                            : AnswerValue<CleanFigures>::write(answer).dump(2) + "\n"));
  outcome.description =
      fmt::format("Cleaned {}: kept {} of {} points", in.filename().string(), cleaning.points_out, cleaning.points_in);
  outcome.text = table(cleaning);
  return outcome;
}

}  // namespace standpoint
