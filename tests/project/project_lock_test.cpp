// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/storage/project_lock.h"

#include <csignal>
#include <fstream>
#include <future>
#include <sys/wait.h>
#include <thread>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "project/storage/project_files.h"
#include "project/storage/session.h"
#include "project/survey/survey_verbs.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using std::chrono::milliseconds;
using testing::AllOf, testing::HasSubstr;
namespace fs = std::filesystem;

Result<ProjectLock> lock(const fs::path& folder, milliseconds patience) {
  Progress progress;
  return ProjectLock::acquire(folder, "station", progress, patience);
}

TEST(ProjectLock, RefusesASecondWriterAndNamesTheFirst) {
  const TemporaryFolder folder;
  const auto first = lock(folder.path(), milliseconds(0));
  ASSERT_TRUE(first);
  const auto second = lock(folder.path(), milliseconds(50));
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().kind, ErrorKind::file_system);
  EXPECT_EQ(second.error().source, folder.path().string());
  EXPECT_THAT(second.error().message,
              AllOf(HasSubstr("standpoint station (process " + std::to_string(::getpid())), HasSubstr(" since 2")));
}

TEST(ProjectLock, GoesToTheNextWriterWhenItIsLetGo) {
  const TemporaryFolder folder;
  auto second = std::async(std::launch::async, [&] {
    std::this_thread::sleep_for(milliseconds(20));
    return lock(folder.path(), std::chrono::seconds(20)).has_value();
  });
  {
    const auto first = lock(folder.path(), milliseconds(0));
    std::this_thread::sleep_for(milliseconds(60));
  }
  EXPECT_TRUE(second.get());
}

TEST(ProjectLock, LeavesNoFileBehind) {
  const TemporaryFolder folder;
  { const auto held = lock(folder.path(), milliseconds(0)); }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(ProjectLock, EndsWithTheProcessThatHeldIt) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "held";
  const pid_t writer = ::fork();
  if (writer == 0) {
    const auto held = lock(folder.path(), milliseconds(0));
    std::ofstream(file).put('1');
    ::pause();
  }
  while (!fs::exists(file)) std::this_thread::sleep_for(milliseconds(1));
  EXPECT_FALSE(lock(folder.path(), milliseconds(0)));
  ::kill(writer, SIGKILL);
  ::waitpid(writer, nullptr, 0);
  EXPECT_TRUE(lock(folder.path(), milliseconds(0)));
}

TEST(ProjectLock, IsGivenUpWhenTheWaitIsCancelled) {
  const TemporaryFolder folder;
  const auto first = lock(folder.path(), milliseconds(0));
  Progress progress;
  progress.cancel();
  const auto second = ProjectLock::acquire(folder.path(), "station", progress);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().kind, ErrorKind::cancelled);
}

TEST(ProjectLock, AReadOnlyPlaceIsAnErrorOfTheFileSystem) {
  const auto refused = lock("/proc/self", milliseconds(0));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::file_system);
  EXPECT_THAT(refused.error().message, HasSubstr("cannot lock the project"));
}

class SharedProject : public testing::Test {
 protected:
  void SetUp() override {
    Progress progress;
    ASSERT_TRUE(saveProject(twoStoreyDocument(), folder_.path(), progress));
  }
  Result<Outcome> runHere(const char* verb, nlohmann::json options) {
    Progress progress;
    options["project"] = folder_.path().string();
    return runOnDisk(*findVerb(verbs(), verb), options, progress);
  }
  std::vector<std::string> stations() {
    Progress progress;
    std::vector<std::string> names;
    const auto document = loadProject(folder_.path(), progress);
    for (const auto& station : document->job->stations) names.push_back(station.name);
    return names;
  }

  TemporaryFolder folder_;
};

TEST_F(SharedProject, KeepsTheStationsOfEightWritersAtOnce) {
  std::vector<std::future<Result<Outcome>>> writers;
  std::vector<std::string> names;
  for (int i = 1; i <= 8; ++i) {
    names.push_back("W" + std::to_string(i));
    writers.push_back(std::async(std::launch::async, [this, name = names.back(), i] {
      return runHere("station", {{"add", name}, {"at", {i * 0.5, 1.0, 1.6}}, {"stand", "free"}});
    }));
  }
  for (auto& writer : writers) {
    const auto outcome = writer.get();
    EXPECT_TRUE(outcome) << describe(outcome.error());
  }
  EXPECT_THAT(stations(), testing::UnorderedElementsAreArray(names));
}

