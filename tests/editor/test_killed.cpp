// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "editor/model/recovery_keeper.h"
#include "emulated-ui/rehearsal/rehearsal.h"
#include "emulated-ui/verbs/rehearse_verb.h"
#include "item_probe.h"
#include "project/storage/project_files.h"
#include "project/storage/project_json.h"
#include "tests/project/killed_process.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

// What somebody does in the editor. A session that came back from a copy has nothing to undo: the verb that comes to
// the same then.
struct ScriptStep {
  std::string verb;  // or undo, redo, save
  json options;
};

const std::vector<ScriptStep>& script() {
  static const std::vector<ScriptStep> steps = {{"import", {{"files", {(samplesFolder() / "house.ifc").string()}}}},
                                                {"station", {{"add", "S1"}, {"on", {4.3, 1.6, 0}}}},
                                                {"station", {{"add", "S2"}, {"on", {3.8, 2.5, 2.8}}}},
                                                {"materials", json::object()},
                                                {"station", {{"move", "S1"}, {"on", {4.5, 1.6, 0}}}},
                                                {"save", {}},
                                                {"target", {{"add", "T1"}, {"at", {4, 2, 1.5}}}},
                                                {"undo", {{"remove", "T1"}}},
                                                {"redo", {{"add", "T1"}, {"at", {4, 2, 1.5}}}},
                                                {"optimize", {{"max-deviation", 0.01}}},
                                                {"target", {{"add", "T2"}, {"at", {4.5, 2, 1.5}}}},
                                                {"save", {}},
                                                {"station", {{"remove", "S2"}}},
                                                {"treat", {{"products", {"class:IfcFurniture*"}}, {"as", "excluded"}}},
                                                {"target", {{"remove", "T2"}}}};
  return steps;
}

std::string stateOf(const Document& document) {
  auto state = documentToJson(document, "/");
  state["excluded"] = 0;
  for (const auto& product : document.imported->products)
    if (product.excluded) state["excluded"] = state["excluded"].get<int>() + 1;
  return fmt::format("{:016x}", contentHash(state.dump()));
}

// The folder of one test: where the editor keeps its copies, the project that it saves, and the diary of what it did.
struct KillFolder {
  fs::path root;
  fs::path copies() const { return root / "copies"; }
  fs::path project() const { return root / "house"; }
  fs::path diary() const { return root / "diary"; }
};

// The editor without a window, as a process of its own (see the parent below). It ends as if it had crashed.
class ScriptedEditor {
 public:
  ScriptedEditor(KillFolder desk, std::size_t first) : desk_(std::move(desk)) {
    if (first > 0) comeBack();
    for (std::size_t i = first; i < script().size(); ++i) {
      act(script()[i]);
      if (!editor_.session.errors().empty()) {
        say("error " + describe(editor_.session.errors().front().error));
        return;
      }
      say(fmt::format("done {} {}", i, stateOf(editor_.session.document())));
    }
  }

 private:
  void comeBack() {
    const auto copies = findLeftWork(desk_.copies());
    copies.empty() || copies.front().project.empty() ? editor_.session.open(desk_.project())
                                                     : editor_.session.recover(copies.front());
    rest();
  }
  void act(const ScriptStep& step) {
    auto& session = editor_.session;
    const bool undo = step.verb == "undo", redo = step.verb == "redo";
    if (step.verb == "save")
      session.save(desk_.project());
    else if (undo && session.history().undoDescription().find("T1") != std::string::npos)
      session.undo();
    else if (redo && session.history().canRedo())
      session.redo();
    else
      session.start(undo || redo ? "target" : step.verb, step.options);
    rest();
  }
  // Until nothing runs and all is kept, as the window's loop does it.
  void rest() {
    do {
      editor_.update();
      gui_.frame();
      keeper_.keep(editor_.session);
    } while (!editor_.session.running().empty() || !keeper_.upToDate(editor_.session));
    gui_.frame();
    keeper_.keep(editor_.session);  // saved: it removes the copy
  }
  void say(const std::string& line) { std::ofstream(desk_.diary(), std::ios::app) << line + '\n'; }

  KillFolder desk_;
  Editor editor_{std::vector<Verb>(allVerbs().begin(), allVerbs().end()), [] {}};
  GuiDriver gui_{editor_};
  RecoveryKeeper keeper_{recoveryFolder(desk_.copies(), getpid())};
};

