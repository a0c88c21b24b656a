// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"

namespace standpoint {

// A copy of unsaved work that a start finds after a crash: <root>/<process id>/{owner.json, copy/}.
struct RecoveryCopy {
  std::filesystem::path folder;   // to be removed when it is no longer wanted
  std::filesystem::path project;  // the copy, a project like any other
  std::string name;               // of the project
  std::string saved_in;           // where the project itself lies; "" when it was never saved
};

std::filesystem::path recoveryFolder(const std::filesystem::path& root, long process);
Result<void> writeRecoveryOwner(const std::filesystem::path& folder, const std::string& name,
                                const std::string& saved_in);
// Copies whose process is gone, newest first.
std::vector<RecoveryCopy> findRecoveryCopies(const std::filesystem::path& root);
void removeRecovery(const std::filesystem::path& folder);

}  // namespace standpoint
