// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/plain_words.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "emulated-ui/device/device.h"
#include "emulated-ui/device/format.h"
#include "emulated-ui/device/numbers.h"
#include "emulated-ui/device/replaced.h"
#include "emulated-ui/device/setup_facts.h"
#include "emulated-ui/rehearsal/office_cleaning.h"
#include "emulated-ui/rehearsal/part_proofs.h"
#include "emulated-ui/rehearsal/proofs.h"

namespace standpoint {

namespace {

using Comparison = Condition::Comparison;
using Sign = Condition::Sign;

struct DeviceUnitRow {
  FactUnit unit;
  const char* name;
};
constexpr DeviceUnitRow kDeviceUnits[] = {{FactUnit::seconds, "s"},  {FactUnit::bytes, "B"},
                                          {FactUnit::metres, "m"},   {FactUnit::degrees, "°"},
                                          {FactUnit::celsius, "°C"}, {FactUnit::millimetres, "mm"}};

// Of the facts with a name of their own.
struct NamedUnitRow {
  std::string_view prefix;
  const char* name;
};
constexpr NamedUnitRow kNamedUnits[] = {
    {"place.", "m"}, {"walk.near.", "m"}, {"expected.reach.", "m"}, {"expected.sigma.", "mm"}};

FactUnit deviceUnit(const Device& device, const std::string& fact) {
  for (const auto* rows : {&device.type().program.facts, &sharedFacts()})
    for (const auto& row : *rows)
      if (fact == row.name) return row.unit;
  return setupFactUnit(fact);
}

const ProofRow* proofRow(const std::string& fact) {
  for (const auto& row : proofRows())
    if (fact == row.name) return &row;
  return nullptr;
}

bool isFraction(const Device& device, const std::string& fact) {
  if (cleaningOfClass(fact)) return true;
  if (const auto* row = proofRow(fact))
    return *row->unit == '\0' && row->domain.minimum == 0 && row->domain.maximum == 1;
  return deviceUnit(device, fact) == FactUnit::fraction;
}

std::string after(const std::string& text, std::string_view prefix) { return text.substr(prefix.size()); }

// The parts between dots.
std::vector<std::string> parts(const std::string& text, char between) {
  std::vector<std::string> found(1);
  for (const char c : text)
    if (c == between)
      found.emplace_back();
    else
      found.back() += c;
  return found;
}

// --- figures in texts ---

class Figure {
 public:
  Figure(std::string_view text, const FactLookup& facts) : rest_(text), facts_(facts) {}

  std::optional<double> value() {
    const auto sum = series(0, true);
    skip();
    if (!rest_.empty()) wrong_ = true;
    return sum;
  }
  bool wrong() const { return wrong_; }
  std::vector<std::string> names;

