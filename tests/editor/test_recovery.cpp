// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/model/recovery_keeper.h"
#include "editor/panels/quality_panel.h"
#include "editor/recovery/differences.h"
#include "editor/shell/actions.h"
#include "editor/words/words.h"
#include "item_probe.h"
#include "project/storage/project_files.h"
#include "project/storage/project_lock.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::ElementsAre, testing::HasSubstr, testing::StartsWith;

constexpr long kGone = 4194305;  // above the largest process id that Linux gives

class Recovery : public testing::Test {
 protected:
  void write(const fs::path& name, const std::string& text) const {
    fs::create_directories((root / name).parent_path());
    std::ofstream(root / name) << text;
  }
  // An editor that ended without closing, with an unsaved copy or without.
  void crash(long process, const SessionMark& mark, bool copy = true) const {
    ASSERT_TRUE(writeSessionMark(recoveryFolder(root, process), mark));
    if (copy) write(fs::path(std::to_string(process)) / "copy" / "project.json", "{}");
  }

  TemporaryFolder folder;
  fs::path root = folder.path();
};

TEST_F(Recovery, IsOfferedOnlyOfProcessesThatAreGone) {
  crash(kGone, {.name = "school", .saved_in = "/projects/school"});
  crash(getpid(), {.name = "house"});
  write("readme/copy/project.json", "{}");
  const auto left = findLeftWork(root);
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(left[0].mark.name, "school");
  EXPECT_EQ(left[0].mark.saved_in, "/projects/school");
  removeRecovery(left[0].folder);
  EXPECT_TRUE(findLeftWork(root).empty());
  write(fs::path(std::to_string(getpid())) / "owner.json", R"({"name": "house", "process_start": "another boot 7"})");
  ASSERT_EQ(findLeftWork(root).size(), 1U) << "another process has its number now";
}

// As a killed editor does while its memory is freed, and until its parent asks for it.
TEST_F(Recovery, IsOfferedOfAProcessThatIsEnding) {
  const pid_t child = fork();
  if (child == 0) {
    crash(getpid(), {.name = "house"});
    _exit(0);
  }
  ASSERT_GT(child, 0);
  siginfo_t ended{};
  ASSERT_EQ(waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT), 0);
  const auto left = findLeftWork(root);
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(left[0].mark.name, "house");
}

TEST_F(Recovery, SaysWhatRanAndHowFarItWas) {
  const LeftJob scan{"Scan all stations", "Scan K3 (2 of 5)", 62, "scan", {{"output", "x.e57"}}};
  const LeftJob import{"Optimise", "", 7, "optimize", json::object()};
  crash(kGone, {.name = "House", .saved_in = "/projects/House", .changes = 3, .jobs = {scan, import}});
  const auto left = findLeftWork(root);
  ASSERT_EQ(left.size(), 1U);
  EXPECT_THAT(sentencesOf(left[0]), ElementsAre("The editor closed unexpectedly.", "The project 'House' was open.",
                                                StartsWith("Last seen at "),
                                                "A recovery copy is available. 3 changes are newer than the project.",
                                                "Scan K3 (2 of 5) stopped at 62 %.",
                                                "Stations that were finished are kept.", "Optimise stopped at 7 %."));
  ASSERT_NE(leftScan(left[0]), nullptr);
  EXPECT_EQ(*leftScan(left[0]), scan);
}

TEST_F(Recovery, SaysWhenTheEditorWasSeenLastAndNotWhenItsCrashWasFound) {
  crash(kGone, {.name = "House"});
  const auto long_ago = fs::last_write_time(recoveryFolder(root, kGone) / "owner.json") - std::chrono::hours(50);
  for (const char* file : {"owner.json", "copy/project.json"})
    fs::last_write_time(recoveryFolder(root, kGone) / file, long_ago);
  const auto before = findLeftWork(root).at(0).last_heard;
  EXPECT_TRUE(takeNewCrashes(root).any);
  EXPECT_FALSE(takeNewCrashes(root).any);
  EXPECT_EQ(findLeftWork(root).at(0).last_heard, before);
}

TEST_F(Recovery, SaysWhatRanInTheLanguageThatIsSpoken) {
  speak("de");
  LeftWork left;
  left.mark.jobs = {{"Scan all stations", "", 62, "scan", json::object()}};
  const auto said = sentencesOf(left);
  speak("en");
  EXPECT_THAT(said, testing::Contains("Alle Standpunkte scannen: bei 62 % abgebrochen."));
}

