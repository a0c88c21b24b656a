// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/desktop/desktop_opener.h"

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "editor/words/words.h"

extern char** environ;

namespace standpoint {

namespace {

// Of a program that was started; it goes on where this is cancelled.
Result<int> exitStatusOf(pid_t child, const Progress& progress) {
  int status = 0;
  pid_t ended = 0;
  while ((ended = waitpid(child, &status, WNOHANG)) == 0) {
    TRY(progress.check());
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return ended == child && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

void DesktopOpener::open(const std::filesystem::path& path, std::function<void()> wake) {
  path_ = path;
  problem_.clear();
  task_.reset();
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    problem_ = trf("{} does not exist", path.string());
    return;
  }
  std::string program = program_, argument = std::filesystem::absolute(path, error).string();
  char* const words[] = {program.data(), argument.data(), nullptr};  // no shell reads them
  pid_t child = 0;
  if (const int failed = posix_spawnp(&child, program_.c_str(), nullptr, nullptr, words, environ); failed != 0) {
    problem_ = trf("Cannot start '{}' ({}). File: {}", program_, std::strerror(failed), path.string());
    return;
  }
  task_ = std::make_unique<Task<int>>(
      trf("Open {}", path.filename().string()), [child](Progress& progress) { return exitStatusOf(child, progress); },
      std::move(wake));
}

const std::string& DesktopOpener::problem() {
  if (task_ && task_->done()) {
    const auto status = std::exchange(task_, nullptr)->take();
    if (status && *status != 0)
      problem_ = trf("'{}' could not open the file (exit code {}). File: {}", program_, *status, path_.string());
  }
  return problem_;
}

std::string firstProgram(std::span<const char* const> names) {
  const char* path = std::getenv("PATH");
  for (const char* name : names) {
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');)
      if (::access((std::filesystem::path(folder) / name).c_str(), X_OK) == 0) return name;
  }
  return {};
}

std::string cloudCompareProgram() {
  static constexpr const char* kNames[] = {"CloudCompare", "cloudcompare", "cloudcompare.CloudCompare"};
  return firstProgram(kNames);
}

}  // namespace standpoint
