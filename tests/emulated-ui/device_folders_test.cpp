// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "project/verb.h"
#include "tests/emulated-ui/support.h"

// A new device is a folder and a line: what else it needs is named here.
namespace standpoint {
namespace {

namespace fs = std::filesystem;

class DeviceFolder : public testing::TestWithParam<const EmulatedDevice*> {};

TEST_P(DeviceFolder, HasItsDataItsTutorialItsPageAndAPictureOfEachScreen) {
  const std::string id = GetParam()->id;
  const fs::path reference = SOURCE_DIR "/docs/reference/devices";
  std::vector<fs::path> needed = {GetParam()->folder() / "device.json",
                                  GetParam()->folder() / "words.json",
                                  GetParam()->folder() / "layout.json",
                                  GetParam()->folder() / "tutorial.json",
                                  reference / (id + ".md"),
                                  reference / id / "off.png"};
  const auto type = loadDevice(*GetParam());
  ASSERT_TRUE(type) << describe(type.error());
  for (const auto& screen : (*type)->definition.screens) needed.push_back(reference / id / (screen.id + ".png"));
  for (const auto& file : needed) EXPECT_TRUE(fs::exists(file)) << "missing: " << file.string();
  std::ifstream in(SOURCE_DIR "/docs/README.md");
  const std::string list{std::istreambuf_iterator<char>(in), {}};
  EXPECT_TRUE(list.find("(reference/devices/" + id + ".md)") != std::string::npos)
      << "missing: reference/devices/" << id << ".md in the list of devices of docs/README.md";
}

TEST_P(DeviceFolder, NamesOnlyTestsThatThereAre) {
  std::set<std::string> tests;
  const auto& program = *testing::UnitTest::GetInstance();
  for (int i = 0; i < program.total_test_suite_count(); ++i) {
    const auto& suite = *program.GetTestSuite(i);
    for (int k = 0; k < suite.total_test_count(); ++k)
      tests.insert(std::string(suite.name()) + "." + suite.GetTestInfo(k)->name());
  }
  for (const char* what : {"widgets", "values"})
    for (const auto& [name, test] : testedBy(*GetParam(), what))
      EXPECT_TRUE(tests.contains(test)) << "tested_by.json: " << what << "/" << name << ": there is no test " << test;
}

INSTANTIATE_TEST_SUITE_P(Devices, DeviceFolder, testing::ValuesIn(everyDevice()), deviceName);

TEST(DeviceFolders, EachHaveTheirLine) {
  for (const auto& entry : fs::directory_iterator(dataFolder() / "emulated-ui" / "devices"))
    EXPECT_NE(findDevice(entry.path().filename().string()), nullptr)
        << "missing: standpoint_device(" << entry.path().filename().string() << " ...) in emulated-ui/CMakeLists.txt";
}

}  // namespace
}  // namespace standpoint
