// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/man_pages.h"

#include <cctype>
#include <string_view>

#include <fmt/format.h>

#include "cli/option_words.h"

namespace standpoint {

namespace {

// Text as roff: a hyphen that can be copied, and no line that is taken for a request.
std::string roff(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (out.empty() && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\') {
      out += "\\e";
    } else {
      if (c == '-') out += '\\';
      out += c;
    }
  }
  return out;
}

std::string bold(std::string_view text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + roff(text) + "\\fR"; }

std::string capitals(std::string text) {
  for (auto& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

// A summary inside of a sentence.
std::string small(std::string text) {
  if (text.size() > 1 && std::islower(static_cast<unsigned char>(text[1])) != 0)
    text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

std::string row(const std::string& head, const std::string& text) { return ".TP\n" + head + "\n" + text + "\n"; }

std::string headOf(const Parameter& p) {
  if (p.positional) return italic(spelling(p));
  const auto head = bold(spelling(p));
  return p.kind == ParameterKind::flag ? head : head + " " + italic(placeholder(p));
}

std::string textOf(const Parameter& p) {
  std::string text = roff(fullHelp(p));
  const auto value = defaultOf(p);
  const auto named = p.required || value.empty() ? value : "default " + value;
  std::string more = p.kind == ParameterKind::flag || p.kind == ParameterKind::text ? "" : domainOf(p);
  if (!named.empty()) more += (more.empty() ? "" : "; ") + named;
  return text + (more.empty() ? "." : fmt::format(" ({}).", roff(more)));
}

}  // namespace

std::string manPage(const Verb& verb) {
  std::string page = ".\\\" Generated from the table of verbs (cli/man_pages.cpp).\n";
  page += fmt::format(".TH STANDPOINT\\-{} 1 \"\" \"Standpoint\" \"Standpoint\"\n", roff(capitals(verb.name)));
  page += fmt::format(".SH NAME\nstandpoint\\-{} \\- {}\n", roff(verb.name), roff(small(verb.summary)));
  page += fmt::format(".SH SYNOPSIS\n{} [{}]\n", bold("standpoint " + call(verb)), italic("OPTIONS"));
  page += fmt::format(".SH DESCRIPTION\n{}.\n.SH OPTIONS\n", roff(verb.summary));
  if (takesProject(verb)) page += row(italic("PROJECT"), "the project's folder.");
  for (const auto& p : verb.parameters) page += row(headOf(p), textOf(p));
  page +=
      row(bold("--json"), "print the result as one JSON object on standard output; progress goes to standard error.");
  page += row(bold("--allow-loss"), "exit with code 0 even if data was lost.");
  page += row(bold("--all-issues"), "list every issue, also where more than 20 are alike.");
  page += ".SH EXIT STATUS\nAs of every verb: see\n.BR standpoint (1).\n.SH SEE ALSO\n.BR standpoint (1)\n";
  return page;
}

std::string manPageWithVerbs(std::span<const Verb> verbs, std::string page) {
  const auto mark = page.find(kManVerbsMark);
  if (mark == std::string::npos) return page;
  std::string rows;
  for (const auto& verb : verbs)
    rows += row(fmt::format("\\fBstandpoint\\-{}\\fR(1)", roff(verb.name)), roff(verb.summary) + ".");
  return page.replace(mark, std::string_view(kManVerbsMark).size(), rows);
}

}  // namespace standpoint
