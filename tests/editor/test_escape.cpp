// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <functional>
#include <random>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/panels/panels.h"
#include "editor/shell/actions.h"
#include "editor/shell/dialogs.h"
#include "editor/shell/escape.h"
#include "editor/widgets/keyboard.h"
#include "editor/widgets/number_field.h"
#include "item_probe.h"

namespace standpoint {
namespace {

int openPopups() { return ImGui::GetCurrentContext()->OpenPopupStack.Size; }

class Escape : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    editor.session.wait();
    gui.frames(2);
  }
  void clickBeside() {
    gui.moveTo({3, ImGui::GetIO().DisplaySize.y - 3});
    gui.press();
    gui.frames(3);
  }
  // What lies below must stay: a tool, and a selection.
  void layOut() {
    editor.view.tool = Tool::measure;
    editor.select(2, false);
    gui.frames(2);
  }
  void expectBelowUntouched(const std::string& what) {
    EXPECT_EQ(editor.view.tool, Tool::measure) << what;
    EXPECT_FALSE(editor.selection.empty()) << what;
  }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

struct Opened {
  const char* name;
  void (*open)(Editor&);
  bool closes_at_click;
};

// Every modal, and every popup that no item of a panel opens.
const Opened kOpened[] = {
    {"file dialog",
     [](Editor& e) { askForFile(e, FileDialogState::Purpose::openFile, "Open", "Open", {}, "", [](const auto&) {}); },
     true},
    {"form of a verb", [](Editor& e) { openVerbForm(e, "station"); }, true},
    {"palette", [](Editor& e) { openPalette(e); }, true},
    {"shortcuts", [](Editor& e) { e.dialogs.shortcuts = true; }, true},
    {"preferences", [](Editor& e) { e.dialogs.preferences = true; }, true},
    {"about", [](Editor& e) { e.dialogs.about = true; }, true},
    {"unsaved changes", [](Editor& e) { e.dialogs.unsaved = true; }, true},
    {"error",
     [](Editor& e) {
       e.session.errors().push_back({"Import", {ErrorKind::unusable, "broken", "x"}});
     },
     true},
    {"recovery", [](Editor& e) { e.dialogs.recovery.resize(1); }, false},
};

TEST_F(Escape, ClosesEveryDialogAndNothingBelowIt) {
  for (const auto& opened : kOpened) {
    layOut();
    opened.open(editor);
    gui.frames(3);
    ASSERT_EQ(openPopups(), 1) << opened.name;
    gui.key(kKeyEscape);
    gui.frames(3);
    EXPECT_EQ(openPopups(), 0) << opened.name;
    expectBelowUntouched(opened.name);
  }
}

TEST_F(Escape, AClickBesideClosesEveryDialogThatLosesNothing) {
  for (const auto& opened : kOpened) {
    layOut();
    opened.open(editor);
    gui.frames(3);
    clickBeside();
    EXPECT_EQ(openPopups(), opened.closes_at_click ? 0 : 1) << opened.name;
    expectBelowUntouched(opened.name);
    gui.key(kKeyEscape);
    gui.frames(3);
    editor.dialogs = DialogStates();
    gui.frames(2);
  }
}

TEST_F(Escape, AFormWithInputShakesAtAClickBesideAndStays) {
  openVerbForm(editor, "station");
  gui.frames(3);
  editor.dialogs.verb.form.find("add")->given = true;
  editor.dialogs.verb.form.find("add")->text = "S9";
  clickBeside();
  EXPECT_TRUE(editor.dialogs.verb.open);
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_FALSE(editor.dialogs.verb.open) << "Esc is Cancel";
}

TEST_F(Escape, TheFirstOneInAFormTakesBackTheEditAndTheSecondClosesTheForm) {
  openVerbForm(editor, "station");
  editor.dialogs.verb.form.find("add")->given = true;
  gui.frames(3);
  for (const auto& item : itemProbe().items)
    if (item.label == "###value" && !item.disabled && !item.clipped) {
      gui.moveTo(item.rect.GetCenter());
      gui.press();
      break;
    }
  ASSERT_TRUE(ImGui::GetIO().WantTextInput);
  gui.key(kKeyEscape);
  EXPECT_TRUE(editor.dialogs.verb.open);
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_FALSE(editor.dialogs.verb.open);
}

TEST_F(Escape, ClosesEveryMenu) {
  for (const char* menu : {"File", "Edit", "View", "Run", "Help"}) {
    layOut();
    ASSERT_TRUE(gui.click(menu)) << menu;
    gui.frames(2);
    ASSERT_EQ(openPopups(), 1) << menu;
    gui.key(kKeyEscape);
    gui.frames(3);
    EXPECT_EQ(openPopups(), 0) << menu;
    expectBelowUntouched(menu);
  }
}

TEST_F(Escape, ClosesAMenuBeforeItEndsTheChoiceOfAPlaceBelowIt) {
  layOut();
  editor.view.teleport.by_click = true;
  ASSERT_TRUE(gui.click("View"));
  gui.frames(2);
  gui.key(kKeyEscape);
  gui.frames(3);
  EXPECT_EQ(openPopups(), 0);
  EXPECT_TRUE(editor.view.teleport.active());
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_FALSE(editor.view.teleport.active());
}

TEST_F(Escape, AClickBesideClosesEveryMenu) {
  for (const char* menu : {"File", "Edit", "View", "Run", "Help"}) {
    layOut();
    ASSERT_TRUE(gui.click(menu)) << menu;
    gui.frames(2);
    clickBeside();
    EXPECT_EQ(openPopups(), 0) << menu;
    expectBelowUntouched(menu);
  }
}

TEST_F(Escape, ClosesTheMenusOfARowAndOfTheView) {
  layOut();
  const auto* row = gui.find("###row");
  const auto* scene = gui.find("###scene");
  ASSERT_TRUE(row != nullptr && scene != nullptr);
  for (const ImVec2 place : {row->rect.GetCenter(), scene->rect.GetCenter()}) {
    for (const bool by_click : {false, true}) {
      layOut();
      gui.moveTo(place);
      gui.press(1);
      gui.frames(2);
      ASSERT_EQ(openPopups(), 1);
      if (by_click)
        clickBeside();
      else
        gui.key(kKeyEscape);
      gui.frames(2);
      EXPECT_EQ(openPopups(), 0);
      EXPECT_EQ(editor.view.tool, Tool::measure);
    }
  }
}

// Whatever any item of any panel opens: lists, menus of rows, dialogs.
TEST_F(Escape, ClosesWhateverAnItemOfAPanelOpens) {
  std::set<ImGuiID> pressed;
  std::set<std::string> opened;
  for (const auto& panel : panels())
    for (int w = 0; w < kWorkspaces; ++w) {
      const auto area = panel.area[static_cast<std::size_t>(w)];
      if (area == Area::none) continue;
      const auto show = [&] {
        editor.workspace = static_cast<Workspace>(w);
        editor.wanted_tab[static_cast<std::size_t>(area)] = panel.id;
        if (!editor.environment()) {
          editor.session.start("demo", nlohmann::json::object());
          gui.settle();
        }
        editor.select(2, false);
        gui.frames(3);
      };
      show();
      for (;;) {
        const auto& items = itemProbe().items;
        const auto next = std::find_if(items.begin(), items.end(), [&](const GuiItem& item) {
          return !item.clipped && !item.disabled && !pressed.contains(item.id);
        });
        if (next == items.end()) break;
        pressed.insert(next->id);
        const auto label = itemProbe().labels[next->id];
        gui.moveTo(next->rect.GetCenter());
        gui.press();
        gui.frames(2);
        if (openPopups() > 0) opened.insert(label);
        for (int i = 0; openPopups() > 0 && i < 4; ++i) {
          const int before = openPopups();
          const bool edits = escapeLayer(editor) == EscapeLayer::text;
          gui.key(kKeyEscape);
          gui.frames(2);
          if (!edits) {
            EXPECT_LT(openPopups(), before) << label;
          }
        }
        editor.dialogs = DialogStates();
        editor.quit = false;
        gui.settle();
        editor.session.errors().clear();
        gui.key(kKeyEscape);
        show();
      }
      break;
    }
  EXPECT_GT(opened.size(), 20U);
}

TEST_F(Escape, GoesFromTheEditThroughTheToolToTheSelection) {
  layOut();
  ASSERT_TRUE(gui.click("###search"));
  EXPECT_EQ(escapeLayer(editor), EscapeLayer::text);
  gui.key(kKeyEscape);
  expectBelowUntouched("text");
  gui.key(kKeyEscape);
  EXPECT_EQ(editor.view.tool, Tool::select);
  EXPECT_FALSE(editor.selection.empty());
  gui.key(kKeyEscape);
  EXPECT_TRUE(editor.selection.empty());
  EXPECT_EQ(escapeLayer(editor), EscapeLayer::none);
}

// Whatever was pressed, eight of them lead back to the plain state.
TEST_F(Escape, EightOfThemReachThePlainState) {
  std::mt19937 random(7);
  for (int round = 0; round < 25; ++round) {
    editor.workspace = static_cast<Workspace>(round % kWorkspaces);
    gui.frames(3);
    for (int i = 0; i < 12; ++i) {
      const auto& items = itemProbe().items;
      const auto& item = items[random() % items.size()];
      if (item.disabled || item.label.find("quit") != std::string::npos) continue;
      if (random() % 2 == 0) {
        gui.activate(item.id);
      } else {
        gui.moveTo(item.rect.GetCenter());
        gui.press(random() % 5 == 0 ? 1 : 0);
      }
      gui.frames(2);
    }
    for (const auto& task : editor.session.running()) task->progress().cancel();  // a scan would take minutes
    gui.settle();
    editor.session.errors().clear();
    for (int i = 0; i < 8; ++i) {
      gui.key(kKeyEscape);
      gui.frames(2);
    }
    EXPECT_EQ(escapeLayer(editor), EscapeLayer::none) << "round " << round;
    EXPECT_EQ(openPopups(), 0) << "round " << round;
    if (!editor.environment()) SetUp();
  }
}

TEST_F(Escape, TakesBackADragInTheView) {
  const auto before = editor.view.camera;
  const auto* window = ImGui::FindWindowByName("###viewport");
  gui.moveTo({window->Pos.x + window->Size.x / 2, window->Pos.y + window->Size.y / 2});
  ImGui::GetIO().MouseDown[0] = true;
  gui.frame();
  for (int i = 0; i < 4; ++i) {
    ImGui::GetIO().MousePos.x += 20;
    gui.frame();
  }
  ASSERT_NE(editor.view.camera.azimuth_rad, before.azimuth_rad);
  editor.select(2, false);
  gui.key(kKeyEscape);
  EXPECT_EQ(editor.view.camera, before);
  EXPECT_FALSE(editor.selection.empty());
  ImGui::GetIO().MousePos.x += 20;
  gui.frame();
  ImGui::GetIO().MouseDown[0] = false;
  gui.frames(2);
  EXPECT_EQ(editor.view.camera, before) << "the drag is over though the button was held";
  EXPECT_FALSE(editor.selection.empty()) << "and it was no click";
}

TEST_F(Escape, AnErrorWaitsUntilTheOpenDialogIsClosed) {
  openVerbForm(editor, "station");
  gui.frames(3);
  editor.session.errors().push_back({"Import", {ErrorKind::unusable, "broken", "x"}});
  gui.frames(5);
  EXPECT_EQ(openPopups(), 1);
  EXPECT_NE(gui.find("###run"), nullptr) << "the form stays";
  gui.key(kKeyEscape);
  gui.frames(3);
  EXPECT_EQ(openPopups(), 1) << "now the error";
  EXPECT_EQ(gui.find("###run"), nullptr);
}

TEST_F(Escape, BringsBackTheFormThatAskedForAFile) {
  openVerbForm(editor, "export");
  gui.frames(3);
  ASSERT_TRUE(gui.click("###browse"));
  gui.frames(3);
  ASSERT_TRUE(editor.dialogs.file.open);
  gui.key(kKeyEscape);
  gui.frames(3);
  EXPECT_FALSE(editor.dialogs.file.open);
  EXPECT_TRUE(editor.dialogs.verb.open);
}

}  // namespace
}  // namespace standpoint
