// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/shell/actions.h"
#include "editor/shell/escape.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/keyboard.h"
#include "editor/widgets/widgets.h"
#include "item_probe.h"
#include "source_text.h"

namespace standpoint {
namespace {

constexpr int kSpace = ' ';

// A list of metals with one that cannot be had, and a list that is searched, on an otherwise empty window.
class DropDown : public ::testing::Test {
 protected:
  DropDown() {
    gui.draws = [this] {
      closeTopmost(editor);
      ImGui::SetNextWindowSize({400, 300});
      ImGui::SetNextWindowPos({100, 100});
      ImGui::Begin("lists");
      ImGui::SetNextItemWidth(200);
      if (ui::beginDropDown("###metal", metals[static_cast<std::size_t>(metal)])) {
        for (int i = 0; i < static_cast<int>(metals.size()); ++i) {
          ImGui::BeginDisabled(i == 2);
          if (ui::choice(metals[static_cast<std::size_t>(i)], i == metal)) metal = i, ++taken;
          ImGui::EndDisabled();
        }
        ui::endDropDown();
      }
      if (ui::beginDropDown("###searched", found.c_str(), ImGuiComboFlags_HeightLargest)) {
        if (ImGui::IsWindowAppearing()) ui::focusNext();
        ui::searchField("filter", "Search", filter);
        for (const char* name : metals)
          if (std::string(name).find(filter) != std::string::npos && ui::choice((std::string(name) + "###f").c_str()))
            found = name;
        ui::endDropDown();
      }
      was_open = ui::dropDownIsOpen();
      ImGui::End();
    };
    gui.frames(3);
  }
  bool open() { return ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId); }
  void openByPointer(const char* id) {
    ASSERT_TRUE(gui.click(id));
    gui.frames(2);
    ASSERT_TRUE(open());
  }

  Editor editor{{}, [] {}};
  GuiDriver gui{editor};
  std::array<const char*, 6> metals = {"Aluminium", "Brass", "Copper", "Iron", "Lead", "Übermetall"};
  int metal = 1, taken = 0;
  bool was_open = false;
  std::string filter, found;
};

TEST_F(DropDown, IsGoneThroughByArrowsPastWhatCannotBeHadAndTakenByEnter) {
  openByPointer("###metal");
  gui.key(kKeyDown);
  EXPECT_EQ(metal, 1) << "Enter takes, no arrow";
  gui.key(kKeyEnter);
  EXPECT_EQ(metal, 3) << "from the chosen one over the disabled one";
  EXPECT_FALSE(open());
  openByPointer("###metal");
  gui.key(kKeyUp);
  gui.key(kKeyUp);
  gui.key(kKeyUp);
  gui.key(kKeyPadEnter);
  EXPECT_EQ(metal, 0) << "it stops at the first";
}

TEST_F(DropDown, GoesToEitherEnd) {
  openByPointer("###metal");
  gui.key(kKeyEnd);
  gui.key(kKeyEnter);
  EXPECT_EQ(metal, 5);
  openByPointer("###metal");
  gui.key(kKeyHome);
  gui.key(kKeyEnter);
  EXPECT_EQ(metal, 0);
}

TEST_F(DropDown, GoesToTheNextEntryThatBeginsWithALetterWithoutItsMarks) {
  openByPointer("###metal");
  gui.type("u");
  gui.key(kKeyEnter);
  EXPECT_EQ(metal, 5);
  openByPointer("###metal");
  gui.type("L");
  gui.key(kKeyEnter);
  EXPECT_EQ(metal, 4);
  openByPointer("###metal");
  gui.type("c");
  gui.key(kKeyEnter);
  EXPECT_EQ(metal, 4) << "it cannot be had";
}

TEST_F(DropDown, IsClosedByEscapeAndKeepsTheKeyboardUntilSomethingElseIsPressed) {
  openByPointer("###metal");
  gui.key(kKeyEnd);
  gui.key(kKeyEscape);
  EXPECT_FALSE(open());
  EXPECT_EQ(metal, 1);
  gui.key(kKeyEnter);
  EXPECT_FALSE(open()) << "Enter is the dialog's";
  for (const int key : {kSpace, kKeyDown}) {
    gui.key(key);
    ASSERT_TRUE(open()) << key;
    EXPECT_EQ(metal, 1);
    gui.key(kKeyEscape);
    ASSERT_FALSE(open());
  }
  gui.type("x");
  gui.key(kKeyDown);
  EXPECT_FALSE(open()) << "another key ended it";
}

TEST_F(DropDown, LeavesTheKeyboardToOthersAfterAClick) {
  openByPointer("###metal");
  ASSERT_TRUE(gui.click("Iron"));
  EXPECT_EQ(metal, 3);
  gui.frames(2);
  EXPECT_FALSE(was_open);
  gui.key(kKeyDown);
  EXPECT_FALSE(open());
  openByPointer("###metal");
  gui.moveTo({700, 700});
  gui.press();
  gui.frames(2);
  EXPECT_FALSE(open());
  EXPECT_FALSE(was_open);
}

TEST_F(DropDown, TakesTheFirstOfWhatIsSearched) {
  openByPointer("###searched");
  gui.type("r");
  gui.key(kKeyEnter);
  EXPECT_EQ(found, "Brass");
  openByPointer("###searched");
  gui.key(kKeyDown);
  gui.key(kKeyDown);
  gui.key(kKeyEnter);
  EXPECT_EQ(found, "Copper") << "of those with an r, by arrows while the field has the letters";
}

class DropDowns : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    gui.frames(2);
  }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(DropDowns, OfTheViewGoByKeysAndLeaveItsToolsAlone) {
  editor.workspace = Workspace::environment;
  editor.view.tool = Tool::measure;
  editor.view.measuring = {MeasurementKind::distance, {}, {}};
  gui.frames(3);
  ASSERT_EQ(editor.view.colour, ColourMode::model);
  ASSERT_TRUE(gui.click("###colour"));
  gui.frames(2);
  gui.key(kKeyDown);
  gui.key(kKeyEnter);
  EXPECT_EQ(editor.view.colour, ColourMode::material);
  EXPECT_EQ(editor.view.tool, Tool::measure);
  gui.key(kKeyDown);
  ASSERT_TRUE(ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId));
  gui.key(kKeyEscape);
  EXPECT_EQ(editor.view.tool, Tool::measure) << "Esc closed the list alone";
}

// So that all have the same keys.
TEST(DropDownSources, MakeNoOtherDropDowns) {
  for (const auto& file : std::filesystem::recursive_directory_iterator(SOURCE_DIR "/editor")) {
    if (file.path().extension() != ".cpp" || file.path().filename() == "drop_down.cpp") continue;
    EXPECT_EQ(allOf(file.path()).find("ImGui::BeginCombo"), std::string::npos) << file.path();
  }
}

}  // namespace
}  // namespace standpoint
