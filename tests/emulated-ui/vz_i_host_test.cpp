// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <thread>

#include "emulated-ui/host.h"
#include "tests/emulated-ui/support.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;

// Two positions of one room, scanned and registered on the device, with the simulation behind it.
class VzIHost : public testing::Test {
 protected:
  VzIHost() : document_(twoStoreyDocument()) {
    document_ = run("station", document_, {{"add", "S1"}, {"at", {500002.2, 5600001.6, 1.6}}})->document;
    document_ =
        run("station", document_, {{"add", "S2"}, {"at", {500003.6, 5600002.3, 1.6}}, {"yaw-deg", 40}})->document;
    host_ = std::make_unique<DeviceHost>(*loadDevice(*findDevice("riegl-vz-i")), document_, nullptr);
    press({"power"});
    device().tick(90);
    (void)device().hand("plug_in");  // the clock goes on while the simulation works
    press({"project", "name=House", "load_or_create", "pattern_now", "pattern=overview", "back"});
    device().change().values["registration_mode"] = "MINING_LARGE";
  }

  Device& device() { return host_->device(); }
  void press(const std::vector<std::string>& widgets) {
    for (const auto& text : widgets) {
      const auto equals = text.find('=');
      const auto done =
          device().act(text.substr(0, equals), equals == std::string::npos ? "" : text.substr(equals + 1));
      EXPECT_TRUE(done) << text << ": " << describe(done.error());
    }
  }
  void runUntilWaiting() {
    for (int i = 0; i < kPatience; ++i) {
      if (auto stored = host_->update(document_, folder_.path() / "scans", 1)) document_ = stored->document;
      if (!host_->busy()) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }
  void scanAt(const std::string& station) {
    ASSERT_TRUE(device().hand("stand_at", station));
    if (device().state().screen != "home") press({"home"});
    press({"start_scan"});
    runUntilWaiting();
  }

  TemporaryFolder folder_;
  Document document_;
  std::unique_ptr<DeviceHost> host_;
};

TEST_F(VzIHost, ScansTwoPositionsAndRegistersTheSecondOnTheFirst) {
  scanAt("S1");
  scanAt("S2");
  ASSERT_EQ(device().fact("setups")->number.value(), 2);
  EXPECT_TRUE(fs::exists(folder_.path() / "scans" / "House" / "ScanPos002.e57"));
  const auto& link = device().newestSetup()->link;
  ASSERT_TRUE(link);
  EXPECT_EQ(device().fact("registration.result")->text, "ok") << link->error_m << ' ' << link->overlap;
  EXPECT_LT(link->true_error_m, 0.02);

  // Laid the wrong way round by hand, the fit does not find back, whatever it says of itself.
  const auto files = device().project()->setups;
  device().give(LinkOrder{files[1].file, files[0].file, 0, 0, 180});
  runUntilWaiting();
  const auto& turned = device().newestSetup()->link;
  ASSERT_TRUE(turned);
  EXPECT_TRUE(!turned->joined || turned->true_error_deg > 90) << turned->true_error_deg;
}

// The trouble makes the real registration fail, once.
TEST_F(VzIHost, FindsNothingWhenItsRegistrationFails) {
  scanAt("S1");
  ASSERT_TRUE(device().trouble("registration_fails"));
  scanAt("S2");
  EXPECT_EQ(device().state().dialog, "fast_reg_failed");
  press({"ok", "register_now"});
  runUntilWaiting();
  EXPECT_EQ(device().fact("registration.result")->text, "ok");
}

}  // namespace
}  // namespace standpoint