TEST_F(SharedProject, IsListedWhileAnotherWrites) {
  const auto writer = lock(folder_.path(), milliseconds(0));
  EXPECT_TRUE(runHere("station", nlohmann::json::object()));
}

TEST_F(SharedProject, IsNotGivenAStationTwiceByWritersWhoNameItAlike) {
  const auto add = [this] { return runHere("station", {{"add", "S1"}, {"at", {1, 1, 1.6}}, {"stand", "free"}}); };
  auto other = std::async(std::launch::async, add);
  const auto mine = add();
  const auto theirs = other.get();
  EXPECT_NE(mine.has_value(), theirs.has_value());
  EXPECT_THAT(stations(), testing::ElementsAre("S1"));
}

TEST_F(SharedProject, IsReadAgainByWhoKeepsItOnlyWhereAnotherHasWritten) {
  KeptProject kept;
  Progress progress;
  const auto add = [&](const char* name, double x) {
    return runOnDisk(*findVerb(verbs(), "station"),
                     {{"project", folder_.path().string()}, {"add", name}, {"at", {x, 1.0, 1.6}}, {"stand", "free"}},
                     kept, progress);
  };
  ASSERT_TRUE(add("S1", 1));
  const auto model = kept.document.imported;
  ASSERT_TRUE(add("S2", 2));
  EXPECT_EQ(kept.document.imported, model);
  ASSERT_TRUE(runHere("station", {{"add", "W"}, {"at", {3, 1, 1.6}}, {"stand", "free"}}));
  ASSERT_TRUE(add("S3", 4));
  EXPECT_NE(kept.document.imported, model);
  EXPECT_THAT(stations(), testing::ElementsAre("S1", "S2", "W", "S3"));
  EXPECT_EQ(kept.text, *projectText(folder_.path()));
}

TEST_F(SharedProject, IsImportedIntoByOneOfTwo) {
  const TemporaryFolder other;
  std::ofstream(other.path() / "a.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const auto import = [&] {
    Progress progress;
    return runOnDisk(*findVerb(verbs(), "import"),
                     {{"files", {(other.path() / "a.obj").string()}}, {"output", (other.path() / "p").string()}},
                     progress);
  };
  auto theirs = std::async(std::launch::async, import);
  const auto mine = import();
  EXPECT_EQ(static_cast<int>(mine.has_value()) + static_cast<int>(theirs.get().has_value()), 1);
}

Scan scanInto(const std::string& file) {
  Scan scan;
  scan.file = file;
  return scan;
}

TEST(ScansCarriedOver, StandAtTheStationsAsTheyAreByThen) {
  Document base = twoStoreyDocument();
  Job job;
  job.stations = {{.name = "S1"}, {.name = "S2"}, {.name = "S3"}};
  job.stations[0].scans = {scanInto("old.e57")};
  base.job = std::make_shared<const Job>(job);

  Document result = base;
  Job scanned = job;
  scanned.stations[0].scans.push_back(scanInto("mine-1.e57"));
  scanned.stations[1].scans.push_back(scanInto("mine-2.e57"));
  result.job = std::make_shared<const Job>(scanned);
  result.scanning = std::make_shared<const ScanChoice>();

  Document newest = base;
  Job others = job;  // S2 is gone, S4 is new, S1 was moved and scanned
  others.stations.erase(others.stations.begin() + 1);
  others.stations.push_back({.name = "S4"});
  others.stations[0].true_pose.translation.x() = 9;
  others.stations[0].scans.push_back(scanInto("theirs.e57"));
  newest.job = std::make_shared<const Job>(others);

  const Document carried = scansCarriedOver(base, result, newest);
  std::string told;
  for (const auto& station : carried.job->stations) {
    told += station.name + ":";
    for (const auto& scan : station.scans) told += " " + scan.file;
    told += "\n";
  }
  EXPECT_EQ(told, "S1: old.e57 theirs.e57 mine-1.e57\nS3:\nS4:\n");
  EXPECT_EQ(carried.job->stations[0].true_pose.translation.x(), 9);
  EXPECT_EQ(carried.scanning, result.scanning);
}

}  // namespace
}  // namespace standpoint