 private:
  static constexpr int kDeepest = 32;
  void skip() {
    while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
  }
  bool take(char c) {
    skip();
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  // Sums of products of what stands alone.
  std::optional<double> series(int depth, bool of_sums) {
    auto result = of_sums ? series(depth, false) : single(depth);
    for (;;) {
      const bool first = take(of_sums ? '+' : '*');
      if (!first && !take(of_sums ? '-' : '/')) return result;
      const auto next = of_sums ? series(depth, false) : single(depth);
      if (!result || !next) {
        result.reset();
      } else if (of_sums) {
        result = first ? *result + *next : *result - *next;
      } else {
        result = first ? *result * *next : *result / *next;
      }
    }
  }
  std::optional<double> single(int depth) {
    if (depth > kDeepest) return wrong_ = true, std::nullopt;
    if (take('-')) {
      const auto value = single(depth + 1);
      return value ? std::optional(-*value) : std::nullopt;
    }
    if (take('(')) {
      const auto value = series(depth + 1, true);
      wrong_ |= !take(')');
      return value;
    }
    skip();
    const auto end = std::min(rest_.find_first_of(" ()"), rest_.size());
    const std::string word(rest_.substr(0, end));
    rest_.remove_prefix(end);
    if (const auto number = numberIn(word)) return number;
    if (word.empty() || std::isalpha(static_cast<unsigned char>(word.front())) == 0) return wrong_ = true, std::nullopt;
    names.push_back(word);
    const auto fact = facts_(word);
    return fact ? fact->number : std::nullopt;
  }

  std::string_view rest_;
  const FactLookup& facts_;
  bool wrong_ = false;
};

struct Place {
  std::size_t from = 0, end = 0;  // with its braces
  std::string what;
  std::optional<int> decimals;
  bool wrong = false;
};

std::string trimmed(std::string_view text) {
  const auto from = text.find_first_not_of(' ');
  if (from == std::string_view::npos) return {};
  return std::string(text.substr(from, text.find_last_not_of(' ') - from + 1));
}

std::vector<Place> placesIn(const std::string& text) {
  constexpr int kMostDecimals = 6;
  std::vector<Place> places;
  for (auto open = text.find('{'); open != std::string::npos; open = text.find('{', open + 1)) {
    Place place;
    place.from = open;
    const auto close = text.find('}', open);
    place.wrong = close == std::string::npos;
    place.end = place.wrong ? text.size() : close + 1;
    const auto inside = text.substr(open + 1, place.end - open - (place.wrong ? 1 : 2));
    const auto colon = inside.find(':');
    place.what = trimmed(std::string_view(inside).substr(0, colon));
    if (colon != std::string::npos) {
      const auto decimals = numberIn(trimmed(std::string_view(inside).substr(colon + 1)));
      if (!decimals || *decimals < 0 || *decimals > kMostDecimals || *decimals != std::floor(*decimals))
        place.wrong = true;
      else
        place.decimals = static_cast<int>(*decimals);
    }
    open = place.end - 1;
    places.push_back(std::move(place));
    if (open >= text.size()) break;
  }
  return places;
}

const FactLookup kNoFacts = [](const std::string&) { return std::optional<Fact>(); };

}  // namespace

std::string withUnit(const std::string& number, const std::string& unit) {
  return number + (unit.empty() || unit == "°" ? unit : " " + unit);
}

std::string unitOf(const Device& device, const std::string& fact) {
  if (const auto* row = proofRow(fact)) return row->unit;
  const auto unit = deviceUnit(device, fact);
  for (const auto& known : kDeviceUnits)
    if (known.unit == unit) return known.name;
  for (const auto& named : kNamedUnits)
    if (fact.starts_with(named.prefix)) return named.name;
  return {};
}

std::vector<double> limitsOf(const Condition& condition, const std::string& fact) {
  std::vector<double> limits;
  for (const auto& c : condition.comparisons())
    if (c.fact == fact && !c.of_fact)
      for (const auto& word : c.words)
        if (const auto number = numberIn(word)) limits.push_back(*number);
  return limits;
}

std::string PlainWords::word(const std::string& key) const {
  const auto& type = device.type();
  return type.words->has(type.definition.id, key, "en") ? type.words->text(type.definition.id, key, language) : "";
}

std::string PlainWords::fill(const char* pattern,
                             std::initializer_list<std::pair<const char*, std::string>> places) const {
  auto text = word(std::string("condition.") + pattern);
  for (const auto& [place, by] : places) text = replaced(std::move(text), place, by);
  return text;
}

// By what it is called on the device.
std::string PlainWords::labelOf(const std::string& widget_id) const {
  const auto& d = device.type().definition;
  const auto labelled = [&](const std::vector<WidgetRow>& rows) {
    for (const auto& row : rows)
      if (row.id == widget_id) return word(row.words);
    return std::string();
  };
  for (const auto& screen : d.screens)
    if (const auto label = labelled(screen.widgets); !label.empty()) return label;
  if (const auto label = labelled(d.keys); !label.empty()) return label;
  const auto label = word(widget_id);
  return label.empty() ? widget_id : label;
}

std::string PlainWords::name(const std::string& fact) const {
  if (const auto known = word("fact." + fact); !known.empty()) return known;
  const auto& d = device.type().definition;
  const auto bound = [&](std::string WidgetRow::*to, const std::string& key) -> std::string {
    for (const auto& screen : d.screens)
      for (const auto& row : screen.widgets)
        if (row.*to == key)
          if (const auto label = word(row.words); !label.empty()) return label;
    return word(key);
  };
  if (fact.starts_with("setting.")) {
    const auto key = after(fact, "setting.");
    if (const auto label = bound(&WidgetRow::setting, key); !label.empty()) return label;
    for (const auto& setting : device.type().instrument.settings)
      if (setting.key == key) return setting.label;
  }
  if (fact.starts_with("value."))
    if (const auto label = bound(&WidgetRow::value, after(fact, "value.")); !label.empty()) return label;
  if (fact.starts_with("entry.")) return labelOf(after(fact, "entry."));
  if (fact.starts_with("newest.setting.")) return fill("newest_setting", {{"{name}", name(after(fact, "newest."))}});
  if (fact.starts_with("place.")) return fill("place", {{"{name}", after(fact, "place.")}});
  if (fact.starts_with("walk.near.")) return fill("near", {{"{name}", after(fact, "walk.near.")}});
  const auto part = parts(fact, '.');
  if (fact.starts_with("setup.") && part.size() > 2) {
    const auto what = after(fact, "setup." + part[1] + ".");
    return fill("setup",
                {{"{number}", part[1]}, {"{name}", name(what.starts_with("setting.") ? what : "newest." + what)}});
  }
  if (partFigure(fact, exercise)) {
    const auto dot = fact.rfind('.');
    return fill("part", {{"{what}", word("part." + fact.substr(dot + 1))}, {"{name}", fact.substr(5, dot - 5)}});
  }
  if (const auto of = cleaningOfClass(fact))
    return fill("cleaning", {{"{what}", word("fact.cleaning." + of->figure)}, {"{name}", of->name}});
  if (fact.starts_with("expected.sigma.") && part.size() > 3)
    return fill("sigma", {{"{range}", part[2]}, {"{percent}", after(fact, "expected.sigma." + part[2] + ".")}});
  if (fact.starts_with("expected.reach.")) return fill("reach", {{"{percent}", after(fact, "expected.reach.")}});
  if (fact.starts_with("answer."))
    for (const auto& question : exercise.questions)
      if (question.id == after(fact, "answer.")) return fill("answer", {{"{name}", question.text.in(language)}});
  if (fact.starts_with("count.")) {
    const auto event = part.size() > 1 ? part[1] : std::string();
    const auto detail = part.size() > 2 ? after(fact, "count." + event + ".") : std::string();
    const auto last = detail.substr(std::min(detail.size(), detail.find('/') + 1));
    if (event == "pressed") return fill("pressed", {{"{name}", labelOf(last)}});
    if (event == "screen") return fill("screen_count", {{"{name}", labelOf(detail)}});
    if (event == "answered")
      return fill("answered",
                  {{"{name}", labelOf("dialog." + detail.substr(0, detail.find('/')))}, {"{answer}", labelOf(last)}});
    return fill("count", {{"{name}", detail.empty() ? event : detail}});
  }
  for (const auto& screen : d.screens)  // a readout of it on the device
    for (const auto& row : screen.widgets)
      if (row.shows == fact)
        if (const auto label = word(row.words); !label.empty()) return label;
  return fact;
}

std::string PlainWords::figure(const std::string& fact, double value, const std::vector<double>& limits) const {
  const auto part = partFigure(fact, exercise);
  const bool fraction = part ? part->domain.maximum == 1 : isFraction(device, fact);
  const auto unit = deviceUnit(device, fact);
  const double factor = fraction ? 100 : 1;
  const auto sided = [&](double shown) {
    return std::all_of(limits.begin(), limits.end(), [&](double limit) {
      return (shown < limit) == (value < limit) && (shown > limit) == (value > limit);
    });
  };
  if (fact == "time" || unit == FactUnit::seconds)
    if (sided(std::round(value))) return clockText(value);
  if (unit == FactUnit::bytes) return bytesText(value);
  // Three digits, none of a whole number lost; more where fewer would stand on the other side of a limit.
  const double shown = value * factor;
  auto text = shown == std::round(shown) || std::abs(shown) >= 100 ? fmt::format("{:.0f}", shown)
                                                                   : fmt::format("{:.3g}", shown);
  for (int digits = 4; digits <= 15 && !sided(numberIn(text).value_or(shown) / factor); ++digits)
    text = fmt::format("{:.{}g}", shown, digits);
  const auto* asked = fact.starts_with("answer.") ? findQuestion(exercise.questions, fact.substr(7)) : nullptr;
  const auto* question = asked != nullptr && asked->number ? asked : nullptr;
  const auto name = fraction         ? std::string("%")
                    : fact == "time" ? std::string("s")
                    : part           ? std::string(part->unit)
                    : question       ? question->number->unit
                                     : unitOf(device, fact);
  return withUnit(text, name);
}

// By its label where it has one.
std::string PlainWords::choice(const std::string& fact, const std::string& value) const {
  const auto& type = device.type();
  if (value.empty()) return fill("none", {});
  if (fact.starts_with("answer."))
    for (const auto& question : exercise.questions)
      for (std::size_t i = 0; question.id == after(fact, "answer.") && i < question.choices.size(); ++i)
        if (question.choices[i] == value && !question.choice_texts[i].texts.empty())
          return question.choice_texts[i].in(language);
  auto key = fact;
  for (const char* prefix : {"newest.", "value.", "setting."})
    if (key.starts_with(prefix)) key = after(key, prefix);
  for (const auto& label : {word(key + "=" + value), word(fact + "=" + value)})
    if (!label.empty()) return label;
  for (const auto& setting : type.instrument.settings)
    for (const auto& one : setting.choices)
      if (setting.key == key && one.value == value) {
        const auto same = word(value);  // a plain On or Off is the same word on every device
        return !same.empty() && type.words->text(type.definition.id, value, "en") == one.label ? same : one.label;
      }
  if (fact == "screen" || value == "yes" || value == "no" || value == "on" || value == "off")
    if (const auto label = word(value); !label.empty()) return label;
  return value;
}

std::string PlainWords::value(const std::string& fact, const std::optional<Fact>& is,
                              const std::vector<double>& limits) const {
  if (!is) return "–";
  const bool words = fact.starts_with("setting.") || fact.starts_with("newest.setting.");  // "6mm" is none, "30" may be
  if (is->number && !words) return figure(fact, *is->number, limits);
  return choice(fact, is->text);
}

std::string PlainWords::condition(const Condition& condition) const {
  Condition::Wording wording;
  wording.all = "; ";
  wording.any = " " + word("condition.or") + " ";
  wording.none = word("condition.not");
  wording.comparison = [&](const Comparison& c) {
    std::string values;
    for (const auto& text : c.words) {
      const auto number = numberIn(text);
      const auto one = c.of_fact ? name(text) : value(c.fact, number ? Fact{text, number} : wordFact(text), {});
      values += (values.empty() ? "" : wording.any) + one;
    }
    constexpr const char* kPatterns[] = {"equal", "unequal", "less", "at_most", "more", "at_least"};
    return fill(kPatterns[static_cast<int>(c.sign)], {{"{what}", name(c.fact)}, {"{value}", values}});
  };
  return condition.worded(wording);
}

std::vector<std::string> factsInText(const std::string& text) {
  std::vector<std::string> names;
  for (const auto& place : placesIn(text)) {
    Figure figure(place.what, kNoFacts);
    (void)figure.value();
    names.insert(names.end(), figure.names.begin(), figure.names.end());
  }
  return names;
}

Result<void> checkFigures(const std::string& text) {
  for (const auto& place : placesIn(text)) {
    Figure figure(place.what, kNoFacts);
    (void)figure.value();
    if (place.wrong || figure.wrong())
      return failure(
          ErrorKind::unusable,
          fmt::format("'{}' is no figure: write a fact, or facts and numbers with + - * / between blanks, "
                      "and its decimals behind a colon, such as {}",
                      text.substr(place.from, place.end - place.from), "{orientation.azimuth / 57.3 * 20000 : 0}"));
  }
  return {};
}

std::string filledFigures(const std::string& text, const PlainWords& words, const FactLookup& facts) {
  std::string filled;
  std::size_t from = 0;
  for (const auto& place : placesIn(text)) {
    filled += text.substr(from, place.from - from);
    from = place.end;
    Figure figure(place.what, facts);
    const auto value = figure.value();
    if (place.wrong || figure.wrong())
      filled += text.substr(place.from, place.end - place.from);
    else if (figure.names.size() == 1 && figure.names[0] == place.what && !place.decimals)
      filled += words.value(place.what, facts(place.what), {});
    else if (!value || !std::isfinite(*value))
      filled += "–";
    else if (place.decimals)
      filled += fmt::format("{:.{}f}", *value, *place.decimals);
    else
      filled += std::abs(*value) >= 100 ? fmt::format("{:.0f}", *value) : fmt::format("{:.3g}", *value);
  }
  return filled + text.substr(from);
}

}  // namespace standpoint
