// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/words/sentences.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <fmt/args.h>

#include "core/data_folder.h"
#include "core/report_words.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

// Where a place ends, before the text that follows it; npos: nowhere. Behind that text is `pattern`. Before the last
// place with an end of its own it is the last such text, so "A (b) (2 m²)" has 2 in the last place of "{} ({} m²)".
std::size_t endOfPlace(std::string_view until, std::string_view text, std::string_view pattern) {
  const auto end = pattern.substr(std::min<std::size_t>(2, pattern.size()));
  if (end.empty() || end.find("{}") != std::string_view::npos) return text.find(until);
  return text.size() < end.size() ? std::string_view::npos : text.substr(0, text.size() - end.size()).rfind(until);
}

// What stands in the places of a pattern; nothing where the text is not of it. A place takes as little as it can, and
// nothing only at the end.
std::optional<std::vector<std::string>> placesIn(std::string_view text, std::string_view pattern) {
  std::vector<std::string> places;
  while (true) {
    const auto place = pattern.find("{}");
    if (place == std::string_view::npos) {
      if (text != pattern) return std::nullopt;
      return places;
    }
    if (text.substr(0, place) != pattern.substr(0, place)) return std::nullopt;
    text.remove_prefix(place);
    pattern.remove_prefix(place + 2);
    const auto until = pattern.substr(0, pattern.find("{}"));
    const auto end = until.empty()      ? text.size()
                     : until == pattern ? text.rfind(until)
                                        : endOfPlace(until, text, pattern.substr(until.size()));
    if (end == std::string_view::npos || (end == 0 && !pattern.empty())) return std::nullopt;
    places.emplace_back(text.substr(0, end));
    text.remove_prefix(end);
  }
}

std::string_view firstWord(std::string_view text) { return text.substr(0, text.find(' ')); }

// Sentences with places by their first word; under "" those whose first word has a place.
using ByWord = std::map<std::string_view, std::vector<std::string_view>>;
const ByWord& sentencesByWord() {
  static const auto all = [] {
    ByWord result;
    for (const std::string_view pattern : sentences()) {
      if (pattern.find("{}") == std::string_view::npos) continue;
      const auto word = firstWord(pattern);
      result[word.find("{}") == std::string_view::npos ? word : std::string_view()].push_back(pattern);
    }
    return result;
  }();
  return all;
}

}  // namespace

const std::vector<std::string>& sentences() {
  static const auto all =
      catalogueOfContext(dataFolder() / "editor/words" / languages()[1].code / "LC_MESSAGES/editor.mo", "sentence");
  return all;
}

std::string trSentence(std::string_view english) {
  if (const auto whole = tr(english); whole != english || spoken() == "en") return whole;
  std::string_view nearest;  // with the most words of its own
  std::vector<std::string> places;
  for (const auto word : {firstWord(english), std::string_view()}) {
    const auto known = sentencesByWord().find(word);
    if (known == sentencesByWord().end()) continue;
    for (const auto pattern : known->second) {
      if (pattern.size() <= nearest.size() || !english.ends_with(pattern.substr(pattern.rfind("{}") + 2))) continue;
      if (auto found = placesIn(english, pattern)) nearest = pattern, places = std::move(*found);
    }
  }
  if (places.empty()) return std::string(english);
  fmt::dynamic_format_arg_store<fmt::format_context> arguments;
  for (const auto& place : places) arguments.push_back(place == english ? place : trSentence(place));
  return trFormatted({nearest.data(), nearest.size()}, arguments);
}

void printReportsAsSpoken() {
  printReportsIn(std::make_shared<const ReportWords>(
      ReportWords{[] { return std::string(spoken()); }, [](std::string_view english) { return trSentence(english); }}));
}

std::string shownSentence(std::string_view english) {
  std::string text = trSentence(english);
  const auto word = text.substr(0, text.find(' '));
  const auto isLetter = [](unsigned char c) { return std::isalpha(c) != 0 || c == '-'; };
  const auto letters = word.ends_with(':') || word.ends_with(',') ? word.size() - 1 : word.size();
  const bool plain = letters > 0 && text[0] != '-' &&
                     std::all_of(word.begin(), word.begin() + static_cast<std::ptrdiff_t>(letters), isLetter);
  if (plain) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string trError(const Error& error) { return describe(Error{error.kind, trSentence(error.message), error.source}); }

}  // namespace standpoint
