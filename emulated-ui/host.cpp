// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/host.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

namespace standpoint {

namespace fs = std::filesystem;

fs::path scanFile(const fs::path& scans_folder, const ScanRequest& request) {
  return scans_folder / request.job / fmt::format("Setup {:03d}.e57", request.setup);
}

std::vector<StoredScan> storedScans(const Document& document, const std::string& instrument) {
  std::vector<StoredScan> stored;
  if (!document.job) return stored;
  for (const auto& station : document.job->stations)
    for (const auto& scan : station.scans) {
      const fs::path file = scan.file;
      int setup = 0;
      if (scan.instrument != instrument || std::sscanf(file.stem().string().c_str(), "Setup %d", &setup) != 1) continue;
      stored.push_back({file.parent_path().filename().string(), setup, station.name, scan.settings, scan.file, scan.points,
                        scan.instrument_seconds});
    }
  std::stable_sort(stored.begin(), stored.end(), [](const StoredScan& a, const StoredScan& b) {
    return std::pair(a.job, a.setup) < std::pair(b.job, b.setup);
  });
  return stored;
}

namespace {

// Adds a scan to a station of the document as it is now.
Document withScan(Document document, const std::string& station_name, const Scan& scan) {
  Job job = *document.job;
  for (auto& station : job.stations)
    if (station.name == station_name) station.scans.push_back(scan);
  document.job = std::make_shared<const Job>(std::move(job));
  return document;
}

}  // namespace

InstrumentHost::InstrumentHost(const EmulatedInstrument& emulated, std::unique_ptr<Menu> menu, const Document& document,
                               std::function<void()> wake)
    : emulated_(emulated), menu_(std::move(menu)), wake_(std::move(wake)) {
  menu_->load(storedScans(document, emulated_.instrument));
}

void InstrumentHost::start(const ScanRequest& request, const Document& document, const fs::path& scans_folder) {
  if (scans_folder.empty()) return menu_->scanFailed("Save the project first: the scan needs a folder.");
  request_ = request;
  file_ = scanFile(scans_folder, request);
  std::error_code error;
  fs::create_directories(file_.parent_path(), error);
  if (error) return menu_->scanFailed("Cannot create " + file_.parent_path().string() + ": " + error.message());
  nlohmann::json settings = nlohmann::json::array();
  for (const auto& [key, value] : request.settings) settings.push_back(key + "=" + value);
  const nlohmann::json options = {{"instrument", request.instrument}, {"set", settings},       {"stations", request.station},
                                  {"seed", seed},                     {"output", file_.string()}};
  task_ = std::make_unique<Task>(fmt::format("{}: setup {} at {}", emulated_.device, request.setup, request.station),
                                 *findVerb(verbs(), "scan"), document, options, wake_);
}

// Takes the simulation's result to the menu.
void InstrumentHost::collect() {
  if (!task_) return;
  menu_->scanMoved(task_->progress().fraction());
  if (!task_->done()) return;
  auto outcome = task_->take();
  task_.reset();
  if (!outcome) {
    if (outcome.error().kind != ErrorKind::cancelled) menu_->scanFailed(describe(outcome.error()));
    return;
  }
  const auto& row = outcome->answer.at("stations").at(0);
  menu_->scanDone({request_.job, request_.setup, request_.station, request_.settings, file_.string(),
                   row.at("points").get<std::uint64_t>(), row.at("instrument_seconds").get<double>()});
  for (const auto& station : outcome->document.job->stations)
    if (station.name == request_.station) finished_ = station.scans.back();
}

std::optional<Outcome> InstrumentHost::update(const Document& document, const fs::path& scans_folder, double seconds,
                                              bool may_store) {
  if (const auto request = menu_->takeRequest()) start(*request, document, scans_folder);
  if (menu_->takeCancel()) {
    if (task_) task_->progress().cancel();
    if (finished_) {
      std::error_code ignored;
      fs::remove(file_, ignored);
      finished_.reset();
    }
  }
  collect();
  menu_->tick(seconds * time_factor);
  if (!may_store || !menu_->takeStored() || !finished_) return std::nullopt;
  Outcome outcome{withScan(document, request_.station, *finished_), nlohmann::json::object(), {}, {}};
  outcome.description = fmt::format("Scanned setup {} of '{}' at {} with {}", request_.setup, request_.job,
                                    request_.station, emulated_.device);
  finished_.reset();
  return outcome;
}

}  // namespace standpoint
