// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/json_file.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <vector>

#include <nlohmann/json.hpp>

namespace standpoint {

namespace {

constexpr int kDeepest = 32;

// nlohmann-json keeps the last of two equal keys; a figure given twice must not vanish, so keys are watched while
// parsing.
class KeyWatch {
 public:
  bool operator()(int depth, nlohmann::json::parse_event_t event, const nlohmann::json& parsed) {
    using Event = nlohmann::json::parse_event_t;
    if (depth > kDeepest) wrong_ = "is nested deeper than " + std::to_string(kDeepest) + " levels";
    if (!wrong_.empty()) return false;
    if (event == Event::object_start) levels_.emplace_back();
    if (event == Event::object_end) levels_.pop_back();
    if (event == Event::key && !levels_.back().insert(parsed.get<std::string>()).second)
      wrong_ = "has the key '" + parsed.get<std::string>() + "' more than once in one object";
    return wrong_.empty();
  }
  const std::string& wrong() const { return wrong_; }

 private:
  std::vector<std::set<std::string>> levels_;
  std::string wrong_;
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
  const JsonPlace root{file_name, {}};
  KeyWatch watch;
  nlohmann::json result;
  try {
    result =
        nlohmann::json::parse(text, [&](int depth, auto event, auto& parsed) { return watch(depth, event, parsed); });
  } catch (const nlohmann::json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    return failure(ErrorKind::unusable, "is not JSON: " + std::string(error.what()),
                   root.file + " line " + std::to_string(1 + std::count(text.begin(), end, '\n')));
  } catch (const nlohmann::json::exception& error) {
    return root.unusable("is not JSON: " + std::string(error.what()));
  }
  if (!watch.wrong().empty()) return root.unusable(watch.wrong());
  return result;
}

}  // namespace standpoint
