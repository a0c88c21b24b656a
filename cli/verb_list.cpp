// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/verb_list.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/option_words.h"

namespace standpoint {

namespace {

std::string inCell(std::string text) {
  for (std::size_t i = 0; (i = text.find('|', i)) != std::string::npos; i += 2) text.insert(i, 1, '\\');
  return text;
}

// `page` with a row for each verb below the head of its table of verbs, where it has one.
std::string withTable(std::span<const Verb> verbs, std::string page) {
  const auto head = page.find(kVerbTableHead);
  if (head == std::string::npos) return page;
  const auto first = head + std::string_view(kVerbTableHead).size();
  auto end = first;
  while (page.compare(end, 1, "|") == 0) end = std::min(page.find('\n', end), page.size() - 1) + 1;
  std::string rows;
  for (const auto& verb : verbs)
    rows += fmt::format("| [`{}`](#{}) | {} |\n", call(verb), verb.name, inCell(verb.summary));
  return page.replace(first, end - first, rows);
}

}  // namespace

std::string verbList(std::span<const Verb> verbs, const std::string& introduction) {
  std::string page = withTable(verbs, introduction) + kVerbListMark;
  for (const auto& verb : verbs) {
    page += fmt::format("\n## {}\n\n{}.\n\n`standpoint {} [OPTIONS]`\n\n", verb.name, verb.summary, call(verb));
    page += "| option | value | default | effect |\n|---|---|---|---|\n";
    for (const auto& p : verb.parameters)
      page += fmt::format("| `{}` | {} | {} | {} |\n", spelling(p),
                          p.kind == ParameterKind::flag ? "" : inCell(domainOf(p)), inCell(defaultOf(p)),
                          inCell(fullHelp(p)));
  }
  return page;
}

}  // namespace standpoint
