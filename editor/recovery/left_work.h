// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/result.h"

namespace standpoint {

// A task as it was when its editor was last heard of.
struct LeftJob {
  std::string title;  // "Scan all stations"
  std::string stage;  // "Scan K3 (2 of 5)"; may be empty
  int percent = 0;
  std::string verb;
  nlohmann::json options = nlohmann::json::object();
  bool operator==(const LeftJob&) const = default;
};

// What a running editor says of itself, for the start after a crash.
struct SessionMark {
  std::string name;         // of the project
  std::string saved_in;     // where the project itself lies; "" when it was never saved
  std::size_t changes = 0;  // that are not saved
  std::vector<LeftJob> jobs;
  bool young = true;          // it has run for less than a minute
  bool after_crash = false;   // it was started after an editor that crashed
  bool display_lost = false;  // it ended because of that: no crash of its own
  // How it was looked at, for whoever opens it again (shell/recovery_dialogs.h).
  nlohmann::json shown = nlohmann::json::object();
  bool operator==(const SessionMark&) const = default;
};

// What a start finds of an editor that ended without closing: <root>/<process id>/{owner.json, copy/}.
struct LeftWork {
  std::filesystem::path folder;   // to be removed when it is no longer wanted
  std::filesystem::path project;  // a copy of unsaved work, a project like any other; empty: nothing was unsaved
  SessionMark mark;
  std::string last_heard;  // "14:32, 2026-11-24"; "" when that is unknown
};

std::filesystem::path recoveryFolder(const std::filesystem::path& root, long process);
// Whole or not at all, with which process it is.
Result<void> writeSessionMark(const std::filesystem::path& folder, const SessionMark& mark);
// Of processes that are gone, newest first: those that left a copy or a job.
std::vector<LeftWork> findLeftWork(const std::filesystem::path& root);
void removeRecovery(const std::filesystem::path& folder);

// The crashes since the last start.
struct NewCrashes {
  bool any = false;
  bool again_at_start = false;  // one within a minute of a start that itself followed a crash: start bare
};
// Each crash is told to one start: what it left stays, and a folder that nothing was left in goes.
NewCrashes takeNewCrashes(const std::filesystem::path& root);

// The scan among its jobs, which can be resumed; null: none.
const LeftJob* leftScan(const LeftWork& left);
// What the user reads, a sentence each.
std::vector<std::string> sentencesOf(const LeftWork& left);

}  // namespace standpoint
