// SPDX-License-Identifier: GPL-3.0-or-later
// Each verb that writes, on a disk that is full from its n-th call on, on a read-only one, and killed at its n-th call:
// what was there is there whole, or what is new is. STANDPOINT_EVERY_FAULT=1 tries every n; else a few, the first and
// the last among them.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>

#include <gtest/gtest.h>

#include "core/part_file.h"
#include "emulated-ui/verbs/rehearse_verb.h"
#include "project/storage/project_files.h"
#include "tests/project/killed_process.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

constexpr long kTried = 4;           // places of a run that are tried
constexpr const char* kOld = "old";  // what a file holds that a verb is to replace

struct Writer {
  friend void PrintTo(const Writer& writer, std::ostream* out) { *out << writer.verb << " " << writer.name; }
  const char* verb;
  const char* name;
  Words words;
  Words files;                   // in the folder of the run; those that begin with "p/" are there before
  bool makes_its_place = false;  // nothing may be there before: a folder
};

// In the folder of the run: the project p, the cloud s.e57, box.obj.
std::vector<Writer> writers() {
  const std::string at = "--at", project = "p/project.json";
  const Words scan = {"scan",
                      "p",
                      "--instrument",
                      "leica-rtc360",
                      "--set",
                      "resolution=12mm",
                      "field_of_view=target_area",
                      "horizontal_from=0",
                      "horizontal_to=20",
                      "vertical_from=-10",
                      "vertical_to=10"};
  const auto with = [](Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  return {
      {"import", "new", {"import", "box.obj", "-o", "q"}, {"q/project.json"}, true},
      {"import", "over", {"import", "box.obj", "-o", "p", "--replace"}, {project}},
      {"add", "", {"add", "p", "box.obj"}, {project}},
      {"optimize", "", {"optimize", "p", "--budget", "80", "--allow-loss"}, {project}},
      {"treat", "", {"treat", "p", "table", "--as", "excluded"}, {project}},
      {"collide", "", {"collide", "p"}, {project}},
      {"materials", "html", {"materials", "p", "--report", "o.html"}, {project, "o.html"}},
      {"materials", "csv", {"materials", "p", "--report", "o.csv"}, {project, "o.csv"}},
      {"georeference", "", {"georeference", "p", "--crs", "EPSG:25832"}, {project}},
      {"station", "", {"station", "p", "--add", "S9", at, "500001.5,5600001.5,1.5"}, {project}},
      {"target", "", {"target", "p", "--add", "T", at, "500001.5,5600001.5,1.5"}, {project}},
      {"bookmark", "", {"bookmark", "p", "--add", "view"}, {project}},
      {"measure",
       "",
       {"measure", "p", "--add", "M1", "--kind", "distance", "--points", "500001,5600001,0", "500002,5600001,0"},
       {project}},
      {"underlay", "", {"underlay", "p", "--add", "s.e57"}, {project}},
      {"locate", "", {"locate", "p", "--to", "moved.e57"}, {project}},
      {"verify", "", {"verify", "p", "--allow-loss"}, {project}},
      {"scan", "e57", with(scan, {"-o", "o.e57"}), {project, "o.e57"}},
      {"scan", "las", with(scan, {"-o", "o.las"}), {project, "o.las"}},
      {"scan", "folder", with(scan, {"-o", "scans"}), {project}},
      {"register", "", {"register", "p", "s.e57", "--control", "control.txt", "-o", "o.e57"}, {"o.e57"}},
      {"trajectory",
       "",
       {"trajectory", "p", "--add", "W", "--through", "500001,5600001,0", "500002,5600002,0"},
       {project}},
      {"mover", "", {"mover", "p", "--add", "M", "--through", "500001,5600001,0", "500002,5600002,0"}, {project}},
      {"waveform",
       "",
       {"waveform", "p", "--station", "S1", "--instrument", "leica-rtc360", "--direction", "10,-20", "-o", "o.csv"},
       {"o.csv"}},
      {"assess", "html", {"assess", "p", "--output", "o.html"}, {"o.html"}},
      {"assess", "csv", {"assess", "p", "--output", "o.csv"}, {"o.csv"}},
      {"export", "glb", {"export", "p", "-o", "o.glb"}, {"o.glb"}},
      {"export", "gltf", {"export", "p", "-o", "o.gltf"}, {"o.gltf", "o.bin"}},
      {"export", "obj", {"export", "p", "-o", "o.obj"}, {"o.obj", "o.mtl"}},
      {"export", "helios", {"export", "p", "-o", "o.xml"}, {"o.xml", "o.obj", "o.mtl"}},
      {"convert", "e57", {"convert", "s.e57", "o.e57"}, {"o.e57"}},
      {"convert", "ptx", {"convert", "s.e57", "o.ptx"}, {"o.ptx"}},
      {"convert", "ply", {"convert", "s.e57", "o.ply"}, {"o.ply"}},
      {"convert", "las", {"convert", "s.e57", "o.las"}, {"o.las"}},
      {"convert", "pcd", {"convert", "s.e57", "o.pcd"}, {"o.pcd"}},
      {"convert", "pts", {"convert", "s.e57", "o.pts"}, {"o.pts"}},
      {"convert", "csv", {"convert", "s.e57", "o.csv"}, {"o.csv"}},
      {"convert", "labels", {"convert", "s.e57", "set", "--dataset", "s3dis"}, {"set/dataset.json"}, true},
      {"clean",
       "",
       {"clean", "s.e57", "-o", "o.e57", "--filters", "outliers", "--report", "o.json"},
       {"o.e57", "o.json"}},
      {"instruments", "", {"instruments", "--copy", "leica-rtc360", "--as", "mine"}, {"own/mine.json"}, true},
      {"dataset",
       "slurm",
       {"dataset", "slurm", "recipe.json", "-o", "set", "--shards", "2"},
       {"set/slurm/array.sbatch", "set/slurm/manifest.sbatch"},
       true},
      {"dataset",
       "run",
       {"dataset", "run", "recipe.json", "-o", "set", "--resume"},
       {"set/croissant.json", "set/SHA256SUMS"},
       true},
      {"score", "html", {"score", "t.labels", "p.txt", "--classes", "s3dis", "-o", "o.html"}, {"o.html"}},
      {"score", "csv", {"score", "t.labels", "p.txt", "--classes", "s3dis", "-o", "o.csv"}, {"o.csv"}},
      {"score", "json", {"score", "t.labels", "p.txt", "--classes", "s3dis", "-o", "o.json"}, {"o.json"}},
      {"run", "", {"run", "job.json"}, {project, "o.glb"}},
      {"rehearse", "", {"rehearse", "E04", "--solution", "-o", "o"}, {"o/result.json", "o/result.csv"}},
      {"assign",
       "",
       {"assign", "exercise.json", "--class", "class.csv", "--key", "class.key", "-o", "o.json"},
       {"o.json"}},
      {"collect",
       "",
       {"collect", "results.d", "--assignment", "given.json", "--class", "class.csv", "--key", "class.key", "-o", "o"},
       {"o/table.csv", "o/criteria.csv", "o/moodle.csv", "o/xapi.json", "o/marks/C1-s-001.mark.json"}},
      {"scorm", "", {"scorm", "given.json", "--class", "class.csv", "-o", "o.zip"}, {"o.zip"}},
  };
}

std::string textOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void put(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

// The program, in `folder`. Returns its exit code, −1 when it was killed.
int run(const Words& words, const fs::path& folder, const Words& faults = {}) {
  Words all = {"/usr/bin/env", "-C", folder.string(), "STANDPOINT_INSTRUMENTS=" + (folder / "own").string()};
  all.insert(all.end(), faults.begin(), faults.end());
  all.emplace_back(PROGRAM);
  for (const auto& word : words) {
    // Whole paths, by which the faults know what lies in the folder.
    const bool place =
        word == "p" || fs::path(word).has_extension() || word == "q" || word == "o" || word == "set" || word == "scans";
    const bool setting = word.find('=') != word.npos || word.find(',') != word.npos;
    all.push_back(place && !setting ? (folder / word).string() : word);
  }
  return Process(all).wait();
}

class Faults : public ::testing::TestWithParam<Writer> {
 protected:
  const Writer& writer() const { return GetParam(); }

  // As it is before the verb: made once by each test, copied for each run.
  void SetUp() override {
    const auto p = base.path() / "p";
    Progress progress;
    ASSERT_TRUE(saveProject(twoStoreyDocument(), p, progress));
    put(base.path() / "box.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    const auto place = (runs.path() / "run").string();
    put(base.path() / "job.json", R"([{"verb": "station", "project": ")" + place +
                                      R"(/p", "add": "S9", "at": [500001.5, 5600001.5, 1.5]},
        {"verb": "export", "project": ")" +
                                      place + R"(/p", "output": ")" + place + R"(/o.glb"}])");
    put(base.path() / "recipe.json", R"({"format": "standpoint-dataset", "recipe_version": 1, "name": "set",
      "license": "CC0-1.0", "creator": "a class", "date": "2026-01-31", "splits": {"train": ["p"]},
      "classes": ["s3dis"],
      "environments": [{"id": "p", "project": "p", "stations": [{"strategy": "grid", "spacing_m": 2, "count": 2}]}],
      "instruments": [{"id": "focus", "instrument": "faro-focus-s350", "set": ["resolution=1/32", "quality=4x"]}]})");
    put(base.path() / "t.labels", "2\n2\n1\n");
    put(base.path() / "p.txt", "2\n1\n1\n");
    ASSERT_EQ(run({"materials", "p"}, base.path()), 0);
    ASSERT_EQ(run({"station", "p", "--add", "S1", "--at", "500001.5,5600001.5,1.5"}, base.path()), 0);
    if (writer().verb == std::string("register")) {
      std::string control;
      for (std::string at : {"500003.5,5600000.9,1.5", "500003.2,5600000.5,1.9", "500004.0,5600001.2,1.1"}) {
        const auto name = "T" + std::to_string(std::count(control.begin(), control.end(), '\n') + 1);
        ASSERT_EQ(run({"target", "p", "--add", name, "--at", at}, base.path()), 0);
        std::replace(at.begin(), at.end(), ',', ' ');
        control += name + " " + at + "\n";
      }
      put(base.path() / "control.txt", control);
    }
    ASSERT_EQ(run({"scan", "p", "--instrument", "leica-rtc360", "--set", "resolution=12mm", "field_of_view=target_area",
                   "horizontal_from=0", "horizontal_to=50", "vertical_from=-30", "vertical_to=30", "-o", "s.e57"},
                  base.path()),
              0);
    if (writer().verb == std::string("verify")) {
      ASSERT_EQ(run({"underlay", "p", "--add", "s.e57"}, base.path()), 0);
    }
    if (writer().verb == std::string("locate")) fs::rename(base.path() / "s.e57", base.path() / "moved.e57");
    if (std::set<std::string>{"assign", "collect", "scorm"}.contains(writer().verb)) setUpClass();
    if (!writer().makes_its_place)
      for (const auto& file : writer().files)
        if (file.rfind("p/", 0) != 0) put(base.path() / file, kOld);
  }

  // An exercise that takes a moment, a class of one, and its result.
  void setUpClass() {
    put(base.path() / "exercise.json", R"({"id": "C1", "title": {"en": "On"}, "goal": {"en": "Switch on."},
      "devices": ["generic"], "model": "house", "pass_mark": 1,
      "steps": [{"id": "on", "text": {"en": "Switch on."}, "done": "screen == home"}],
      "solution": [{"press": "power"}, {"wait": 20}]})");
    put(base.path() / "class.csv", "id\ns-001\n");
    put(base.path() / "actions.json", R"([{"press": "power"}, {"wait": 20}])");
    ASSERT_EQ(
        run({"assign", "exercise.json", "--class", "class.csv", "--key", "class.key", "--new-key", "-o", "given.json"},
            base.path()),
        0);
    ASSERT_EQ(run({"rehearse", "given.json", "--student", "s-001", "--actions", "actions.json", "-o", "results.d"},
                  base.path(), {"XDG_CONFIG_HOME=" + (base.path() / "config").string()}),
              0);
  }

  fs::path fresh() {
    const auto folder = runs.path() / "run";
    fs::remove_all(folder);
    fs::copy(base.path(), folder, fs::copy_options::recursive);
    return folder;
  }

  Words faultsAt(const fs::path& folder, const std::string& kind, long at) const {
    return {"LD_PRELOAD=" FAULTS, "FAULTS_UNDER=" + folder.string(), "FAULTS_KIND=" + kind,
            "FAULTS_AT=" + std::to_string(at), "FAULTS_REPORT=" + report().string()};
  }
  fs::path report() const { return runs.path() / "report"; }

  // Of the run without a fault: how many calls it makes, and what it leaves.
  void runWhole() {
    const auto folder = fresh();
    code = run(writer().words, folder, faultsAt(folder, "", 0));
    ASSERT_TRUE(code == 0 || code == 3) << code;
    std::ifstream lines(report());
    for (std::string word, rest; lines >> word >> rest;) {
      EXPECT_NE(word, "unsynced") << rest << " was renamed before it was on the disk";
      if (word == "calls") calls = std::stol(rest);
    }
    ASSERT_GT(calls, 0);
    for (const auto& file : writer().files) {
      after.push_back(textOf(folder / file));
      EXPECT_FALSE(after.back().empty()) << file;
    }
  }

  std::vector<long> places() const {
    std::set<long> all;
    if (std::getenv("STANDPOINT_EVERY_FAULT") != nullptr)
      for (long i = 1; i <= calls; ++i) all.insert(i);
    else
      for (long i = 0; i < kTried; ++i) all.insert(1 + i * (calls - 1) / (kTried - 1));
    return {all.begin(), all.end()};
  }

  void expectOldOrNew(const fs::path& folder, const std::string& where) const {
    for (std::size_t i = 0; i < writer().files.size(); ++i) {
      const auto& file = writer().files[i];
      const auto now = textOf(folder / file);
      EXPECT_TRUE(now == after[i] || now == textOf(base.path() / file)) << file << where;
    }
    if (writer().words[1] == "p") {
      EXPECT_EQ(run({"info", "p"}, folder), 0) << "the project does not open" << where;
    }
  }

  bool allAreOld(const fs::path& folder) const {
    return std::all_of(writer().files.begin(), writer().files.end(),
                       [&](const auto& file) { return textOf(folder / file) == textOf(base.path() / file); });
  }

  bool allAreNew(const fs::path& folder) const {
    for (std::size_t i = 0; i < after.size(); ++i)
      if (textOf(folder / writer().files[i]) != after[i]) return false;
    return true;
  }

  static std::size_t partsIn(const fs::path& folder) {
    std::size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) count += isPart(entry.path()) ? 1U : 0U;
    return count;
  }

  TemporaryFolder base, runs;
  long calls = 0;
  int code = 0;
  std::vector<std::string> after;
};

