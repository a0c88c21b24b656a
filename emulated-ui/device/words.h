// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/result.h"

namespace standpoint {

// The words on the instruments' screens, in the languages that the files of a folder have: a teacher with the manual at
// hand corrects them, or adds a language, without a build. A file is
//   {"about": "…", "of": "leica-rtc360", "words": {"scan": {"en": "Scan", "de": "Scannen", "uk": "…"}}}
// and every file may add languages to the words of others. "of" is absent for words that the devices share.
class Words {
 public:
  static Result<Words> read(const std::filesystem::path& folder);

  // The device's own word, else the shared one; in English where the language lacks it; the key where nobody has it.
  std::string text(const std::string& device, const std::string& key, const std::string& language) const;
  bool has(const std::string& device, const std::string& key, const std::string& language) const;
  std::vector<std::string> languages() const;  // "de", "en", "uk", …

 private:
  const std::string* find(const std::string& device, const std::string& key, const std::string& language) const;

  std::map<std::string, std::map<std::string, std::string>> texts_;  // "leica-rtc360/scan" or "scan": language: text
};

}  // namespace standpoint