TEST(KilledEditor, DISABLED_Script) {
  const char* root = std::getenv("STANDPOINT_KILL_FOLDER");
  const char* first = std::getenv("STANDPOINT_KILL_FIRST");
  if (root == nullptr || first == nullptr) GTEST_SKIP() << "the other test starts it";
  const ScriptedEditor editor({root}, static_cast<std::size_t>(std::atoi(first)));
}

Process scriptedEditor(const KillFolder& desk, std::size_t first) {
  setenv("STANDPOINT_KILL_FOLDER", desk.root.c_str(), 1);
  setenv("STANDPOINT_KILL_FIRST", std::to_string(first).c_str(), 1);
  return Process({fs::read_symlink("/proc/self/exe").string(), "--gtest_also_run_disabled_tests",
                  "--gtest_filter=KilledEditor.DISABLED_Script"});
}

struct Diary {
  std::vector<std::string> states;  // of each step, as far as there was one
  std::string error;
};
Diary readDiary(const KillFolder& desk) {
  Diary diary;
  std::ifstream in(desk.diary());
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("error")) diary.error = line;
    if (!line.starts_with("done")) continue;
    diary.states.resize(std::stoul(line.substr(5)) + 1);
    diary.states.back() = line.substr(line.rfind(' ') + 1);
  }
  return diary;
}

// The state that a new start of the editor would come back to; empty: none.
std::string stateFound(const KillFolder& desk, std::string& error) {
  auto copies = findLeftWork(desk.copies());
  for (std::size_t i = 1; i < copies.size(); ++i) removeRecovery(copies[i].folder);  // "Discard"
  std::error_code ignored;
  const auto from = copies.empty() ? desk.project() : copies.front().project;
  std::string state;
  for (const auto& folder : {from, desk.project()}) {
    if (!fs::exists(folder / "project.json", ignored)) continue;
    Progress progress;
    const auto loaded = loadProject(folder, progress);
    if (!loaded) error += describe(loaded.error()) + "\n";
    if (loaded && state.empty()) state = stateOf(*loaded);
  }
  return state;
}

void clear(const KillFolder& desk) {
  fs::remove_all(desk.root);
  fs::create_directories(desk.root);
}

constexpr std::chrono::milliseconds kCopying{30};  // that it takes to write a copy, or more

// What is there after a kill is the state after the last step whose result was kept, or after the one that ran.
TEST(KilledEditor, LosesAtMostTheStepThatRuns) {
  const TemporaryFolder folder;
  const KillFolder desk{folder.path() / "desk"};
  clear(desk);
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(scriptedEditor(desk, 0).wait(), 0);
  const auto whole = std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - start);
  const auto reference = readDiary(desk);
  ASSERT_EQ(reference.error, "");
  ASSERT_EQ(reference.states.size(), script().size());

  std::mt19937 random(killSeed());
  std::size_t first = 0;  // the step that comes next
  unsigned killed = 0, back_before = 0, back_after = 0;
  clear(desk);
  while (killed < kills()) {
    fs::remove(desk.diary());
    const auto left = whole * static_cast<long>(script().size() - first) / static_cast<long>(script().size());
    auto process = scriptedEditor(desk, first);
    // Every second time while it writes its first copy.
    const auto copy = recoveryFolder(desk.copies(), process.id()) / "copy";
    const auto copies = [&] { return fs::exists(copy); };
    if (killed % 2 == 0 ? process.killAfter(randomTime(random, left + whole / 10))
                        : process.killAfter(copies, randomTime(random, kCopying)))
      ++killed;
    const auto diary = readDiary(desk);
    ASSERT_EQ(diary.error, "") << "kill " << killed;
    const auto done = std::max(first, diary.states.size());  // steps
    std::string error;
    const auto found = stateFound(desk, error);
    ASSERT_EQ(error, "") << "kill " << killed << " during step " << done;
    const bool before = done == 0 ? found.empty() : found == reference.states[done - 1];
    const bool after = done < script().size() && found == reference.states[done];
    ASSERT_TRUE(before || after) << "kill " << killed << " of seed " << killSeed() << " during step " << done;
    (before ? back_before : back_after) += 1;
    first = before ? done : done + 1;
    if (first < script().size()) continue;
    first = 0;
    clear(desk);
  }
  std::printf(
      "%u kills of the editor, seed %u, script of %zu steps in %.2f s: %u times back to the last step that was "
      "kept, %u times to the one that ran\n",
      killed, killSeed(), script().size(), static_cast<double>(whole.count()) * 1e-6, back_before, back_after);
}

}  // namespace
}  // namespace standpoint