TEST_F(Recovery, IsOfferedOfAJobThoughNothingWasUnsaved) {
  crash(kGone, {.name = "House", .jobs = {{"Import house.ifc", "Read", 30, "import", json::object()}}}, false);
  const auto left = findLeftWork(root);
  ASSERT_EQ(left.size(), 1U);
  EXPECT_TRUE(left[0].project.empty());
}

TEST_F(Recovery, BearsAMarkOfGarbage) {
  for (const char* text : {"", "{", "[]", R"({"jobs": 7, "changes": -3, "name": []})", R"({"jobs": [1, {"verb": 2}]})",
                           R"({"name": "x", "seen": "yes", "young": "yes"})"}) {
    write(fs::path(std::to_string(kGone)) / "owner.json", text);
    write(fs::path(std::to_string(kGone)) / "copy" / "project.json", "{}");
    ASSERT_EQ(findLeftWork(root).size(), 1U) << text;
    EXPECT_FALSE(sentencesOf(findLeftWork(root)[0]).empty()) << text;
    takeNewCrashes(root);
  }
}

TEST_F(Recovery, StartsBareOnlyWhenTheEditorCrashedTwiceAtItsStart) {
  EXPECT_FALSE(takeNewCrashes(root).any) << "the first start of all";
  crash(kGone, {.young = true, .after_crash = false});
  const auto first = takeNewCrashes(root);
  EXPECT_TRUE(first.any);
  EXPECT_FALSE(first.again_at_start) << "once is not twice";
  EXPECT_FALSE(takeNewCrashes(root).any) << "each crash is told once";
  crash(kGone, {.young = false, .after_crash = true});
  EXPECT_FALSE(takeNewCrashes(root).again_at_start) << "it ran for more than a minute";
  crash(kGone, {.young = true, .after_crash = true});
  EXPECT_TRUE(takeNewCrashes(root).again_at_start);
  EXPECT_FALSE(takeNewCrashes(root).again_at_start) << "the next start is as usual again";
}

TEST_F(Recovery, KeepsTheCopyOfACrashThatHasBeenTold) {
  crash(kGone, {.name = "school"});
  crash(kGone + 1, {.name = "nothing was left"}, false);
  EXPECT_TRUE(takeNewCrashes(root).any);
  EXPECT_EQ(findLeftWork(root).size(), 1U) << "it was left for later";
  EXPECT_FALSE(fs::exists(recoveryFolder(root, kGone + 1)));
}

TEST_F(Recovery, NotesWhatRunsUntilItEnds) {
  Session session(verbsWithDemo(), [] {});
  ASSERT_TRUE(session.start("demo", json::object()));
  session.wait();
  ASSERT_TRUE(session.start("plan", json::object(), "Plan the survey"));
  RecoveryKeeper keeper(root / "1");
  keeper.keep(session);
  const auto noted = [&] {
    std::ifstream in(root / "1" / "owner.json");
    return json::parse(in);
  };
  ASSERT_EQ(noted()["jobs"].size(), 1U) << noted();
  EXPECT_EQ(noted()["jobs"][0]["title"], "Plan the survey");
  EXPECT_EQ(noted()["young"], true);
  session.wait();
  keeper.keep(session);
  session.wait();
  keeper.keep(session);
  EXPECT_EQ(noted()["jobs"].size(), 0U) << "and never its own copying: " << noted();
  EXPECT_EQ(noted()["changes"], 1);
  EXPECT_EQ(keeper.problem(), "");
}

TEST_F(Recovery, BringsColoursBackAndAssessesAnewWhatWasAssessed) {
  Editor editor(verbsWithDemo(), [] {});
  GuiDriver gui(editor);
  ASSERT_TRUE(editor.session.start("demo", json::object()));
  gui.settle();
  editor.view.colour = ColourMode::material;
  editor.view.points_by = ColourBy::range;
  gui.frames(2);
  ASSERT_TRUE(editor.session.shown_as);
  const auto shown = editor.session.shown_as();
  EXPECT_EQ(shown.at("on"), (json{"colour-material", "points-by-range"})) << shown;
  EXPECT_FALSE(shown.contains("assessed"));
  crash(kGone, {.name = "House", .shown = {{"on", {"colour-material", "quit"}}, {"assessed", "loa20"}}});
  const auto left = findLeftWork(root);
  ASSERT_EQ(left.size(), 1U);
  editor.view.colour = ColourMode::model;
  editor.dialogs.shown_before = left[0].mark.shown;
  gui.frames(2);
  EXPECT_EQ(editor.view.colour, ColourMode::material);
  EXPECT_FALSE(editor.quit) << "what is not of the view is not run";
  EXPECT_TRUE(editor.dialogs.shown_before.empty());
}

