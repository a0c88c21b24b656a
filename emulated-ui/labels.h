// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "core/result.h"

namespace standpoint {

// The words on an instrument's screens, in a data file, so that a teacher with the manual at hand corrects them without a
// build. Keys are widget or screen ids; a key that is missing shows itself.
class Labels {
 public:
  static Result<Labels> read(const std::filesystem::path& file);
  std::string operator()(const std::string& key) const;

 private:
  std::map<std::string, std::string> texts_;
};

}  // namespace standpoint
