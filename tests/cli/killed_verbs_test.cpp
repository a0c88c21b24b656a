// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <functional>
#include <map>

#include <gtest/gtest.h>

#include "project/storage/project_files.h"
#include "tests/project/killed_process.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

const fs::path kProgram = fs::path(BINARY_DIR) / "bin" / "standpoint";

// A model file, a cloud and a project with a station, a target, a scan's record and an underlay. PROJECT and FOLDER are
// filled in.
class Workshop {
 public:
  Workshop() {
    Progress progress;
    auto d = twoStoreyDocument();
    for (const auto& [verb, options] : std::vector<std::pair<const char*, nlohmann::json>>{
             {"station", {{"add", "S1"}, {"on", {500002, 5600002}}}},
             {"station", {{"add", "S2"}, {"on", {500004.5, 5600001}}}},
             {"materials", nlohmann::json::object()},
             {"target", {{"add", "T1"}, {"at", {500001, 5600001, 1.5}}}},
             {"export", {{"output", (folder() / "other.obj").string()}}},
             {"scan",
              {{"instrument", "faro-focus-s350"},
               {"set", {"resolution=1/32", "quality=4x"}},
               {"output", (folder() / "cloud.e57").string()}}},
             {"underlay", {{"add", (folder() / "cloud.e57").string()}}}}) {
      auto done = run(verb, d, options);
      if (!done) throw std::runtime_error(std::string(verb) + ": " + describe(done.error()));
      d = done->document;
    }
    fs::copy_file(folder() / "cloud.e57", folder() / "copy.e57");
    if (!saveProject(d, original(), progress)) throw std::runtime_error("cannot save");
  }
  const fs::path& folder() const { return folder_.path(); }
  fs::path original() const { return folder() / "original"; }
  fs::path project() const { return folder() / "project"; }
  void renew() const {
    fs::remove_all(project());
    fs::copy(original(), project(), fs::copy_options::recursive);
  }
  Words filled(Words words) const {
    for (auto& word : words)
      for (const auto& [name, value] : {std::pair<std::string, fs::path>{"PROJECT", project()}, {"FOLDER", folder()}})
        if (const auto at = word.find(name); at != std::string::npos) word.replace(at, name.size(), value.string());
    words.insert(words.begin(), kProgram.string());
    return words;
  }

 private:
  TemporaryFolder folder_;
};

// How each verb that writes a project is started; a new verb fails the test until it has its line.
const std::map<std::string, Words>& writingVerbs() {
  static const std::map<std::string, Words> verbs = {
      {"import", {"import", "FOLDER/other.obj", "-o", "PROJECT", "--replace"}},
      {"add", {"add", "PROJECT", "FOLDER/other.obj"}},
      {"optimize", {"optimize", "PROJECT"}},
      {"treat", {"treat", "PROJECT", "name:table", "--as", "excluded"}},
      {"collide", {"collide", "PROJECT"}},
      {"materials", {"materials", "PROJECT", "--assign", "class:IfcWall=brick_red_bare"}},
      {"georeference", {"georeference", "PROJECT", "--crs", "EPSG:25832"}},
      {"station", {"station", "PROJECT", "--add", "S3", "--on", "500002,5600002,3"}},
      {"target", {"target", "PROJECT", "--add", "T2", "--at", "500002,5600001,1.5"}},
      {"bookmark", {"bookmark", "PROJECT", "--add", "view"}},
      {"measure",
       {"measure", "PROJECT", "--add", "M1", "--kind", "distance", "--points", "500001,5600001,0", "500002,5600001,0"}},
      {"underlay", {"underlay", "PROJECT", "--remove", "cloud"}},
      {"locate", {"locate", "PROJECT", "--file", "cloud.e57", "--to", "FOLDER/copy.e57"}},
      {"verify", {"verify", "PROJECT"}},
      {"scan",
       {"scan", "PROJECT", "--instrument", "faro-focus-s350", "--set", "resolution=1/32", "quality=4x", "-o",
        "FOLDER/new.e57"}},
      {"trajectory", {"trajectory", "PROJECT", "--add", "W", "--through", "500001,5600001", "500002,5600001"}},
      {"mover", {"mover", "PROJECT", "--add", "M", "--through", "500001,5600001", "500002,5600001"}},
      {"register", {"register", "PROJECT", "FOLDER/cloud.e57", "--cloud"}}};
  return verbs;
}

constexpr std::chrono::milliseconds kWriting{20};  // that a verb takes to write, or more

struct Tally {
  unsigned killed = 0, old_state = 0, new_state = 0;
  std::string wrong;
};

Tally killAtRandom(const Workshop& shop, const Words& words, std::mt19937& random) {
  Tally tally;
  const auto text = [&] { return projectText(shop.project()).value_or(""); };
  shop.renew();
  const auto before = text();
  const auto start = std::chrono::steady_clock::now();
  if (const int code = Process(shop.filled(words)).wait(); code != 0 && code != 3)
    return {0, 0, 0, "exit code " + std::to_string(code)};
  const auto whole = std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - start);
  const auto after = text();
  if (before == after) return {0, 0, 0, "it changes nothing"};
  for (unsigned tries = 0; tally.killed < kills() && tries < 10 * kills(); ++tries) {
    shop.renew();
    // Every second one while it writes, which is the least of its time.
    const auto touched = fs::last_write_time(shop.project() / "geometry");
    const auto writes = [&] { return fs::last_write_time(shop.project() / "geometry") != touched; };
    Process process(shop.filled(words));
    if (!(tries % 2 == 0 ? process.killAfter(randomTime(random, whole))
                         : process.killAfter(writes, randomTime(random, kWriting))))
      continue;
    ++tally.killed;
    const auto now = text();
    (now == before ? tally.old_state : tally.new_state) += 1;
    Progress progress;
    const auto loaded = loadProject(shop.project(), progress);
    const auto nth = "kill " + std::to_string(tally.killed) + ": ";
    if (!loaded) return {tally.killed, 0, 0, nth + describe(loaded.error())};
    if (now != before && now != after) return {tally.killed, 0, 0, nth + "neither the old project nor the new one"};
  }
  if (Process(shop.filled(words)).wait() < 0 || text().empty()) tally.wrong = "cannot go on after the last kill";
  return tally;
}

TEST(KilledVerbs, AreAllThatWriteAProject) {
  for (const auto& verb : verbs())
    EXPECT_EQ(writingVerbs().contains(verb.name), verb.scope == VerbScope::creates || verb.scope == VerbScope::changes)
        << verb.name;
}

class KilledVerb : public ::testing::TestWithParam<std::string> {};

TEST_P(KilledVerb, LeavesTheProjectAsItWasOrAsItWillBe) {
  static const Workshop shop;
  std::mt19937 random(killSeed());
  const auto tally = killAtRandom(shop, writingVerbs().at(GetParam()), random);
  EXPECT_EQ(tally.wrong, "") << "seed " << killSeed();
  std::printf("%-13s %u kills, seed %u: %u times as it was, %u times as it will be\n", GetParam().c_str(), tally.killed,
              killSeed(), tally.old_state, tally.new_state);
}

INSTANTIATE_TEST_SUITE_P(Each, KilledVerb, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const auto& [name, words] : writingVerbs()) names.push_back(name);
                           return names;
                         }()),
                         [](const auto& one) { return one.param; });

}  // namespace
}  // namespace standpoint
