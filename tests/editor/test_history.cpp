// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>
#include <regex>

#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "demo_verbs.h"
#include "emulated-ui/verbs/rehearse_verb.h"
#include "item_probe.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class HistoryPanel : public testing::Test {
 protected:
  void SetUp() override {
    editor.wanted_tab[2] = "history";
    ASSERT_TRUE(editor.session.start("demo", json::object()));
    gui.settle();
    for (const char* name : {"A", "B", "C"}) {
      ASSERT_TRUE(editor.session.start("target", {{"add", name}, {"at", {4, 2, 1.5}}}));
      gui.settle();
      ASSERT_TRUE(editor.session.errors().empty());
    }
    editor.wanted_tab[2] = "history";
    gui.frames(3);
  }
  std::size_t targets() const { return editor.session.document().job->targets.size(); }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor, {1280, 1000}};
};

TEST_F(HistoryPanel, GoesToTheStepThatIsClickedAndBack) {
  const auto all = targets();
  ASSERT_TRUE(gui.click("Added target A###step"));
  gui.frames(3);
  EXPECT_EQ(targets(), all - 2);
  EXPECT_EQ(editor.session.history().position(), 2U);
  ASSERT_TRUE(gui.click("Added target C  (undone)###step"));
  gui.frames(3);
  EXPECT_EQ(targets(), all);
  EXPECT_EQ(editor.session.history().position(), 4U);
  ASSERT_TRUE(gui.click("Added target C###step"));
  EXPECT_EQ(targets(), all) << "the current one leads nowhere";
}

TEST_F(HistoryPanel, GivesUndoneStepsUpWhenSomethingElseIsDone) {
  ASSERT_TRUE(gui.click("Added target A###step"));
  gui.frames(2);
  ASSERT_TRUE(editor.session.start("target", {{"add", "D"}, {"at", {4, 2, 1.5}}}));
  gui.settle();
  gui.frames(3);
  EXPECT_EQ(editor.session.history().size(), 4U);
  EXPECT_EQ(gui.find("Added target B  (undone)###step"), nullptr);
  EXPECT_NE(gui.find("Added target D###step"), nullptr);
}

TEST_F(HistoryPanel, RefusesWhileATaskHoldsTheDocument) {
  ASSERT_TRUE(editor.session.start("optimize", {{"max-deviation", 0.01}}));
  EXPECT_NE(editor.session.whyNotGoTo(1), "");
  editor.session.goTo(1);
  EXPECT_EQ(editor.session.history().position(), 4U);
  gui.settle();
}

// What each verb that changes the document may be asked for, in a project with two stations, a target and a scan.
std::map<std::string, std::vector<json>> samplesOfVerbs(const fs::path& folder) {
  const auto house = (samplesFolder() / "house.ifc").string();
  const auto scan = (folder / "internal" / "S1.e57").string();
  return {
      {"import", {{{"files", {house}}}, {{"files", {house}}, {"update", true}}}},
      {"add", {{{"files", {(samplesFolder() / "street.ifc").string()}}}}},
      {"optimize", {{{"max-deviation", 0.02}}, {{"budget", 4000}}}},
      {"treat", {{{"products", {"class:IfcFurniture*"}}, {"as", "excluded"}}}},
      {"collide", {json::object()}},
      {"materials",
       {json::object(),
        {{"assign", {"class:IfcWall*=brick_red_bare"}}},
        {{"assign", {"class:IfcDoor&name:*=stainless_brushed"}}},
        {{"assign", {"class:IfcWall@0,0,1=brick_red_bare"}}}}},
      {"verify", {{{"underlay", "S1"}}}},
      {"georeference", {{{"crs", "EPSG:25832"}, {"origin", {500000, 5600000, 100}}}}},
      {"station",
       {{{"add", "S3"}, {"on", {4.3, 1.6, 0}}},
        {{"move", "S1"}, {"on", {4.5, 1.6, 0}}},
        {{"rename", "S1"}, {"name", "S9"}},
        {{"remove", "S1"}}}},
      {"target",
       {{{"add", "T2"}, {"at", {4, 2, 1.5}}},
        {{"move", "T1"}, {"at", {4, 2, 1.6}}},
        {{"rename", "T1"}, {"name", "T9"}},
        {{"remove", "T1"}}}},
      {"underlay", {{{"add", scan}}, {{"hide", "S1"}}, {{"remove", "S1"}}}},
      {"locate", {{{"file", "S1.e57"}, {"to", (folder / "internal" / "moved.e57").string()}}}},
      {"plan", {json::object()}},
      {"bookmark", {{{"add", "Stair"}}, {{"rename", "Door"}, {"name", "Entrance"}}, {{"remove", "Door"}}}},
      {"measure",
       {{{"add", "M2"}, {"kind", "height"}, {"points", {"1,1,0", "1,1,2.5"}}},
        {{"rename", "M1"}, {"name", "Width"}},
        {{"remove", "M1"}}}},
      {"scan", {{{"instrument", "faro-focus-s350"}, {"set", {"resolution=1/32", "quality=4x"}}, {"output", scan}}}},
      {"trajectory",
       {{{"add", "Walk 2"}, {"through", {"4.3,1.6,0", "4.3,2.4,0"}}},
        {{"change", "Walk 1"}, {"carrier", "backpack"}},
        {{"rename", "Walk 1"}, {"name", "Ground floor"}},
        {{"remove", "Walk 1"}}}},
      {"mover", {{{"add", "Bea"}, {"through", {"4.3,1.6,0", "4.3,2.4,0"}}}, {{"remove", "Ada"}}}},
      {"register", {}},  // its line names only how many stations; a run needs overlapping scans
  };
}

