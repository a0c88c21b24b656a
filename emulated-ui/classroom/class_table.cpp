// SPDX-License-Identifier: GPL-3.0-or-later
#include <initializer_list>

#include <fmt/format.h>

#include "core/csv_text.h"
#include "core/data_folder.h"
#include "core/html_text.h"
#include "emulated-ui/classroom/collect.h"
#include "emulated-ui/classroom/dates.h"
#include "emulated-ui/device/format.h"
#include "emulated-ui/device/words.h"

namespace standpoint {

namespace {

constexpr const char* kTableStyle =
    "body{font:14px/1.4 sans-serif;color:#222;max-width:80em;margin:2em auto;padding:0 1em}"
    "h1{font-size:1.5em;margin:0}h2{font-size:1.15em;margin:1.4em 0 .3em}"
    "table{border-collapse:collapse;width:100%}"
    "td,th{border-bottom:1px solid #ccc;padding:.3em .5em;text-align:left;vertical-align:top}"
    "th{white-space:nowrap}.n{text-align:right;white-space:nowrap}.no{color:#a11}.yes{color:#171}small{color:#595959}"
    ".about{width:auto}.about td,.about th{border:0;padding:.1em 1.5em .1em 0}.about "
    "th{font-weight:normal;color:#595959}"
    "@page{size:A4 landscape;margin:12mm}tr{break-inside:avoid}thead{display:table-header-group}"
    "@media print{body{margin:0;max-width:none;padding:0;font-size:9.5pt}}";

std::string shownPercent(double share) { return fmt::format("{:.0f} %", 100 * share); }

std::string joined(const std::vector<std::string>& texts, const char* between = ", ") {
  return fmt::format("{}", fmt::join(texts, between));
}

// A computer room may share one key: then a few of them do.
std::string someOf(const std::vector<std::string>& texts) {
  constexpr std::size_t kMost = 3;
  if (texts.size() <= kMost) return joined(texts);
  return joined({texts.begin(), texts.begin() + kMost}) + fmt::format(", +{}", texts.size() - kMost);
}

// The table in the making.
class ClassPage {
 public:
  ClassPage(const CollectedClass& c, std::string language, bool names)
      : c_(c), language_(std::move(language)), names_(names) {
    if (auto words = Words::read(dataFolder() / "emulated-ui" / "words")) words_ = *std::move(words);
  }

  std::string whole(const std::string& date) {
    const auto variant = c_.assignment.exerciseWith(c_.assignment.variants.front());
    const auto title = htmlText(c_.assignment.id() + " · " + (variant ? variant->title.in(language_) : ""));
    html_ = fmt::format(
        "<!doctype html><html lang=\"{}\"><head><meta charset=\"utf-8\"><title>{}: {}</title><style>{}</style></head>"
        "<body>\n<small>{}</small><h1>{}</h1>\n",
        htmlText(language_), word("title"), title, kTableStyle, word("title"), title);
    addAbout(date);
    addStudents();
    addMistakes();
    addCriteria();
    addVariants();
    return html_ + "<p><small>" + word("promise") + "</small></p>\n</body></html>\n";
  }

 private:
  std::string word(const std::string& key) const { return htmlText(words_.text({}, "class." + key, language_)); }

  // `cells` are HTML; those after the first `texts` are figures.
  void row(const char* tag, const std::vector<std::string>& cells, std::size_t figures_from = 99) {
    html_ += "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i)
      html_ += fmt::format("<{}{}>{}</{}>", tag, i >= figures_from ? " class=\"n\"" : "", cells[i], tag);
    html_ += "</tr>\n";
  }
  void beginTable(const std::string& title, const std::vector<std::string>& heads, std::size_t figures_from = 99) {
    html_ += "<h2>" + title + "</h2>\n<table><thead>";
    row("th", heads, figures_from);
    html_ += "</thead><tbody>\n";
  }
  void endTable() { html_ += "</tbody></table>\n"; }

