// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "emulated-ui/draw/device_view.h"

namespace standpoint {

// Gives a device the layout of its user where there is a file of it that can be used, else its own, and follows that
// file while it is edited: what was saved is shown at once.
class LayoutFollower {
 public:
  // `wake` is called from another thread when the file changes.
  void follow(const Device& device, DeviceView& view, const std::function<void()>& wake);
  // Why the user's file is not used: file, place and remedy; empty: it is, or there is none.
  const std::string& problem() const { return problem_; }
  const std::filesystem::path& file() const { return file_; }

 private:
  std::string device_;
  std::string instrument_;
  std::filesystem::path file_;
  std::filesystem::file_time_type written_{};  // the smallest: there is no file
  std::shared_ptr<const Layout> layout_;
  std::string problem_;
  std::jthread watch_;
};

}  // namespace standpoint
