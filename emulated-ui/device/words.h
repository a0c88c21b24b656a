// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/result.h"

namespace standpoint {

// The words on the instruments' screens, in the languages that their files have: a teacher with the manual at hand
// corrects them, or adds a language, without a build. A file is
//   {"about": "…", "words": {"scan": {"en": "Scan", "de": "Scannen", "uk": "…"}}}
// Every file may add languages to the words of others. The files of a folder have the words that the devices share, or
// those of the device that "of" names: {"of": "leica-rtc360", …}.
class Words {
 public:
  static Result<Words> read(const std::filesystem::path& folder);
  Result<void> add(const std::filesystem::path& file, const std::string& device);  // the device's own words

  // The device's own word, else the shared one; in English where the language lacks it; the key where nobody has it.
  std::string text(const std::string& device, const std::string& key, const std::string& language) const;
  bool has(const std::string& device, const std::string& key, const std::string& language) const;
  std::vector<std::string> languages() const;  // "de", "en", "uk", …

 private:
  Result<void> take(const std::filesystem::path& file, std::string device);
  const std::string* find(const std::string& device, const std::string& key, const std::string& language) const;

  std::map<std::string, std::map<std::string, std::string>> texts_;  // "leica-rtc360/scan" or "scan": language: text
};

}  // namespace standpoint
