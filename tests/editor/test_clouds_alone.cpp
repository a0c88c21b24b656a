// SPDX-License-Identifier: GPL-3.0-or-later
// Point clouds that are opened without a model, and files of a project that are no longer where it has them.
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "demo_verbs.h"
#include "editor/shell/actions.h"
#include "editor/shell/dialogs.h"
#include "editor/shell/import_preview.h"
#include "item_probe.h"
#include "pointclouds/formats.h"
#include "project/model/import_verb.h"
#include "project/storage/project_files.h"
#include "project/survey/locate_verb.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

// A wall of 4 x 3 m that faces the X axis, in a far zone.
const Eigen::Vector3d kFar(500000, 5600002, 101);

fs::path wallCloudFile(const fs::path& file, const Eigen::Vector3d& at = kFar) {
  std::ofstream out(file);
  out.precision(17);
  for (int i = 0; i <= 40; ++i)
    for (int k = 0; k <= 30; ++k)
      out << at.x() << ' ' << at.y() + 0.1 * i << ' ' << at.z() + 0.1 * k << ' ' << i << '\n';
  return file;
}

class CloudAlone : public ::testing::Test {
 protected:
  void open(const std::vector<fs::path>& files) {
    openFiles(editor, files);
    gui.frames(2);
    gui.settle();
    gui.settle();
  }
  std::string why(const char* action) const { return whyNot(*findAction(action), editor); }
  ImVec2 screenOf(const Eigen::Vector3d& point) const {
    const auto pixel = project(editor.view.camera, point, editor.view.size);
    const auto* window = ImGui::FindWindowByName("###viewport");
    return {window->Pos.x + static_cast<float>(pixel->x()), window->Pos.y + static_cast<float>(pixel->y())};
  }
  TemporaryFolder folder;
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(CloudAlone, IsOpenedLikeAModelAndShownAtOnce) {
  const auto file = wallCloudFile(folder.path() / "wall.xyz");
  open({file});
  ASSERT_TRUE(editor.session.errors().empty()) << describe(editor.session.errors().front().error);
  EXPECT_FALSE(editor.session.document().hasModel());
  EXPECT_EQ(editor.workspace, Workspace::inspect);
  ASSERT_TRUE(editor.cloud());
  EXPECT_EQ(editor.cloud()->file, file);
  EXPECT_EQ(editor.cloud()->points.size(), 41U * 31U);
  EXPECT_TRUE(editor.underlays.reading().empty()) << "it is not read twice";
  const auto seen = editor.visibleBounds();
  ASSERT_FALSE(seen.empty());
  EXPECT_LT((seen.min + editor.shift_m() - kFar).norm(), 1e-6);
  const auto pixel = project(editor.view.camera, (seen.min + seen.max) / 2, editor.view.size);
  ASSERT_TRUE(pixel) << "the camera looks at it";
  EXPECT_NEAR(pixel->x(), editor.view.size.x() / 2, 5);
}

TEST_F(CloudAlone, IsMeasuredInItsOwnCoordinatesAndTheStatusBarNamesIt) {
  open({wallCloudFile(folder.path() / "wall.xyz")});
  ASSERT_EQ(why("measure"), "");
  ASSERT_TRUE(invoke(editor, "measure"));
  look(editor.view.camera, StandardView::right);
  editor.frameSelection();
  const Eigen::Vector3d first = kFar + Eigen::Vector3d(0, 0.5, 0.5), second = kFar + Eigen::Vector3d(0, 3.5, 0.5);
  for (const auto& place : {first, second}) {
    gui.moveTo(screenOf(place - editor.shift_m()));
    gui.frames(2);
    if (place == first) {
      EXPECT_THAT(gui.texts(), testing::Contains(HasSubstr("Point of wall   500000.000  5600002.500  101.500 m")));
    }
    gui.press();
    gui.settle();
  }
  const auto& kept = editor.session.document().measurements;
  ASSERT_TRUE(kept);
  EXPECT_NEAR(figuresOf(kept->front())[0].value, 3, 1e-3);
}

TEST_F(CloudAlone, IsColouredCutAndPickedWhileWhatNeedsAModelSaysSo) {
  open({wallCloudFile(folder.path() / "wall.xyz")});
  for (const char* action :
       {"points-by-height", "section-z", "clip-box", "pick-wall", "add-bookmark", "save-as", "picture"})
    EXPECT_EQ(why(action), "") << action;
  for (const char* action : {"add-station", "add-target", "walk", "export", "scan", "points-by-deviation"})
    EXPECT_THAT(why(action), HasSubstr("point clouds only")) << action;
  ASSERT_TRUE(invoke(editor, "points-by-height"));
  gui.frames(3);
  gui.settle();
  EXPECT_EQ(editor.view.points_by, ColourBy::height);
  for (const auto workspace : {Workspace::environment, Workspace::optimise, Workspace::materials,
                               Workspace::georeference, Workspace::survey, Workspace::inspect}) {
    editor.workspace = workspace;
    gui.frames(3);
  }
  EXPECT_TRUE(editor.session.errors().empty());
}

TEST_F(CloudAlone, IsSavedOpenedAgainAndGetsAModel) {
  open({wallCloudFile(folder.path() / "wall.xyz")});
  ASSERT_TRUE(editor.session.save(folder.path() / "p"));
  gui.settle();
  editor.session.clear();
  gui.frames(2);
  EXPECT_FALSE(editor.cloud());
  ASSERT_TRUE(editor.session.open(folder.path() / "p"));
  gui.settle();
  gui.settle();
  ASSERT_TRUE(editor.cloud());
  const auto model = folder.path() / "m.obj";
  std::ofstream(model) << "v 500000 5600002 101\nv 500001 5600002 101\nv 500000 5600003 101\nf 1 2 3\n";
  ASSERT_TRUE(editor.session.start("add", {{"files", {model.string()}}, {"up", "z"}}));
  gui.settle();
  EXPECT_TRUE(editor.session.document().hasModel());
  EXPECT_EQ(why("export"), "");
}

TEST_F(CloudAlone, IsExportedAsE57FromTheMenuAndTheFormOfTheModelsExport) {
  EXPECT_THAT(why("export-points"), HasSubstr("add a point cloud"));
  const auto cloud = wallCloudFile(folder.path() / "wall.xyz");
  editor.settings.last_folder = folder.path().string();
  open({cloud});
  ASSERT_TRUE(gui.click("File"));
  gui.frames(2);
  ASSERT_TRUE(gui.click("###export-points"));
  gui.frames(3);
  const auto& form = editor.dialogs.verb.form;
  EXPECT_EQ(form.options()["in"], cloud.string());
  EXPECT_EQ(form.problem(), "") << "one press of Export is enough";
  EXPECT_EQ(gui.find("dataset"), nullptr);
  ASSERT_NE(gui.find("###export-model"), nullptr);
  EXPECT_TRUE(gui.find("###export-model")->disabled) << "there is no model";
  const std::filesystem::path out = form.options()["out"];
  EXPECT_EQ(out.extension(), ".e57");
  ASSERT_TRUE(gui.click("###run"));
  gui.settle();
  ASSERT_TRUE(std::filesystem::exists(out));
  Progress progress;
  EXPECT_EQ(measureCloud(out, progress)->points, measureCloud(cloud, progress)->points);
}

TEST_F(CloudAlone, OfSeveralAreShownTogether) {
  open({wallCloudFile(folder.path() / "a.xyz"),
        wallCloudFile(folder.path() / "b.xyz", kFar + Eigen::Vector3d(5, 0, 0))});
  EXPECT_EQ(editor.session.document().underlays.size(), 2U);
  EXPECT_FALSE(editor.cloud());
  editor.underlays.wait(editor.session.document());
  EXPECT_EQ(editor.viewState().underlays.size(), 2U);
}

TEST_F(CloudAlone, ThatCannotBeReadIsAnErrorAndNoProject) {
  std::ofstream(folder.path() / "noise.e57") << "no E57 at all";
  open({folder.path() / "noise.e57"});
  ASSERT_EQ(editor.session.errors().size(), 1U);
  EXPECT_THAT(editor.session.errors().front().error.source, HasSubstr("noise.e57"));
  EXPECT_FALSE(editor.session.document().imported);
}

TEST_F(CloudAlone, ThatIsGoneIsLocatedFromTheErrorBesideIt) {
  const auto file = wallCloudFile(folder.path() / "wall.xyz");
  open({file});
  ASSERT_TRUE(editor.session.save(folder.path() / "p"));
  gui.settle();
  fs::rename(file, folder.path() / "moved.xyz");
  ASSERT_TRUE(editor.session.open(folder.path() / "p"));
  gui.settle();
  gui.settle();
  ASSERT_FALSE(editor.session.errors().empty());
  gui.frames(3);
  ASSERT_TRUE(gui.click("###locate-missing"));
  gui.frames(2);
  ASSERT_TRUE(editor.dialogs.file.open);
  const auto chosen = editor.dialogs.file.done;
  editor.dialogs.file.open = false;
  chosen(folder.path() / "moved.xyz");
  gui.settle();
  gui.settle();
  EXPECT_TRUE(editor.session.errors().empty());
  EXPECT_EQ(editor.session.document().underlays.front()->file, (folder.path() / "moved.xyz").string());
  editor.session.undo();
  EXPECT_EQ(editor.session.document().underlays.front()->file, file.string());
}

TEST_F(CloudAlone, ThatIsGoneOffersLocateInPanelsAndOverTheView) {
  const auto file = wallCloudFile(folder.path() / "wall.xyz");
  open({file});
  EXPECT_EQ(gui.find("###locate"), nullptr);
  fs::rename(file, folder.path() / "moved.xyz");
  std::this_thread::sleep_for(std::chrono::milliseconds(2100));  // between two looks for what is shown
  editor.wanted_tab[0] = "points";
  gui.frames(4);
  EXPECT_NE(gui.find("###locate"), nullptr);
  EXPECT_NE(gui.find("###locate-cloud"), nullptr);
  LocateOptions options{.file = file};
  options.to = folder.path() / "moved.xyz";
  ASSERT_TRUE(editor.session.start(options));
  gui.settle();
  gui.settle();
  ASSERT_TRUE(editor.cloud());
  EXPECT_EQ(editor.cloud()->file, folder.path() / "moved.xyz") << "what is shown follows";
}

TEST_F(CloudAlone, APartOfAProjectThatIsMissingIsPutBack) {
  ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
  gui.settle();
  ASSERT_TRUE(editor.session.save(folder.path() / "p"));
  gui.settle();
  fs::path part;
  for (const auto& entry : fs::directory_iterator(folder.path() / "p" / "geometry"))
    if (entry.path().filename().string().starts_with("imported-")) part = entry.path();
  fs::rename(part, folder.path() / "found.glb");
  editor.session.clear();
  ASSERT_TRUE(editor.session.open(folder.path() / "p"));
  gui.settle();
  ASSERT_EQ(editor.session.errors().size(), 1U);
  EXPECT_EQ(projectMissing(editor.session.errors().front().error.source), folder.path() / "p");
  EXPECT_FALSE(restorePart(part, wallCloudFile(folder.path() / "wall.xyz"))) << "another file";
  EXPECT_FALSE(fs::exists(part));
  gui.frames(3);
  ASSERT_TRUE(gui.click("###locate-missing"));
  gui.frames(2);
  const auto chosen = editor.dialogs.file.done;
  ASSERT_TRUE(chosen);
  editor.dialogs.file.open = false;
  chosen(folder.path() / "found.glb");
  gui.settle();
  EXPECT_TRUE(editor.session.errors().empty());
  EXPECT_TRUE(editor.session.document().hasModel());
}

TEST_F(CloudAlone, ErrorsThatWaitAreAllShownAndClosedTogether) {
  editor.session.errors().push_back({"Open a", {ErrorKind::unusable, "the first is broken", "a.e57"}});
  editor.session.errors().push_back({"Open b", {ErrorKind::unusable, "the second is broken", "b.e57"}});
  gui.frames(3);
  EXPECT_THAT(gui.texts(), IsSupersetOf({"The first is broken", "The second is broken"}));
  ASSERT_TRUE(gui.click("Copy text"));
  EXPECT_THAT(std::string(ImGui::GetClipboardText()), testing::AllOf(HasSubstr("a.e57"), HasSubstr("b.e57")));
  ASSERT_TRUE(gui.click("###close"));
  gui.frames(2);
  EXPECT_TRUE(editor.session.errors().empty());
}

}  // namespace
}  // namespace standpoint
