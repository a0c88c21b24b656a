// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/part_file.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <fstream>
#include <iterator>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;

std::string textOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void put(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

class PartFiles : public ::testing::Test {
 protected:
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : fs::directory_iterator(folder)) all.push_back(entry.path().filename());
    std::sort(all.begin(), all.end());
    return all;
  }
  TemporaryFolder own;
  fs::path folder = own.path(), file = own / "house.glb";
};

TEST_F(PartFiles, ReplaceTheOldFileOnlyInCommit) {
  put(file, "old");
  auto part = PartFile::create(file);
  ASSERT_TRUE(part);
  ASSERT_TRUE(part->append("new"));
  EXPECT_EQ(textOf(file), "old");
  ASSERT_TRUE(part->commit());
  EXPECT_EQ(textOf(file), "new");
  EXPECT_EQ(names(), std::vector<std::string>{"house.glb"});
}

TEST_F(PartFiles, VanishWithoutACommit) {
  put(file, "old");
  {
    auto part = PartFile::create(file);
    ASSERT_TRUE(part && part->append("new"));
    EXPECT_TRUE(isPart(folder / names().front()));
  }
  EXPECT_EQ(textOf(file), "old");
  EXPECT_EQ(names(), std::vector<std::string>{"house.glb"});
}

TEST_F(PartFiles, OfSeveralWritersDoNotMeet) {
  auto first = PartFile::create(file);
  auto second = PartFile::create(file);
  ASSERT_TRUE(first && second);
  ASSERT_TRUE(first->append("first") && second->append("second"));
  ASSERT_TRUE(second->commit());
  EXPECT_EQ(textOf(file), "second");
  ASSERT_TRUE(first->commit());
  EXPECT_EQ(textOf(file), "first");
  EXPECT_EQ(names(), std::vector<std::string>{"house.glb"});
}

TEST_F(PartFiles, OfAKilledWriterAreUsedAgain) {
  put(file, "old");
  if (const auto child = fork(); child == 0) {
    auto part = PartFile::create(file);
    if (part && part->append("far more than the next one writes")) std::raise(SIGKILL);
    _exit(1);
  } else {
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
  }
  EXPECT_EQ(textOf(file), "old");
  EXPECT_EQ(names().size(), 2U);
  ASSERT_TRUE(writeWholeText(file, "new"));
  EXPECT_EQ(textOf(file), "new");
  EXPECT_EQ(names(), std::vector<std::string>{"house.glb"});
}

