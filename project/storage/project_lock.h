// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
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

}  // namespace standpoint
