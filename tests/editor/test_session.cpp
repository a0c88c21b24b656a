// SPDX-License-Identifier: GPL-3.0-or-later
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/model/session.h"
#include "project/storage/project_files.h"
#include "project/storage/session.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;

std::atomic<bool> released{false};

// Three verbs that a test can steer: one that changes, one that waits until it is let go, one that fails.
std::vector<Verb> steeredVerbs() {
  auto table = verbsWithDemo();
  table.push_back({"rename",
                   "Rename",
                   VerbScope::changes,
                   {{.name = "to", .kind = ParameterKind::text, .help = "", .required = true}},
                   [](const Document& d, const json& options, Progress&) -> Result<Outcome> {
                     Outcome outcome{d};
                     outcome.document.name = options.at("to").get<std::string>();
                     outcome.description = "Renamed to " + outcome.document.name;
                     return outcome;
                   }});
  table.push_back({"wait",
                   "Wait",
                   VerbScope::changes,
                   {},
                   [](const Document& d, const json&, Progress& progress) -> Result<Outcome> {
                     while (!released) {
                       if (auto checked = progress.check(); !checked) return failure(checked.error());
                       std::this_thread::sleep_for(std::chrono::milliseconds(1));
                     }
                     return Outcome{d};
                   }});
  table.push_back(
      {"break", "Break", VerbScope::changes, {}, [](const Document&, const json&, Progress&) -> Result<Outcome> {
         return failure(ErrorKind::unusable, "it is broken", "house.ifc #12");
       }});
  return table;
}

class DemoSession : public ::testing::Test {
 protected:
  void SetUp() override {
    released = false;
    ASSERT_TRUE(session.start("demo", json::object()));
    session.wait();
  }
  Session session{steeredVerbs(), [] {}};
};

TEST(Session, WithoutAModelSaysWhatToDoFirst) {
  const Session session(steeredVerbs(), [] {});
  EXPECT_EQ(session.whyNot("demo"), "");
  EXPECT_NE(session.whyNot("rename").find("Import a model"), std::string::npos);
  EXPECT_NE(session.whyNot("no-such-verb"), "");
  EXPECT_FALSE(session.modified());
}

TEST_F(DemoSession, BringsTheResultOfAVerbInAndUndoesIt) {
  EXPECT_TRUE(session.modified());
  ASSERT_TRUE(session.start("rename", {{"to", "castle"}}));
  EXPECT_EQ(session.document().name, "demo house") << "the document changes when the task is done";
  session.wait();
  EXPECT_EQ(session.document().name, "castle");
  EXPECT_EQ(session.history().undoDescription(), "Renamed to castle");
  session.undo();
  EXPECT_EQ(session.document().name, "demo house");
  session.redo();
  EXPECT_EQ(session.document().name, "castle");
}

class SavedSession : public DemoSession {
 protected:
  void SetUp() override {
    DemoSession::SetUp();
    ASSERT_TRUE(session.save(folder));
    session.wait();
    ASSERT_EQ(session.folder(), folder);
  }
  // As the command line does it.
  void addStationFromOutside(const std::string& name) {
    Progress progress;
    const auto done =
        runOnDisk(*findVerb(verbs(), "station"),
                  {{"project", folder.string()}, {"add", name}, {"at", {1, 1, 1.6}}, {"stand", "free"}}, progress);
    ASSERT_TRUE(done) << describe(done.error());
  }
  std::vector<std::string> stationsOnDisk() {
    Progress progress;
    const auto document = loadProject(folder, progress);
    std::vector<std::string> names;
    for (const auto& station : document->job->stations) names.push_back(station.name);
    return names;
  }
  TemporaryFolder temporary;
  const std::filesystem::path folder = temporary.path();
};

TEST_F(SavedSession, SeesNoChangeOnDiskOfItsOwnSaves) {
  ASSERT_TRUE(session.start("rename", {{"to", "castle"}}));
  session.wait();
  ASSERT_TRUE(session.save(folder));
  session.wait();
  EXPECT_FALSE(session.changedOnDisk());
  EXPECT_FALSE(session.modified());
}

