// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/points.h"
#include "core/report.h"
#include "emulated-ui/device/device.h"
#include "emulated-ui/walk_map.h"
#include "project/task.h"
#include "project/verb.h"

namespace standpoint {

// Where a device's setup is stored in a project: scans/<project>/[<cluster>/]<name>.e57. The names are the record: a
// project that is opened again fills the device's memory from them.
std::filesystem::path scanFile(const std::filesystem::path& scans_folder, const ScanOrder& order);
// Where it stands on the device's map, and how its cloud is turned there.
void putOnPlan(StoredSetup& setup, const Pose& pose);
std::vector<StoredSetup> storedSetups(const Document& document, const DeviceType& type);

// Runs an emulated device against a document: its orders become tasks, its clock goes as fast as the user wants, and a
// setup enters the document only when the device has stored it. A station's pose whose standing axis leans by that
// much, about Y and X of the file's frame; level: as it is.
Eigen::Quaterniond leaning(const Eigen::Quaterniond& rotation, double x_deg, double y_deg);

class DeviceHost {
 public:
  DeviceHost(std::shared_ptr<const DeviceType> type, const Document& document, std::function<void()> wake);

  Device& device() { return device_; }
  const Device& device() const { return device_; }

  double time_factor = 20;  // device seconds per second: 1 is rehearsal in real time
  std::uint64_t seed = 1;
  bool truth = false;  // the files hold what is known of each point
  // Who sees the points of a scan beside its file, as they are simulated; empty, or null: nobody.
  std::function<std::shared_ptr<PointSink>(const ScanOrder&)> watch;

  // A project that is opened: the device gets back what it remembers in the folder of the scans, and remembers from
  // here on. What cannot be read stays as it is, and nothing is written over it.
  Result<void> remember(const std::filesystem::path& scans_folder);

  // Call once per frame. `seconds` since the last call; `scans_folder` empty while the project has no folder.
  // Gives `document` with the setup in it, and the undo line, when the device has stored one; whatever else was done to
  // the document meanwhile stays. `may_store` false: something else is changing the document just now, so a finished
  // setup waits.
  std::optional<Outcome> update(const Document& document, const std::filesystem::path& scans_folder, double seconds,
                                bool may_store = true);

  // As Device::hand; nobody who carries a scanner walks through a wall.
  Result<void> hand(const std::string& id, const std::string& value = {});

  // What a task has computed, on its way to the device: called in the thread that owns the host.
  using Delivery = std::function<void(DeviceHost&, const Document&)>;
  // What was lost since this was asked last: a copy in another format does not hold all of a scan.
  Report takeReport() { return std::exchange(report_, {}); }
  // The simulation that runs behind the device's screen; null when none does.
  Task<Delivery>* task() { return task_.get(); }
  bool busy() const { return device_.busy() || task_ != nullptr; }
  // Only our computing is waited for: the real instrument would be done, so the device's clock stands meanwhile.
  bool clockStands() const { return task_ != nullptr && device_.idles(); }

 private:
  std::optional<Outcome> goOn(const Document& document, const std::filesystem::path& scans_folder, double seconds,
                              bool may_store);
  void keepMemory(const std::filesystem::path& scans_folder);
  void start(const Order& order, const Document& document, const std::filesystem::path& scans_folder);
  void startScan(const ScanOrder& order, const Document& document, const std::filesystem::path& scans_folder);
  void startWalk(const ScanOrder& order, const Document& document);
  Result<void> wayIsFree(const std::string& walk_to) const;  // from where the way ends so far, to "4.5,3,0.8"
  StoredSetup setupOf(const ScanOrder& order, const Scan& scan) const;
  Document leaning(Document document, const std::string& station) const;
  Result<Pose> believedBy(const StationOrientation& orientation, const Station& station, bool compensator,
                          const Document& document) const;
  void startTask(std::string title, Task<Delivery>::Work work);
  void collect(const Document& document);
  Result<Outcome> oriented(const Document& document, const StationOrientation& orientation) const;
  void takeScan(const ScanOrder& order, const Scan& scan, const Document& document);
  void takeWalk(const ScanOrder& order, const CarriedTrajectory& trajectory, const WalkResult& result);

  Device device_;
  std::function<void()> wake_;
  Report report_;
  std::optional<Order> running_;
  std::filesystem::path file_;
  std::shared_ptr<const Job> known_of_;  // whose places the device was told
  std::optional<Scan> finished_;         // waits for the device to store it
  std::string station_;                  // of the finished scan
  CarriedTrajectory walked_;             // of the finished scan, where it was carried
  WalkMap map_;
  SettingValues notes_;  // of the scan that runs
  bool remembers_ = false;
  std::uint64_t kept_at_ = 0;  // events of the device when its memory was written last
  nlohmann::json kept_;
  std::unique_ptr<Task<Delivery>> task_;  // last: it is joined before anything else here is gone
};

}  // namespace standpoint
