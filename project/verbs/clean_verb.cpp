// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include <fmt/format.h>

#include "core/output_place.h"
#include "pointclouds/filters/cleaning.h"
#include "project/verbs/file_verbs.h"

namespace standpoint {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

// A share that is not asked of nothing.
json fractionOf(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? json(nullptr) : json(static_cast<double>(part) / static_cast<double>(whole));
}

json takenJson(const Taken& t) { return {{"in", t.in}, {"removed", t.taken}, {"share", fractionOf(t.taken, t.in)}}; }

json figuresJson(const FilterFigures& f) {
  json row = {
      {"filter", f.filter}, {"in", f.points.in}, {"removed", f.points.taken}, {"out", f.points.in - f.points.taken}};
  if (f.has_truth) {
    json flags = json::object();
    for (std::size_t bit = 0; bit < f.flags.size(); ++bit)
      flags[flagNames()[bit]] = {{"in", f.flags[bit].in},
                                 {"removed", f.flags[bit].taken},
                                 {"recall", fractionOf(f.flags[bit].taken, f.flags[bit].in)},
                                 {"precision", fractionOf(f.flags[bit].taken, f.with_truth.taken)}};
    row["truth"] = std::move(flags);
    row["mixed_by_over_1cm"] = takenJson(f.plainly_mixed);
    row["good"] = takenJson(f.good);
  }
  if (f.has_labels) {
    json classes = json::object();
    for (const auto& [name, taken] : f.good_of_class)
      if (taken.in > 0) classes[name] = takenJson(taken);
    row["classes"] = std::move(classes);
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

Result<void> writeReport(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) return failure(ErrorKind::file_system, "cannot write the file", file.string());
  return {};
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
  static const Fields<O> fields = {{"in", &O::in, "cloud to read", {.positional = true, .required = true}},
                                   {"output", &O::output, "cloud to write", {.required = true}},
                                   {"filters", &O::filters, filters.c_str(), {.required = true}},
                                   {"report", &O::report, "file for the figures of each filter (.json, .csv)"}};
  return fields;
}

Result<Outcome> runClean(const Document& document, const CleanOptions& options, Progress& progress) {
  const fs::path &in = options.in, &report = options.report;
  std::error_code error;
  if (!fs::exists(in, error)) return failure(ErrorKind::file_system, "file not found", in.string());
  if (!report.empty() && report.extension() != ".json" && report.extension() != ".csv")
    return failure(ErrorKind::usage, "unsupported report format: use .json or .csv", "--report");
  TRY(checkFolderOf(options.output, "--output"));
  if (!report.empty()) TRY(checkFolderOf(report, "--report"));
  TRY_ASSIGN(auto cleaning, cleanCloud(in, options.output, options.filters, progress));
  Outcome outcome{document, json::object(), std::move(cleaning.report), {}};
  json rows = json::array(), files = json::array();
  for (const FilterFigures& f : cleaning.filters) rows.push_back(figuresJson(f));
  for (const auto& file : cleaning.files) files.push_back(file.string());
  outcome.answer = {
      {"points_in", cleaning.points_in}, {"points_out", cleaning.points_out}, {"filters", std::move(rows)}};
  if (!report.empty())
    TRY(writeReport(report, report.extension() == ".csv" ? csv(cleaning) : outcome.answer.dump(2) + "\n"));
  outcome.answer["files"] = std::move(files);
  outcome.description =
      fmt::format("Cleaned {}: kept {} of {} points", in.filename().string(), cleaning.points_out, cleaning.points_in);
  outcome.text = table(cleaning);
  return outcome;
}

}  // namespace standpoint
