// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/words.h"

#include <algorithm>
#include <set>

#include <nlohmann/json.hpp>

#include "core/json_fields.h"
#include "core/json_file.h"

namespace standpoint {

namespace {

constexpr std::size_t kLongestWord = 2000;
constexpr std::string_view kLanguage = "language=";  // with a code: the name of that language

}  // namespace

Result<Words> Words::read(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  if (error) return failure(ErrorKind::file_system, "cannot read the folder: " + error.message(), folder.string());
  std::sort(files.begin(), files.end());
  for (auto& file : languageFiles(folder, "common")) files.push_back(std::move(file));
  Words words;
  for (const auto& file : files) TRY(words.take(file, {}));
  return words;
}

Result<void> Words::add(const std::filesystem::path& file, const std::string& device) { return take(file, device); }

Result<void> Words::take(const std::filesystem::path& file, std::string device) {
  TRY_ASSIGN(const auto json, readJsonFile(file));
  JsonFault fault(nameWithFolder(file));
  JsonFields root(fault, json, "");
  root.skip("about");
  if (device.empty()) device = root.textOr("of", "");
  const auto only = root.textOr("language", "");
  const auto put = [&](const std::string& key, const std::string& language, const std::string& text,
                       const std::string& at) {
    if (text.empty() || text.size() > kLongestWord) fault.say(at, "must be a text of 1 to 2000 bytes");
    if (!texts_[device.empty() ? key : device + "/" + key].emplace(language, text).second)
      fault.say(at, "already defined in another file");
  };
  root.each("words", [&](const std::string& key, const nlohmann::json& word, const std::string& at) {
    if (!only.empty()) return put(key, only, textAt(fault, word, at, "Scan"), at);
    JsonFields fields(fault, word, at);
    fields.everyText(
        [&](const std::string& language, const std::string& text) { put(key, language, text, at + "/" + language); });
  });
  root.close();
  return fault.result();
}

const std::string* Words::find(const std::string& device, const std::string& key, const std::string& language) const {
  const auto in = key.starts_with(kLanguage) ? key.substr(kLanguage.size()) : language;
  for (const auto& name : {device + "/" + key, key})
    if (const auto found = texts_.find(name); found != texts_.end()) {
      if (const auto text = found->second.find(in); text != found->second.end()) return &text->second;
      if (found->second.contains("en")) return nullptr;  // a word of its own: the shared one means something else
    }
  return nullptr;
}

std::string Words::text(const std::string& device, const std::string& key, const std::string& language) const {
  if (const auto* found = find(device, key, language)) return *found;
  if (const auto* english = find(device, key, "en")) return *english;
  return key;
}

bool Words::has(const std::string& device, const std::string& key, const std::string& language) const {
  return find(device, key, language) != nullptr;
}

std::vector<std::filesystem::path> languageFiles(const std::filesystem::path& folder, const std::string& name) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (auto file = entry.path() / (name + ".json"); std::filesystem::is_regular_file(file, error))
      files.push_back(std::move(file));
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> Words::languages() const {
  std::set<std::string> all;
  for (const auto& [key, by_language] : texts_)
    for (const auto& [language, text] : by_language) all.insert(language);
  return {all.begin(), all.end()};
}

}  // namespace standpoint
