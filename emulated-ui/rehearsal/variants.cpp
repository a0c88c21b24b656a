// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/variants.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/json_fields.h"
#include "core/json_file.h"
#include "core/nearest_name.h"
#include "core/random.h"

namespace standpoint {

namespace {

using nlohmann::json;

constexpr double kMostValues = 10000;  // of one figure
constexpr std::size_t kMostFigures = 32, kMostVariants = 1'000'000;

// from + i · step, without the digits that binary fractions add.
double stepValue(double from, double step, int i) {
  constexpr double kDecimals = 1e6;
  return std::round((from + i * step) * kDecimals) / kDecimals;
}

VariantFigure figure(JsonFields& f, const std::string& name) {
  VariantFigure figure{name, {}};
  if (const auto* choices = f.raw("choices")) {
    for (const auto& value : choices->is_array() ? *choices : json::array())
      if (value.is_number() || value.is_string()) figure.values.push_back(value);
    if (!choices->is_array() || choices->empty() || figure.values.size() != choices->size())
      f.needs("choices", *choices, "a list of numbers or texts");
    return figure;
  }
  const double from = f.number("from", -1e6, 1e6), to = f.number("to", -1e6, 1e6), step = f.number("step", 1e-6, 1e6);
  if (to < from) f.wrong("to", "must not be less than 'from'");
  const double count = std::floor((to - from) / step + 1e-6) + 1;
  if (count > kMostValues) f.wrong("step", fmt::format("makes more than {:.0f} values", kMostValues));
  for (int i = 0; i < std::min(count, kMostValues); ++i) figure.values.emplace_back(stepValue(from, step, i));
  return figure;
}

std::string shown(const json& value) {
  return value.is_string() ? value.get<std::string>() : fmt::format("{}", value.get<double>());
}

// The end of the place "${name}" that begins at i; else npos.
std::size_t endOfPlace(const std::string& text, std::size_t i) {
  return text.compare(i, 2, "${") == 0 ? text.find('}', i) : std::string::npos;
}

class Filler {
 public:
  Filler(const Figures& figures, JsonFault& fault) : figures_(figures), fault_(fault) {}

  json filled(const json& value, const JsonPlace& at) {
    if (value.is_string()) return filledText(value.get_ref<const std::string&>(), at);
    if (value.is_array()) {
      json out = json::array();
      for (std::size_t i = 0; i < value.size(); ++i) out.push_back(filled(value[i], at / i));
      return out;
    }
    if (!value.is_object()) return value;
    json out = json::object();
    for (const auto& [key, one] : value.items()) out[key] = filled(one, at / key);
    return out;
  }

 private:
  json filledText(const std::string& text, const JsonPlace& at) {
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
      const auto end = endOfPlace(text, i);
      if (end == std::string::npos) {
        out += text[i++];
        continue;
      }
      const auto name = text.substr(i + 2, end - i - 2);
      const auto found = figures_.find(name);
      if (found == figures_.end()) {
        std::vector<std::string> known;
        for (const auto& [one, unused] : figures_) known.push_back(one);
        fault_.say(at.pointer, known.empty() ? fmt::format("'{}' stands for a figure, but there are no 'variants'",
                                                           "${" + name + "}")
                                             : fmt::format("unknown figure '{}'; {}", name, knownInstead(name, known)));
        return out;
      }
      if (i == 0 && end + 1 == text.size()) return found->second;  // alone: a number stays a number
      out += shown(found->second);
      i = end + 1;
    }
    return out;
  }

  const Figures& figures_;
  JsonFault& fault_;
};

}  // namespace

Result<std::vector<VariantFigure>> variantFigures(const json& exercise, const std::string& file_name) {
  std::vector<VariantFigure> figures;
  if (!exercise.is_object() || !exercise.contains("variants")) return figures;
  JsonFault fault(file_name);
  JsonFields all(fault, exercise, "");
  all.each("variants", [&](const std::string& name, const json& value, const std::string& pointer) {
    if (name.empty() || name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") != std::string::npos)
      fault.say(pointer, fmt::format("'{}' can contain only letters a to z, digits and _", name));
    JsonFields f(fault, value, pointer);
    figures.push_back(figure(f, name));
    f.close();
  });
  if (figures.size() > kMostFigures) fault.say("/variants", fmt::format("more than {} figures", kMostFigures));
  TRY(fault.result());
  return figures;
}

Figures standardFigures(const std::vector<VariantFigure>& figures) {
  Figures standard;
  for (const auto& figure : figures) standard[figure.name] = figure.values.front();
  return standard;
}

Figures drawnFigures(const std::vector<VariantFigure>& figures, std::uint64_t seed) {
  Figures drawn;
  for (const auto& figure : figures) {
    const auto name = stableHash(figure.name.c_str());
    const auto block = philox({seed, 0}, static_cast<std::uint32_t>(name), static_cast<std::uint32_t>(name >> 32U), 0);
    drawn[figure.name] = figure.values[static_cast<std::uint64_t>(block[0]) * figure.values.size() >> 32U];
  }
  return drawn;
}

std::size_t countVariants(const std::vector<VariantFigure>& figures) {
  std::size_t count = 1;
  for (const auto& figure : figures) count = std::min(kMostVariants, count * figure.values.size());
  return count;
}

std::set<std::string> figuresIn(const std::string& text) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (const auto end = endOfPlace(text, i); end != std::string::npos) names.insert(text.substr(i + 2, end - i - 2));
  return names;
}

Result<json> withFigures(const json& exercise, const Figures& figures, const std::string& file_name) {
  JsonFault fault(file_name);
  json without = exercise;
  if (without.is_object()) without.erase("variants");
  auto filled = Filler(figures, fault).filled(without, {file_name, ""});
  TRY(fault.result());
  return filled;
}

}  // namespace standpoint