// With the scans where an unsaved project has them.
TEST_F(Recovery, AssessesAnewWhatWasAssessedOfAnUnsavedProject) {
  setenv("XDG_DATA_HOME", (root / "data").c_str(), 1);
  const auto left_in = recoveryFolder(root / "recovery", kGone);
  const auto scan_file = [](const Session& session) { return session.ownFolder() / "scans" / "S1.e57"; };
  {
    Editor editor(verbsWithDemo(), [] {});
    GuiDriver gui(editor);
    ASSERT_TRUE(editor.session.start("demo", json::object()));
    gui.settle();
    ASSERT_TRUE(editor.session.folder().empty());
    fs::create_directories(scan_file(editor.session).parent_path());
    ASSERT_TRUE(editor.session.start(ScanVerbOptions{.instrument = "faro-focus-s350",
                                                     .settings = {{"resolution", "1/20"}, {"quality", "4x"}},
                                                     .ideal = true,
                                                     .output = scan_file(editor.session)}));
    gui.settle();
    editor.panels.of<QualityState>().profile = QualityProfile::loa20;
    ASSERT_TRUE(invoke(editor, "assess"));
    EXPECT_EQ(editor.session.shown_as().at("assessed"), "LOA20") << "a crash may come while it is made";
    gui.settle();
    ASSERT_NE(editor.session.lastAnswer<AssessAnswer>("assess"), nullptr);
    RecoveryKeeper keeper(left_in);
    keeper.keep(editor.session);
    editor.session.wait();
    keeper.keep(editor.session);
  }
  std::ifstream in(left_in / "owner.json");
  auto mark = json::parse(in);
  mark["process_start"] = "another boot 7";
  write(fs::path("recovery") / std::to_string(kGone) / "owner.json", mark.dump());
  Editor editor(verbsWithDemo(), [] {});
  GuiDriver gui(editor);
  editor.dialogs.recovery = findLeftWork(root / "recovery");
  ASSERT_EQ(editor.dialogs.recovery.size(), 1U);
  gui.frames(2);
  ASSERT_TRUE(gui.click("###open"));
  for (int i = 0; i < 3; ++i) gui.settle();  // opened, kept again, assessed
  ASSERT_TRUE(editor.session.errors().empty()) << describe(editor.session.errors().front().error);
  const auto* answer = editor.session.lastAnswer<AssessAnswer>("assess");
  ASSERT_NE(answer, nullptr);
  EXPECT_EQ(answer->profile, "LOA20");
  EXPECT_FALSE(answer->scans.empty()) << "its file is found";
  unsetenv("XDG_DATA_HOME");
}

TEST_F(Recovery, NotesWhatAnEmulatedDeviceWorksOn) {
  Session session(verbsWithDemo(), [] {});
  session.runs_elsewhere = [] { return std::vector<LeftJob>{{"RTC360: Setup 1 at S1", {}, 40, {}, json::object()}}; };
  const auto left = recoveryFolder(root, kGone);
  RecoveryKeeper keeper(left);
  keeper.keep(session);
  std::ifstream in(left / "owner.json");
  auto mark = json::parse(in);
  mark["process_start"] = "another boot 7";
  write(fs::path(std::to_string(kGone)) / "owner.json", mark.dump());
  const auto found = findLeftWork(root);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(sentencesOf(found[0]), testing::Contains("RTC360: Setup 1 at S1 stopped at 40 %."));
  EXPECT_EQ(leftScan(found[0]), nullptr) << "the device has not stored it: there is nothing to resume";
}

