// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a verb's answer is called outside of the program. Inside it is a plain struct; one table of fields beside the
// verb maps its members to the keys of `--json`. Structs become JSON in one place, `outcomeOf`.

#include <algorithm>
#include <any>
#include <concepts>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "core/units.h"
#include "project/verb.h"

namespace standpoint {

template <class A>
struct AnswerField;
template <class A>
using AnswerFields = std::vector<AnswerField<A>>;

// A struct is part of an answer when its table is found beside it:
// const AnswerFields<A>& answerFields(const A*).
template <class A>
concept HasAnswerFields = requires(const A* a) {
  { answerFields(a) } -> std::same_as<const AnswerFields<A>&>;
};

// How a member's type is written; `names` are the keys below it, with '/' between levels.
template <class T>
struct AnswerValue {
  static_assert(!std::is_enum_v<T>, "write it as a word, by a conversion in the table");
  static nlohmann::json write(const T& value) { return value; }
  static std::vector<std::string> names() { return {}; }
};

template <>
struct AnswerValue<std::filesystem::path> {
  static nlohmann::json write(const std::filesystem::path& path) { return path.string(); }
  static std::vector<std::string> names() { return {}; }
};

template <>
struct AnswerValue<Eigen::Vector3d> {
  static nlohmann::json write(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
  static std::vector<std::string> names() { return {}; }
};

// Null where there is nothing.
template <class T>
struct AnswerValue<std::optional<T>> {
  static nlohmann::json write(const std::optional<T>& value) {
    return value ? AnswerValue<T>::write(*value) : nlohmann::json();
  }
  static std::vector<std::string> names() { return AnswerValue<T>::names(); }
};

template <class T>
struct AnswerValue<std::vector<T>> {
  static nlohmann::json write(const std::vector<T>& rows) {
    nlohmann::json array = nlohmann::json::array();
    for (const auto& row : rows) array.push_back(AnswerValue<T>::write(row));
    return array;
  }
  static std::vector<std::string> names() { return AnswerValue<T>::names(); }
};

// An object whose keys are data, such as names of targets; `names` are those of its values.
template <class T>
struct AnswerValue<std::map<std::string, T>> {
  static nlohmann::json write(const std::map<std::string, T>& values) {
    nlohmann::json object = nlohmann::json::object();
    for (const auto& [key, value] : values) object[key] = AnswerValue<T>::write(value);
    return object;
  }
  static std::vector<std::string> names() { return AnswerValue<T>::names(); }
};

// Of a verb that answers one of several things.
template <class... T>
struct AnswerValue<std::variant<T...>> {
  static nlohmann::json write(const std::variant<T...>& value) {
    return std::visit([](const auto& one) { return AnswerValue<std::remove_cvref_t<decltype(one)>>::write(one); },
                      value);
  }
  static std::vector<std::string> names() {
    std::vector<std::string> all;
    const auto add = [&all](std::vector<std::string> more) {
      for (auto& name : more)
        if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(std::move(name));
    };
    (add(AnswerValue<T>::names()), ...);
    return all;
  }
};

template <HasAnswerFields A>
struct AnswerValue<A> {
  static nlohmann::json write(const A& answer) {
    nlohmann::json object = nlohmann::json::object();
    for (const auto& field : answerFields(&answer))
      if (auto value = field.written(answer)) object[field.name] = *std::move(value);
    return object;
  }
  static std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const auto& field : answerFields(static_cast<const A*>(nullptr))) {
      all.emplace_back(field.name);
      for (const auto& below : field.below) all.push_back(std::string(field.name) + "/" + below);
    }
    return all;
  }
};

// What a member becomes where it leaves the program: conversions for a row of the table.
namespace answers {

inline double degrees(double angle_rad) { return angle_rad / kRadPerDeg; }
inline Eigen::Vector3d degreesOfEach(const Eigen::Vector3d& angles_rad) { return angles_rad / kRadPerDeg; }
inline std::optional<std::string> nullWhereEmpty(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

}  // namespace answers

template <class T>
concept IsOptional = std::same_as<T, std::optional<typename T::value_type>>;

// The key is left out where there is nothing (an optional) or no row (a vector).
struct LeftOut {};
inline constexpr LeftOut kLeftOut;

// A member of the answer A, or of a base of it.
template <class A>
struct AnswerField {
  template <class B, class T>
  requires std::derived_from<A, B> AnswerField(const char* key, T B::*member)
      : name(key),
        written([member](const A& a) { return AnswerValue<T>::write(a.*member); }),
        below(AnswerValue<T>::names()) {}

