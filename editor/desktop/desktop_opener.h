// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "project/task.h"

namespace standpoint {

// Opens files and folders with what the desktop has for them. Nothing waits for the program that is started.
class DesktopOpener {
 public:
  // `program` takes the path as its only argument.
  explicit DesktopOpener(std::string program = "xdg-open") : program_(std::move(program)) {}

  // `wake` is called from another thread when problem() may have changed.
  void open(const std::filesystem::path& path, std::function<void()> wake);
  // What went wrong with the last `open`, once that is known; empty else. Names the path.
  const std::string& problem();
  // The last problem was read.
  void forget() { problem_.clear(); }

 private:
  std::string program_, problem_;
  std::filesystem::path path_;
  std::unique_ptr<Task<int>> task_;  // ends with the exit status of the program, or -1
};

// The first of these programs that the search path has; "" where it has none.
std::string firstProgram(std::span<const char* const> names);
// What CloudCompare is called on this machine; "" where it is not installed.
std::string cloudCompareProgram();

}  // namespace standpoint