TEST(Differences, BetweenAProjectAndItsCopyAreInWordsAndFigures) {
  Document project = twoStoreyDocument();
  const auto with = [](const Document& d, const char* verb, const json& options) {
    const auto done = standpoint::run(verb, d, options);
    EXPECT_TRUE(done) << describe(done.error());
    return done ? done->document : d;
  };
  project = with(project, "station", {{"add", "S1"}, {"on", {500002, 5600002, 0}}});
  project = with(project, "station", {{"add", "S2"}, {"on", {500002, 5600002, 3}}});
  project = with(project, "measure", {{"add", "M1"}, {"points", {"500001,5600001,0", "500002,5600001,0"}}});
  EXPECT_TRUE(differences(project, project).empty());
  auto copy = with(project, "station", {{"move", "S1"}, {"on", {500002.25, 5600002, 0}}});
  copy = with(copy, "station", {{"remove", "S2"}});
  copy = with(copy, "target", {{"add", "T1"}, {"at", {500001, 5600001, 1.5}}});
  copy = with(copy, "georeference", {{"crs", "EPSG:25832"}});
  copy = with(copy, "treat", {{"products", {"table"}}, {"as", "excluded"}});
  EXPECT_THAT(
      differences(project, copy),
      ElementsAre("Triangles of the model: 144 in the project, 132 in the copy",
                  "Treatments: 0 in the project, 1 in the copy", "CRS: none in the project, EPSG:25832 in the copy",
                  "Station S1: moved by 0.250 m", "Station S2: only in the project", "Target T1: only in the copy"));
}

TEST_F(Recovery, ComparesACopyWithItsProjectAtTheButton) {
  Progress progress;
  const auto project = folder.path() / "house", left = recoveryFolder(root, kGone);
  const auto copy = standpoint::run("bookmark", twoStoreyDocument(), {{"add", "Stair"}});
  ASSERT_TRUE(copy);
  ASSERT_TRUE(saveProject(twoStoreyDocument(), project, progress));
  ASSERT_TRUE(writeSessionMark(left, {.name = "house", .saved_in = project.string(), .changes = 1}));
  ASSERT_TRUE(saveProject(copy->document, left / "copy", progress));
  Editor editor(verbsWithDemo(), [] {});
  editor.dialogs.recovery = findLeftWork(root);
  ASSERT_EQ(editor.dialogs.recovery.size(), 1U);
  GuiDriver gui(editor);
  gui.frames(3);
  ASSERT_TRUE(gui.click("###compare"));
  editor.dialogs.comparison.task->wait();
  itemProbe().listens = true;
  gui.frames(2);
  itemProbe().listens = false;
  EXPECT_THAT(itemProbe().texts, testing::Contains("Bookmark Stair: only in the copy"));
  ASSERT_NE(gui.find("###open"), nullptr) << "and the offer stays";
  ASSERT_TRUE(gui.click("###later"));
  EXPECT_FALSE(editor.dialogs.comparison.task);
}

TEST_F(Recovery, SaysWhereNothingCanBeKept) {
  write("in-the-way", "a file where the folder should be");
  Session session(verbsWithDemo(), [] {});
  RecoveryKeeper keeper(root / "in-the-way" / "1");
  keeper.keep(session);
  EXPECT_THAT(keeper.problem(), HasSubstr("in-the-way"));
}

TEST_F(Recovery, LeadsFromTheStatusBarToAnotherFolder) {
  Editor editor(verbsWithDemo(), [] {});
  ASSERT_TRUE(editor.session.start("demo", json::object()));
  GuiDriver gui(editor);
  gui.settle();
  EXPECT_EQ(gui.find("###keeping-problem"), nullptr);
  editor.keeping_problem = "cannot write: No space left on device";
  gui.frames(2);
  ASSERT_TRUE(gui.click("###keeping-problem"));
  gui.frames(2);
  EXPECT_TRUE(editor.dialogs.file.open);
}

TEST_F(Recovery, OpensWhatWasLeftAtTheButton) {
  Session before(verbsWithDemo(), [] {});
  ASSERT_TRUE(before.start("demo", json::object()));
  before.wait();
  const auto left = recoveryFolder(root, kGone);
  RecoveryKeeper keeper(left);
  keeper.keep(before);
  before.wait();
  std::ifstream in(left / "owner.json");
  auto mark = json::parse(in);
  mark["process_start"] = "another boot 7";
  write(fs::path(std::to_string(kGone)) / "owner.json", mark.dump());

  Editor editor(verbsWithDemo(), [] {});
  editor.dialogs.recovery = findLeftWork(root);
  GuiDriver gui(editor);
  gui.frames(3);
  EXPECT_TRUE(gui.says("the history begins anew"));
  ASSERT_TRUE(gui.click("###open"));
  gui.settle();
  EXPECT_EQ(editor.session.document().name, "demo house");
  EXPECT_TRUE(editor.session.modified());
  EXPECT_EQ(editor.session.lastChange(), "Recovered demo house");
  EXPECT_FALSE(editor.session.history().canUndo()) << "nothing of it is taken back by a key";
}

