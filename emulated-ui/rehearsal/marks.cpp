// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/marks.h"

#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include "emulated-ui/device/format.h"
#include "emulated-ui/rehearsal/setup_picture.h"

namespace standpoint {

namespace {

using nlohmann::json;

// A hint costs half of its step.
constexpr double kHinted = 0.5;

std::string unitOf(const std::string& fact) {
  for (const auto& row : proofRows())
    if (fact == row.name) return row.unit;
  return {};
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') out += "&amp;";
    else if (c == '<') out += "&lt;";
    else if (c == '>') out += "&gt;";
    else if (c == '"') out += "&quot;";
    else out += c;
  }
  return out;
}

std::string textOf(const json& value) {
  return value.is_string() ? value.get<std::string>() : value.is_null() ? std::string() : value.dump();
}

// A demand that nothing asked is not met, but it says nothing of the data either.
std::string neverAsked(const Rehearsal& rehearsal, const ExerciseRule& rule, const std::string& language) {
  const auto& words = *rehearsal.device().type().words;
  return words.text({}, "never_asked", language) + ": " + words.text({}, "never." + rule.event, language);
}

}  // namespace

json marksOf(const Rehearsal& rehearsal, const std::string& student, const std::string& language) {
  const auto& e = rehearsal.exercise();
  double points = 0, possible = 0;
  bool must = true;
  json steps = json::array(), rules = json::array();
  for (std::size_t i = 0; i < e.steps.size(); ++i) {
    const auto& step = e.steps[i];
    const auto& state = rehearsal.steps()[i];
    const double earned = state.done ? step.points * (state.hinted ? kHinted : 1) : 0;
    points += earned;
    possible += step.points;
    steps.push_back({{"id", step.id}, {"text", step.text.in(language)}, {"expected", step.done.text()}, {"done", state.done},
                     {"at_s", state.done ? json(state.at_s) : json(nullptr)}, {"hinted", state.hinted}, {"points", earned}, {"of", step.points}});
  }
  const auto judged = rehearsal.judge();
  for (std::size_t i = 0; i < e.rules.size(); ++i) {
    const auto& rule = e.rules[i];
    const auto& state = judged[i];
    points += state.held ? rule.points : 0;
    possible += rule.points;
    must = must && (state.held || !rule.must);
    json row = {{"id", rule.id},
                {"text", rule.text.in(language)},
                {"expected", rule.holds.text()},
                {"found", state.asked ? state.found : neverAsked(rehearsal, rule, language)},
                {"asked", state.asked},
                {"held", state.held},
                {"must", rule.must},
                {"points", state.held ? rule.points : 0},
                {"of", rule.points}};
    if (!state.held) {
      row["at_s"] = state.broken_at_s >= 0 ? json(state.broken_at_s) : json(nullptr);
      if (!rule.mistake.empty()) row["mistake"] = rule.mistake;
      if (state.asked && !rule.because.texts.empty()) row["because"] = rule.because.in(language);
    }
    if (state.asked && !rule.proof.empty())
      if (const auto proof = rehearsal.fact(rule.proof))
        row["proof"] = {{"fact", rule.proof}, {"value", proof->number ? json(*proof->number) : json(proof->text)}, {"unit", unitOf(rule.proof)}};
    rules.push_back(std::move(row));
  }
  const double score = possible > 0 ? points / possible : 1;
  json actions = json::array(), files = json::array(), failures = json::array();
  for (const auto& failed : rehearsal.failures())
    failures.push_back({{"at_s", failed.at_s}, {"reason", failed.reason}});
  for (const auto& action : rehearsal.actions()) actions.push_back(toJson(action));
  for (const auto& project : rehearsal.device().state().projects)
    for (const auto& setup : project.setups) files.push_back({{"file", setup.file}, {"station", setup.station}, {"points", setup.points}});
  const bool in_time = !rehearsal.overTime();
  return {{"exercise", e.id},
          {"title", e.title.in(language)},
          {"device", rehearsal.device().type().definition.title},
          {"instrument", rehearsal.device().type().instrument.id},
          {"student", student},
          {"operator", rehearsal.device().value("operator")},
          {"passed", must && in_time && score >= e.pass_mark},
          {"score", score},
          {"pass_mark", e.pass_mark},
          {"seconds", rehearsal.seconds()},
          {"time_limit_s", e.time_limit_s},
          {"in_time", in_time},
          {"steps", std::move(steps)},
          {"rules", std::move(rules)},
          {"failures", std::move(failures)},
          {"actions", std::move(actions)},
          {"files", std::move(files)}};
}

