// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/json_fields.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "core/json_file.h"
#include "emulated-ui/device/nearest.h"

namespace standpoint {

namespace {

const nlohmann::json kNothing = nlohmann::json::object();
constexpr std::size_t kLongestShown = 40;  // bytes of a wrong value

std::string shortened(std::string text) {
  if (text.size() <= kLongestShown) return text;
  std::size_t end = kLongestShown;
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
  if (!error_) error_ = Error{ErrorKind::unusable, message, file_ + " " + (pointer.empty() ? "/" : pointer)};
}

JsonFields::JsonFields(JsonFault& fault, const nlohmann::json& object, std::string pointer)
    : fault_(fault), object_(object.is_object() ? object : kNothing), pointer_(std::move(pointer)) {
  if (!object.is_object()) fault_.say(pointer_, fmt::format("must be an object, in {{ }}, not {}", described(object)));
}

bool JsonFields::has(const char* key) const { return object_.contains(key); }

bool JsonFields::isNull(const char* key) {
  const auto* value = find(key, false);
  return value != nullptr && value->is_null();
}

std::vector<std::string> JsonFields::keys() const {
  std::vector<std::string> all;
  for (const auto& [name, value] : object_.items()) all.push_back(name);
  return all;
}

void JsonFields::wrong(const char* key, const std::string& message) {
  fault_.say(*key == '\0' ? pointer_ : (JsonPlace{{}, pointer_} / std::string_view(key)).pointer, message);
}

void JsonFields::needs(const char* key, const nlohmann::json& found, const std::string& needed) {
  wrong(key, fmt::format("must be {}, not {}", needed, described(found)));
}

const nlohmann::json* JsonFields::find(const char* key, bool required) {
  known_.insert(key);
  const auto found = object_.find(key);
  if (found != object_.end()) return &*found;
  if (required) fault_.say(pointer_, fmt::format("'{}' is missing", key));
  return nullptr;
}

const nlohmann::json* JsonFields::raw(const char* key) { return find(key, false); }

std::string JsonFields::text(const char* key, const char* example) {
  const auto* value = find(key, true);
  if (value == nullptr) return {};
  if (value->is_string() && !value->get_ref<const std::string&>().empty()) return value->get<std::string>();
  // Without an example, a number or a flag only lacks its quotes.
  const bool bare = *example == '\0' && (value->is_number() || value->is_boolean());
  const auto such = bare ? shortened(value->dump()) : std::string(example);
  const auto hint = such.empty() ? std::string() : fmt::format("; write {}\"{}\"", bare ? "" : "it like ", such);
  if (value->is_string())
    wrong(key, "must not be empty" + hint);
  else
    wrong(key, fmt::format("must be a text, in quotes, not {}{}", described(*value), hint));
  return {};
}

std::string JsonFields::textOr(const char* key, const std::string& default_value, const char* example) {
  return has(key) ? text(key, example) : (known_.insert(key), default_value);
}

std::string JsonFields::wordOf(const char* key, const std::vector<std::string>& allowed) {
  auto word = text(key);
  if (std::find(allowed.begin(), allowed.end(), word) == allowed.end())
    wrong(key, fmt::format("'{}' is not one of {}", word, fmt::join(allowed, ", ")));
  return word;
}

double JsonFields::number(const char* key, double minimum, double maximum) {
  const auto* value = find(key, true);
  if (value == nullptr) return minimum;
  const double number = value->is_number() ? value->get<double>() : std::nan("");
  if (!(number >= minimum && number <= maximum)) {
    needs(key, *value,
          fmt::format("a number from {} to {}{}", minimum, maximum, value->is_string() ? ", without quotes," : ""));
    return minimum;
  }
  return number;
}

double JsonFields::numberOr(const char* key, double default_value, double minimum, double maximum) {
  return has(key) ? number(key, minimum, maximum) : (known_.insert(key), default_value);
}

bool JsonFields::flagOr(const char* key, bool default_value) {
  const auto* value = find(key, false);
  if (value == nullptr) return default_value;
  if (!value->is_boolean()) needs(key, *value, "true or false, without quotes,");
  return value->is_boolean() ? value->get<bool>() : default_value;
}

std::uint32_t JsonFields::colourOr(const char* key, std::uint32_t default_value) {
  if (!has(key)) return default_value;
  const auto written = text(key, "#2e3033");
  std::uint32_t colour = 0;
  const auto* end = written.data() + written.size();
  const bool hexadecimal =
      written.size() == 7 && written.front() == '#' && std::from_chars(written.data() + 1, end, colour, 16).ptr == end;
  if (!hexadecimal && !written.empty()) wrong(key, fmt::format("'{}' is not a colour such as #2e3033", written));
  return hexadecimal ? colour : default_value;
}

Condition JsonFields::condition(const char* key) {
  auto parsed = Condition::parse(textOr(key, "", "setups >= 1"));
  if (!parsed) {
    wrong(key, parsed.error().message);
    return {};
  }
  return *std::move(parsed);
}

std::vector<std::string> JsonFields::texts(const char* key) {
  std::vector<std::string> found;
  const auto* value = find(key, false);
  if (value == nullptr) return found;
  if (!value->is_array())
    needs(key, *value, "a list of texts, such as [\"a\", \"b\"],");
  else
    for (const auto& text : *value) {
      if (text.is_string())
        found.push_back(text.get<std::string>());
      else
        wrong(key, fmt::format("must be a list of texts, but contains {}", described(text)));
    }
  return found;
}

void JsonFields::list(const char* key, const std::function<void(JsonFields&)>& one) {
  const auto* value = find(key, false);
  if (value == nullptr) return;
  if (!value->is_array()) return needs(key, *value, "a list of objects, [{…}, {…}],");
  for (std::size_t i = 0; i < value->size(); ++i) {
    JsonFields fields(fault_, (*value)[i], fmt::format("{}/{}/{}", pointer_, key, i));
    one(fields);
    fields.close();
  }
}

void JsonFields::object(const char* key, const std::function<void(JsonFields&)>& one) {
  const auto* value = find(key, false);
  if (value == nullptr) return;
  JsonFields fields(fault_, *value, fmt::format("{}/{}", pointer_, key));
  one(fields);
  fields.close();
}

void JsonFields::each(const char* key,
                      const std::function<void(const std::string&, const nlohmann::json&, const std::string&)>& one) {
  const auto* value = find(key, false);
  if (value == nullptr) return;
  if (!value->is_object()) return needs(key, *value, "an object, {…},");
  for (const auto& [name, inner] : value->items())
    one(name, inner, (JsonPlace{{}, pointer_} / key / std::string_view(name)).pointer);
}

void JsonFields::everyText(const std::function<void(const std::string&, const std::string&)>& one) {
  for (const auto& [name, value] : object_.items()) {
    if (value.is_string())
      one(name, value.get<std::string>());
    else
      needs(name.c_str(), value, "a text, in quotes,");
  }
}

void JsonFields::close() {
  for (const auto& [name, value] : object_.items())
    if (!known_.contains(name))
      wrong(name.c_str(), "unknown key; " + knownInstead(name, {known_.begin(), known_.end()}));
}

}  // namespace standpoint
