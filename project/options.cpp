// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "project/verb.h"

namespace standpoint {

namespace {

using nlohmann::json;

constexpr double kFarthest = 1e9;  // of a place, in metres: beyond it nothing can be computed in single precision

bool isListOfTexts(const json& value) {
  return value.is_array() && std::all_of(value.begin(), value.end(), [](const json& v) { return v.is_string(); });
}

bool fits(const Parameter& p, const json& value) {
  switch (p.kind) {
    case ParameterKind::number:
      return value.is_number() && value.get<double>() >= p.minimum && value.get<double>() <= p.maximum;
    case ParameterKind::integer:
      return value.is_number_integer() && value.get<double>() >= p.minimum && value.get<double>() <= p.maximum;
    case ParameterKind::flag: return value.is_boolean();
    case ParameterKind::choice:
      return value.is_string() && std::any_of(p.choices.begin(), p.choices.end(),
                                              [&](const char* c) { return value.get_ref<const std::string&>() == c; });
    case ParameterKind::triple:
      return value.is_array() && value.size() >= p.min_numbers && value.size() <= 3 &&
             std::all_of(value.begin(), value.end(),
                         [](const json& v) { return v.is_number() && std::abs(v.get<double>()) <= kFarthest; });
    case ParameterKind::pairs:
      return isListOfTexts(value) && std::all_of(value.begin(), value.end(), [](const json& v) {
               return v.get_ref<const std::string&>().find('=') != std::string::npos;
             });
    case ParameterKind::list: return isListOfTexts(value);
    case ParameterKind::path:
    case ParameterKind::text: return value.is_string();
  }
  return false;
}

}  // namespace

std::string fullHelp(const Parameter& parameter) {
  return *parameter.term == 0 ? parameter.help : fmt::format("{} ({})", parameter.help, parameter.term);
}

std::string domainOf(const Parameter& p) {
  switch (p.kind) {
    case ParameterKind::number:
    case ParameterKind::integer: {
      const char* what = p.kind == ParameterKind::integer ? "a whole number" : "a number";
      const std::string unit = *p.unit != 0 ? fmt::format(" in {}", p.unit) : "";
      if (p.minimum > -1e300 && p.maximum < 1e300)
        return fmt::format("{}{} from {} to {}", what, unit, p.minimum, p.maximum);
      if (p.minimum > -1e300) return fmt::format("{}{}, at least {}", what, unit, p.minimum);
      return what + unit;
    }
    case ParameterKind::flag: return "true or false";
    case ParameterKind::choice: return fmt::format("one of {}", fmt::join(p.choices, ", "));
    case ParameterKind::triple:
      return fmt::format("three numbers{}{}, none beyond 1e9", *p.unit != 0 ? fmt::format(" in {}", p.unit) : "",
                         p.min_numbers < 3 ? " (the third may be left out)" : "");
    case ParameterKind::pairs: return "a list of key=value";
    case ParameterKind::list: return "a list of texts";
    case ParameterKind::path: return "a path";
    case ParameterKind::text: return "a text";
  }
  return {};
}

Result<json> checkOptions(const Verb& verb, const json& options) {
  if (!options.is_object()) return failure(ErrorKind::usage, "options must be a JSON object", verb.name);
  json complete = json::object();
  for (const auto& [key, value] : options.items()) {
    const auto found = std::find_if(verb.parameters.begin(), verb.parameters.end(),
                                    [&key = key](const Parameter& p) { return key == p.name; });
    if (found == verb.parameters.end()) {
      std::vector<const char*> names;
      for (const auto& p : verb.parameters) names.push_back(p.name);
      return failure(ErrorKind::usage, fmt::format("unknown option '{}'; available: {}", key, fmt::join(names, ", ")),
                     verb.name);
    }
    if (!fits(*found, value))
      return failure(ErrorKind::usage, fmt::format("'{}' must be {}, not {}", key, domainOf(*found), value.dump()),
                     verb.name);
    if (found->check)
      if (auto ok = found->check(value); !ok)
        return failure(ok.error().kind, ok.error().message, ok.error().source.empty() ? "--" + key : ok.error().source);
    complete[key] = value;
  }
  for (const auto& p : verb.parameters) {
    if (complete.contains(p.name)) continue;
    if (p.required) return failure(ErrorKind::usage, fmt::format("'{}' is required: {}", p.name, p.help), verb.name);
    if (!p.default_value.is_null()) complete[p.name] = p.default_value;
  }
  return complete;
}

Result<Outcome> runVerb(const Verb& verb, const Document& document, const json& options, Progress& progress) {
  TRY_ASSIGN(auto complete, checkOptions(verb, options));
  const bool takes_document = verb.scope == VerbScope::changes || verb.scope == VerbScope::reads;
  if (takes_document && !document.imported)
    return failure(ErrorKind::usage, "there is no model: import one first", verb.name);
  if (takes_document && !document.hasModel() && !verb.without_model)
    return failure(ErrorKind::usage, "the project has point clouds and no model: add a model first", verb.name);
  try {
    return verb.run(document, complete, progress);
  } catch (const std::bad_alloc&) {
    return failure(ErrorKind::unusable, "not enough memory", verb.name);
  } catch (const std::exception& e) {
    return failure(ErrorKind::internal, fmt::format("unexpected error: {}", e.what()), verb.name);
  }
}

const Verb* findVerb(std::span<const Verb> table, std::string_view wanted) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const Verb& v) { return wanted == v.name; });
  return found == table.end() ? nullptr : &*found;
}

const Verb* findVerb(std::span<const Verb> table, std::type_index options_type) {
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const Verb& v) { return v.options_type == options_type; });
  return found == table.end() ? nullptr : &*found;
}

}  // namespace standpoint