TEST_F(SavedSession, DoesNotSaveOverWhatAnotherProgramWrote) {
  addStationFromOutside("Outside");
  ASSERT_TRUE(session.save(folder));
  session.wait();
  ASSERT_EQ(session.errors().size(), 1U);
  EXPECT_EQ(session.errors().front().error.kind, ErrorKind::file_system);
  EXPECT_EQ(stationsOnDisk().back(), "Outside");
  EXPECT_TRUE(session.changedOnDisk());
}

TEST_F(SavedSession, ReloadsWhatAnotherProgramWrote) {
  addStationFromOutside("Outside");
  ASSERT_TRUE(session.changedOnDisk());
  ASSERT_TRUE(session.open(folder));
  session.wait();
  EXPECT_FALSE(session.changedOnDisk());
  EXPECT_EQ(session.document().job->stations.back().name, "Outside");
}

TEST_F(SavedSession, ReplacesWhatAnotherProgramWroteWhenTheUserKeepsTheOwnVersion) {
  addStationFromOutside("Outside");
  ASSERT_TRUE(session.changedOnDisk());
  session.keepOverDisk();
  EXPECT_FALSE(session.changedOnDisk());
  EXPECT_TRUE(session.modified()) << "what is on disk is not what is shown";
  ASSERT_TRUE(session.save(folder));
  session.wait();
  EXPECT_TRUE(session.errors().empty());
  EXPECT_NE(stationsOnDisk().back(), "Outside");
}

TEST_F(DemoSession, RunsOneChangingTaskAtATime) {
  ASSERT_TRUE(session.start("wait", json::object(), "Wait a while"));
  EXPECT_FALSE(session.start("rename", {{"to", "castle"}}));
  EXPECT_NE(session.whyNot("rename").find("Wait a while"), std::string::npos);
  EXPECT_NE(session.whyNotUndo(), "") << "an undo now would be overwritten";
  EXPECT_EQ(session.whyNot("export"), "") << "reading is free";
  released = true;
  session.wait();
  EXPECT_EQ(session.whyNot("rename"), "");
}

TEST_F(DemoSession, LeavesTheDocumentAloneWhenATaskIsCancelled) {
  const auto before = session.document();
  ASSERT_TRUE(session.start("wait", json::object()));
  session.running().front()->progress().cancel();
  session.wait();
  EXPECT_EQ(session.document(), before);
  EXPECT_TRUE(session.finished().front().cancelled);
  EXPECT_TRUE(session.errors().empty()) << "a cancel is no error to be shown";
}

TEST_F(DemoSession, ShowsAnErrorWithItsPlace) {
  ASSERT_TRUE(session.start("break", json::object(), "Break it"));
  session.wait();
  ASSERT_EQ(session.errors().size(), 1U);
  EXPECT_EQ(session.errors().front().title, "Break it");
  EXPECT_EQ(session.errors().front().error.source, "house.ifc #12");
  EXPECT_EQ(session.log().back().level, LogLevel::error);
}

TEST_F(DemoSession, LogsWhatWasLost) {
  const auto losses = std::count_if(session.log().begin(), session.log().end(),
                                    [](const LogEntry& e) { return e.level == LogLevel::loss; });
  EXPECT_EQ(losses, 1);
}