  void addAbout(const std::string& date) {
    const auto& s = c_.statistics;
    std::size_t counted = 0, passed = 0;
    double sum = 0;
    for (const auto& r : c_.results)
      if (r.counts) ++counted, sum += r.verification.marks->score, passed += r.verification.marks->passed ? 1 : 0;
    html_ += "<table class=\"about\">";
    const auto line = [&](const char* key, const std::string& value) {
      html_ += fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", word(key), value);
    };
    line("class", htmlText(c_.assignment.class_name));
    line("deadline", c_.assignment.deadline.empty() ? word("none") : localText(c_.assignment.deadline));
    line("collected", htmlText(date));
    line("students", fmt::format("{}", c_.list.students.size()));
    line("handed_in", fmt::format("{}", counted));
    line("passed", fmt::format("{}", passed));
    if (counted > 0) line("mean", shownPercent(sum / static_cast<double>(counted)));
    if (s.alpha) line("alpha", fmt::format("{:.2f}", *s.alpha));
    html_ += "</table>\n";
  }

  std::string who(const std::string& id) const {
    const auto* student = c_.list.find(id);
    auto text = htmlText(id);
    if (names_ && student != nullptr && !student->name.empty())
      text += "<br><small>" + htmlText(student->name) + "</small>";
    return text;
  }

  void addResult(const CollectedResult& r) {
    const auto& v = r.verification;
    std::string mark = "–", mistakes, verified;
    if (v.verified()) {
      const auto& m = *v.marks;
      mark = fmt::format("<span class=\"{}\">{} {}</span>", m.passed ? "yes" : "no", m.passed ? "✓" : "✗",
                         htmlText(percentText(m.score)));
      mistakes = htmlText(joined(mistakesOf(m)));
      verified = "<span class=\"yes\">✓ " + word("yes") + "</span>";
    } else {
      verified = "<span class=\"no\">✗ " + word("no") + "</span><br><small>" + htmlText(v.why) + "</small>";
    }
    if (r.late) verified += ", <span class=\"no\">" + word("late") + "</span>";
    if (v.verified() && !r.counts) verified += "<br><small>" + word("superseded") + "</small>";
    if (const auto same = c_.same_key.find(r.result.student); same != c_.same_key.end())
      verified += "<br><small>" + word("same_key") + " " + htmlText(someOf(same->second)) + "</small>";
    row("td",
        {who(r.result.student), "<small>" + htmlText(r.result.seed.substr(0, 6)) + "</small>", verified, mistakes,
         localText(r.result.finished), mark, v.verified() ? clockText(v.marks->seconds) : "–",
         v.verified() ? fmt::format("{:.0f}", v.marks->hints) : "–"},
        5);
  }

  void addStudents() {
    beginTable(word("results"),
               {word("student"), word("variant"), word("verified"), word("mistakes"), word("finished"), word("mark"),
                word("time"), word("hints")},
               5);
    std::size_t next = 0;
    const auto addOf = [&](const std::string& id) {
      bool any = false;
      for (; next < c_.results.size() && c_.results[next].result.student == id; ++next)
        addResult(c_.results[next]), any = true;
      return any;
    };
    for (const auto& student : c_.list.students)
      if (!addOf(student.id))
        row("td", {who(student.id), "", "<small>" + word("nothing") + "</small>", "", "", "–", "–", "–"}, 5);
    for (; next < c_.results.size(); ++next) addResult(c_.results[next]);  // not of this class
    endTable();
  }

  // What is behind a mistake's id, in the words of the exercise.
  std::string mistakeText(const std::string& id) const {
    for (const auto& r : c_.results) {
      if (!r.verification.verified()) continue;
      for (const auto& rule : r.verification.marks->rules)
        if (rule.id == id || rule.mistake == id) return rule.text;
      for (const auto& step : r.verification.marks->steps)
        if ("step " + step.id == id) return step.text;
    }
    return {};
  }

  void addMistakes() {
    if (c_.mistakes.empty()) return;
    beginTable(word("commonest"), {word("mistake"), "", word("how_often")}, 2);
    for (const auto& [mistake, count] : c_.mistakes)
      row("td", {htmlText(mistake), htmlText(mistakeText(mistake)), fmt::format("{}", count)}, 2);
    endTable();
  }

  void addCriteria() {
    const auto& s = c_.statistics;
    if (s.results == 0) return;
    const bool enough = s.results >= kEnoughResults;
    std::vector<std::string> heads = {word("criterion"), word("met"), word("facility"), word("interval")};
    if (enough) heads.insert(heads.end(), {word("correlation"), word("discrimination")});
    beginTable(word("criteria"), heads, 1);
    for (const auto& c : s.criteria) {
      std::vector<std::string> cells = {
          htmlText(c.text), fmt::format("{} / {}", c.met, c.of), shownPercent(c.facility),
          fmt::format("{}–{}", shownPercent(c.facility_low), shownPercent(c.facility_high))};
      if (enough) {
        cells.push_back(c.correlation ? fmt::format("{:.2f}", *c.correlation) : "–");
        cells.push_back(c.discrimination ? fmt::format("{:.2f}", *c.discrimination) : "–");
      }
      row("td", cells, 1);
    }
    endTable();
    html_ += "<p><small>" + word("first_only") + (enough ? "" : word("few")) + "</small></p>\n";
  }

