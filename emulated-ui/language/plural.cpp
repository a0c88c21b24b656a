// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/language/plural.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace standpoint {

namespace {

// One row for the languages that count alike: https://cldr.unicode.org/index/cldr-spec/plural-rules
struct Rule {
  std::vector<std::string_view> languages;
  std::vector<std::string_view> forms;  // of whole numbers below a million
  std::string_view (*form)(double count);
};

bool isWhole(double count) { return count == std::floor(count); }
bool isWholeMillions(double count) { return count > 0 && std::fmod(count, 1e6) == 0; }
// 2 to 4, 22 to 24, but not 12 to 14.
bool isFew(double count) {
  const double ten = std::fmod(count, 10), hundred = std::fmod(count, 100);
  return ten >= 2 && ten <= 4 && !(hundred >= 12 && hundred <= 14);
}

std::string_view germanic(double count) { return count == 1 ? "one" : "other"; }
std::string_view romance(double count) {
  if (isWholeMillions(count)) return "many";  // "1 000 000 de points"
  return germanic(count);
}
std::string_view french(double count) {
  if (isWholeMillions(count)) return "many";
  return count < 2 ? "one" : "other";  // 0, 1, 1,5
}
std::string_view polish(double count) {
  if (!isWhole(count)) return "other";
  if (count == 1) return "one";
  return isFew(count) ? "few" : "many";
}
std::string_view ukrainian(double count) {
  if (!isWhole(count)) return "other";
  if (std::fmod(count, 10) == 1 && std::fmod(count, 100) != 11) return "one";
  return isFew(count) ? "few" : "many";
}

const Rule& ruleOf(std::string_view language) {
  static const std::vector<Rule> rules = {{{"en", "de"}, {"one", "other"}, germanic},
                                          {{"es", "it"}, {"one", "other"}, romance},
                                          {{"fr"}, {"one", "other"}, french},
                                          {{"pl"}, {"one", "few", "many"}, polish},
                                          {{"uk"}, {"one", "few", "many"}, ukrainian}};
  for (const auto& rule : rules)
    if (std::find(rule.languages.begin(), rule.languages.end(), language) != rule.languages.end()) return rule;
  return rules.front();
}

bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

}  // namespace

std::string_view pluralForm(std::string_view language, double count) { return ruleOf(language).form(count); }

std::vector<std::string_view> pluralForms(std::string_view language) { return ruleOf(language).forms; }

char decimalSign(std::string_view language) { return language == "en" ? '.' : ','; }

std::string numberInSentence(std::string figure, std::string_view language) {
  const bool percent_joins = language == "it" || language == "pl";
  if (const auto blank = figure.rfind(" %"); percent_joins && blank != std::string::npos) figure.erase(blank, 1);
  for (std::size_t i = 1; i + 1 < figure.size(); ++i)
    if (figure[i] == '.' && isDigit(figure[i - 1]) && isDigit(figure[i + 1])) figure[i] = decimalSign(language);
  return figure;
}

CountedPart countedPart(std::string_view between_braces) {
  CountedPart part;
  auto bar = between_braces.find('|');
  part.fact = between_braces.substr(0, bar);
  while (bar != std::string_view::npos) {
    const auto next = between_braces.find('|', bar + 1);
    const auto one = between_braces.substr(bar + 1, next == std::string_view::npos ? next : next - bar - 1);
    const auto equals = one.find('=');
    part.forms.push_back({one.substr(0, equals), equals == std::string_view::npos ? "" : one.substr(equals + 1)});
    bar = next;
  }
  return part;
}

std::string_view formFor(const CountedPart& part, std::string_view language, double count) {
  for (const auto name : {pluralForm(language, count), std::string_view("other")})
    for (const auto& form : part.forms)
      if (form.name == name) return form.text;
  return part.forms.empty() ? std::string_view() : part.forms.back().text;
}

}  // namespace standpoint
