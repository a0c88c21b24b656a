// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
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

class Session;

// Keeps a copy of what a session has not saved, anew after every change, and none where all is saved.
class RecoveryKeeper {
 public:
  explicit RecoveryKeeper(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // Begins a copy where the document has changed since the last one. Call once a frame.
  void keep(Session& session);
  // Nothing would be lost now.
  bool upToDate(const Session& session) const;

 private:
  std::filesystem::path folder_;
  std::uint64_t tried_revision_ = 0;
  std::string owner_name_, owner_saved_in_;  // as they were written last
  bool there_ = false;
};

}  // namespace standpoint
