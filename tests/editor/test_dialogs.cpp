// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/desktop/user_folders.h"
#include "editor/shell/actions.h"
#include "editor/shell/dialogs.h"
#include "editor/widgets/keyboard.h"
#include "editor/widgets/widgets.h"
#include "editor/words/words.h"
#include "item_probe.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

class Dialogs : public ::testing::Test {
 protected:
  void open() {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    editor.session.wait();
  }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(Dialogs, FindsAnActionInThePaletteByWords) {
  open();
  gui.key('P', true);
  gui.frames(2);
  EXPECT_TRUE(editor.dialogs.palette.open);
  gui.type("view top");
  gui.key(kKeyEnter);
  EXPECT_FALSE(editor.dialogs.palette.open);
  EXPECT_TRUE(editor.view.camera.forward().isApprox(-Eigen::Vector3d::UnitZ(), 1e-9));
}

TEST_F(Dialogs, TakesMoreWordsInThePaletteAfterEnterOnNothing) {
  open();
  gui.key('P', true);
  gui.frames(2);
  gui.type("view topp");
  gui.key(kKeyEnter);
  gui.frames(3);
  ASSERT_TRUE(editor.dialogs.palette.open) << "nothing matches";
  gui.key(kKeyBackspace);
  gui.key(kKeyEnter);
  EXPECT_FALSE(editor.dialogs.palette.open);
  EXPECT_TRUE(editor.view.camera.forward().isApprox(-Eigen::Vector3d::UnitZ(), 1e-9));
}

TEST_F(Dialogs, SavesWhereATypedPathSaysWithoutAClick) {
  open();
  const TemporaryFolder folder;
  std::filesystem::path chosen;
  askForFile(editor, FileDialogState::Purpose::saveFile, "Save", "Save", {".png"}, "house.png",
             [&](const auto& path) { chosen = path; });
  gui.frames(3);
  gui.type((folder.path() / "gone" / "a.png").string());
  gui.key(kKeyEnter);
  EXPECT_TRUE(editor.dialogs.file.open) << "there is no such folder";
  gui.key('A', true);
  gui.type((folder.path() / "a.png").string());
  gui.key(kKeyEnter);
  EXPECT_FALSE(editor.dialogs.file.open);
  EXPECT_EQ(chosen, folder.path() / "a.png");
  EXPECT_EQ(editor.settings.last_folder, folder.path().string());
}

TEST_F(Dialogs, OpensAModelByATypedPathWithoutAClickAndSaysWhereAFolderHasNone) {
  const TemporaryFolder folder;
  folder.write("house.ifc", "");
  std::filesystem::create_directory(folder / "empty");
  editor.settings.last_folder = (folder / "empty").string();
  std::filesystem::path chosen;
  askForFile(editor, FileDialogState::Purpose::openFile, "Import", "Open", {".ifc"}, "",
             [&](const auto& path) { chosen = path; });
  gui.frames(3);
  EXPECT_TRUE(gui.says("No files of this kind in this folder"));
  gui.type((folder / "house.ifc").string());
  gui.key(kKeyEnter);
  EXPECT_EQ(chosen, folder / "house.ifc");
}

TEST_F(Dialogs, ListsOnlyFilesWithWhatIsTypedAndEnterOpensTheOneThatIsLeft) {
  const TemporaryFolder folder;
  for (const char* file : {"Küche.ifc", "Bad.ifc", "Kueche.ifc"}) folder.write(file, "");
  std::filesystem::create_directory(folder / "models");
  editor.settings.last_folder = folder.path().string();
  std::filesystem::path chosen;
  askForFile(editor, FileDialogState::Purpose::openFile, "Import", "Open", {".ifc"}, "",
             [&](const auto& path) { chosen = path; });
  gui.frames(3);
  const auto& state = editor.dialogs.file;
  EXPECT_EQ(state.listed.size(), 4U);
  gui.type("K");
  gui.frames(2);
  EXPECT_EQ(state.listed.size(), 2U) << "both kitchens";
  EXPECT_FALSE(gui.says("File not found"));
  gui.key(kKeyEnter);
  EXPECT_TRUE(state.open) << "there are two";
  gui.key('A', true);
  gui.type("nothing");
  gui.frames(2);
  EXPECT_TRUE(gui.says("No file in this folder has 'nothing' in its name"));
  gui.key('A', true);
  gui.type("mod");
  gui.key(kKeyEnter);
  gui.frames(3);
  EXPECT_EQ(state.folder, folder / "models");
  EXPECT_TRUE(gui.says("No files of this kind in this folder")) << "what was typed is gone";
  ASSERT_TRUE(gui.click("###up"));
  ASSERT_TRUE(gui.click("###name"));
  gui.type("kuche");
  gui.key(kKeyEnter);
  EXPECT_EQ(chosen, folder / "Küche.ifc");
  EXPECT_FALSE(state.open);
}

TEST_F(Dialogs, AsksBeforeUnsavedChangesAreLost) {
  open();
  gui.key('N', true);
  gui.frames(3);
  EXPECT_TRUE(editor.dialogs.unsaved);
  EXPECT_TRUE(editor.environment());
  ASSERT_TRUE(gui.click("Do not save"));
  gui.frames(2);
  EXPECT_FALSE(editor.environment());
}

TEST_F(Dialogs, ShowsAnErrorUntilItIsClosed) {
  editor.session.open("/no/such/project");
  gui.settle();
  ASSERT_EQ(editor.session.errors().size(), 1U);
  ASSERT_TRUE(gui.click("###close"));
  EXPECT_TRUE(editor.session.errors().empty());
}

TEST_F(Dialogs, NamesWhatTheExportWritesPlainlyAndSaysWhyThereAreNoPoints) {
  open();
  ASSERT_TRUE(invoke(editor, "export"));
  itemProbe().listens = true;
  itemProbe().texts.clear();
  gui.frames(3);
  itemProbe().listens = false;
  const auto drawn = [&](const char* text) {
    return std::any_of(itemProbe().texts.begin(), itemProbe().texts.end(),
                       [&](const auto& t) { return t.find(text) != std::string::npos; });
  };
  EXPECT_TRUE(drawn("The model as it was imported: "));
  EXPECT_TRUE(drawn("Simpler versions"));
  EXPECT_TRUE(drawn("Collision shapes"));
  EXPECT_FALSE(drawn("Assigned materials")) << "this format has them always";
  EXPECT_FALSE(drawn("Physical"));
  EXPECT_FALSE(drawn("file to write")) << "as the command line says it";
  EXPECT_FALSE(drawn("MSFT_lod")) << "in the tooltip only";
  ASSERT_NE(gui.find("###export-points"), nullptr);
  EXPECT_EQ(whyNot(*findAction("export-points"), Editor(verbsWithDemo(), [] {})), "Scan first, or add a point cloud");
}

TEST_F(Dialogs, EnterExports) {
  open();
  const TemporaryFolder folder;
  editor.settings.last_folder = folder.path().string();
  ASSERT_TRUE(invoke(editor, "export"));
  gui.frames(3);
  ASSERT_EQ(editor.dialogs.verb.form.problem(), "");
  const std::filesystem::path file = editor.dialogs.verb.form.find("output")->text;
  gui.key(kKeyEnter);
  gui.settle();
  EXPECT_FALSE(editor.dialogs.verb.open);
  EXPECT_TRUE(std::filesystem::exists(file)) << file;
}

TEST_F(Dialogs, ExportsUnderTheProjectsNameWhereNothingIsYet) {
  open();
  const TemporaryFolder folder;
  editor.settings.last_folder = folder.path().string();
  const auto offered = [&] {
    EXPECT_TRUE(invoke(editor, "export"));
    gui.frames(2);
    EXPECT_EQ(editor.dialogs.verb.form.problem(), "") << "one press of Run is enough";
    const std::filesystem::path file = editor.dialogs.verb.form.find("output")->text;
    editor.dialogs.verb.open = false;
    gui.frames(2);
    return file;
  };
  const auto first = offered();
  EXPECT_EQ(first, folder.path() / (editor.session.name() + ".glb"));
  std::ofstream(first) << "somebody's";
  EXPECT_NE(offered(), first);
}

TEST_F(Dialogs, ChoosesTheFormatOfAnExportFromAListThatTheEndingFollows) {
  open();
  const TemporaryFolder folder;
  editor.settings.last_folder = folder.path().string();
  ASSERT_TRUE(invoke(editor, "export"));
  gui.frames(3);
  auto& form = editor.dialogs.verb.form;
  const std::string first = form.find("output")->text;
  const auto stem = std::filesystem::path(first).stem().string();
  std::ofstream(folder / (stem + ".obj")) << "somebody's";
  ASSERT_TRUE(gui.click("###format"));
  gui.frames(2);
  ASSERT_TRUE(gui.click("###.obj"));
  gui.frames(2);
  EXPECT_EQ(form.find("output")->text, (folder / (stem + " 2.obj")).string()) << "over nothing that is there";
  EXPECT_TRUE(form.offers(*form.find("physical")));
  EXPECT_FALSE(form.offers(*form.find("collision")));
  EXPECT_TRUE(gui.says("Assigned materials"));
  form.find("output")->text = first + "x";
  EXPECT_TRUE(gui.says("No format has the ending '.glbx'"));
  EXPECT_TRUE(gui.find("###run")->disabled);
  form.find("output")->text = (folder / "HOUSE.IFC").string();
  gui.frames(2);
  EXPECT_TRUE(gui.says("IFC (.ifc)")) << "a typed ending chooses its format";
  EXPECT_FALSE(gui.find("###run")->disabled);
}

TEST_F(Dialogs, LeavesNoGapBelowAShortForm) {
  open();
  for (const char* verb : {"export", "info"}) {
    openVerbForm(editor, verb);
    gui.frames(4);
    float lowest = 0;
    for (const auto& item : itemProbe().items)
      if (item.window.find("form") != std::string::npos) lowest = std::max(lowest, item.rect.Max.y);
    ASSERT_NE(gui.find("###run"), nullptr);
    ASSERT_GT(lowest, 0);
    EXPECT_LT(gui.find("###run")->rect.Min.y - lowest, editor.px(60)) << verb;
    editor.dialogs.verb.open = false;
    gui.frames(2);
  }
}

TEST_F(Dialogs, PreferencesSayWhatScansOfUnsavedProjectsTake) {
  TemporaryFolder folder;
  setenv("XDG_DATA_HOME", folder.path().c_str(), 1);
  editor.dialogs.preferences = true;
  gui.frames(3);
  EXPECT_EQ(gui.find("###unsaved-scans"), nullptr) << "there are none";
  editor.dialogs.preferences = false;
  gui.frames(3);
  std::filesystem::create_directories(unsavedRoot() / "house" / "scans");
  std::ofstream(unsavedRoot() / "house" / "scans" / "S1.e57") << std::string(2400000, ' ');
  editor.dialogs.preferences = true;
  gui.frames(3);
  ASSERT_NE(gui.find("###unsaved-scans"), nullptr);
  EXPECT_TRUE(gui.says("2.4 MB"));
  EXPECT_FALSE(gui.says("only draws them"));
  editor.dialogs.preferences = false;
  gui.frames(3);
  std::ofstream(unsavedRoot() / "house" / "scans" / "S1.octree") << std::string(1500000, ' ');
  editor.dialogs.preferences = true;
  gui.frames(3);
  EXPECT_TRUE(gui.says("3.9 MB"));
  EXPECT_TRUE(gui.says("1.5 MB of it only draws them"));
  unsetenv("XDG_DATA_HOME");
}

TEST_F(Dialogs, AResultNamesItsFilesBelowTheirFolderAndShowsThatFolder) {
  open();
  TemporaryFolder folder;
  nlohmann::json files = nlohmann::json::array();
  for (const char* name : {"walk K1.ply", "walk K2.ply"}) {
    std::ofstream(folder.path() / name) << "ply";
    files.push_back((folder.path() / name).string());
  }
  editor.session.answers().push_back({"Exported 2 files, walk K1.ply to walk K2.ply", "", {{"files", files}}});
  gui.frames(4);
  const auto texts = gui.texts();
  EXPECT_NE(std::find(texts.begin(), texts.end(), "walk K2.ply"), texts.end()) << "without its folder";
  EXPECT_NE(gui.find("###answer-folder"), nullptr);
  std::filesystem::remove(folder.path() / "walk K1.ply");
  gui.frames(2);
  EXPECT_EQ(gui.find("###answer-folder"), nullptr) << "what is not there is listed as a figure";
}

TEST_F(Dialogs, AShortResultHasASmallDialogAndEnterSavesAPicture) {
  open();
  editor.session.answers().push_back(
      {"Exported", "2 files", {{"file", "a.glb"}, {"bytes", 2411000}, {"triangles", 23842}}});
  gui.frames(4);
  EXPECT_TRUE(gui.says("2.4 MB"));
  EXPECT_TRUE(gui.says(groupedDigits(23842)));
  const auto* dialog = gui.find("###close-answer");
  ASSERT_NE(dialog, nullptr);
  const auto* window = ImGui::FindWindowByName(dialog->window.c_str());
  ASSERT_NE(window, nullptr);
  EXPECT_LT(window->Size.y, 260) << "two lines of result";
  EXPECT_LT(window->Size.x, 520);
  ASSERT_TRUE(gui.click("###close-answer"));
  gui.frames(2);
  struct Picture : SceneView {
    std::uint64_t texture(const ViewState&, int, int, bool) override { return 0; }
    std::uint64_t texture(const std::shared_ptr<const PixelPicture>&) override { return 0; }
  };
  ASSERT_TRUE(invoke(editor, "picture"));
  gui.frames(3);
  gui.key(kKeyEnter);
  gui.frames(3);
  EXPECT_FALSE(editor.dialogs.file.open) << "without OpenGL there is nothing to save";
  EXPECT_TRUE(gui.says("Nothing draws pictures")) << "it may be cut, and says why in a tooltip";
  Picture picture;
  editor.scene = &picture;
  gui.frames(2);
  ASSERT_TRUE(gui.click("###shot-size"));
  gui.key(kKeyEnter);
  gui.frames(3);
  EXPECT_FALSE(editor.dialogs.file.open) << "it belongs to the open list";
  EXPECT_TRUE(editor.shots.open);
  gui.key(kKeyEnter);
  gui.frames(3);
  EXPECT_TRUE(editor.dialogs.file.open) << "it asks where to";
  editor.scene = nullptr;
}

TEST_F(Dialogs, APictureOfTheViewHasItsLabelsUnlessTheyAreLeftOut) {
  open();
  struct Picture : SceneView {
    std::uint64_t texture(const ViewState&, int, int, bool) override { return 0; }
    std::uint64_t texture(const std::shared_ptr<const PixelPicture>&) override { return 0; }
    Result<PixelPicture> pixels(const ViewState&, int width, int height) override {
      return PixelPicture{width, height, std::vector<std::array<std::uint8_t, 4>>(std::size_t(width) * height)};
    }
    void drawOver(PixelPicture& picture, ImDrawData& drawing) override {
      ++drawn;
      EXPECT_EQ(static_cast<int>(drawing.DisplaySize.x * drawing.FramebufferScale.x), picture.width);
      EXPECT_EQ(static_cast<int>(drawing.DisplaySize.y * drawing.FramebufferScale.y), picture.height);
      vertices = drawing.TotalVtxCount;
    }
    int drawn = 0, vertices = 0;
  };
  Picture picture;
  TemporaryFolder folder;
  editor.scene = &picture;
  ASSERT_TRUE(invoke(editor, "picture"));
  gui.frames(3);
  const auto save = [&] {
    ASSERT_TRUE(gui.click("###shot-make"));
    gui.frames(2);
    ASSERT_TRUE(editor.dialogs.file.open);
    editor.dialogs.file.open = false;
    editor.dialogs.file.done(folder.path() / "view.png");
    gui.frames(4);
    EXPECT_FALSE(editor.shots.made.empty()) << editor.shots.problem;
  };
  const auto camera = editor.view.camera;
  const auto size = editor.view.size;
  ASSERT_NO_FATAL_FAILURE(save());
  EXPECT_EQ(picture.drawn, 1);
  EXPECT_GT(picture.vertices, 0);
  EXPECT_EQ(editor.view.camera, camera);
  EXPECT_EQ(editor.view.size, size);
  const auto* unnamed = ImGui::FindWindowByName("Debug##Default");
  EXPECT_TRUE(unnamed == nullptr || !unnamed->Active);
  ASSERT_TRUE(gui.click("###shot-labels"));
  ASSERT_NO_FATAL_FAILURE(save());
  EXPECT_EQ(picture.drawn, 1);
  editor.scene = nullptr;
}

TEST_F(Dialogs, NamesTheTaskOfAnExportShortly) {
  open();
  const TemporaryFolder folder;
  editor.settings.last_folder = folder.path().string();
  ASSERT_TRUE(invoke(editor, "export"));
  gui.frames(3);
  ASSERT_TRUE(gui.click("###run"));
  gui.settle();
  ASSERT_FALSE(editor.session.finished().empty());
  EXPECT_EQ(editor.session.finished().front().title, "Export model");
}

}  // namespace
}  // namespace standpoint
