// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "editor/recovery/left_work.h"

namespace standpoint {

class Session;

// Keeps a copy of what a session has not saved, anew after every change, and none where all is saved. Beside it, what
// the session is and what runs in it. The folder is this process's own; whoever closes the editor removes it.
class RecoveryKeeper {
 public:
  explicit RecoveryKeeper(std::filesystem::path folder, bool after_crash = false)
      : folder_(std::move(folder)), after_crash_(after_crash) {}

  // Begins a copy where the document has changed since the last one. Call once a frame.
  void keep(Session& session, bool copies = true);
  // The display is gone, and the program will be: waits until the newest change is kept.
  void keepLast(Session& session);
  // Nothing would be lost now.
  bool upToDate(const Session& session) const;
  // Until the session is no longer young, so that keep() is called then; less than 0: it is not.
  double untilGrown_s() const;
  // Why nothing can be kept; "" when all is well.
  const std::string& problem() const { return problem_; }

 private:
  using Clock = std::chrono::steady_clock;
  void keepCopy(Session& session);
  void keepMark(const Session& session);

  std::filesystem::path folder_;
  bool after_crash_ = false, display_lost_ = false;
  Clock::time_point begun_ = Clock::now(), marked_;
  std::uint64_t tried_revision_ = 0;
  std::optional<SessionMark> written_;
  std::string problem_;
  bool there_ = false;  // a copy
};

}  // namespace standpoint
