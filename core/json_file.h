// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/result.h"

namespace standpoint {

// Where a value stands: the file's name and a JSON pointer, as errors print it ("wood.json /3/reflectance/0/1").
struct JsonPlace {
  std::string file;
  std::string pointer;

  JsonPlace operator/(std::string_view key) const;
  JsonPlace operator/(std::size_t index) const { return {file, pointer + '/' + std::to_string(index)}; }
  tl::unexpected<Error> unusable(std::string message) const;
};

Result<std::string> readWholeFile(const std::filesystem::path& file, std::uintmax_t max_bytes);
constexpr std::uintmax_t kLargestJsonFile = 16U << 20U;  // of what people write: the library of materials is 0.1 MB

// Files that people write. One that is too large or nests too deeply, syntax errors and a key given twice are errors
// with their place.
Result<nlohmann::json> readJsonFile(const std::filesystem::path& file, std::uintmax_t max_bytes = kLargestJsonFile);
Result<nlohmann::json> readJsonArray(const std::filesystem::path& file);
Result<nlohmann::json> parseJson(const std::string& text, const std::string& file_name);

}  // namespace standpoint
