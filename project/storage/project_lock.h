// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "core/progress.h"
#include "core/result.h"

namespace standpoint {

constexpr const char* kProjectLockFile = ".lock";

// The right to change a project: one writer at a time holds it, from reading the project to having replaced it.
// Advisory, by flock(2) on a file in the project's folder that says who writes and since when. The system takes it back
// when its process ends, however it ends, so no lock outlives its writer; readers need none (see loadProject).
class ProjectLock {
 public:
  // How long a second writer waits for the first.
  static constexpr std::chrono::seconds kPatience{30};

  // Waits for another writer, and is cancelled by `progress`. Then an error of kind file_system that names the other
  // writer and the remedy. Makes the folder where there is none. `doing` is what others are told: "station".
  static Result<ProjectLock> acquire(const std::filesystem::path& folder, const std::string& doing, Progress& progress,
                                     std::chrono::milliseconds patience = kPatience);

  ProjectLock(ProjectLock&& other) noexcept;
  ProjectLock& operator=(ProjectLock&&) = delete;
  ~ProjectLock();

 private:
  ProjectLock(std::filesystem::path file, int descriptor) : file_(std::move(file)), descriptor_(descriptor) {}

  std::filesystem::path file_;
  int descriptor_;
};

constexpr const char* kOpenMarkFile = ".open";

// Says that an editor has the project open, so that a second one can ask before two people change it side by side. It
// keeps nobody from writing, and goes with its process like the lock.
class OpenMark {
 public:
  // Nothing where another one has it; `holder` then says who. In a folder that may not be written there is no mark, and
  // none is missed.
  static std::optional<OpenMark> take(const std::filesystem::path& folder, std::string& holder);

  OpenMark(OpenMark&& other) noexcept;
  OpenMark& operator=(OpenMark&&) = delete;
  ~OpenMark();

 private:
  OpenMark(std::filesystem::path file, int descriptor) : file_(std::move(file)), descriptor_(descriptor) {}

  std::filesystem::path file_;
  int descriptor_;  // -1: none could be made
};

}  // namespace standpoint