TEST_P(Faults, OnAFullDiskLeaveTheOldFileOrTheNewOneAndExitWithFour) {
  ASSERT_NO_FATAL_FAILURE(runWhole());
  for (const long at : places()) {
    const auto folder = fresh();
    const auto where = " with the disk full at call " + std::to_string(at) + " of " + std::to_string(calls);
    const int exited = run(writer().words, folder, faultsAt(folder, "full", at));
    EXPECT_TRUE(exited == 4 || exited == code) << exited << where;
    expectOldOrNew(folder, where);
    EXPECT_EQ(partsIn(folder), 0U) << where;
  }
}

TEST_P(Faults, OnAReadOnlyDiskLeaveTheOldFileAndExitWithFour) {
  const auto folder = fresh();
  EXPECT_EQ(run(writer().words, folder, faultsAt(folder, "readonly", 1)), 4);
  EXPECT_TRUE(allAreOld(folder));
  EXPECT_EQ(partsIn(folder), 0U);
}

TEST_P(Faults, KilledLeaveTheOldFileOrTheNewOneAndWorkAgain) {
  ASSERT_NO_FATAL_FAILURE(runWhole());
  for (const long at : places()) {
    const auto folder = fresh();
    const auto where = " killed at call " + std::to_string(at) + " of " + std::to_string(calls);
    EXPECT_EQ(run(writer().words, folder, faultsAt(folder, "kill", at)), -1) << where;
    expectOldOrNew(folder, where);
    if (allAreOld(folder)) {
      EXPECT_EQ(run(writer().words, folder), code) << where << ", again";
      EXPECT_EQ(partsIn(folder), 0U) << where << ", again";
    }
  }
}