  void addVariants() {
    if (c_.assignment.variants.size() < 2) return;
    beginTable(word("variants"), {word("variant"), "", word("students"), word("mean")}, 2);
    for (const auto& variant : c_.assignment.variants) {
      const auto seed = seedText(variant.seed);
      std::vector<std::string> figures;
      for (const auto& [name, value] : variant.figures)
        figures.push_back(name + " = " + (value.is_string() ? value.get<std::string>() : value.dump()));
      const auto found = c_.variant_means.find(seed);
      const bool any = found != c_.variant_means.end();
      row("td",
          {htmlText(seed.substr(0, 6)), htmlText(joined(figures)), any ? fmt::format("{}", found->second.second) : "0",
           any ? shownPercent(found->second.first) : "–"},
          2);
    }
    endTable();
  }

  const CollectedClass& c_;
  std::string language_;
  bool names_;
  Words words_;
  std::string html_;
};

void csvLine(std::string& csv, const std::vector<std::string>& cells) { csv += joined(cells, ",") + "\r\n"; }

std::string figure(const std::optional<double>& value) { return value ? fmt::format("{:.4f}", *value) : std::string(); }

}  // namespace

std::string classHtml(const CollectedClass& collected, const std::string& language, const std::string& date,
                      bool names) {
  return ClassPage(collected, language, names).whole(date);
}

std::string classCsv(const CollectedClass& c) {
  std::string csv;
  csvLine(csv, {"student", "exercise", "variant", "verified", "verdict", "from_action", "late", "counts", "score",
                "points", "of", "passed", "seconds", "hints", "finished", "mistakes", "file"});
  const auto line = [&](const CollectedResult& r) {
    const auto& v = r.verification;
    std::vector<std::string> cells = {
        csvText(r.result.student), csvText(r.result.exercise), csvText(r.result.seed),
        csvText(verifiedText(r)),  csvText(wordOf(v.verdict)), v.from_action ? fmt::format("{}", *v.from_action) : "",
        r.late ? "1" : "0",        r.counts ? "1" : "0"};
    if (v.verified()) {
      const auto& m = *v.marks;
      for (const auto& one :
           {fmt::format("{:.4f}", m.score), fmt::format("{:g}", m.points), fmt::format("{:g}", m.of),
            std::string(m.passed ? "1" : "0"), fmt::format("{:.0f}", m.seconds), fmt::format("{:.0f}", m.hints)})
        cells.push_back(one);
    } else {
      cells.insert(cells.end(), 6, "");
    }
    cells.push_back(csvText(r.result.finished));
    cells.push_back(v.verified() ? csvText(joined(mistakesOf(*v.marks), "; ")) : "");
    cells.push_back(csvText(r.file));
    csvLine(csv, cells);
  };
  for (const auto& r : c.results) line(r);
  for (const auto& student : c.list.students) {
    const bool any = std::any_of(c.results.begin(), c.results.end(),
                                 [&](const CollectedResult& r) { return r.result.student == student.id; });
    if (any) continue;
    std::vector<std::string> cells = {csvText(student.id), csvText(c.assignment.id()), "",
                                      csvText("nothing handed in")};
    cells.insert(cells.end(), 13, "");
    csvLine(csv, cells);
  }
  return csv;
}

std::string criteriaCsv(const CollectedClass& c) {
  std::string csv;
  csvLine(csv, {"kind", "id", "text", "must", "met", "of", "facility", "low", "high", "correlation", "discrimination"});
  for (const auto& s : c.statistics.criteria)
    csvLine(csv, {s.rule ? "rule" : "step", csvText(s.id), csvText(s.text), s.must ? "1" : "0",
                  fmt::format("{}", s.met), fmt::format("{}", s.of), figure(s.facility), figure(s.facility_low),
                  figure(s.facility_high), figure(s.correlation), figure(s.discrimination)});
  return csv;
}

}  // namespace standpoint
