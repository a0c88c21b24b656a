// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdlib>
#include <fcntl.h>
#include <functional>
#include <random>
#include <signal.h>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <vector>

namespace standpoint {

// How often tests kill, and from which seed: STANDPOINT_KILLS and STANDPOINT_KILL_SEED, for scripts/kills.sh.
inline unsigned kills() {
  const char* asked = std::getenv("STANDPOINT_KILLS");
  return asked == nullptr ? 10 : static_cast<unsigned>(std::atoi(asked));
}
inline unsigned killSeed() {
  const char* asked = std::getenv("STANDPOINT_KILL_SEED");
  return asked == nullptr ? 1 : static_cast<unsigned>(std::atoi(asked));
}

// Another program, with its output thrown away.
class Process {
 public:
  explicit Process(std::vector<std::string> words) {
    std::vector<char*> arguments;
    for (auto& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    if (posix_spawn(&id_, arguments.front(), &files, nullptr, arguments.data(), environ) != 0) id_ = -1;
    posix_spawn_file_actions_destroy(&files);
  }
  pid_t id() const { return id_; }
  // Waits for its end; its exit code, or -1.
  int wait() {
    int status = 0;
    if (id_ < 0 || waitpid(id_, &status, 0) != id_) return -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  // False where it had ended before.
  bool killAfter(std::chrono::microseconds time) {
    std::this_thread::sleep_for(time);
    if (id_ < 0) return false;
    kill(id_, SIGKILL);
    int status = 0;
    waitpid(id_, &status, 0);
    return WIFSIGNALED(status);
  }
  // The same from when something has begun.
  bool killAfter(const std::function<bool()>& begun, std::chrono::microseconds time) {
    while (id_ > 0 && !begun()) {
      if (waitpid(id_, nullptr, WNOHANG) == id_) return false;
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    return killAfter(time);
  }

 private:
  pid_t id_ = -1;
};

// From 0 to `longest`, evenly.
inline std::chrono::microseconds randomTime(std::mt19937& random, std::chrono::microseconds longest) {
  return longest * static_cast<long>(random() % 10000) / 10000;
}

}  // namespace standpoint
