// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdlib>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "editor/model/recovery_keeper.h"
#include "emulated-ui/verbs/rehearse_verb.h"
#include "item_probe.h"
#include "project/survey/survey_verbs.h"
#include "source_text.h"
#include "tests/project/killed_process.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

std::vector<Verb> everyVerb() { return {allVerbs().begin(), allVerbs().end()}; }

ScanVerbOptions threeStations(const fs::path& output) {
  ScanVerbOptions options;
  options.instrument = "faro-focus-s350";
  options.settings = {{"resolution", "1/16"}, {"quality", "4x"}};
  options.seed = 5;
  options.output = output;
  return options;
}

// Imports the sample house, sets three stations up and scans them into `output`, as the window's loop does it. Nothing
// has been saved.
void scanIn(Editor& editor, const fs::path& output, const std::function<void()>& each_frame) {
  GuiDriver gui(editor);
  const auto rest = [&](const std::function<bool()>& until) {
    do {
      gui.frame();
      each_frame();
    } while (!editor.session.running().empty() || !until());
  };
  const auto always = [] { return true; };
  editor.session.start("import", {{"files", {(samplesFolder() / "house.ifc").string()}}});
  rest(always);
  const std::vector<std::pair<const char*, json>> places = {
      {"K1", {4.3, 1.6, 0}}, {"K2", {3.8, 2.5, 2.8}}, {"K3", {4.6, 1.6, 0}}};
  for (const auto& [name, on] : places) {
    editor.session.start("station", {{"add", name}, {"on", on}});
    rest(always);
  }
  editor.startScan(threeStations(output), "Scan all stations");
  rest(always);
}

TEST(KilledScan, DISABLED_Script) {
  const char* root = std::getenv("STANDPOINT_KILL_FOLDER");
  if (root == nullptr) GTEST_SKIP() << "the other test starts it";
  const fs::path folder = root;
  Editor editor(everyVerb(), [] {});
  RecoveryKeeper keeper(recoveryFolder(folder / "copies", getpid()));
  scanIn(editor, folder / "scans.e57", [&] { keeper.keep(editor.session); });
}

TEST(KilledScan, IsResumedAtTheNextStartToTheBytesOfARunWithoutABreak) {
  const TemporaryFolder folder;
  const auto root = folder.path();
  setenv("STANDPOINT_KILL_FOLDER", root.c_str(), 1);
  Process process({fs::read_symlink("/proc/self/exe").string(), "--gtest_also_run_disabled_tests",
                   "--gtest_filter=KilledScan.DISABLED_Script"});
  const auto parts = root / "scans.e57.parts";
  const auto one_is_whole = [&] { return fs::exists(parts / "K1.json"); };
  ASSERT_TRUE(process.killAfter(one_is_whole, std::chrono::milliseconds(1))) << "it had ended before";
  ASSERT_FALSE(fs::exists(root / "scans.e57")) << "half a scan is none";
  ASSERT_TRUE(one_is_whole());

  EXPECT_TRUE(takeNewCrashes(root / "copies").any);
  const auto left = findLeftWork(root / "copies");
  ASSERT_EQ(left.size(), 1U);
  const auto* job = leftScan(left[0]);
  ASSERT_NE(job, nullptr);
  EXPECT_THAT(job->stage, HasSubstr("of 3)"));

  {
    Editor editor(everyVerb(), [] {});
    editor.dialogs.recovery = left;
    GuiDriver gui(editor);
    gui.frames(3);
    ASSERT_TRUE(gui.click("###resume"));
    gui.settle();
    gui.settle();
    ASSERT_TRUE(editor.session.errors().empty()) << describe(editor.session.errors().front().error);
    const auto* answer = editor.session.lastAnswer<ScanAnswer>("scan");
    ASSERT_NE(answer, nullptr) << "the scan has not gone on";
    ASSERT_EQ(answer->stations.size(), 3U);
    EXPECT_TRUE(answer->stations[0].resumed.value_or(false)) << "K1 was finished";
    EXPECT_FALSE(answer->stations[2].resumed.value_or(false));
    EXPECT_FALSE(fs::exists(parts));
  }
  Editor whole(everyVerb(), [] {});
  scanIn(whole, root / "whole.e57", [] {});
  EXPECT_GT(fs::file_size(root / "whole.e57"), 100000U);
  EXPECT_TRUE(allOf(root / "scans.e57") == allOf(root / "whole.e57"));
}

}  // namespace
}  // namespace standpoint
