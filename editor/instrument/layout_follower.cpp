// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/instrument/layout_follower.h"

#include <condition_variable>
#include <mutex>

#include "editor/words/sentences.h"
#include "emulated-ui/menus.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

fs::file_time_type writtenAt(const fs::path& file) {
  std::error_code none;
  const auto at = fs::last_write_time(file, none);
  return none ? fs::file_time_type::min() : at;
}

// Looks twice a second whether the file is another than the one written at `known`, without waking the window.
void watchFile(const std::stop_token& stop, const fs::path& file, fs::file_time_type known,
               const std::function<void()>& changed) {
  std::mutex mutex;
  std::condition_variable_any stopped;
  while (!stop.stop_requested()) {
    std::unique_lock lock(mutex);
    stopped.wait_for(lock, stop, std::chrono::milliseconds(500), [] { return false; });
    if (const auto now = writtenAt(file); now != known) {
      known = now;
      changed();
    }
  }
}

}  // namespace

void LayoutFollower::follow(const Device& device, DeviceView& view, const std::function<void()>& wake) {
  const auto& type = device.type();
  const auto* row = findDevice(type.definition.id);
  if (row == nullptr) return;
  const auto file = userLayout(*row);
  const auto written = writtenAt(file);
  const bool other = device_ != type.definition.id || instrument_ != type.instrument.id || file_ != file;
  if (!other && written == written_ && view.layout == layout_) return;
  if (file_ != file || !watch_.joinable()) {
    watch_ = std::jthread([file, written, wake](const std::stop_token& stop) { watchFile(stop, file, written, wake); });
  }
  device_ = type.definition.id;
  instrument_ = type.instrument.id;
  file_ = file;
  written_ = written;
  problem_.clear();
  auto layout = written == fs::file_time_type::min() ? loadLayout(*row, type) : readLayout(file, type.definition);
  if (!layout) {
    problem_ = trError(layout.error());
    layout = loadLayout(*row, type);
  }
  layout_ = std::make_shared<const Layout>(layout ? *std::move(layout) : plainLayout(type.definition));
  view.layout = layout_;
}

}  // namespace standpoint
