// SPDX-License-Identifier: GPL-3.0-or-later
#include <atomic>
#include <chrono>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/shell/import_preview.h"
#include "item_probe.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

using nlohmann::json;

std::atomic<int> imports_run{0};
std::atomic<bool> import_may_end{true};

// An importer that reads nothing: the demo house, larger by what the unit says. It notices a cancel.
Result<Outcome> importDemo(const Document&, const json& options, Progress& progress) {
  ++imports_run;
  progress.stage("Reading " + options.at("files").at(0).get<std::string>());
  while (!import_may_end.load()) {
    if (auto going = progress.check(); !going) return failure(going.error());
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  if (options.at("files").at(0) == "broken.ifc")
    return failure(ErrorKind::unusable, "is not a building", "broken.ifc line 3");
  if (options.value("crs", "") == "EPSG:none") return failure(ErrorKind::usage, "no such system");
  Outcome outcome;
  outcome.document = demoHouse();
  if (options.value("unit", "") == "mm") {
    auto scaled = std::make_shared<Environment>(*outcome.document.imported);
    for (auto& i : scaled->instances) i.world_from_mesh = Eigen::Scaling(1000.0) * i.world_from_mesh;
    outcome.document.imported = scaled;
  }
  outcome.report.lose("#7", "a railing");
  outcome.report.warn("line 9", "no unit");
  outcome.report.note("", "read");
  outcome.description = "Imported the demo";
  return outcome;
}

std::vector<Verb> verbsWithDemoImport() {
  auto table = verbsWithDemo();
  for (auto& verb : table)
    if (std::string_view(verb.name) == "import") verb.run = importDemo;
  return table;
}

class Preview : public ::testing::Test {
 protected:
  void SetUp() override {
    imports_run = 0;
    import_may_end = true;
  }
  void TearDown() override { import_may_end = true; }
  void open(const char* file = "house.ifc") {
    openFiles(editor, {file});
    editor.preview.wait();
    gui.frames(2);
  }
  Editor editor{verbsWithDemoImport(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(Preview, IsReadOnceAndThatResultBecomesTheDocument) {
  open();
  ASSERT_EQ(editor.preview.stage(), ImportPreview::Stage::ready);
  EXPECT_EQ(editor.session.document().imported, nullptr) << "nothing is taken in before it is accepted";
  const auto candidate = editor.preview.outcome()->document.imported;
  EXPECT_EQ(editor.viewState().environment, candidate) << "the viewport shows the candidate";
  acceptPreview(editor);
  gui.frames(2);
  EXPECT_EQ(editor.session.document().imported, candidate);
  EXPECT_EQ(imports_run.load(), 1);
  EXPECT_FALSE(editor.preview.isOpen());
  EXPECT_EQ(editor.viewState().environment, candidate);
  int losses = 0;
  for (const auto& entry : editor.session.log()) losses += entry.level == LogLevel::loss;
  EXPECT_EQ(losses, 1) << "its issues are in the log";
}

TEST_F(Preview, CountsProductsPerClassAndIssuesPerSeverity) {
  open();
  const auto& facts = editor.preview.facts();
  const auto house = demoHouse();
  std::size_t products = 0;
  std::uint64_t triangles = 0;
  for (const auto& row : facts.classes) products += row.products, triangles += row.triangles;
  EXPECT_EQ(products, house.imported->products.size());
  EXPECT_EQ(triangles, triangleCount(*house.imported));
  EXPECT_EQ(facts.triangles, sceneTriangleCount(*house.imported)) << "as they are counted once it is taken in";
  EXPECT_EQ(facts.triangles + facts.triangles_of_spaces, triangles);
  EXPECT_EQ(facts.losses, 1u);
  EXPECT_EQ(facts.warnings, 1u);
  EXPECT_EQ(facts.notes, 1u);
  const Bounds b = bounds(*house.imported);
  EXPECT_LT((facts.size_m - (b.max - b.min)).norm(), 1e-9);
}

TEST_F(Preview, ShowsWhatAnotherUnitDoesToTheSize) {
  open();
  const Eigen::Vector3d first = editor.preview.facts().size_m;
  editor.preview.overrides.unit = "mm";
  editor.preview.readAgain();
  editor.preview.wait();
  EXPECT_LT((editor.preview.facts().size_m - 1000 * first).norm(), 1e-6);
  ASSERT_TRUE(editor.preview.firstSize_m().has_value());
  EXPECT_EQ(*editor.preview.firstSize_m(), first);
  EXPECT_NE(editor.preview.facts().doubt, "") << "a house some kilometres high is doubted aloud";
  editor.preview.overrides.unit.clear();
  editor.preview.readAgain();
  editor.preview.wait();
  EXPECT_FALSE(editor.preview.firstSize_m().has_value());
  EXPECT_EQ(editor.preview.facts().doubt, "");
}

TEST_F(Preview, OffersTheTypesOfAnIfcFileAndPassesThemOn) {
  open();
  gui.frames(1);
  EXPECT_EQ(gui.find("###preview-types") != nullptr, editor.preview.hasIfc());
  EXPECT_FALSE(importOptions({"a.ifc"}, {}).contains("types"));
  EXPECT_EQ(importOptions({"a.ifc"}, {.types = true})["types"], true);
}

TEST_F(Preview, KeepsWhatWasReadWhenAnotherChoiceCannotBe) {
  open();
  const auto candidate = editor.preview.outcome()->document.imported;
  editor.preview.overrides.crs = "EPSG:none";
  editor.preview.readAgain();
  editor.preview.wait();
  gui.frames(1);
  EXPECT_EQ(editor.preview.stage(), ImportPreview::Stage::ready);
  EXPECT_EQ(editor.preview.outcome()->document.imported, candidate);
  EXPECT_EQ(editor.preview.error().message, "no such system");
  EXPECT_EQ(editor.preview.overrides.crs, "");
}

TEST_F(Preview, GivenUpLeavesTheDocumentAndTheCameraAsTheyWere) {
  ASSERT_TRUE(editor.session.start("demo", json::object()));
  editor.session.wait();
  gui.settle();
  const auto before = editor.session.document();
  const auto camera = editor.view.camera;
  open();
  EXPECT_NE(editor.viewState().environment, before.environment());
  gui.key(256);  // Esc
  gui.frames(2);
  EXPECT_FALSE(editor.preview.isOpen());
  EXPECT_TRUE(editor.session.document() == before);
  EXPECT_TRUE(editor.view.camera == camera);
}

TEST_F(Preview, CancelsWithoutWaitingForTheImporter) {
  import_may_end = false;
  openFiles(editor, {"house.ifc"});
  EXPECT_TRUE(editor.preview.reading());
  closePreview(editor);
  EXPECT_FALSE(editor.preview.isOpen());
  gui.frames(3);
  EXPECT_EQ(editor.session.document().imported, nullptr);
}

TEST_F(Preview, OfWhatCannotBeReadSaysWhyAndCannotBeAccepted) {
  open("broken.ifc");
  EXPECT_EQ(editor.preview.stage(), ImportPreview::Stage::failed);
  EXPECT_EQ(editor.preview.error().source, "broken.ifc line 3");
  acceptPreview(editor);
  EXPECT_TRUE(editor.preview.isOpen());
  EXPECT_EQ(editor.session.document().imported, nullptr);
}

TEST_F(Preview, IsAcceptedByEnter) {
  open();
  gui.key(257);
  gui.frames(2);
  EXPECT_NE(editor.session.document().imported, nullptr);
}

TEST_F(Preview, CanBeAddedToWhatIsOpen) {
  ASSERT_TRUE(editor.session.start("demo", json::object()));
  editor.session.wait();
  gui.settle();
  const auto before = editor.session.document();
  open();
  addPreview(editor);
  editor.session.wait();
  gui.frames(2);
  const auto& after = editor.session.document();
  EXPECT_EQ(after.imported->products.size(), 2 * before.imported->products.size());
  EXPECT_EQ(after.job, before.job) << "stations stay";
  EXPECT_EQ(validate(*after.imported), "");
  EXPECT_EQ(imports_run.load(), 1);
  editor.session.undo();
  EXPECT_TRUE(editor.session.document() == before);
}

TEST_F(Preview, OfADroppedCloudWaitsForAModelAndThenLiesUnderIt) {
  const TemporaryFolder folder;
  const auto file = folder.write("points.xyz", "0 0 0 1\n1 2 3 5\n");
  openFiles(editor, {file, "house.ifc"});
  editor.preview.wait();
  acceptPreview(editor);
  for (int i = 0; i < 3; ++i) gui.frames(1), editor.session.wait();
  ASSERT_EQ(editor.session.document().underlays.size(), 1u);
  editor.underlays.wait(editor.session.document());
  const auto state = editor.viewState();
  ASSERT_EQ(state.underlays.size(), 1u);
  // What stands in the sample, led through the matrix, is where the file has it, less the shift.
  const auto& [cloud, matrix] = state.underlays[0];
  ASSERT_EQ(cloud->colours.size(), 2u);
  const auto& place = cloud->points[1].position_m;
  const Eigen::Vector4d last(place[0], place[1], place[2], 1);
  const Eigen::Vector3d there = (matrix * last).head<3>() + editor.shift_m();
  EXPECT_LT((there - Eigen::Vector3d(1, 2, 3)).norm(), 1e-4);
  EXPECT_GT(cloud->colours[1][0], cloud->colours[0][0]) << "the brighter point is brighter";
}

TEST_F(Preview, IsNoneOfACloudWithoutAModelWhichIsOpenedAlone) {
  const TemporaryFolder folder;
  const auto file = folder.write("points.xyz", "0 0 0\n");
  openFiles(editor, {file});
  gui.frames(1);
  EXPECT_FALSE(editor.preview.isOpen());
  gui.settle();
  EXPECT_TRUE(editor.session.errors().empty());
  EXPECT_EQ(imports_run, 1) << "it is imported at once, with nothing to accept";
}

}  // namespace
}  // namespace standpoint