TEST_F(Recovery, DeletesACopyAtASecondPressOnly) {
  Progress progress;
  const auto left = recoveryFolder(root, kGone);
  ASSERT_TRUE(writeSessionMark(left, {.name = "house", .changes = 1}));
  ASSERT_TRUE(saveProject(twoStoreyDocument(), left / "copy", progress));
  Editor editor(verbsWithDemo(), [] {});
  editor.dialogs.recovery = findLeftWork(root);
  ASSERT_EQ(editor.dialogs.recovery.size(), 1U);
  GuiDriver gui(editor);
  gui.frames(3);
  ASSERT_TRUE(gui.click("###delete"));
  gui.frames(2);
  EXPECT_TRUE(fs::exists(left)) << "the pointer may have been there when the dialog opened";
  EXPECT_TRUE(gui.says("Press again to delete"));
  ASSERT_TRUE(gui.click("###delete"));
  gui.frames(2);
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(editor.dialogs.recovery.empty());
}

TEST_F(Recovery, OfABareStartCanBeTakenBack) {
  Editor editor(verbsWithDemo(), [] {});
  bool as_usual = false;
  editor.dialogs.bare = true;
  editor.dialogs.start_as_usual = [&] { as_usual = true; };
  GuiDriver gui(editor);
  gui.frames(3);
  ASSERT_TRUE(gui.click("###as-usual"));
  gui.frames(3);
  EXPECT_TRUE(as_usual);
  EXPECT_FALSE(editor.dialogs.bare);
  EXPECT_FALSE(editor.dialogs.start_as_usual) << "preferences are written again";
}

class OpenTwice : public testing::Test {
 protected:
  void SetUp() override {
    Session first(verbsWithDemo(), [] {});
    first.start("demo", json::object());
    first.wait();
    first.save(project);
    first.wait();
  }
  TemporaryFolder folder;
  fs::path project = folder.path() / "house";
};

TEST_F(OpenTwice, IsSaidByTheSecondEditorOnly) {
  Session one(verbsWithDemo(), [] {}), two(verbsWithDemo(), [] {});
  one.open(project);
  one.wait();
  EXPECT_EQ(one.openElsewhere(), "");
  one.open(project);  // anew: it is its own
  one.wait();
  EXPECT_EQ(one.openElsewhere(), "");
  two.open(project);
  two.wait();
  EXPECT_THAT(two.openElsewhere(), HasSubstr("standpoint editor (process " + std::to_string(getpid())));
  two.workOnCopy();
  EXPECT_EQ(two.openElsewhere(), "");
  EXPECT_TRUE(two.modified());
  EXPECT_TRUE(two.folder().empty());
  one.clear();
  EXPECT_FALSE(fs::exists(project / kOpenMarkFile)) << "nothing is left in the project";
}

TEST_F(OpenTwice, OffersAWayOnInPlace) {
  std::string nobody;
  const auto other = OpenMark::take(project, nobody);
  ASSERT_TRUE(other);
  for (const char* button : {"###copy", "###beside", "###close"}) {
    SCOPED_TRACE(button);
    Editor editor(verbsWithDemo(), [] {});
    editor.session.open(project);
    GuiDriver gui(editor);
    gui.settle();
    gui.frames(3);
    ASSERT_TRUE(gui.click(button));
    gui.frames(3);
    EXPECT_EQ(editor.session.openElsewhere(), "");
    EXPECT_EQ(editor.session.folder().empty(), std::string_view(button) != "###beside");
    EXPECT_EQ(editor.environment() == nullptr, std::string_view(button) == "###close");
  }
}

TEST_F(OpenTwice, IsNotMissedInAFolderThatMayNotBeWritten) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  fs::permissions(project, fs::perms::owner_read | fs::perms::owner_exec);
  Session one(verbsWithDemo(), [] {});
  one.open(project);
  one.wait();
  EXPECT_EQ(one.openElsewhere(), "");
  EXPECT_TRUE(one.errors().empty());
  fs::permissions(project, fs::perms::owner_all);
}

}  // namespace
}  // namespace standpoint
