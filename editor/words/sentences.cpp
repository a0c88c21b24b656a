// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/words/sentences.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/args.h>

#include "core/data_folder.h"
#include "core/report_words.h"
#include "editor/words/figures.h"
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
std::optional<std::vector<std::string_view>> placesIn(std::string_view text, std::string_view pattern) {
  std::vector<std::string_view> places;
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
    places.push_back(text.substr(0, end));
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

struct Match {
  std::string_view pattern;  // empty: none
  std::vector<std::string_view> places;
};

// The sentence with the most words of its own that the text is.
Match matchOf(std::string_view english) {
  Match nearest;
  for (const auto word : {firstWord(english), std::string_view()}) {
    const auto known = sentencesByWord().find(word);
    if (known == sentencesByWord().end()) continue;
    for (const auto pattern : known->second) {
      if (pattern.size() <= nearest.pattern.size() || !english.ends_with(pattern.substr(pattern.rfind("{}") + 2)))
        continue;
      if (auto found = placesIn(english, pattern)) nearest = {pattern, std::move(*found)};
    }
  }
  return nearest;
}

// What has a figure without a unit behind it. Elsewhere a number without a unit may be the name of a room: "1.01".
bool announcesFigure(std::string_view before) {
  static constexpr std::array<std::string_view, 12> kWords = {
      "scale ",  "confidence ", "refraction ",  "transmission ", "length ", "factor ",
      "height ", "floor at ",   "floor is at ", "score ",        "least ",  "most "};
  return std::any_of(kWords.begin(), kWords.end(), [&](auto word) { return before.ends_with(word); });
}

// Figures that are drawn have the decimal sign of the language; a report's other figures have the point, and so have
// those of its sentences.
enum class Sign { of_language, point };

struct Said {
  std::string text;
  bool name_first = false;  // it begins with what stands in a place, and has no translation
};
Said said(std::string_view english, Sign sign);

// A name within a place, "IfcWall 'North'", in the quotation marks of the language.
std::string quoted(std::string text) {
  const auto open = text.find('\''), close = text.rfind('\'');
  const bool named = open != std::string::npos && close > open + 1 && (open == 0 || text[open - 1] == ' ') &&
                     (close + 1 == text.size() || text[close + 1] == ' ') && text.find('\'', open + 1) == close;
  if (!named) return text;
  return text.substr(0, open) + trf("'{}'", text.substr(open + 1, close - open - 1)) + text.substr(close + 1);
}

// What stands in a place, in the language that is spoken. In quotes is what somebody has typed.
std::string inPlace(std::string_view sentence, std::string_view place, Sign sign) {
  const auto begin = static_cast<std::size_t>(place.data() - sentence.data());
  const auto before = sentence.substr(0, begin);
  const bool typed = before.ends_with('\'') && place.find('.') != std::string_view::npos;
  if (place == sentence || typed) return tr(place);
  if (sign == Sign::point) return said(place, sign).text;
  if (!isFigure(place)) {
    auto text = said(place, sign).text;
    const auto end = place.find("; ");
    if (text == place && end != std::string_view::npos)  // a list, of materials say
      return inPlace(sentence, place.substr(0, end), sign) + "; " + inPlace(sentence, place.substr(end + 2), sign);
    return quoted(std::move(text));
  }
  return hasUnit(sentence, begin + place.size()) || announcesFigure(before) ? asFigure(std::string(place))
                                                                            : std::string(place);
}

bool beginsWithName(const Match& match, const std::vector<std::string>& places) {
  const auto translation = tr(match.pattern);
  if (!translation.starts_with('{')) return false;
  const auto number = translation.size() > 1 && std::isdigit(static_cast<unsigned char>(translation[1])) != 0
                          ? static_cast<std::size_t>(translation[1] - '0')
                          : 0;
  return number < places.size() && places[number] == match.places[number];
}

Said said(std::string_view english, Sign sign) {
  if (auto whole = tr(english); whole != english || spoken() == "en") return {std::move(whole)};
  const auto match = matchOf(english);
  if (match.places.empty()) return {sign == Sign::point ? std::string(english) : figuresIn(std::string(english))};
  std::vector<std::string> places;
  for (const auto place : match.places) places.push_back(inPlace(english, place, sign));
  fmt::dynamic_format_arg_store<fmt::format_context> arguments;
  for (const auto& place : places) arguments.push_back(std::cref(place));
  return {trFormatted({match.pattern.data(), match.pattern.size()}, arguments), beginsWithName(match, places)};
}

}  // namespace

const std::vector<std::string>& sentences() {
  static const auto all =
      catalogueOfContext(dataFolder() / "editor/words" / languages()[1].code / "LC_MESSAGES/editor.mo", "sentence");
  return all;
}

std::string trSentence(std::string_view english) {
  return said(countsIn(std::string(english)), Sign::of_language).text;
}

void printReportsAsSpoken() {
  printReportsIn(std::make_shared<const ReportWords>(ReportWords{
      [] { return std::string(spoken()); }, [](std::string_view english) { return said(english, Sign::point).text; }}));
}

namespace {

// The first letter, Latin or Cyrillic, in UTF-8.
void capitalise(std::string& text) {
  const auto first = static_cast<unsigned char>(text[0]);
  if (first < 0x80 || text.size() < 2) {
    text[0] = static_cast<char>(std::toupper(first));
    return;
  }
  const auto become = [&](int lead, int last) { text[0] = static_cast<char>(lead), text[1] = static_cast<char>(last); };
  const int second = static_cast<unsigned char>(text[1]);
  if (first == 0xC3 && second >= 0xA0 && second != 0xB7 && second != 0xBF) become(0xC3, second - 0x20);  // ä
  if (first == 0xD0 && second >= 0xB0) become(0xD0, second - 0x20);                                      // а to п
  if (first == 0xD1 && second < 0x90) become(0xD0, second + 0x20);                                       // р to я
  if (first == 0xD1 && second >= 0x90 && second < 0xA0) become(0xD0, second - 0x10);                     // і, ї, є
  if (first == 0xD2 && second == 0x91) become(0xD2, 0x90);                                               // ґ
}

}  // namespace

std::string shownSentence(std::string_view english) {
  Said shown = said(countsIn(std::string(english)), Sign::of_language);
  std::string text = std::move(shown.text);
  if (shown.name_first) return text;
  const auto word = text.substr(0, text.find(' '));
  // Not "glTF", either.
  const auto isPlain = [](unsigned char c) {
    return (std::isalpha(c) != 0 && std::isupper(c) == 0) || c == '-' || c >= 0x80;
  };
  const auto letters = word.ends_with(':') || word.ends_with(',') ? word.size() - 1 : word.size();
  const bool plain = letters > 0 && text[0] != '-' &&
                     std::all_of(word.begin(), word.begin() + static_cast<std::ptrdiff_t>(letters), isPlain);
  if (plain) capitalise(text);
  return text;
}

std::string trError(const Error& error) { return describe(Error{error.kind, trSentence(error.message), error.source}); }

}  // namespace standpoint
