// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/html_text.h"
#include "core/number_text.h"
#include "project/dataset/manifest.h"
#include "project/dataset/program_version.h"

namespace standpoint {

namespace {

constexpr const char* kCardStyle =
    R"(body{font:10pt sans-serif;color:#111;background:#fff;max-width:180mm;margin:2em auto}
h1{font-size:16pt}h2{font-size:12pt;margin:1.4em 0 .4em}table{border-collapse:collapse;width:100%}
td,th{border-bottom:1px solid #ccc;padding:3px 6px;text-align:left}td.n,th.n{text-align:right;white-space:nowrap}
img{max-width:100%}
)";

// What both cards say, as rows of name and value.
std::vector<std::pair<std::string, std::string>> aboutSet(const Recipe& recipe, const SetCheck& check) {
  std::uint64_t points = 0, bytes = 0;
  std::set<std::string> stations;
  for (const auto& scan : check.scans) {
    points += scan.record.points;
    for (const auto& file : scan.record.files) bytes += file.bytes;
    stations.insert(recipe.environments[scan.place.environment].id + "/" + scan.place.station);
  }
  return {{"Version", recipe.version},
          {"Date", recipe.date},
          {"Creator", recipe.creator},
          {"License", recipe.license},
          {"Environments", std::to_string(recipe.environments.size())},
          {"Stations", std::to_string(stations.size())},
          {"Scans", std::to_string(check.scans.size())},
          {"Points", groupedDigits(points)},
          {"Bytes of clouds and labels", groupedDigits(bytes)},
          {"Seed", std::to_string(recipe.seed)},
          {"Made with", fmt::format("Standpoint {}", programVersion())}};
}

struct CardRow {
  std::string id, what;
};
// The axes of the recipe, an entry a row.
std::vector<CardRow> axesOf(const Recipe& recipe) {
  std::vector<CardRow> rows;
  for (const auto& i : recipe.instruments) {
    std::string what = i.instrument;
    for (const auto& [key, value] : i.settings) what += fmt::format(" {}={}", key, value);
    rows.push_back({i.id, std::move(what)});
  }
  for (const auto& w : recipe.weather)
    rows.push_back({w.id, w.weather || w.sun || w.interference > 0 ? "weather, as in recipe.json" : "clear air"});
  for (const auto& m : recipe.materials)
    rows.push_back({m.id, m.rules.empty() && m.assign.empty() ? "materials by the rules of the environment"
                                                              : "materials, as in recipe.json"});
  for (const auto& f : recipe.field_faults)
    rows.push_back(
        {f.id, f.fault.any() ? fmt::format("field fault: {}", fmt::join(pairsOf(f.fault), " ")) : "no field fault"});
  for (const auto& e : recipe.effects)
    rows.push_back({e.id, e.ideal     ? "no effects: the first surface on the axis of each pulse, exactly"
                          : e.without ? "without " + FieldValue<Effects>::write(*e.without).get<std::string>()
                                      : "all effects"});
  return rows;
}

// What of the materials the models have nothing for, in the order of the environments.
struct IdleRow {
  std::string environment, materials, what;
};
std::vector<IdleRow> withoutEffect(const Recipe& recipe, const SetCheck& check) {
  std::vector<IdleRow> rows;
  for (std::size_t e = 0; e < check.environments.size(); ++e)
    for (const auto& idle : check.environments[e].without_effect)
      rows.push_back({recipe.environments[e].id, idle.materials, idle.what});
  return rows;
}

}  // namespace

std::string cardMarkdown(const Recipe& recipe, const SetCheck& check) {
  std::string text = fmt::format("# {}\n\n{}\n\n| | |\n|---|---|\n", recipe.name, recipe.description);
  for (const auto& [name, value] : aboutSet(recipe, check)) text += fmt::format("| {} | {} |\n", name, value);
  text += "\n## Environments\n\n| environment | building | split | license |\n|---|---|---|---|\n";
  for (const auto& e : recipe.environments)
    text += fmt::format("| {} | {} | {} | {} |\n", e.id, e.building, recipe.splitOf(e),
                        e.license.empty() ? "not stated" : e.license);
  text += "\n## Plans\n";
  for (const auto& e : recipe.environments)
    text += fmt::format("\n{}\n\n![Plan with its stations]({})\n", e.id, pictureFile(e).generic_string());
  text += "\n## Axes\n\n| id | what |\n|---|---|\n";
  for (const auto& row : axesOf(recipe)) text += fmt::format("| {} | {} |\n", row.id, row.what);
  const auto idle = withoutEffect(recipe, check);
  if (!idle.empty())
    text += "\n## Materials without effect\n\n| environment | materials | matches nothing |\n|---|---|---|\n";
  for (const auto& row : idle) text += fmt::format("| {} | {} | `{}` |\n", row.environment, row.materials, row.what);
  for (std::size_t m = 0; m < recipe.classes.size(); ++m) {
    const auto balance = balanceOf(recipe, check, m);
    text += fmt::format("\n## Classes: {}\n\n![Balance of the classes]({})\n\n| id | class |",
                        recipe.classes[m].map.name, balanceFile(recipe.classes[m]));
    for (const auto& split : balance) text += fmt::format(" {} |", split.split);
    text += "\n|--:|---|";
    for (std::size_t s = 0; s < balance.size(); ++s) text += "--:|";
    text += "\n";
    const auto& classes = recipe.classes[m].map.classes;
    for (std::size_t k = 0; k < classes.size(); ++k) {
      text += fmt::format("| {} | {}{} |", classes[k].id, classes[k].name, classes[k].ignored ? " (ignored)" : "");
      for (const auto& split : balance) text += fmt::format(" {} |", groupedDigits(split.points[k]));
      text += "\n";
    }
  }
  text += "\nEach file is checked by `standpoint dataset verify FOLDER`, or by `sha256sum -c SHA256SUMS`.\n";
  return text;
}

std::string cardHtml(const Recipe& recipe, const SetCheck& check) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>\n<style>{1}</style></head>"
      "<body>\n<h1>{0}</h1>\n<p>{2}</p>\n<table>\n",
      htmlText(recipe.name), kCardStyle, htmlText(recipe.description));
  for (const auto& [name, value] : aboutSet(recipe, check))
    text += fmt::format("<tr><td>{}<td>{}</tr>\n", htmlText(name), htmlText(value));
  text += "</table>\n<h2>Environments</h2>\n<table><tr><th>Environment<th>Building<th>Split<th>License</tr>\n";
  for (const auto& e : recipe.environments)
    text += fmt::format("<tr><td>{}<td>{}<td>{}<td>{}</tr>\n", htmlText(e.id), htmlText(e.building),
                        htmlText(recipe.splitOf(e)), e.license.empty() ? "not stated" : htmlText(e.license));
  text += "</table>\n<h2>Axes</h2>\n<table><tr><th>Id<th>What</tr>\n";
  for (const auto& row : axesOf(recipe))
    text += fmt::format("<tr><td>{}<td>{}</tr>\n", htmlText(row.id), htmlText(row.what));
  text += "</table>\n";
  if (const auto idle = withoutEffect(recipe, check); !idle.empty()) {
    text += "<h2>Materials without effect</h2>\n<table><tr><th>Environment<th>Materials<th>Matches nothing</tr>\n";
    for (const auto& row : idle)
      text += fmt::format("<tr><td>{}<td>{}<td>{}</tr>\n", htmlText(row.environment), htmlText(row.materials),
                          htmlText(row.what));
    text += "</table>\n";
  }
  text += "<h2>Plans</h2>\n";
  for (const auto& e : recipe.environments)
    text += fmt::format("<h3>{0}</h3>\n<p><img src=\"{1}\" alt=\"Plan of {0} with its stations\"></p>\n",
                        htmlText(e.id), pictureFile(e).generic_string());
  for (std::size_t m = 0; m < recipe.classes.size(); ++m) {
    const auto& map = recipe.classes[m];
    text += fmt::format("<h2>Classes: {0}</h2>\n<p><img src=\"{1}\" alt=\"Balance of the classes of {0}\"></p>\n",
                        htmlText(map.map.name), balanceFile(map));
    const auto balance = balanceOf(recipe, check, m);
    text += "<table><tr><th class=\"n\">Id<th>Class";
    for (const auto& split : balance) text += fmt::format("<th class=\"n\">Points: {}", split.split);
    text += "</tr>\n";
    for (std::size_t k = 0; k < map.map.classes.size(); ++k) {
      const auto& one = map.map.classes[k];
      text +=
          fmt::format("<tr><td class=\"n\">{}<td>{}{}", one.id, htmlText(one.name), one.ignored ? " (ignored)" : "");
      for (const auto& split : balance) text += fmt::format("<td class=\"n\">{}", groupedDigits(split.points[k]));
      text += "</tr>\n";
    }
    text += "</table>\n";
  }
  return text + fmt::format("<p>Starved: less than {} % of the points of a split.</p>\n</body></html>\n",
                            100 * recipe.starved_below);
}

}  // namespace standpoint
