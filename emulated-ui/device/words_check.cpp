// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "emulated-ui/device/words.h"
#include "emulated-ui/language/plural.h"

namespace standpoint {

namespace {

constexpr std::string_view kNameOfLanguage = "language=";

std::vector<CountedPart> partsOf(const std::string& text) {
  std::vector<CountedPart> parts;
  for (auto open = text.find('{'); open != std::string::npos; open = text.find('{', open + 1)) {
    const auto end = text.find('}', open);
    if (end == std::string::npos) break;
    parts.push_back(countedPart(std::string_view(text).substr(open + 1, end - open - 1)));
  }
  return parts;
}

// A fact beside whose value a language needs no form of its own is no fault.
std::set<std::string_view> factsOf(const std::vector<CountedPart>& parts) {
  std::set<std::string_view> facts;
  for (const auto& part : parts)
    if (part.forms.empty()) facts.insert(part.fact);
  return facts;
}

std::size_t letters(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

// What stands on a widget: helps, questions and other sentences have lines to spare.
bool isLabel(const std::string& key, const std::string& english) {
  return key.back() != '?' && english.back() != '.' && english.back() != '?' &&
         key.find("dialog.") == std::string::npos && key.find("never.") == std::string::npos;
}

// Twice as long, and a few letters more where there are few; a long label half as much more.
std::size_t roomFor(std::size_t english) {
  constexpr std::size_t kFewLetters = 8, kLong = 20;
  return english > kLong ? std::max(2 * kLong, english * 7 / 5) : std::max(2 * english, english + kFewLetters);
}

std::string wrongForms(const CountedPart& part, const std::string& language) {
  std::set<std::string_view> names;
  for (const auto& form : part.forms) names.insert(form.name);
  for (const auto& needed : pluralForms(language))
    if (!names.contains(needed)) return fmt::format("'{}' lacks the form '{}'", part.fact, needed);
  names.erase("other");  // of fractions
  names.erase("many");   // of millions
  for (const auto& needed : pluralForms(language)) names.erase(needed);
  return names.empty() ? "" : fmt::format("'{}' has no form '{}' here", part.fact, *names.begin());
}

}  // namespace

Report Words::check() const {
  Report report;
  const auto all = languages();
  for (const auto& [key, texts] : texts_) {
    if (key.find(kNameOfLanguage) != std::string::npos) continue;
    const auto english = texts.find("en");
    if (english == texts.end()) {
      const bool shared = key.find('/') != std::string::npos && texts_.contains(key.substr(key.find('/') + 1));
      if (!shared) report.lose(key, fmt::format("has a text in '{}', but none in English", texts.begin()->first));
      continue;
    }
    const auto facts = factsOf(partsOf(english->second));
    for (const auto& language : all) {
      const auto text = texts.find(language);
      const auto place = fmt::format("{} ({})", key, language);
      if (text == texts.end()) {
        report.lose(place, fmt::format("no text for '{}'", english->second));
        continue;
      }
      const auto parts = partsOf(text->second);
      if (factsOf(parts) != facts)
        report.lose(place, fmt::format("'{}' names other facts than '{}'", text->second, english->second));
      for (const auto& part : parts)
        if (!part.forms.empty())
          if (const auto wrong = wrongForms(part, language); !wrong.empty()) report.lose(place, wrong);
      if (isLabel(key, english->second) && letters(text->second) > roomFor(letters(english->second)))
        report.warn(place, fmt::format("'{}' is much longer than '{}'", text->second, english->second));
    }
  }
  for (const auto& language : all)
    if (!texts_.contains(std::string(kNameOfLanguage) + language))
      report.lose(std::string(kNameOfLanguage) + language, "the language has no name");
  return report;
}

}  // namespace standpoint