// Nobody who looks at the list of steps knows where the program keeps its files, nor how its selectors are written.
std::string whatIsNotPlain(const std::string& line, const fs::path& folder) {
  if (line.empty()) return "empty";
  if (std::isupper(static_cast<unsigned char>(line.front())) == 0) return "no capital at its beginning";
  if (line.find(folder.string()) != std::string::npos || line.find("internal") != std::string::npos) return "a path";
  static const std::regex kInternal(R"(/[a-z]+/|\.glb|\.json|[a-z]+:[A-Z*]|&|@-?[0-9]|--[a-z]|[0-9a-f]{12}|_[a-z])");
  std::smatch found;
  return std::regex_search(line, found, kInternal) ? "'" + found.str() + "'" : "";
}

TEST(UndoNames, OfEveryVerbAreInPlainWords) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "internal");
  const auto samples = samplesOfVerbs(folder.path());
  Document house = *[] {
    auto imported = standpoint::run("import", {}, {{"files", {(samplesFolder() / "house.ifc").string()}}});
    EXPECT_TRUE(imported) << describe(imported.error());
    return imported ? std::optional(imported->document) : std::nullopt;
  }();
  const std::vector<std::pair<const char*, json>> setup = {
      {"station", {{"add", "S1"}, {"on", {4.3, 1.6, 0}}}},
      {"station", {{"add", "S2"}, {"on", {3.8, 2.5, 2.8}}}},
      {"target", {{"add", "T1"}, {"at", {4, 2, 1.5}}}},
      {"materials", json::object()},
      {"bookmark", {{"add", "Door"}}},
      {"measure", {{"add", "M1"}, {"kind", "distance"}, {"points", {"1,1,0", "2,1,0"}}}},
      {"trajectory", {{"add", "Walk 1"}, {"through", {"4.3,1.6,0", "4.5,2.2,0"}}}},
      {"mover", {{"add", "Ada"}, {"through", {"4.3,1.6,0", "4.5,2.2,0"}}}},
      {"scan",
       {{"instrument", "faro-focus-s350"},
        {"stations", "S1"},
        {"set", {"resolution=1/32", "quality=4x"}},
        {"output", (folder.path() / "internal" / "S1.e57").string()}}},
      {"underlay", {{"add", (folder.path() / "internal" / "S1.e57").string()}}}};
  for (const auto& [verb, options] : setup) {
    const auto done = standpoint::run(verb, house, options);
    ASSERT_TRUE(done) << verb << ": " << describe(done.error());
    house = done->document;
  }
  fs::copy_file(folder.path() / "internal" / "S1.e57", folder.path() / "internal" / "moved.e57");
  for (const auto& verb : allVerbs()) {
    if (verb.scope != VerbScope::creates && verb.scope != VerbScope::changes) continue;
    const auto asked = samples.find(verb.name);
    ASSERT_NE(asked, samples.end()) << verb.name << " is new: say here what it may be asked for";
    for (const auto& options : asked->second) {
      SCOPED_TRACE(std::string(verb.name) + " " + options.dump());
      Progress progress;
      const auto done = runVerb(verb, house, options, progress);
      if (!done) {
        ADD_FAILURE() << describe(done.error());
        continue;
      }
      if (done->document == house) continue;  // nothing to undo
      EXPECT_EQ(whatIsNotPlain(done->description, folder.path()), "") << done->description;
    }
  }
}

TEST(UndoNames, AreChecked) {
  EXPECT_EQ(whatIsNotPlain("Moved station S2 by 0.35 m", "/tmp/x"), "");
  EXPECT_EQ(whatIsNotPlain("Assigned glass to class IfcDoor, name *", "/tmp/x"), "");
  for (const char* line : {"", "moved it", "Opened /home/me/house", "Assigned glass to class:IfcDoor",
                           "Wrote geometry/light-0123456789abcdef.glb", "Assigned brick to #12@0,0,1"})
    EXPECT_NE(whatIsNotPlain(line, "/tmp/x"), "") << line;
}

}  // namespace
}  // namespace standpoint
