// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/report.h"
#include "core/result.h"

namespace standpoint {

// The words on the instruments' screens, in the languages that their files have: a teacher with the manual at hand
// corrects them, or adds a language, without a build. A file is
//   {"about": "…", "words": {"scan": {"en": "Scan", "de": "Scannen", "uk": "…"}}}
// and in a language's folder, such as pl/common.json or pl/leica-rtc360.json,
//   {"language": "pl", "words": {"scan": "Skanuj"}}
// Every file may add languages to the words of others. The files of a folder, and common.json of each language, have
// the words that the devices share, or those of the device that "of" names: {"of": "leica-rtc360", …}. A word may name
// facts in braces, "{battery} remaining", and have forms for a count (language/plural.h):
//   "{setups} {setups|one=setup|other=setups}"
class Words {
 public:
  static Result<Words> read(const std::filesystem::path& folder);                  // with common.json of each language
  Result<void> add(const std::filesystem::path& file, const std::string& device);  // the device's own words

  // The device's own word, else the shared one; in English where the language lacks it; the key where nobody has it.
  // The name of a language ("language=pl") is in that language.
  std::string text(const std::string& device, const std::string& key, const std::string& language) const;
  bool has(const std::string& device, const std::string& key, const std::string& language) const;
  std::vector<std::string> languages() const;  // "de", "en", "uk", …

  // All that is wrong between the languages, by word: a language lacks it, or it is in no use since the English is
  // gone; other facts in braces, or other forms for a count than the language has. A label much longer than the English
  // one is a warning.
  Report check() const;

 private:
  Result<void> take(const std::filesystem::path& file, std::string device);
  const std::string* find(const std::string& device, const std::string& key, const std::string& language) const;

  std::map<std::string, std::map<std::string, std::string>> texts_;  // "leica-rtc360/scan" or "scan": language: text
};

// The files of this name in the folders of the languages, by language: "common", "exercises", the id of a device.
std::vector<std::filesystem::path> languageFiles(const std::filesystem::path& folder, const std::string& name);

}  // namespace standpoint
