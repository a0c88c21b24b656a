// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/json_fields.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/json_file.h"
#include "core/nearest_name.h"

namespace standpoint {

namespace {

const nlohmann::json kNothing = nlohmann::json::object();
constexpr std::size_t kLongestShown = 40;  // bytes of a wrong value
constexpr std::size_t kLongestPointer = 200, kLongestMessage = 2000;

std::string shortened(std::string text, std::size_t longest = kLongestShown) {
  if (text.size() <= longest) return text;
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // not within a letter
  return text.substr(0, end) + "…";
}

}  // namespace

std::string nameWithFolder(const std::filesystem::path& file) {
  return (file.parent_path().filename() / file.filename()).generic_string();
}

std::string described(const nlohmann::json& value) {
  if (value.is_string()) return fmt::format("the text \"{}\"", shortened(value.get<std::string>()));
  if (value.is_number()) return fmt::format("the number {}", shortened(value.dump()));
  if (value.is_boolean()) return value.dump();
  if (value.is_array()) return "a list";
  return value.is_object() ? "an object" : "null";
}

void JsonFault::say(const std::string& pointer, const std::string& message) {
  if (error_) return;
  error_ = JsonPlace{file_, shortened(pointer, kLongestPointer)}.unusable(shortened(message, kLongestMessage)).value();
}

void JsonFault::needs(const std::string& pointer, const nlohmann::json& found, const std::string& needed) {
  say(pointer, fmt::format("must be {}, not {}", needed, described(found)));
}

Result<void> JsonFault::result() const { return error_ ? Result<void>(failure(*error_)) : Result<void>(); }

std::string textAt(JsonFault& fault, const nlohmann::json& value, const std::string& pointer,
                   std::string_view example) {
  if (value.is_string() && value.get_ref<const std::string&>().find_first_not_of(" \t\r\n") != std::string::npos)
    return value.get<std::string>();
  // Without an example, a number or a flag only lacks its quotes.
  const bool bare = example.empty() && (value.is_number() || value.is_boolean());
  const auto such = bare ? shortened(value.dump()) : std::string(example);
  const auto hint = such.empty() ? std::string() : fmt::format("; write {}\"{}\"", bare ? "" : "it like ", such);
  if (value.is_string())
    fault.say(pointer, "must not be empty" + hint);
  else
    fault.say(pointer, fmt::format("must be a text, in quotes, not {}{}", described(value), hint));
  return {};
}

double numberAt(JsonFault& fault, const nlohmann::json& value, const std::string& pointer, double minimum,
                double maximum) {
  const double number = value.is_number() ? value.get<double>() : std::nan("");
  if (number >= minimum && number <= maximum) return number;
  fault.needs(pointer, value,
              fmt::format("a number from {} to {}{}", minimum, maximum, value.is_string() ? ", without quotes" : ""));
  return minimum;
}

JsonFields::JsonFields(JsonFault& fault, const nlohmann::json& object, std::string pointer)
    : fault_(fault), object_(object.is_object() ? object : kNothing), pointer_(std::move(pointer)) {
  if (!object.is_object()) fault_.say(pointer_, fmt::format("must be an object in braces, not {}", described(object)));
}

bool JsonFields::has(std::string_view key) const { return object_.contains(key); }

bool JsonFields::isNull(std::string_view key) {
  const auto* value = raw(key);
  return value != nullptr && value->is_null();
}

std::vector<std::string> JsonFields::keys() const {
  std::vector<std::string> all;
  for (const auto& [name, value] : object_.items()) all.push_back(name);
  return all;
}

std::string JsonFields::pointer(std::string_view key) const { return (JsonPlace{{}, pointer_} / key).pointer; }

void JsonFields::wrong(std::string_view key, const std::string& message) {
  fault_.say(key.empty() ? pointer_ : pointer(key), message);
}

void JsonFields::needs(std::string_view key, const nlohmann::json& found, const std::string& needed) {
  fault_.needs(pointer(key), found, needed);
}

const nlohmann::json* JsonFields::raw(std::string_view key) {
  skip(key);
  const auto found = object_.find(key);
  return found == object_.end() ? nullptr : &*found;
}

const nlohmann::json* JsonFields::required(std::string_view key) {
  const auto* value = raw(key);
  if (value == nullptr) wrong(key, "is missing");
  return value;
}

std::string JsonFields::text(std::string_view key, std::string_view example) {
  const auto* value = required(key);
  return value == nullptr ? std::string() : textAt(fault_, *value, pointer(key), example);
}

std::string JsonFields::textOr(std::string_view key, const std::string& default_value, std::string_view example) {
  return has(key) ? text(key, example) : (skip(key), default_value);
}

std::string JsonFields::anyText(std::string_view key) {
  const auto* value = raw(key);
  return value != nullptr && value->is_string() ? value->get<std::string>() : text(key);
}

std::string JsonFields::wordOf(std::string_view key, const std::vector<std::string>& allowed) {
  auto word = text(key);
  if (std::find(allowed.begin(), allowed.end(), word) == allowed.end())
    wrong(key, fmt::format("'{}' is not one of {}", word, fmt::join(allowed, ", ")));
  return word;
}

double JsonFields::number(std::string_view key, double minimum, double maximum) {
  const auto* value = required(key);
  return value == nullptr ? minimum : numberAt(fault_, *value, pointer(key), minimum, maximum);
}

std::optional<double> JsonFields::optionalNumber(std::string_view key, double minimum, double maximum) {
  const auto* value = raw(key);
  return value == nullptr ? std::nullopt : std::optional(numberAt(fault_, *value, pointer(key), minimum, maximum));
}

double JsonFields::numberOr(std::string_view key, double default_value, double minimum, double maximum) {
  return optionalNumber(key, minimum, maximum).value_or(default_value);
}

bool JsonFields::flagOr(std::string_view key, bool default_value) {
  const auto* value = raw(key);
  if (value == nullptr) return default_value;
  if (!value->is_boolean()) needs(key, *value, "true or false, without quotes");
  return value->is_boolean() ? value->get<bool>() : default_value;
}

std::uint32_t JsonFields::colourOr(std::string_view key, std::uint32_t default_value) {
  if (!has(key)) return skip(key), default_value;
  const auto written = text(key, "#2e3033");
  std::uint32_t colour = 0;
  const auto* end = written.data() + written.size();
  const bool hexadecimal =
      written.size() == 7 && written.front() == '#' && std::from_chars(written.data() + 1, end, colour, 16).ptr == end;
  if (!hexadecimal && !written.empty()) wrong(key, fmt::format("'{}' is not a colour such as #2e3033", written));
  return hexadecimal ? colour : default_value;
}

std::vector<std::string> JsonFields::texts(std::string_view key) {
  std::vector<std::string> found;
  const auto* value = raw(key);
  if (value == nullptr) return found;
  if (!value->is_array())
    needs(key, *value, "a list of texts, such as [\"a\", \"b\"]");
  else
    for (const auto& text : *value) {
      if (text.is_string())
        found.push_back(text.get<std::string>());
      else
        wrong(key, fmt::format("must be a list of texts, but contains {}", described(text)));
    }
  return found;
}

void JsonFields::list(std::string_view key, const std::function<void(JsonFields&)>& one) {
  const auto* value = raw(key);
  if (value == nullptr) return;
  if (!value->is_array()) return needs(key, *value, "a list of objects, [{…}, {…}]");
  for (std::size_t i = 0; i < value->size(); ++i) {
    JsonFields fields(fault_, (*value)[i], fmt::format("{}/{}", pointer(key), i));
    one(fields);
    fields.close();
  }
}

void JsonFields::object(std::string_view key, const std::function<void(JsonFields&)>& one) {
  const auto* value = raw(key);
  if (value == nullptr) return;
  JsonFields fields(fault_, *value, pointer(key));
  one(fields);
  fields.close();
}

void JsonFields::each(std::string_view key,
                      const std::function<void(const std::string&, const nlohmann::json&, const std::string&)>& one) {
  const auto* value = raw(key);
  if (value == nullptr) return;
  if (!value->is_object()) return needs(key, *value, "an object, {…}");
  for (const auto& [name, inner] : value->items())
    one(name, inner, (JsonPlace{{}, pointer(key)} / std::string_view(name)).pointer);
}

void JsonFields::everyText(const std::function<void(const std::string&, const std::string&)>& one) {
  for (const auto& [name, value] : object_.items()) {
    if (value.is_string())
      one(name, value.get<std::string>());
    else
      needs(name, value, "a text, in quotes");
  }
}

void JsonFields::close() {
  for (const auto& [name, value] : object_.items())
    if (!known_.contains(name)) wrong(name, "unknown key; " + knownInstead(name, {known_.begin(), known_.end()}));
}

}  // namespace standpoint
