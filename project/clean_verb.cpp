// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include <fmt/format.h>

#include "pointclouds/filters/cleaning.h"
#include "project/file_verbs.h"
#include "project/output_place.h"

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

Result<Outcome> runClean(const Document& document, const json& options, Progress& progress) {
  const fs::path in = options.at("in").get<std::string>();
  std::error_code error;
  if (!fs::exists(in, error)) return failure(ErrorKind::file_system, "file not found", in.string());
  const fs::path report = options.value("report", "");
  if (!report.empty() && report.extension() != ".json" && report.extension() != ".csv")
    return failure(ErrorKind::usage, "unsupported report format: use .json or .csv", "--report");
  for (const char* option : {"output", "report"})
    if (const fs::path file = options.value(option, ""); !file.empty())
      if (auto there = checkFolderOf(file, option == std::string_view("output") ? "--output" : "--report"); !there)
        return failure(there.error());
  std::vector<ChosenFilter> filters;
  for (const auto& text : options.at("filters")) {
    auto chosen = filterFrom(text.get<std::string>());
    if (!chosen) return failure(chosen.error());
    filters.push_back(*std::move(chosen));
  }
  auto cleaning = cleanCloud(in, options.at("output").get<std::string>(), filters, progress);
  if (!cleaning) return failure(cleaning.error());
  Outcome outcome{document, json::object(), std::move(cleaning->report), {}};
  json rows = json::array(), files = json::array();
  for (const FilterFigures& f : cleaning->filters) rows.push_back(figuresJson(f));
  for (const auto& file : cleaning->files) files.push_back(file.string());
  outcome.answer = {
      {"points_in", cleaning->points_in}, {"points_out", cleaning->points_out}, {"filters", std::move(rows)}};
  if (!report.empty())
    if (auto written =
            writeReport(report, report.extension() == ".csv" ? csv(*cleaning) : outcome.answer.dump(2) + "\n");
        !written)
      return failure(written.error());
  outcome.answer["files"] = std::move(files);
  outcome.description = fmt::format("Cleaned {}: kept {} of {} points", in.filename().string(), cleaning->points_out,
                                    cleaning->points_in);
  outcome.text = table(*cleaning);
  return outcome;
}

}  // namespace standpoint
