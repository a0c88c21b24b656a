// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/result.h"
#include "emulated-ui/device/condition.h"

namespace standpoint {

// As errors name a file whose folder says what it is of: "leica-rtc360/device.json".
std::string nameWithFolder(const std::filesystem::path& file);

// The first thing that is wrong with a file: what is read after it is of no use.
class JsonFault {
 public:
  explicit JsonFault(std::string file) : file_(std::move(file)) {}
  void say(const std::string& pointer, const std::string& message);
  const std::optional<Error>& error() const { return error_; }

 private:
  std::string file_;
  std::optional<Error> error_;
};

// The fields of one JSON object. What is missing, of another kind, out of its bounds or unknown is a fault with its
// JSON pointer; what is returned then is only there to go on.
class JsonFields {
 public:
  JsonFields(JsonFault& fault, const nlohmann::json& object, std::string pointer);

  bool has(const char* key) const;
  bool isNull(const char* key);  // it is there, as null
  std::vector<std::string> keys() const;
  // `example`: what such a text looks like, for whoever wrote something else.
  std::string text(const char* key, const char* example = "");
  std::string textOr(const char* key, const std::string& default_value, const char* example = "");
  std::string wordOf(const char* key, const std::vector<std::string>& allowed);
  double number(const char* key, double minimum, double maximum);
  double numberOr(const char* key, double default_value, double minimum, double maximum);
  bool flagOr(const char* key, bool default_value);
  std::uint32_t colourOr(const char* key, std::uint32_t default_value);  // "#2e3033" as 0x2e3033
  Condition condition(const char* key);                                  // empty when it is missing
  std::vector<std::string> texts(const char* key);                       // empty when it is missing
  // Objects of a list that may be missing, in their order.
  void list(const char* key, const std::function<void(JsonFields&)>& one);
  // An object that may be missing.
  void object(const char* key, const std::function<void(JsonFields&)>& one);
  // Values of an object that may be missing.
  void each(const char* key,
            const std::function<void(const std::string& name, const nlohmann::json&, const std::string& pointer)>& one);
  void everyText(const std::function<void(const std::string& key, const std::string& text)>& one);
  const nlohmann::json* raw(const char* key);  // null when it is missing
  void skip(const char* key) { known_.insert(key); }
  void close();  // unknown keys are a fault

  void wrong(const char* key, const std::string& message);
  // The same where a value is of another kind: what is needed, and what was found.
  void needs(const char* key, const nlohmann::json& found, const std::string& needed);
  JsonFault& fault() { return fault_; }
  const std::string& pointer() const { return pointer_; }

 private:
  const nlohmann::json* find(const char* key, bool required);

  JsonFault& fault_;
  const nlohmann::json& object_;
  std::string pointer_;
  std::set<std::string> known_;
};

// A value for a message: "the number 2", "the text 'two'", "a list".
std::string described(const nlohmann::json& value);

}  // namespace standpoint
