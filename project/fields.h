// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a verb's options are called outside of the program. Inside they are a plain struct; one table of fields beside
// the verb maps its members to the names, units and limits of command line, job files, `--json` and forms. JSON becomes
// the struct in one place, `optionsFrom`.

#include <any>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "core/result.h"
#include "core/survey.h"
#include "project/answer_fields.h"
#include "project/verb.h"

namespace standpoint {

// "key=value", in the order given.
using KeyValues = std::vector<std::pair<std::string, std::string>>;

// One word of a choice. An enumeration is an option when `choices(E)` is found beside it:
// std::span<const Choice<E>> choices(E).
template <class E>
struct Choice {
  const char* name;
  E value;
};

// What JSON a member's type is written as. Each has
//   kKind; describe(Parameter&), for what the kind does not say;
//   read(json), of a value that fits the kind: an error says what the text must look like;
//   write(T), null where nothing is said.
// A type with a text form of its own (a shard, the weather) specialises it beside that type.
template <class T>
struct FieldValue;

namespace fields {

nlohmann::json writtenPlace(const FloorPlace& place);
FloorPlace placeFrom(const nlohmann::json& numbers);
nlohmann::json writtenPairs(const KeyValues& pairs);
KeyValues pairsFrom(const nlohmann::json& texts);

template <class T>
struct Plain {
  static void describe(Parameter&) {}
  static Result<T> read(const nlohmann::json& value) { return value.get<T>(); }
  static nlohmann::json write(const T& value) { return value; }
};

}  // namespace fields

template <>
struct FieldValue<bool> : fields::Plain<bool> {
  static constexpr auto kKind = ParameterKind::flag;
  static nlohmann::json write(bool value) { return value ? nlohmann::json(true) : nlohmann::json(); }
};

template <>
struct FieldValue<double> : fields::Plain<double> {
  static constexpr auto kKind = ParameterKind::number;
};

template <std::integral T>
struct FieldValue<T> : fields::Plain<T> {
  static constexpr auto kKind = ParameterKind::integer;
};

template <>
struct FieldValue<std::string> : fields::Plain<std::string> {
  static constexpr auto kKind = ParameterKind::text;
  static nlohmann::json write(const std::string& text) {
    return text.empty() ? nlohmann::json() : nlohmann::json(text);
  }
};

template <>
struct FieldValue<std::filesystem::path> {
  static constexpr auto kKind = ParameterKind::path;
  static void describe(Parameter&) {}
  static Result<std::filesystem::path> read(const nlohmann::json& value) { return value.get<std::string>(); }
  static nlohmann::json write(const std::filesystem::path& path) {
    return path.empty() ? nlohmann::json() : nlohmann::json(path.string());
  }
};

template <>
struct FieldValue<std::vector<std::string>> : fields::Plain<std::vector<std::string>> {
  static constexpr auto kKind = ParameterKind::list;
  static nlohmann::json write(const std::vector<std::string>& texts) {
    return texts.empty() ? nlohmann::json() : nlohmann::json(texts);
  }
};

template <>
struct FieldValue<std::vector<std::filesystem::path>> {
  static constexpr auto kKind = ParameterKind::list;
  static void describe(Parameter&) {}
  static Result<std::vector<std::filesystem::path>> read(const nlohmann::json& value) {
    const auto texts = value.get<std::vector<std::string>>();
    return std::vector<std::filesystem::path>(texts.begin(), texts.end());
  }
  static nlohmann::json write(const std::vector<std::filesystem::path>& paths) {
    nlohmann::json texts;
    for (const auto& path : paths) texts.push_back(path.string());
    return texts;
  }
};

template <>
struct FieldValue<Eigen::Vector3d> {
  static constexpr auto kKind = ParameterKind::triple;
  static void describe(Parameter&) {}
  static Result<Eigen::Vector3d> read(const nlohmann::json& v) {
    return Eigen::Vector3d(v[0].get<double>(), v[1].get<double>(), v[2].get<double>());
  }
  static nlohmann::json write(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
};

template <>
struct FieldValue<FloorPlace> {
  static constexpr auto kKind = ParameterKind::triple;
  static void describe(Parameter& p) { p.min_numbers = 2; }
  static Result<FloorPlace> read(const nlohmann::json& value) { return fields::placeFrom(value); }
  static nlohmann::json write(const FloorPlace& place) { return fields::writtenPlace(place); }
};

template <>
struct FieldValue<KeyValues> {
  static constexpr auto kKind = ParameterKind::pairs;
  static void describe(Parameter&) {}
  static Result<KeyValues> read(const nlohmann::json& value) { return fields::pairsFrom(value); }
  static nlohmann::json write(const KeyValues& pairs) { return fields::writtenPairs(pairs); }
};

template <class E>
requires std::is_enum_v<E>
struct FieldValue<E> {
  static constexpr auto kKind = ParameterKind::choice;
  static void describe(Parameter& p) {
    for (const auto& choice : choices(E{})) p.choices.push_back(choice.name);
  }
  static Result<E> read(const nlohmann::json& value) {
    for (const auto& choice : choices(E{}))
      if (value.get_ref<const std::string&>() == choice.name) return choice.value;
    return failure(ErrorKind::internal, "a choice without a value");
  }
  static nlohmann::json write(E value) {
    for (const auto& choice : choices(E{}))
      if (value == choice.value) return choice.name;
    return nullptr;
  }
};

// Nothing is said, or a value.
template <class T>
struct FieldValue<std::optional<T>> {
  static constexpr auto kKind = FieldValue<T>::kKind;
  static void describe(Parameter& p) { FieldValue<T>::describe(p); }
  static Result<std::optional<T>> read(const nlohmann::json& value) {
    TRY_ASSIGN(auto said, FieldValue<T>::read(value));
    return std::optional<T>(std::move(said));
  }
  static nlohmann::json write(const std::optional<T>& value) {
    return value ? FieldValue<T>::write(*value) : nlohmann::json();
  }
};

struct FieldDetails {
  const char* unit = "";
  double minimum = -1e300, maximum = 1e300;
  std::vector<const char*> choices = {};  // of a text whose words come from a table of data
  bool positional = false;
  bool required = false;
  const char* label = "";  // of Parameter
  const char* term = "";
};

// A member of the options O, or of a base of theirs. Its default is what a default-constructed O holds.
template <class O>
struct Field {
  template <class B, class T>
  requires std::derived_from<O, B> Field(const char* name, T B::*member, const char* help, FieldDetails details = {})
      : set([member](O& options, const nlohmann::json& value) -> Result<void> {
          TRY_ASSIGN(auto read, FieldValue<T>::read(value));
          options.*member = std::move(read);
          return {};
        }),
        written([member](const O& options) { return FieldValue<T>::write(options.*member); }) {
    parameter.name = name;
    parameter.kind = details.choices.empty() ? FieldValue<T>::kKind : ParameterKind::choice;
    parameter.help = help;
    parameter.unit = details.unit;
    parameter.default_value = details.required ? nlohmann::json() : written(O());
    parameter.minimum = details.minimum;
    parameter.maximum = details.maximum;
    parameter.choices = std::move(details.choices);
    FieldValue<T>::describe(parameter);
    parameter.positional = details.positional;
    parameter.required = details.required;
    parameter.label = details.label;
    parameter.term = details.term;
    parameter.check = [](const nlohmann::json& value) -> Result<void> {
      TRY(FieldValue<T>::read(value));
      return {};
    };
  }