std::string marksText(const json& m) {
  std::string text = fmt::format("{} {} with {}: {}, {:.0f} % of the points, {} of the device's time\n", m["exercise"].get<std::string>(),
                                 m["title"].get<std::string>(), m["device"].get<std::string>(), m["passed"].get<bool>() ? "passed" : "not passed",
                                 m["score"].get<double>() * 100, clockText(m["seconds"].get<double>()));
  for (const auto& s : m["steps"]) text += fmt::format("  {} {}\n", s["done"].get<bool>() ? "[x]" : "[ ]", s["text"].get<std::string>());
  for (const auto& r : m["rules"]) {
    text += fmt::format("  {} {}: {}\n", r["held"].get<bool>() ? "[x]" : "[ ]", r["text"].get<std::string>(), r["found"].get<std::string>());
    if (r.contains("because")) text += fmt::format("        {}\n", r["because"].get<std::string>());
    if (!r["held"].get<bool>() && r.contains("proof"))
      text += fmt::format("        your points: {} = {} {}\n", r["proof"]["fact"].get<std::string>(), textOf(r["proof"]["value"]), r["proof"]["unit"].get<std::string>());
  }
  for (const auto& f : m["failures"])
    text += fmt::format("  failed after {}: {}\n", clockText(f["at_s"].get<double>()), f["reason"].get<std::string>());
  return text;
}

std::string marksCsv(const json& m) {
  std::string csv = "exercise,student,device,kind,id,text,expected,found,held,points,of\r\n";
  const auto row = [&](const char* kind, const json& r, const std::string& found, bool held) {
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\r\n", quoted(m["exercise"]), quoted(m["student"]), quoted(m["device"]), kind, quoted(r["id"]),
                       quoted(r["text"]), quoted(r["expected"]), quoted(found), held ? 1 : 0, r["points"].get<double>(), r["of"].get<double>());
  };
  for (const auto& s : m["steps"]) row("step", s, s["done"].get<bool>() ? fmt::format("done at {:.0f} s", s["at_s"].get<double>()) : "not done", s["done"]);
  for (const auto& r : m["rules"]) row("rule", r, r["found"], r["held"]);
  for (const auto& f : m["failures"])
    csv += fmt::format("{},{},{},failure,,{},,failed at {:.0f} s,,,\r\n", quoted(m["exercise"]), quoted(m["student"]),
                       quoted(m["device"]), quoted(f["reason"]), f["at_s"].get<double>());
  csv += fmt::format("{},{},{},total,,,,,{},{:.4f},1\r\n", quoted(m["exercise"]), quoted(m["student"]), quoted(m["device"]), m["passed"].get<bool>() ? 1 : 0, m["score"].get<double>());
  return csv;
}

