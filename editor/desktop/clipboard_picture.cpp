// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/desktop/clipboard_picture.h"

#include <cstdlib>
#include <fcntl.h>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace standpoint {

namespace {

std::string inPath(const char* program) {
  const char* folders = std::getenv("PATH");
  std::istringstream list(folders != nullptr ? folders : "");
  for (std::string folder; std::getline(list, folder, ':');)
    if (const auto file = folder + '/' + program; access(file.c_str(), X_OK) == 0) return file;
  return {};
}

}  // namespace

std::string whyNotCopyPicture() {
  return inPath("xclip").empty() ? "Copying pictures needs the package xclip; show the folder instead" : "";
}

// xclip reads the file, goes into the background and serves it; what this starts has ended by then.
std::string copyPicture(const std::filesystem::path& file) {
  const auto program = inPath("xclip");
  if (program.empty()) return whyNotCopyPicture();
  std::vector<std::string> words = {
      program, "-selection", "clipboard", "-t", file.extension() == ".png" ? "image/png" : "image/jpeg",
      "-i",    file.string()};
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t process = -1;
  const int failed = posix_spawn(&process, program.c_str(), &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  int status = 0;
  if (failed != 0 || waitpid(process, &status, 0) != process || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    return "The picture could not be copied; show the folder instead";
  return {};
}

}  // namespace standpoint
