// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/json_file.h"
#include "emulated-ui/menus.h"

namespace standpoint {

// Turns of 2 ms and more to wait for a task: a watched build on a busy machine takes minutes. What hangs is ended by
// ctest.
constexpr int kPatience = 200'000;

// For suites that go through the table of devices.
inline std::vector<const EmulatedDevice*> everyDevice() {
  std::vector<const EmulatedDevice*> all;
  for (const auto& device : emulatedDevices()) all.push_back(&device);
  return all;
}
// By their names: each test is a process of its own, and to load every device takes two seconds.
inline bool isCarried(const EmulatedDevice& device) {
  constexpr std::array<std::string_view, 3> kCarried = {"geoslam-zeb-horizon", "leica-blk2go", "navvis-vlx"};
  return std::find(kCarried.begin(), kCarried.end(), device.id) != kCarried.end();
}
// Those that stand on a tripod.
inline std::vector<const EmulatedDevice*> everyTripod() {
  auto all = everyDevice();
  std::erase_if(all, [](const EmulatedDevice* device) { return isCarried(*device); });
  return all;
}
inline std::string deviceName(const testing::TestParamInfo<const EmulatedDevice*>& info) {
  std::string name = info.param->id;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

// What the tests of all devices do not reach, as the device's tested_by.json says: widgets ("screen/id") or values
// (id), with the test that has the longer story.
inline std::map<std::string, std::string> testedBy(const EmulatedDevice& device, const char* what) {
  const auto file = device.folder() / "tested_by.json";
  if (!std::filesystem::exists(file)) return {};
  const auto json = readJsonFile(file);
  EXPECT_TRUE(json) << describe(json.error());
  return json ? json->value(what, std::map<std::string, std::string>()) : std::map<std::string, std::string>();
}

// A sphere that was found and fits to a millimetre.
inline FittedTarget fittedSphere(const std::string& name, int points, double range_m = 5) {
  FittedTarget target;
  target.name = name;
  target.kind = "sphere";
  target.points = points;
  target.range_m = range_m;
  target.residual_m = 0.001;
  target.found = true;
  return target;
}

// A device in the hands of a test, with a simulation that takes no time.
class TestDevice {
 public:
  explicit TestDevice(const std::string& id, const std::string& instrument = {}) : device_(load(id, instrument)) {}
  explicit TestDevice(std::shared_ptr<const DeviceType> type) : device_(std::move(type)) {}

  Device& operator*() { return device_; }
  Device* operator->() { return &device_; }

  // Presses one widget after the other: "resolution=12mm", "back".
  testing::AssertionResult press(const std::vector<std::string>& widgets) {
    for (const auto& text : widgets) {
      const auto equals = text.find('=');
      const auto done = device_.act(text.substr(0, equals), equals == std::string::npos ? "" : text.substr(equals + 1));
      if (!done)
        return testing::AssertionFailure() << text << " on screen '" << device_.screen().id << "', dialogue '"
                                           << device_.screen().dialog.id << "': " << describe(done.error());
    }
    return testing::AssertionSuccess();
  }
  bool refuses(const std::string& widget, const std::string& value = {}) { return !device_.act(widget, value); }

  std::string shows(const std::string& widget) const {
    const auto screen = device_.screen();
    const auto* w = findWidget(screen, widget);
    return w == nullptr ? "(not there)" : w->value;
  }
  std::string phase() const { return device_.state().phase; }
  std::string screen() const { return device_.screen().id; }
  std::string dialog() const { return device_.state().dialog; }
  std::string fact(const std::string& name) const {
    const auto found = device_.fact(name);
    return found ? found->text : "(no fact)";
  }
  bool happened(const std::string& what, const std::string& detail = {}) const {
    for (const auto& event : device_.state().log)
      if (event.what == what && (detail.empty() || event.detail == detail)) return true;
    return false;
  }

  // The simulation is done at once; the device's clock goes on until it waits.
  ScanOrder scanned(std::uint64_t points = 1000000) {
    const auto order = device_.takeOrder();
    const auto* scan = order ? std::get_if<ScanOrder>(&*order) : nullptr;
    EXPECT_NE(scan, nullptr);
    if (scan == nullptr) return {};
    finish(*scan, points);
    return *scan;
  }
  void finish(const ScanOrder& scan, std::uint64_t points = 1000000) {
    StoredSetup s;
    s.project = scan.project;
    s.number = scan.number;
    s.name = scan.name;
    s.station = scan.station;
    s.settings = scan.settings;
    s.file = "scans/" + scan.project + "/" + scan.name + ".e57";
    s.points = points;
    s.bytes = static_cast<double>(points) * device_.type().definition.body.bytes_per_point;
    device_.orderMoved(1);
    device_.scanDone(std::move(s));
  }
  void settle() {
    for (int i = 0; i < 1000 && device_.busy(); ++i) device_.tick(10);
  }

 private:
  static Device load(const std::string& id, const std::string& instrument) {
    const auto* row = findDevice(id);
    EXPECT_NE(row, nullptr) << id;
    auto type = loadDevice(*row, instrument);
    EXPECT_TRUE(type) << describe(type.error());
    return Device(*type);
  }

  Device device_;
};

}  // namespace standpoint