  Parameter parameter;
  std::function<Result<void>(O&, const nlohmann::json&)> set;
  std::function<nlohmann::json(const O&)> written;  // null: nothing is said
};

template <class O>
using Fields = std::vector<Field<O>>;

// From options that checkOptions has passed.
template <class O>
Result<O> optionsFrom(const Fields<O>& fields, const nlohmann::json& checked) {
  O options;
  for (const auto& field : fields)
    if (const auto said = checked.find(field.parameter.name); said != checked.end()) TRY(field.set(options, *said));
  return options;
}

// As a job file would say it: what differs from the default.
template <class O>
nlohmann::json jobOptions(const Fields<O>& fields, const O& options) {
  nlohmann::json result = nlohmann::json::object();
  for (const auto& field : fields)
    if (auto value = field.written(options); !value.is_null() && value != field.parameter.default_value)
      result[field.parameter.name] = std::move(value);
  return result;
}

// The entry of the table of verbs for a typed function: options from JSON before it, its answer to JSON after it.
template <class O, class A>
Verb verbOf(const char* name, const char* summary, VerbScope scope, const Fields<O>& fields,
            Result<Answered<A>> (*run)(const Document&, const O&, Progress&)) {
  Verb verb{name, summary, scope, {}, {}, AnswerValue<A>::names()};
  for (const auto& field : fields) verb.parameters.push_back(field.parameter);
  verb.options_type = typeid(O);
  verb.job_options = [&fields](const std::any& options) {
    return jobOptions(fields, std::any_cast<const O&>(options));
  };
  verb.run = [&fields, run](const Document& document, const nlohmann::json& checked,
                            Progress& progress) -> Result<Outcome> {
    TRY_ASSIGN(const auto options, optionsFrom(fields, checked));
    TRY_ASSIGN(auto answered, run(document, options, progress));
    return outcomeOf(std::move(answered));
  };
  return verb;
}

}  // namespace standpoint