TEST_F(PartFiles, FollowALinkAndKeepPermissions) {
  const auto other = folder / "other";
  fs::create_directory(other);
  put(other / "real.glb", "old");
  ::chmod((other / "real.glb").c_str(), 0640);
  fs::create_symlink("other/real.glb", file);
  ASSERT_TRUE(writeWholeText(file, "new"));
  EXPECT_TRUE(fs::is_symlink(file));
  EXPECT_EQ(textOf(other / "real.glb"), "new");
  struct stat status {};
  ASSERT_EQ(::stat((other / "real.glb").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0640U);
}

TEST_F(PartFiles, RefuseWhatIsNoRegularFile) {
  for (const auto& place : {folder, fs::path("/dev/null")}) {
    const auto part = PartFile::create(place);
    ASSERT_FALSE(part);
    EXPECT_EQ(part.error().kind, ErrorKind::file_system);
    EXPECT_EQ(part.error().source, place.string());
  }
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

// In pieces of all sizes, with places written over and read back on the way.
TEST_F(PartFiles, OfManyMegabytesAreWholeToo) {
  std::vector<std::uint8_t> whole(PartFile::kDirectFrom + 21'000'001);
  std::uint32_t state = 1;
  for (auto& byte : whole) byte = static_cast<std::uint8_t>((state = state * 1664525U + 1013904223U) >> 24U);
  auto part = PartFile::create(file);
  ASSERT_TRUE(part);
  std::size_t at = 0;
  for (std::size_t piece = 1; at < whole.size(); piece = piece * 3 % 7'000'003) {
    const std::size_t n = std::min(piece, whole.size() - at);
    ASSERT_TRUE(part->append({whole.data() + at, n}));
    at += n;
    if (at <= PartFile::kDirectFrom + 100 || piece % 5 != 0) continue;
    const std::size_t back = at - 50 - piece % 3000;
    std::array<std::uint8_t, 40> read{};
    ASSERT_TRUE(part->read(back, read));
    ASSERT_TRUE(std::equal(read.begin(), read.end(), whole.begin() + static_cast<std::ptrdiff_t>(back)));
    std::fill_n(whole.begin() + static_cast<std::ptrdiff_t>(back), 40, std::uint8_t{7});
    ASSERT_TRUE(part->overwrite(back, {whole.data() + back, 40}));
  }
  EXPECT_EQ(part->size(), whole.size());
  ASSERT_TRUE(part->commit());
  const std::string text = textOf(file);
  EXPECT_TRUE(std::equal(text.begin(), text.end(), whole.begin(), whole.end(),
                         [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; }));
}

TEST_F(PartFiles, OfManyMegabytesSayThatTheDiskIsFull) {
  put(file, "old");
  if (const auto child = fork(); child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit most{PartFile::kDirectFrom + 10'000'001, PartFile::kDirectFrom + 10'000'001};
    ::setrlimit(RLIMIT_FSIZE, &most);
    auto part = PartFile::create(file);
    const std::vector<std::uint8_t> megabyte(1U << 20U);
    for (int i = 0; part && i < 100; ++i)
      if (const auto written = part->append(megabyte); !written)
        _exit(written.error().kind == ErrorKind::file_system &&
                      written.error().message.find("free some space") != std::string::npos
                  ? 0
                  : 2);
    _exit(1);
  } else {
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 0);
  }
  EXPECT_EQ(textOf(file), "old");
}

TEST_F(PartFiles, TakeALongNameAndOneInTheCurrentFolder) {
  ASSERT_TRUE(writeWholeText(folder / std::string(255, 'x'), "new"));
  const auto before = fs::current_path();
  fs::current_path(folder);
  EXPECT_TRUE(writeWholeText("here.txt", "new"));
  fs::current_path(before);
  EXPECT_EQ(textOf(folder / "here.txt"), "new");
}

TEST_F(PartFiles, OnAFullDiskNameTheFileAndARemedy) {
  put(file, "old");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit limit{2, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &limit);
  const auto written = writeWholeText(file, "new text");
  ::setrlimit(RLIMIT_FSIZE, &before);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().source, file.string());
  EXPECT_NE(written.error().message.find("free some space"), std::string::npos);
  EXPECT_EQ(textOf(file), "old");
  EXPECT_EQ(names(), std::vector<std::string>{"house.glb"});
}

TEST_F(PartFiles, OfAFolderAreThereWholeOrNotAtAll) {
  const auto set = folder / "set";
  {
    auto part = PartFolder::create(set);
    ASSERT_TRUE(part);
    put(part->path() / "a", "a");
  }
  EXPECT_TRUE(names().empty());
  auto part = PartFolder::create(set);
  auto other = PartFolder::create(set);
  ASSERT_TRUE(part && other);
  put(part->path() / "a", "a");
  put(other->path() / "b", "b");
  ASSERT_TRUE(part->commit());
  EXPECT_FALSE(other->commit()) << "the set that is there stays";
  EXPECT_EQ(textOf(set / "a"), "a");
}

TEST_F(PartFiles, OfAFolderWhoseWriterWasKilledAreEmptiedAndUsedAgain) {
  const auto left = folder / ".set.standpoint-part";
  fs::create_directory(left);
  put(left / "old", "old");
  auto part = PartFolder::create(folder / "set");
  ASSERT_TRUE(part);
  EXPECT_EQ(part->path(), left);
  EXPECT_TRUE(fs::is_empty(left));
}

}  // namespace
}  // namespace standpoint