std::string marksHtml(const json& m, const Rehearsal& rehearsal) {
  const bool passed = m["passed"].get<bool>();
  std::string html = fmt::format(
      "<!doctype html><html><head><meta charset=\"utf-8\"><title>{0}</title><style>"
      "body{{font:15px/1.45 sans-serif;color:#222;max-width:48em;margin:3em auto;padding:0 1em}}h1{{font-size:1.6em;margin:0}}"
      "table{{border-collapse:collapse;width:100%;margin:1em 0}}td,th{{border-bottom:1px solid #ddd;padding:.4em .5em;text-align:left;vertical-align:top}}"
      ".n{{text-align:right;white-space:nowrap}}.no{{color:#a11}}.yes{{color:#171}}small{{color:#666}}img{{width:100%;margin:.3em 0 1em}}"
      ".mark{{font-size:1.3em;margin:.6em 0}}@media print{{body{{margin:0}}}}</style></head><body>\n<small>Standpoint rehearsal</small><h1>{0}</h1>\n",
      escaped(m["exercise"].get<std::string>() + " · " + m["title"].get<std::string>()));
  html += fmt::format("<p class=\"mark {}\"><b>{}</b>, {:.0f} % of the points ({:.0f} % are needed)</p>\n", passed ? "yes" : "no", passed ? "Passed" : "Not passed",
                      m["score"].get<double>() * 100, m["pass_mark"].get<double>() * 100);
  const auto named = [&](const char* who, const char* as) { return m[who].get<std::string>().empty() ? "" : as + escaped(m[who]) + " · "; };
  html += fmt::format("<p>{}{}{} · {} of the device's time</p>\n", named("student", ""), named("operator", "operator "), escaped(m["device"]),
                      clockText(m["seconds"].get<double>()));
  html += "<table><tr><th>Step or demand</th><th>Expected</th><th>Found</th><th class=\"n\">Points</th></tr>\n";
  const auto row = [&](const json& r, bool held, std::string found) {
    if (r.contains("because")) found += "<br><small>" + escaped(r["because"]) + "</small>";
    if (r.contains("proof")) found += fmt::format("<br><small>points: {} = {} {}</small>", escaped(r["proof"]["fact"]), escaped(textOf(r["proof"]["value"])), escaped(r["proof"]["unit"]));
    html += fmt::format("<tr><td class=\"{}\">{} {}</td><td><small>{}</small></td><td>{}</td><td class=\"n\">{:g} / {:g}</td></tr>\n", held ? "yes" : "no", held ? "✓" : "✗",
                        escaped(r["text"]), escaped(r["expected"]), found, r["points"].get<double>(), r["of"].get<double>());
  };
  for (const auto& s : m["steps"]) row(s, s["done"], s["done"].get<bool>() ? fmt::format("after {}", clockText(s["at_s"].get<double>())) : "–");
  for (const auto& r : m["rules"]) row(r, r["held"], escaped(r["found"]));
  html += "</table>\n";
  for (const auto& f : m["failures"])
    html += fmt::format("<p class=\"no\">Failed after {}: {}</p>\n", clockText(f["at_s"].get<double>()),
                        escaped(f["reason"].get<std::string>()));
  for (const auto& project : rehearsal.device().state().projects)
    for (const auto& setup : project.setups) {
      const auto picture = setupPicture(setup);
      if (picture.empty()) continue;
      html += fmt::format("<p><b>{}</b> at {}: {} points</p><img alt=\"{}\" src=\"data:image/png;base64,{}\">\n", escaped(setup.name), escaped(setup.station), setup.points,
                          escaped(setup.name), picture);
    }
  return html + "<p><small>The device is emulated by Standpoint; it is not affiliated with or endorsed by its maker.</small></p>\n</body></html>\n";
}

Result<void> writeMarks(const Rehearsal& rehearsal, const json& marks, const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return failure(ErrorKind::file_system, "cannot create the folder: " + error.message(), folder.string());
  const std::pair<const char*, std::string> kFiles[] = {{"result.json", marks.dump(2) + "\n"}, {"result.csv", marksCsv(marks)}, {"result.html", marksHtml(marks, rehearsal)}};
  for (const auto& [name, text] : kFiles) {
    std::ofstream out(folder / name, std::ios::binary);
    out << text;
    out.close();
    if (!out) return failure(ErrorKind::file_system, "cannot write it: is the disk full?", (folder / name).string());
  }
  return {};
}

}  // namespace standpoint
