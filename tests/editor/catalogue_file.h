// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace standpoint {

// The texts of a .po file by their English ones, as far as our own files go: msgid, msgid_plural, msgstr over lines.
// Those with a context are among them.
struct CatalogueText {
  std::string plural;              // English; empty: one form
  std::vector<std::string> forms;  // translated
};

inline std::string withoutEscapes(const std::string& quoted) {
  std::string text;
  for (std::size_t i = 0; i < quoted.size(); ++i) {
    if (quoted[i] != '\\' || i + 1 == quoted.size())
      text += quoted[i];
    else
      text += quoted[++i] == 'n' ? '\n' : quoted[i];
  }
  return text;
}

// All of them, where a matcher would show the first ones.
inline std::string oneALine(const std::set<std::string>& texts) {
  std::string all;
  for (const auto& text : texts) all += "\n" + text;
  return all;
}

inline std::map<std::string, CatalogueText> textsOf(const std::string& file) {
  std::map<std::string, CatalogueText> all;
  std::ifstream in(file);
  std::string english, *begun = nullptr;
  CatalogueText text;
  const auto keep = [&] {
    if (!english.empty()) all[english] = text;
    english.clear();
    text = {};
  };
  for (std::string line; std::getline(in, line);) {
    const auto from = line.find('"'), to = line.rfind('"');
    if (line.starts_with("msgctxt ")) keep(), begun = nullptr;
    if (line.starts_with("msgid ")) keep(), begun = &english;
    if (line.starts_with("msgid_plural ")) begun = &text.plural;
    if (line.starts_with("msgstr")) begun = &text.forms.emplace_back();
    if (begun != nullptr && from < to) *begun += withoutEscapes(line.substr(from + 1, to - from - 1));
  }
  keep();
  return all;
}

}  // namespace standpoint
