// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/desktop_opener.h"

#include <chrono>
#include <cstring>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>

#include <fmt/format.h>

extern char** environ;

namespace standpoint {

void DesktopOpener::open(const std::filesystem::path& path, std::function<void()> wake) {
  path_ = path;
  problem_.clear();
  ended_ = {};
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    problem_ = fmt::format("{} does not exist", path.string());
    return;
  }
  std::string program = program_, argument = std::filesystem::absolute(path, error).string();
  char* const words[] = {program.data(), argument.data(), nullptr};  // no shell reads them
  pid_t child = 0;
  if (const int failed = posix_spawnp(&child, program_.c_str(), nullptr, nullptr, words, environ); failed != 0) {
    problem_ = fmt::format("Cannot start '{}' ({}). File: {}", program_, std::strerror(failed), path.string());
    return;
  }
  std::promise<int> promise;
  ended_ = promise.get_future();
  std::thread([child, promise = std::move(promise), wake = std::move(wake)]() mutable {
    int status = 0;
    const bool known = waitpid(child, &status, 0) == child && WIFEXITED(status);
    promise.set_value(known ? WEXITSTATUS(status) : -1);
    wake();
  }).detach();
}

const std::string& DesktopOpener::problem() {
  if (ended_.valid() && ended_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
    if (const int status = ended_.get(); status != 0)
      problem_ = fmt::format("'{}' could not open the file (exit code {}). File: {}", program_, status, path_.string());
  return problem_;
}

}  // namespace standpoint
