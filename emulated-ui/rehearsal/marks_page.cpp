// SPDX-License-Identifier: GPL-3.0-or-later
#include <initializer_list>
#include <utility>

#include <fmt/format.h>

#include "core/html_text.h"
#include "emulated-ui/device/format.h"
#include "emulated-ui/device/replaced.h"
#include "emulated-ui/rehearsal/marks.h"
#include "emulated-ui/rehearsal/setup_picture.h"

namespace standpoint {

namespace {

constexpr const char* kStyle =
    "body{font:15px/1.45 sans-serif;color:#222;max-width:48em;margin:3em auto;padding:0 "
    "1em}h1{font-size:1.6em;margin:0}"
    "table{border-collapse:collapse;width:100%;margin:1em 0}"
    "td,th{border-bottom:1px solid #ddd;padding:.4em .5em;text-align:left;vertical-align:top}"
    ".about{width:auto}.about td,.about th{border:0;padding:.1em 1em .1em 0}.about th{font-weight:normal;color:#666}"
    ".n{text-align:right;white-space:nowrap}.no{color:#a11}.yes{color:#171}small{color:#666}"
    "figure{margin:0}img{width:100%;margin:.3em 0 1em}.mark{font-size:1.3em;margin:.6em 0}"
    "@page{size:A4;margin:18mm 16mm}tr,figure,img{break-inside:avoid}thead{display:table-header-group}"
    "@media print{body{margin:0;max-width:none;padding:0;font-size:10.5pt}}";

// The certificate in the making.
class Page {
 public:
  Page(const Marks& marks, const Rehearsal& rehearsal) : m_(marks), rehearsal_(rehearsal) {}

  std::string whole(const std::string& date) {
    const auto title = htmlText(m_.exercise + " · " + m_.title);
    html_ = fmt::format(
        "<!doctype html><html lang=\"{}\"><head><meta "
        "charset=\"utf-8\"><title>{}</title><style>{}</style></head><body>\n"
        "<small>{}</small><h1>{}</h1>\n",
        htmlText(m_.language), title, kStyle, word("rehearsal"), title);
    addOutcome();
    addAbout(date);
    addDemands();
    addAnswers();
    for (const auto& f : m_.failures)
      html_ += fmt::format("<p class=\"no\">{}: {}</p>\n", word("failed", {{"{time}", clockText(f.at_s)}}),
                           htmlText(f.reason));
    addPictures();
    return html_ + "<p><small>" + word("emulated") + "</small></p>\n</body></html>\n";
  }

 private:
  using Places = std::initializer_list<std::pair<const char*, std::string>>;

  // Of the marks' words, with its places filled; to be put into the page as it is.
  std::string word(const std::string& key, Places places = {}) const {
    auto out = rehearsal_.device().type().words->text({}, "marks." + key, m_.language);
    for (const auto& [place, by] : places) out = replaced(std::move(out), place, by);
    return htmlText(out);
  }

  void addOutcome() {
    const bool passed = m_.passed;
    html_ += fmt::format("<p class=\"mark {}\"><b>{}</b>, {}</p>\n", passed ? "yes" : "no",
                         word(passed ? "passed" : "not_passed"),
                         word("score", {{"{score}", percentText(m_.score)}, {"{needed}", percentText(m_.pass_mark)}}));
    if (!m_.must_broken.empty())
      html_ += fmt::format("<p class=\"no\">{}: {}</p>\n", word("must_broken"), htmlText(brokenDemands(m_)));
    if (!m_.in_time)
      html_ += fmt::format("<p class=\"no\">{}</p>\n", word("over_time", {{"{limit}", clockText(m_.time_limit_s)}}));
  }

  void addAbout(const std::string& date) {
    const auto row = [&](const std::string& name, const std::string& value) {
      if (!value.empty()) html_ += fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", name, htmlText(value));
    };
    const auto& words = *rehearsal_.device().type().words;
    html_ += "<table class=\"about\">\n";
    row(word("student"), m_.student);
    row(htmlText(words.text({}, "note.operator", m_.language)), m_.operator_name);
    row(word("goal"), m_.goal);
    row(word("instrument"), m_.maker + " " + m_.model);
    row(word("date"), date);
    row(word("time"), clockText(m_.seconds));
    row(word("hints"), fmt::format("{:.0f}", m_.hints));
    html_ += "</table>\n";
  }

  // A step or a rule.
  template <class Demand>
  void addDemand(const Demand& d, const std::string& name, bool held, const std::string& found) {
    html_ += fmt::format(
        "<tr><td class=\"{}\">{} {}</td><td><small>{}</small></td><td>{}</td><td class=\"n\">{:g} / {:g}</td></tr>\n",
        held ? "yes" : "no", held ? "✓" : "✗", name, htmlText(d.expected_text), found, d.points, d.of);
  }

  void addDemands() {
    html_ += fmt::format("<table><tr><th>{}</th><th>{}</th><th>{}</th><th class=\"n\">{}</th></tr>\n", word("demand"),
                         word("expected"), word("found"), word("points"));
    for (const auto& s : m_.steps) {
      auto found = s.done ? word("after", {{"{time}", clockText(*s.at_s)}}) : "–";
      if (s.hinted) found += "<br><small>" + word("hinted") + "</small>";
      addDemand(s, htmlText(s.text), s.done, found);
    }
    for (const auto& r : m_.rules) {
      auto found = htmlText(r.found_text);
      if (r.because) found += "<br><small>" + htmlText(*r.because) + "</small>";
      if (r.cost) found += "<br><small>" + word("cost") + ": " + htmlText(*r.cost) + "</small>";
      if (r.proof)
        found += fmt::format("<br><small>{}: {}: {}</small>", word("proof"), htmlText(r.proof->name),
                             htmlText(r.proof->text));
      if (r.place)
        found += fmt::format("<br><small>{}: {} (x {:.2f}, y {:.2f}, z {:.2f} m)</small>", word("place"),
                             htmlText(r.place->text), r.place->x_m, r.place->y_m, r.place->z_m);
      addDemand(r, htmlText(r.text) + (r.must ? "<br><small>" + word("must") + "</small>" : ""), r.held, found);
    }
    html_ += "</table>\n";
  }

  void addAnswers() {
    if (m_.answers.empty()) return;
    html_ += fmt::format("<table><tr><th>{}</th><th>{}</th></tr>\n", word("question"), word("answer"));
    for (const auto& a : m_.answers)
      html_ += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", htmlText(a.question),
                           a.value.empty() ? word("unanswered") : htmlText(a.answer));
    html_ += "</table>\n";
  }

  void addPictures() {
    for (const auto& project : rehearsal_.device().state().projects)
      for (const auto& setup : project.setups) {
        const auto picture = setupPicture(setup);
        if (picture.empty()) continue;
        html_ += fmt::format(
            "<figure><figcaption>{}</figcaption><img alt=\"{}\" src=\"data:image/png;base64,{}\"></figure>\n",
            word("setup",
                 {{"{name}", setup.name}, {"{station}", setup.station}, {"{points}", fmt::format("{}", setup.points)}}),
            htmlText(setup.name), picture);
      }
  }

  const Marks& m_;
  const Rehearsal& rehearsal_;
  std::string html_;
};

}  // namespace

std::string marksHtml(const Marks& marks, const Rehearsal& rehearsal, const std::string& date) {
  return Page(marks, rehearsal).whole(date);
}

}  // namespace standpoint