class FaultsOfSets : public Faults {};

// Whatever was made before stays; only what is missing is made again.
TEST_P(FaultsOfSets, LeaveOneThatResumesToTheSameBytes) {
  ASSERT_NO_FATAL_FAILURE(runWhole());
  for (const char* kind : {"full", "kill"})
    for (const long at : places()) {
      const auto folder = fresh();
      const auto where = std::string(" ") + kind + " at call " + std::to_string(at) + " of " + std::to_string(calls);
      const int exited = run(writer().words, folder, faultsAt(folder, kind, at));
      EXPECT_TRUE(exited != 0 || allAreNew(folder)) << where;
      EXPECT_EQ(run(writer().words, folder), 0) << where << ", resumed";
      EXPECT_TRUE(allAreNew(folder)) << where << ", resumed";
      EXPECT_EQ(run({"dataset", "verify", "set"}, folder), 0) << where << ", resumed";
      EXPECT_FALSE(fs::exists(folder / "set/.work")) << where << ", resumed";
    }
}

std::string nameOf(const ::testing::TestParamInfo<Writer>& writer) {
  return writer.param.verb + std::string(writer.param.name);
}

std::vector<Writer> setWriters() {
  auto all = writers();
  std::erase_if(all, [](const Writer& w) { return w.verb != std::string("dataset") || w.name != std::string("run"); });
  return all;
}

INSTANTIATE_TEST_SUITE_P(OfSets, FaultsOfSets, ::testing::ValuesIn(setWriters()), nameOf);
INSTANTIATE_TEST_SUITE_P(OfEachWriter, Faults, ::testing::ValuesIn(writers()), nameOf);

TEST(FaultsOfEachWriter, WalkEveryVerbThatWrites) {
  std::set<std::string> walked = {"info", "compare", "plan", "coverage"};  // which write nothing
  for (const auto& writer : writers()) walked.insert(writer.verb);
  for (const auto& verb : allVerbs()) EXPECT_TRUE(walked.contains(verb.name)) << verb.name;
}

}  // namespace
}  // namespace standpoint
