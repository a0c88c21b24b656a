// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/data_folder.h"

#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>

namespace standpoint {
namespace {

namespace fs = std::filesystem;

TEST(DataFolder, OfAMovedTreeMovesWithIt) {
  const fs::path tree = fs::path(BINARY_DIR) / "scratch" / "moved tree";
  fs::remove_all(tree);
  fs::create_directories(tree / "share/standpoint/materials");
  std::ofstream(tree / "share/standpoint" / kDataMark) << "{}";
  EXPECT_EQ(dataFolderOf(tree / "bin" / "standpoint"), tree / "share/standpoint");
}

TEST(DataFolder, BesideAProgramIsTakenOnlyByItsMark) {
  const fs::path tree = fs::path(BINARY_DIR) / "scratch" / "tree of another";
  fs::remove_all(tree);
  fs::create_directories(tree / "share/standpoint/materials");
  const auto found = dataFolderOf(tree / "bin" / "standpoint");
  EXPECT_TRUE(found.is_absolute()) << found;
  EXPECT_EQ(found.lexically_relative(tree).native().substr(0, 2), "..") << found;
  EXPECT_EQ(dataFolderOf({}), found);  // of a program that does not know its place
}

TEST(DataFolder, OfTheBuildFolderHoldsWhatIsInstalled) {
  EXPECT_EQ(dataFolder(), fs::path(BINARY_DIR) / "share/standpoint");
  EXPECT_TRUE(fs::equivalent(dataFolder() / "materials/library", SOURCE_DIR "/materials/library"));
  EXPECT_EQ(samplesFolder(), dataFolder() / "samples");
}

TEST(DataFolder, IsWhatTheEnvironmentSays) {
  setenv("STANDPOINT_DATA", "/some/where", 1);
  EXPECT_EQ(dataFolder(), "/some/where");
  EXPECT_EQ(samplesFolder(), "/some/where/samples");
  setenv("STANDPOINT_SAMPLES", "/else/where", 1);
  EXPECT_EQ(samplesFolder(), "/else/where");
  useDataFolder("/of/a/module");
  EXPECT_EQ(dataFolder(), "/some/where");
  setenv("STANDPOINT_DATA", "", 1);  // set to nothing is not set
  EXPECT_EQ(dataFolder(), "/of/a/module");
  useDataFolder({});
  EXPECT_EQ(dataFolder(), fs::path(BINARY_DIR) / "share/standpoint");
  unsetenv("STANDPOINT_DATA");
  unsetenv("STANDPOINT_SAMPLES");
}

}  // namespace
}  // namespace standpoint