  template <class B, class T, class Convert>
  requires std::derived_from<A, B> && std::invocable<Convert, const T&> AnswerField(const char* key, T B::*member,
                                                                                    Convert convert)
      : name(key),
        written([member, convert](const A& a) {
          const auto converted = convert(a.*member);
          return AnswerValue<std::remove_const_t<decltype(converted)>>::write(converted);
        }),
        below(AnswerValue<std::remove_cvref_t<std::invoke_result_t<Convert, const T&>>>::names()) {}

  template <class B, class T>
  requires std::derived_from<A, B> AnswerField(const char* key, std::optional<T> B::*member, LeftOut)
      : name(key),
        written([member](const A& a) {
          return a.*member ? std::optional(AnswerValue<T>::write(*(a.*member))) : std::nullopt;
        }),
        below(AnswerValue<T>::names()) {}

  template <class B, class T, class Convert>
  requires std::derived_from<A, B> && std::invocable<Convert, const T&> AnswerField(const char* key,
                                                                                    std::optional<T> B::*member,
                                                                                    Convert convert, LeftOut)
      : name(key),
        written([member, convert](const A& a) -> std::optional<nlohmann::json> {
          if (!(a.*member)) return std::nullopt;
          const auto converted = convert(*(a.*member));
          return AnswerValue<std::remove_const_t<decltype(converted)>>::write(converted);
        }),
        below(AnswerValue<std::remove_cvref_t<std::invoke_result_t<Convert, const T&>>>::names()) {}

  // Left out where the conversion has nothing to say.
  template <class B, class T, class Convert>
  requires std::derived_from<A, B> && IsOptional<std::invoke_result_t<Convert, const T&>> AnswerField(const char* key,
                                                                                                      T B::*member,
                                                                                                      Convert convert,
                                                                                                      LeftOut)
      : name(key),
        written([member, convert](const A& a) -> std::optional<nlohmann::json> {
          const auto converted = convert(a.*member);
          using Converted = typename std::remove_const_t<decltype(converted)>::value_type;
          return converted ? std::optional(AnswerValue<Converted>::write(*converted)) : std::nullopt;
        }),
        below(AnswerValue<std::remove_cvref_t<std::invoke_result_t<Convert, const T&>>>::names()) {}

  template <class B, class T>
  requires std::derived_from<A, B> AnswerField(const char* key, std::vector<T> B::*member, LeftOut)
      : name(key),
        written([member](const A& a) {
          return (a.*member).empty() ? std::nullopt : std::optional(AnswerValue<std::vector<T>>::write(a.*member));
        }),
        below(AnswerValue<T>::names()) {}

  // A row of the base's table.
  template <class B>
  requires std::derived_from<A, B> &&(!std::same_as<A, B>)AnswerField(const AnswerField<B>& of_base)
      : name(of_base.name), written(of_base.written), below(of_base.below) {}

  const char* name;
  std::function<std::optional<nlohmann::json>(const A&)> written;  // nothing: the key is left out
  std::vector<std::string> below;                                  // names of its own table
};

// The table of a struct that adds rows to those of its bases.
template <class A, class... B>
AnswerFields<A> withBases(AnswerFields<A> own, const AnswerFields<B>&... bases) {
  (own.insert(own.end(), bases.begin(), bases.end()), ...);
  return own;
}

// What a typed verb gives back: as Outcome says, with the answer as a struct.
template <class A>
struct Answered {
  Document document;
  A answer = {};
  Report report = {};
  std::string description = {};
  std::string text = {};
};

// For a door: the answer as JSON, and beside it as it is.
template <class A>
Outcome outcomeOf(Answered<A> answered) {
  Outcome outcome{std::move(answered.document), AnswerValue<A>::write(answered.answer), std::move(answered.report),
                  std::move(answered.description), std::move(answered.text)};
  outcome.typed = std::make_shared<const A>(std::move(answered.answer));
  return outcome;
}

// The typed answer of an outcome; null where its verb has another one.
template <class A>
const A* answerAs(const std::any& typed) {
  const auto* held = std::any_cast<std::shared_ptr<const A>>(&typed);
  return held == nullptr ? nullptr : held->get();
}

}  // namespace standpoint
