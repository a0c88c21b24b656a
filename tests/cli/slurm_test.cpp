// SPDX-License-Identifier: GPL-3.0-or-later
// The job array of `dataset slurm` on a real Slurm, by scripts/slurm.sh: plain runs against arrays of one and two
// tasks and one with a task that is requeued. STANDPOINT_SLURM=1 tries four tasks, a node that is drained, one that
// dies, a controller that is killed, an array that is cancelled and one that fails, too: some minutes more.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <sys/wait.h>

#include <gtest/gtest.h>

namespace standpoint {
namespace {

TEST(Slurm, MakesTheBytesOfAPlainRun) {
  const bool all = std::getenv("STANDPOINT_SLURM") != nullptr;
  const auto command =
      std::string(SOURCE_DIR "/scripts/slurm.sh ") + (all ? "" : "-q ") + PROGRAM + " " + HOUSE + " 2>&1";
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::string said;
  std::array<char, 4096> piece;
  while (const std::size_t n = std::fread(piece.data(), 1, piece.size(), pipe)) said.append(piece.data(), n);
  const int status = ::pclose(pipe);
  ASSERT_TRUE(WIFEXITED(status));
  constexpr int kNoSlurm = 77;
  if (WEXITSTATUS(status) == kNoSlurm) GTEST_SKIP() << said;
  EXPECT_EQ(WEXITSTATUS(status), 0) << said;
}

}  // namespace
}  // namespace standpoint
