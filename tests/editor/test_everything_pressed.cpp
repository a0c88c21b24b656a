// SPDX-License-Identifier: GPL-3.0-or-later
// A monkey at the editor: each item, action and form, with and without a document.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>

#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/panels/panels.h"
#include "editor/shell/actions.h"
#include "editor/shell/dialogs.h"
#include "editor/shell/shell.h"
#include "item_probe.h"

namespace standpoint {
namespace {

constexpr int kEscapeKey = 256;

class EverythingPressed : public ::testing::Test {
 protected:
  void open() {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    editor.session.wait();
  }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

void closeEverything(Editor& editor, GuiDriver& gui) {
  editor.dialogs = DialogStates();
  editor.quit = false;
  gui.frames(2);
  for (int i = 0; i < 3; ++i) gui.key(kEscapeKey);
  gui.settle();
  editor.session.errors().clear();
  gui.frames(2);
}

// Every item that can be reached in one workspace, pressed one after the other.
void pressEverything(Editor& editor, GuiDriver& gui, const std::function<void()>& restore, int& pressed) {
  std::set<ImGuiID> done;
  const auto dialogs_folder = std::filesystem::path(BINARY_DIR) / "test_editor_gui";
  std::filesystem::create_directories(dialogs_folder);
  editor.settings.last_folder = dialogs_folder.string();
  while (true) {
    ImGuiID next = 0;
    for (const auto& item : itemProbe().items)
      if (!item.disabled && done.insert(item.id).second) {
        next = item.id;
        break;
      }
    if (next == 0) return;
    gui.activate(next);
    gui.frames(2);
    ++pressed;
    if (editor.environment()) {
      ASSERT_EQ(validate(*editor.environment()), "") << itemProbe().labels[next];
    }
    closeEverything(editor, gui);
    restore();
    gui.frames(2);
  }
}

TEST_F(EverythingPressed, SurvivesEveryItemBeingPressedOnAnEmptyProject) {
  int pressed = 0;
  for (int w = 0; w < kWorkspaces; ++w) {
    const auto restore = [&] { editor.workspace = static_cast<Workspace>(w); };
    restore();
    gui.frames(2);
    pressEverything(editor, gui, restore, pressed);
  }
  EXPECT_GT(pressed, 40);
}

TEST_F(EverythingPressed, SurvivesEveryItemBeingPressedOnADocument) {
  open();
  int pressed = 0;
  for (const auto& panel : panels()) {
    for (int w = 0; w < kWorkspaces; ++w) {
      if (panel.area[static_cast<std::size_t>(w)] == Area::none) continue;
      const auto restore = [&] {
        if (!editor.environment()) open();
        editor.workspace = static_cast<Workspace>(w);
        editor.wanted_tab[static_cast<std::size_t>(panel.area[static_cast<std::size_t>(w)])] = panel.id;
        editor.select(productNamed(*editor.environment(), "Wall east OG"), true);
        editor.survey.station = 0;
      };
      restore();
      gui.frames(3);
      pressEverything(editor, gui, restore, pressed);
      break;
    }
  }
  EXPECT_GT(pressed, 200);
}

TEST_F(EverythingPressed, RunsEveryActionWithAndWithoutADocument) {
  for (const bool with_document : {false, true}) {
    for (const auto& action : actions()) {
      if (with_document && !editor.environment()) open();
      invoke(editor, action.id);
      gui.frames(3);
      closeEverything(editor, gui);
    }
  }
}

TEST_F(EverythingPressed, OpensTheFormOfEveryVerb) {
  open();
  for (const auto& verb : editor.session.verbs()) {
    openVerbForm(editor, verb.name);
    gui.frames(3);
    EXPECT_NE(gui.find("###run"), nullptr) << verb.name;
    for (const auto& parameter : verb.parameters) {
      const bool drawn = std::any_of(itemProbe().items.begin(), itemProbe().items.end(),
                                     [](const GuiItem& i) { return i.label.find("###value") != std::string::npos; });
      EXPECT_TRUE(drawn) << verb.name << " " << parameter.name;
    }
    closeEverything(editor, gui);
  }
}

}  // namespace
}  // namespace standpoint
