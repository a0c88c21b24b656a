// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/result.h"

namespace standpoint {

// Typed look-ups in JSON that people write, for the readers of all rooms.

// As errors name a file whose folder says what it is of: "leica-rtc360/device.json".
std::string nameWithFolder(const std::filesystem::path& file);

// The first thing that is wrong with a file: what is read after it is of no use.
class JsonFault {
 public:
  explicit JsonFault(std::string file) : file_(std::move(file)) {}
  void say(const std::string& pointer, const std::string& message);
  // The same where a value is of another kind: what is needed, and what was found.
  void needs(const std::string& pointer, const nlohmann::json& found, const std::string& needed);
  const std::string& file() const { return file_; }
  const std::optional<Error>& error() const { return error_; }
  Result<void> result() const;

 private:
  std::string file_;
  std::optional<Error> error_;
};

// Values that are no members of an object, such as entries of a list. A text is not blank; a number after a fault is
// `minimum`.
std::string textAt(JsonFault& fault, const nlohmann::json& value, const std::string& pointer,
                   std::string_view example = {});
double numberAt(JsonFault& fault, const nlohmann::json& value, const std::string& pointer, double minimum,
                double maximum);

// The fields of one JSON object. What is missing, of another kind, out of its bounds or unknown is a fault with its
// JSON pointer; what is returned then is only there to go on.
class JsonFields {
 public:
  JsonFields(JsonFault& fault, const nlohmann::json& object, std::string pointer);

  bool has(std::string_view key) const;
  bool isNull(std::string_view key);  // it is there, as null
  std::vector<std::string> keys() const;
  // Not blank. `example`: what such a text looks like, for whoever wrote something else.
  std::string text(std::string_view key, std::string_view example = {});
  std::string textOr(std::string_view key, const std::string& default_value, std::string_view example = {});
  std::string anyText(std::string_view key);  // blank, too
  std::string wordOf(std::string_view key, const std::vector<std::string>& allowed);
  double number(std::string_view key, double minimum, double maximum);
  std::optional<double> optionalNumber(std::string_view key, double minimum, double maximum);
  double numberOr(std::string_view key, double default_value, double minimum, double maximum);
  bool flagOr(std::string_view key, bool default_value);
  std::uint32_t colourOr(std::string_view key, std::uint32_t default_value);  // "#2e3033" as 0x2e3033
  std::vector<std::string> texts(std::string_view key);                       // empty when it is missing
  // Objects of a list that may be missing, in their order.
  void list(std::string_view key, const std::function<void(JsonFields&)>& one);
  // An object that may be missing.
  void object(std::string_view key, const std::function<void(JsonFields&)>& one);
  // Values of an object that may be missing.
  void each(std::string_view key,
            const std::function<void(const std::string& name, const nlohmann::json&, const std::string& pointer)>& one);
  void everyText(const std::function<void(const std::string& key, const std::string& text)>& one);
  const nlohmann::json* raw(std::string_view key);       // null when it is missing
  const nlohmann::json* required(std::string_view key);  // a fault when it is missing
  void skip(std::string_view key) { known_.emplace(key); }
  void close();  // unknown keys are a fault

  void wrong(std::string_view key, const std::string& message);  // of the object itself where `key` is empty
  void needs(std::string_view key, const nlohmann::json& found, const std::string& needed);
  JsonFault& fault() { return fault_; }
  const std::string& pointer() const { return pointer_; }
  std::string pointer(std::string_view key) const;

 private:
  JsonFault& fault_;
  const nlohmann::json& object_;
  std::string pointer_;
  std::set<std::string, std::less<>> known_;
};

// A value for a message: "the number 2", "the text 'two'", "a list".
std::string described(const nlohmann::json& value);

}  // namespace standpoint
