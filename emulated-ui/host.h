// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "emulated-ui/menus.h"
#include "project/task.h"

namespace standpoint {

// Where an instrument's setup is stored in a project: scans/<job>/Setup 001.e57. The names are the record: a project that
// is opened again fills the instrument's memory from them.
std::filesystem::path scanFile(const std::filesystem::path& scans_folder, const ScanRequest& request);
std::vector<StoredScan> storedScans(const Document& document, const std::string& instrument);

// Runs an emulated instrument against a document: its requests become the verb `scan` (as a Task), its clock goes as fast
// as the user wants, and a setup enters the document only when the instrument has stored it.
class InstrumentHost {
 public:
  InstrumentHost(const EmulatedInstrument& emulated, std::unique_ptr<Menu> menu, const Document& document,
                 std::function<void()> wake);

  Menu& menu() { return *menu_; }
  const char* device() const { return emulated_.device; }

  // Instrument seconds per second: 1 is rehearsal in real time.
  double time_factor = 20;
  std::uint64_t seed = 1;

  // Call once per frame. `seconds` since the last call; `scans_folder` empty while the project has no folder.
  // Gives `document` with the setup in it, and the undo line, when the instrument has stored one; whatever else was done
  // to the document while the instrument was scanning stays. `may_store` false: something else is changing the document
  // just now, so a finished setup waits.
  std::optional<Outcome> update(const Document& document, const std::filesystem::path& scans_folder, double seconds,
                                bool may_store = true);

  // The simulation that runs behind the instrument's screen; null when none does.
  Task* task() { return task_.get(); }
  bool busy() const { return menu_->busy() || task_ != nullptr; }

 private:
  void start(const ScanRequest& request, const Document& document, const std::filesystem::path& scans_folder);
  void collect();

  EmulatedInstrument emulated_;
  std::unique_ptr<Menu> menu_;
  std::function<void()> wake_;
  std::unique_ptr<Task> task_;
  ScanRequest request_;
  std::filesystem::path file_;
  std::optional<Scan> finished_;      // waits for the instrument to store it
};

}  // namespace standpoint