TEST_F(DemoSession, SavesOpensAndRecovers) {
  const auto root = std::filesystem::path(BINARY_DIR) / "test_editor_session";
  std::filesystem::remove_all(root);
  ASSERT_TRUE(session.save(root / "house"));
  session.wait();
  ASSERT_TRUE(session.errors().empty()) << describe(session.errors().front().error);
  EXPECT_FALSE(session.modified());
  EXPECT_EQ(session.folder(), root / "house");
  session.start("rename", {{"to", "castle"}});
  session.wait();
  EXPECT_TRUE(session.modified());
  ASSERT_TRUE(session.saveRecovery(root / "recovery" / "copy"));
  session.wait();
  EXPECT_TRUE(session.modified()) << "a recovery copy is not a save";

  Session other(steeredVerbs(), [] {});
  ASSERT_TRUE(other.open(root / "house"));
  other.wait();
  EXPECT_EQ(other.document().name, "house") << "a project is called like its folder";
  EXPECT_FALSE(other.modified());
  EXPECT_EQ(other.document().imported->products.size(), session.document().imported->products.size());

  const SessionMark mark{.name = "castle", .saved_in = (root / "house").string()};
  ASSERT_TRUE(other.recover({root / "recovery", root / "recovery" / "copy", mark, ""}));
  other.wait();
  EXPECT_EQ(other.document().name, "castle");
  EXPECT_TRUE(other.modified());
  EXPECT_EQ(other.folder(), root / "house");
  EXPECT_TRUE(std::filesystem::exists(root / "recovery")) << "it is all there is of the work";
  ASSERT_TRUE(other.saveRecovery(root / "next" / "copy"));
  other.wait();
  EXPECT_FALSE(std::filesystem::exists(root / "recovery")) << "now there is another one";
}

TEST_F(DemoSession, KeepsACopyOfEveryChangeUntilItIsSaved) {
  const TemporaryFolder folder;
  const auto root = folder.path() / "recovery";
  RecoveryKeeper keeper(root);
  const auto kept = [&] {
    keeper.keep(session);
    session.wait();
    EXPECT_TRUE(keeper.upToDate(session));
    Progress progress;
    return loadProject(root / "copy", progress);
  };
  EXPECT_FALSE(keeper.upToDate(session));
  ASSERT_TRUE(kept());
  const auto part = std::filesystem::last_write_time(*std::filesystem::directory_iterator(root / "copy" / "geometry"));
  ASSERT_TRUE(session.start("rename", {{"to", "castle"}}));
  session.wait();
  EXPECT_FALSE(keeper.upToDate(session));
  ASSERT_TRUE(kept());
  EXPECT_EQ(std::filesystem::last_write_time(*std::filesystem::directory_iterator(root / "copy" / "geometry")), part)
      << "a part that has not changed is not written again";
  session.undo();
  EXPECT_FALSE(keeper.upToDate(session));
  ASSERT_TRUE(kept());
  ASSERT_TRUE(session.save(folder.path() / "house"));
  session.wait();
  EXPECT_TRUE(keeper.upToDate(session));
  keeper.keep(session);
  EXPECT_FALSE(std::filesystem::exists(root / "copy")) << "what is saved needs no copy";
}

TEST_F(DemoSession, SaysThatNoCopyCanBeKeptForAsLongAsItIsSo) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "recovery") << "a file where the folder should be";
  for (const char* name : {"castle", "tower"}) {
    ASSERT_TRUE(session.start("rename", {{"to", name}}));
    session.wait();
    ASSERT_TRUE(session.saveRecovery(folder.path() / "recovery"));
    session.wait();
  }
  EXPECT_TRUE(session.errors().empty()) << "nobody asked for the copy: no dialog in the way";
  EXPECT_NE(session.keepingProblem(), "");
  const auto said = [&] {
    return std::count_if(session.log().begin(), session.log().end(),
                         [](const LogEntry& entry) { return entry.level == LogLevel::error; });
  };
  EXPECT_EQ(said(), 1) << "the same after every change is read by nobody";
  ASSERT_TRUE(session.saveRecovery(folder.path() / "elsewhere"));
  session.wait();
  EXPECT_EQ(session.keepingProblem(), "");
}

TEST_F(DemoSession, KeepsWhatIsOpenWhenAnotherProjectCannotBeRead) {
  ASSERT_TRUE(session.open("/no/such/project"));
  session.wait();
  EXPECT_EQ(session.errors().size(), 1U);
  EXPECT_EQ(session.document().name, "demo house");
}

}  // namespace
}  // namespace standpoint
