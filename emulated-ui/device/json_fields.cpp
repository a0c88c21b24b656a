// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/json_fields.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace standpoint {

namespace {

const nlohmann::json kNothing = nlohmann::json::object();

}  // namespace

void JsonFault::say(const std::string& pointer, const std::string& message) {
  if (!error_) error_ = Error{ErrorKind::unusable, message, file_ + " " + (pointer.empty() ? "/" : pointer)};
}

JsonFields::JsonFields(JsonFault& fault, const nlohmann::json& object, std::string pointer)
    : fault_(fault), object_(object.is_object() ? object : kNothing), pointer_(std::move(pointer)) {
  if (!object.is_object()) fault_.say(pointer_, "an object is needed here");
}

bool JsonFields::has(const char* key) const { return object_.contains(key); }

void JsonFields::wrong(const char* key, const std::string& message) { fault_.say(pointer_ + "/" + key, message); }

const nlohmann::json* JsonFields::find(const char* key, bool required) {
  known_.insert(key);
  const auto found = object_.find(key);
  if (found != object_.end()) return &*found;
  if (required) fault_.say(pointer_, fmt::format("'{}' is missing", key));
  return nullptr;
}

const nlohmann::json* JsonFields::raw(const char* key) { return find(key, false); }

std::string JsonFields::text(const char* key) {
  const auto* value = find(key, true);
  if (value == nullptr) return {};
  if (!value->is_string() || value->get_ref<const std::string&>().empty()) {
    wrong(key, "a text is needed here");
    return {};
  }
  return value->get<std::string>();
}

std::string JsonFields::textOr(const char* key, const std::string& standard) {
  return has(key) ? text(key) : (known_.insert(key), standard);
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
    wrong(key, fmt::format("a number from {} to {} is needed here", minimum, maximum));
    return minimum;
  }
  return number;
}

double JsonFields::numberOr(const char* key, double standard, double minimum, double maximum) {
  return has(key) ? number(key, minimum, maximum) : (known_.insert(key), standard);
}

bool JsonFields::flagOr(const char* key, bool standard) {
  const auto* value = find(key, false);
  if (value == nullptr) return standard;
  if (!value->is_boolean()) wrong(key, "true or false is needed here");
  return value->is_boolean() ? value->get<bool>() : standard;
}

Condition JsonFields::condition(const char* key) {
  auto parsed = Condition::parse(textOr(key, ""));
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
  if (!value->is_array()) wrong(key, "a list of texts is needed here");
  else
    for (const auto& text : *value) {
      if (text.is_string()) found.push_back(text.get<std::string>());
      else wrong(key, "a list of texts is needed here");
    }
  return found;
}

void JsonFields::list(const char* key, const std::function<void(JsonFields&)>& one) {
  const auto* value = find(key, false);
  if (value == nullptr) return;
  if (!value->is_array()) return wrong(key, "a list is needed here");
  for (std::size_t i = 0; i < value->size(); ++i) {
    JsonFields fields(fault_, (*value)[i], fmt::format("{}/{}/{}", pointer_, key, i));
    one(fields);
    fields.close();
  }
}

void JsonFields::each(const char* key, const std::function<void(const std::string&, const nlohmann::json&, const std::string&)>& one) {
  const auto* value = find(key, false);
  if (value == nullptr) return;
  if (!value->is_object()) return wrong(key, "an object is needed here");
  for (const auto& [name, inner] : value->items()) one(name, inner, fmt::format("{}/{}/{}", pointer_, key, name));
}

void JsonFields::everyText(const std::function<void(const std::string&, const std::string&)>& one) {
  for (const auto& [name, value] : object_.items()) {
    if (value.is_string()) one(name, value.get<std::string>());
    else wrong(name.c_str(), "a text is needed here");
  }
}

void JsonFields::close() {
  for (const auto& [name, value] : object_.items())
    if (!known_.contains(name)) wrong(name.c_str(), "an unknown key");
}

}  // namespace standpoint
