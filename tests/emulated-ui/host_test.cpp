// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include "emulated-ui/host.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;

std::string bytes(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class HostTest : public testing::Test {
 protected:
  HostTest()
      : document_(run("station", twoStoreyDocument(), {{"add", "S1"}, {"at", {500002.5, 5600002, 1.6}}})->document),
        host_(emulatedInstruments()[0], *makeMenu(emulatedInstruments()[0]), document_, nullptr) {
    auto& menu = host_.menu();
    (void)menu.act("power");
    menu.tick(60);
    menu.standAt("S1");
    (void)menu.act("job");
    (void)menu.act("new_job");
    (void)menu.act("name", "House");
    (void)menu.act("create");
    (void)menu.act("settings");
    (void)menu.act("resolution", "12mm");
    (void)menu.act("images", "off");
    (void)menu.act("back");
  }

  std::optional<Outcome> runUntilIdle(double seconds_a_step) {
    for (int i = 0; i < 10000; ++i) {
      if (auto stored = host_.update(document_, folder_.path(), seconds_a_step)) return stored;
      if (!host_.busy()) return std::nullopt;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return std::nullopt;
  }

  TemporaryFolder folder_;
  Document document_;
  InstrumentHost host_;
};

TEST_F(HostTest, AScanThroughTheMenuGivesTheSameBytesAsTheVerb) {
  ASSERT_TRUE(host_.menu().act("scan"));
  const auto stored = runUntilIdle(1);
  ASSERT_TRUE(stored);
  const auto& scan = stored->document.job->stations[0].scans.at(0);
  EXPECT_EQ(fs::path(scan.file), folder_.path() / "House" / "Setup 001.e57");
  EXPECT_EQ(stored->description, "Scanned setup 1 of 'House' at S1 with Leica RTC360");
  const auto direct = folder_.path() / "direct.e57";
  ASSERT_TRUE(run("scan", document_, {{"instrument", "leica-rtc360"}, {"set", {"resolution=12mm", "images=off"}}, {"seed", 1}, {"output", direct.string()}}));
  EXPECT_TRUE(bytes(scan.file) == bytes(direct));
}

TEST_F(HostTest, AStoppedScanLeavesNoFileAndNoSetup) {
  ASSERT_TRUE(host_.menu().act("scan"));
  host_.time_factor = 0.001;
  (void)host_.update(document_, folder_.path(), 0.01);
  ASSERT_TRUE(host_.menu().act("stop"));
  ASSERT_TRUE(host_.menu().act("yes"));
  EXPECT_FALSE(runUntilIdle(0.01));
  for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) EXPECT_FALSE(entry.is_regular_file()) << entry.path();
}

TEST_F(HostTest, WithoutAProjectFolderTheInstrumentSaysWhatToDo) {
  ASSERT_TRUE(host_.menu().act("scan"));
  EXPECT_FALSE(host_.update(document_, {}, 0.1));
  EXPECT_NE(findWidget(host_.menu().screen(), "message")->label.find("Save the project"), std::string::npos);
}

TEST_F(HostTest, TheInstrumentsMemoryIsFilledFromTheProject) {
  ASSERT_TRUE(host_.menu().act("scan"));
  const auto stored = runUntilIdle(1);
  ASSERT_TRUE(stored);
  const auto scans = storedScans(stored->document, "leica-rtc360");
  ASSERT_EQ(scans.size(), 1U);
  EXPECT_EQ(scans[0].job, "House");
  EXPECT_EQ(scans[0].setup, 1);
  EXPECT_EQ(scans[0].station, "S1");
}

}  // namespace
}  // namespace standpoint
