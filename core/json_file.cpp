// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/json_file.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <set>
#include <vector>

#include <nlohmann/json.hpp>

namespace standpoint {

namespace {

constexpr std::size_t kDeepest = 32;

// nlohmann-json keeps the last of two equal keys; a figure given twice must not vanish. A pass of its own looks for
// them: the callback of json::parse() walks through the whole list again after each of its objects.
class KeyWatch : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit KeyWatch(const std::string& text) : text_(text) {}

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override {
    levels_.emplace_back();
    return isShallow();
  }
  bool end_object() override { return levels_.pop_back(), true; }
  bool start_array(std::size_t) override {
    levels_.emplace_back();
    return isShallow();
  }
  bool end_array() override { return levels_.pop_back(), true; }
  bool key(string_t& key) override {
    if (levels_.back().insert(key).second) return true;
    wrong_ = "has the key '" + key + "' more than once in one object";
    return false;
  }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::json::exception& error) override {
    wrong_ = "is not JSON: " + std::string(error.what());
    if (dynamic_cast<const nlohmann::json::parse_error*>(&error) == nullptr) return false;  // a number out of range
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(position, text_.size()));
    line_ = 1 + std::count(text_.begin(), end, '\n');
    return false;
  }

  // What is wrong, and in which line where the text is no JSON.
  const std::string& wrong() const { return wrong_; }
  std::optional<std::ptrdiff_t> line() const { return line_; }

 private:
  bool isShallow() {
    if (levels_.size() <= kDeepest) return true;
    wrong_ = "is nested deeper than " + std::to_string(kDeepest) + " levels";
    return false;
  }

  const std::string& text_;
  std::vector<std::set<std::string>> levels_;  // the keys so far, of a list none
  std::string wrong_;
  std::optional<std::ptrdiff_t> line_;
};

}  // namespace

JsonPlace JsonPlace::operator/(std::string_view key) const {
  std::string escaped;  // RFC 6901
  for (const char c : key) escaped += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return {file, pointer + '/' + escaped};
}

tl::unexpected<Error> JsonPlace::unusable(std::string message) const {
  return failure(ErrorKind::unusable, std::move(message), pointer.empty() ? file : file + ' ' + pointer);
}

Result<std::string> readWholeFile(const std::filesystem::path& file, std::uintmax_t max_bytes) {
  std::error_code code;
  const auto size = std::filesystem::file_size(file, code);
  if (code) return failure(ErrorKind::file_system, "cannot be read: " + code.message(), file.string());
  if (size > max_bytes)
    return failure(ErrorKind::unusable, "is larger than " + std::to_string(max_bytes >> 20U) + " MB", file.string());
  std::ifstream stream(file, std::ios::binary);
  std::string text(size, '\0');
  if (!stream.read(text.data(), static_cast<std::streamsize>(size)))
    return failure(ErrorKind::file_system, "cannot be read", file.string());
  return text;
}

Result<nlohmann::json> readJsonFile(const std::filesystem::path& file, std::uintmax_t max_bytes) {
  TRY_ASSIGN(const auto text, readWholeFile(file, max_bytes));
  return parseJson(text, file.filename().string());
}

Result<nlohmann::json> readJsonArray(const std::filesystem::path& file) {
  auto content = readJsonFile(file);
  if (content && !content->is_array()) return JsonPlace{file.filename().string(), {}}.unusable("must be a list");
  return content;
}

Result<nlohmann::json> parseJson(const std::string& text, const std::string& file_name) {
  KeyWatch watch(text);
  if (!nlohmann::json::sax_parse(text, &watch)) {
    const auto line = watch.line();
    return failure(ErrorKind::unusable, watch.wrong(), line ? file_name + " line " + std::to_string(*line) : file_name);
  }
  return nlohmann::json::parse(text);
}

}  // namespace standpoint
