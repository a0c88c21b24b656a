// SPDX-License-Identifier: GPL-3.0-or-later
#include <atomic>
#include <chrono>
#include <fstream>
#include <iterator>
#include <thread>

#include <gtest/gtest.h>

#include "editor/desktop/desktop_opener.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;

class Opener : public testing::Test {
 protected:
  std::string problemOf(const std::string& program, const fs::path& path) {
    DesktopOpener opener(program);
    std::atomic<bool> woken = false;
    opener.open(path, [&] { woken = true; });
    if (!opener.problem().empty()) return opener.problem();
    for (int i = 0; i < 2000 && !woken; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_TRUE(woken);
    return opener.problem();
  }
  fs::path script(const std::string& text) const {
    const auto file = folder_.path() / "opener";
    std::ofstream(file) << "#!/bin/sh\n" << text << '\n';
    fs::permissions(file, fs::perms::owner_all);
    return file;
  }
  TemporaryFolder folder_;
};

TEST_F(Opener, GivesThePathToTheProgramAsOneWord) {
  const auto file = folder_.path() / "a 'name'; $(touch x) & more.html", seen = folder_.path() / "seen";
  std::ofstream(file) << "page";
  EXPECT_EQ(problemOf(script("printf '%s|%s' \"$#\" \"$1\" > '" + seen.string() + "'"), file), "");
  std::ifstream in(seen);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "1|" + file.string());
}

TEST_F(Opener, NamesThePathWhenItCannotBeOpened) {
  const auto missing = folder_.path() / "missing.html";
  EXPECT_NE(problemOf("true", missing).find(missing.string()), std::string::npos);
  const auto there = script("exit 3");
  const auto refused = problemOf(there, there);
  EXPECT_NE(refused.find("code 3"), std::string::npos) << refused;
  EXPECT_NE(refused.find(there.string()), std::string::npos) << refused;
  const auto absent = problemOf("no-such-opener", there);
  EXPECT_NE(absent.find("no-such-opener"), std::string::npos) << absent;
  EXPECT_NE(absent.find(there.string()), std::string::npos) << absent;
}

}  // namespace
}  // namespace standpoint
